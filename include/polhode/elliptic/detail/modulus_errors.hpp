// SPDX-License-Identifier: MIT
// Errors of pairs that are not the members of a modulus.
#pragma once

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {
[[noreturn]] void throw_bad_ratio(double a, double b);
[[noreturn]] void throw_bad_modulus_pair(double m, double m1);
[[noreturn]] void throw_bad_any_pair(double m, double m1);
}  // namespace detail
}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
