// SPDX-License-Identifier: MIT
// Where the keys of a TOML document stand in its text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scenario/detail/toml.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A name or an index.
using KeyStep = std::variant<std::string, std::size_t>;
using KeyPath = std::vector<KeyStep>;

// Bytes from begin on, end not included.
struct TextSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// From lines and code points, as toml++ counts, to bytes.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  std::size_t place(const toml::source_position& at) const;
  TextSpan span(const toml::source_region& region) const {
    return {place(region.begin), place(region.end)};
  }
  // The start of the line of a byte, and that of the next one.
  std::size_t line_start(std::size_t at) const;
  std::size_t next_line(std::size_t at) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;
};

// Null where there is none.
const toml::node* node_at(const toml::table& file, const KeyPath& path);

// The headers [a.b] of tables, in the order of the text; with the path of each.
struct TomlHeader {
  std::size_t begin;  // byte of its first bracket
  KeyPath path;
};
std::vector<TomlHeader> toml_headers(const toml::table& file, std::string_view text,
                                     const TextLines& lines);

// What can be parsed, or nothing.
std::optional<toml::table> parsed_toml(std::string_view text);
// Of equal values.
bool are_equal(const toml::node& a, const toml::node& b);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
