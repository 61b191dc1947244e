// SPDX-License-Identifier: MIT
// Numbers as text: the shortest decimal that reads back to the same double.
#pragma once

#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

constexpr int longest_number = 32;  // "-2.2250738585072014e-308" has 24 characters

// Writes to out[0 .. longest_number) what std::to_chars(value) would, in half its time, but "nan"
// for a NaN of any sign, and returns the end.
char* write_number(char* out, double value);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
