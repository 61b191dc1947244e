// SPDX-License-Identifier: MIT
// SpinAxis: the state of a body of which only the direction of its spin matters.
//
// Equations   s, the unit vector along the angular momentum.
// Domain      any direction.
// Accuracy    |s| = 1 to rounding.
// Errors      DomainError for a direction of no length.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

struct SpinAxis {
  Vec3 s;

  constexpr bool operator==(const SpinAxis&) const = default;
};
template <class Visit>
void each_number(SpinAxis& axis, Visit&& visit) {
  for (double* const x : {&axis.s.x, &axis.s.y, &axis.s.z}) visit(*x);
}

// DomainError for a vector of no length.
SpinAxis spin_axis(const Vec3& direction);

}  // namespace secular
}  // namespace v0
}  // namespace polhode
