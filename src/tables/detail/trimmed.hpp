// SPDX-License-Identifier: MIT
// A text without what stands around it: blanks at its ends, a byte order mark.
#pragma once

#include <string_view>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t") {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// Editors of Windows begin a text in UTF-8 with a mark of three bytes.
inline std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
