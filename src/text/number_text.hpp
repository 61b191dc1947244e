// SPDX-License-Identifier: MIT
// Numbers as text: the shortest decimal that reads back to the same double.
#pragma once

#include <charconv>

#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr int longest_number = 32;  // "-2.2250738585072014e-308" has 24 characters

// Writes to out[0 .. longest_number) and returns the end.
inline char* write_number(char* out, double value) {
  return std::to_chars(out, out + longest_number, value).ptr;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
