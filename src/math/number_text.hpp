// SPDX-License-Identifier: MIT
// Numbers in error sentences: the shortest text that reads back as the same double.
#pragma once

#include <charconv>
#include <cstddef>
#include <initializer_list>
#include <string>

namespace polhode {
inline namespace v0 {
namespace detail {

inline std::string number_text(double x) {
  char buffer[32];
  const std::to_chars_result end = std::to_chars(buffer, buffer + sizeof buffer, x);
  return std::string(buffer, end.ptr);
}

// "1 start", "3 starts".
inline std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

// To three digits: "1.23e+04".
inline std::string rounded_text(double x) {
  char buffer[32];
  const std::to_chars_result end =
      std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, 3);
  return std::string(buffer, end.ptr);
}

// "(1, 2.5, nan)"
inline std::string tuple_text(std::initializer_list<double> values) {
  std::string text;
  for (const double x : values) text += (text.empty() ? "(" : ", ") + number_text(x);
  return text + ")";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
