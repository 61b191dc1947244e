// SPDX-License-Identifier: MIT
// Letters, names and quotations in the text of series: ASCII, whatever the locale.
#pragma once

#include <string>
#include <string_view>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
constexpr bool is_name_character(char c) { return is_letter(c) || is_digit(c) || c == '\''; }

// For a message of one printable line.
inline std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) out += c >= 0x20 && c < 0x7f ? c : '?';
  return out + (text.size() > 40 ? "...'" : "'");
}

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
