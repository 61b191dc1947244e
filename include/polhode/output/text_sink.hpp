// SPDX-License-Identifier: MIT
// text_sink: most of an output format of text: a head that says where the file is from, a line for
// each row, and perhaps an end.
//
// Units       those that the columns name.
// Domain      a file that goes on is cut back to its position; its head must be the same. The
//             comments of a head begin with the start of their style.
// Accuracy    what `row` appends.
// Errors      DomainError as open_sink; OutputError when writing fails.
// Cost        a call of `row` per row, a system call per block.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "polhode/output/output_format.hpp"
#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {

// How a format writes comments.
struct CommentStyle {
  std::string_view start;
  std::size_t longest = std::string_view::npos;  // text in one line
  bool ascii = false;                            // what is beyond it becomes ?
  // What the first line behind the head begins with. Empty: that is the first line that is no
  // comment, and it names the columns.
  std::string_view head_end = {};
};

// One line or more for each line of the text, with `lead` in front.
void append_comment(std::string& out, const CommentStyle& style, std::string_view lead,
                    std::string_view text);
// Version, title, notes, citations and scenario.
void append_origin(std::string& out, const CommentStyle& style, const Provenance& provenance);

// Why a complete file is not one with this head: "of another scenario". Empty: it is.
std::string text_difference(const std::string& path, const CommentStyle& style,
                            const std::string& head);

// `closing`: how comments look behind the rows, where a format may have them there.
std::unique_ptr<Sink> text_sink(
    const SinkRequest& request, const std::string& head,
    std::function<void(std::string& out, std::span<const double> row)> row, std::string end = {},
    const CommentStyle& closing = {});

}  // namespace v0
}  // namespace polhode
