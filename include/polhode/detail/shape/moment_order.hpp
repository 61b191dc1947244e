// SPDX-License-Identifier: MIT
// The order in which arrays hold the mass integrals of one degree.
//
// Equations   M_abc = int x^a y^b z^c dm, a + b + c the degree, at moment_place(b, c).
// Domain      b, c >= 0.
// Accuracy    exact.
// Cost        none at run time where b and c are constants.
#pragma once

#include <array>
#include <cstddef>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace shape {

// The place of x^a y^b z^c among the moments of degree a + b + c. It does not depend on a.
constexpr std::size_t moment_place(int b, int c) {
  const auto n = static_cast<std::size_t>(b) + static_cast<std::size_t>(c);
  return n * (n + 1) / 2 + static_cast<std::size_t>(c);
}
// How many moments, or coefficients of a homogeneous polynomial, a degree has.
constexpr std::size_t moment_count(int degree) { return moment_place(0, degree) + 1; }

template <Number T, int degree>
using BasicMoments = std::array<T, moment_count(degree)>;

}  // namespace shape
}  // namespace v0
}  // namespace polhode
