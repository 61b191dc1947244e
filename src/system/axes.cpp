// SPDX-License-Identifier: MIT
#include "polhode/system/axes.hpp"

#include <cmath>
#include <limits>

#include "polhode/math/quaternion.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace charts {

namespace {

RotorAxes rotor_axes(const Quaternion& q, const Vec3& g_B, const Vec3& w_B) {
  return {axis_angles(rotate(q, Vec3{0.0, 0.0, 1.0})), axis_angles(rotate(q, g_B)),
          axis_angles(rotate(q, w_B))};
}

}  // namespace

AxisAngles axis_angles(const Vec3& axis) {
  if (axis == Vec3{}) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  const double across = std::hypot(axis.x, axis.y);
  return {std::atan2(across, axis.z), across == 0.0 ? 0.0 : std::atan2(axis.x, -axis.y)};
}

RotorAxes inertial_axes(const System& system, double t, const RotorState& s) {
  const Quaternion q_IB = normalized(inertial_state(system, t, s).q);
  return rotor_axes(q_IB, s.g, angular_velocity(system, t, s).inertial);
}

RotorAxes relative_axes(const System& system, double t, const RotorState& s) {
  return rotor_axes(normalized(s.q), s.g, angular_velocity(system, t, s).relative);
}

}  // namespace charts
}  // namespace v0
}  // namespace polhode
