// SPDX-License-Identifier: MIT
// The inertial axes that a scenario knows. Ecliptic and equator of J2000 share axis 1, the equinox.
#pragma once

#include <cmath>
#include <string_view>

#include "polhode/math/vector.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

inline Vec3 ecliptic_from_equator(const Vec3& x) {
  const double c = std::cos(obliquity_J2000), s = std::sin(obliquity_J2000);
  return {x.x, c * x.y + s * x.z, c * x.z - s * x.y};
}
inline Vec3 equator_from_ecliptic(const Vec3& x) {
  const double c = std::cos(obliquity_J2000), s = std::sin(obliquity_J2000);
  return {x.x, c * x.y - s * x.z, c * x.z + s * x.y};
}

// Components along other axes. Two different axes are both of J2000.
inline Vec3 in_other_axes(const Vec3& x, std::string_view from, std::string_view to) {
  if (from == to) return x;
  return to == "ecliptic-J2000" ? ecliptic_from_equator(x) : equator_from_ecliptic(x);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
