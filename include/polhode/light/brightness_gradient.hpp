// SPDX-License-Identifier: MIT
// A brightness with its first derivatives.
//
// Units       brightness in units of area; by an axis, in units of length.
// Domain      to_sun and to_observer along the axes of the body, of any length: derivatives are by
//             their components as given, so at right angles to them. A small rotation d of the
//             body, along its own axes, turns v into v + v x d: its derivative is by_sun x to_sun
//             + by_observer x to_observer. By the weights of Scattering: single, multiple.
// Accuracy    plain values.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

struct BrightnessGradient {
  double value = 0.0;
  Vec3 by_sun = {};
  Vec3 by_observer = {};
  double by_single = 0.0;
  double by_multiple = 0.0;
};

// Of an ellipsoid, by its semi-axes a, b, c too.
struct EllipsoidGradient : BrightnessGradient {
  Vec3 by_axes = {};
};

}  // namespace v0
}  // namespace polhode
