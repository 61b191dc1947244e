// SPDX-License-Identifier: MIT
// Whether directions have a mean: their resultant against that of directions at random.
#pragma once

#include <cmath>

namespace polhode {
inline namespace v0 {
namespace detail {

// Of n directions in a plane with a resultant of length r: they agree, or the chance exp(-n r^2)
// of as long a resultant at random (Rayleigh) is small.
inline bool tells_a_mean(double r, double n) { return r >= 0.9 || n * r * r > 6.907755278982137; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
