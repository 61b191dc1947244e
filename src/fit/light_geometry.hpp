// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Sums of the directions of all points, and what lies between the first and the last.
struct LightGeometry {
  Vec3 to_sun, to_observer;
  double time_base;
};
LightGeometry geometry_of(std::span<const LightCurve> curves);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
