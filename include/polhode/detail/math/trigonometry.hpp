// SPDX-License-Identifier: MIT
// Sine and cosine together, as one value.
//
// Units       radians.
// Domain      any angle of double; NaN for infinities.
// Accuracy    that of <cmath>.
// Cost        one call of the C library's sincos where the compiler merges the two.
#pragma once

#include <cmath>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

template <class T>
struct SinCos {
  T sin;
  T cos;
};

// DoubleDouble and Dual have their own, found by argument-dependent lookup: kernels write
// `const auto [s, c] = sincos(x);` for every number type.
inline SinCos<double> sincos(double x) { return {std::sin(x), std::cos(x)}; }

}  // namespace v0
}  // namespace polhode
