// SPDX-License-Identifier: MIT
// The lines of a text output before its rows that say where it is from; and whether an output that
// is complete is from the same.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct CommentStyle {
  std::string_view start;
  std::size_t longest = std::string_view::npos;  // text in one line
  bool ascii = false;                            // what is beyond it becomes ?
};
constexpr CommentStyle csv_comments{"# "};
constexpr CommentStyle aem_comments{"COMMENT ", 230, true};  // the standard: 254 characters

// One line or more for each line of the text, with `lead` in front.
void append_comment(std::string& out, const CommentStyle& style, std::string_view lead,
                    std::string_view text);
// Version, title, notes, citations and scenario.
void append_origin(std::string& out, const CommentStyle& style, const Provenance& provenance);

// Why a complete output is not that of this scenario, of its files or with these columns: "of
// another scenario". Empty: it is.
std::string foreign_origin(const std::string& path, const std::vector<ColumnGroup>& groups,
                           const Provenance& provenance);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
