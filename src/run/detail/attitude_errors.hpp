// SPDX-License-Identifier: MIT
// What a covariance of an attitude says about the three axes.
#pragma once

#include <cmath>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The standard error about axis k. The variance of what is known nearly exactly may be rounded to
// below 0: that is 0. What is not a number stays so.
inline double error_about(const Mat3& c, int k) { return c(k, k) < 0.0 ? 0.0 : std::sqrt(c(k, k)); }

// Whether an error is more than a radian, or is not known.
inline bool is_open(const Mat3& c) { return !(c(0, 0) <= 1.0 && c(1, 1) <= 1.0 && c(2, 2) <= 1.0); }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
