// SPDX-License-Identifier: MIT
#include "polhode/rotor/roll_pitch_yaw.hpp"

#include <cmath>
#include <limits>

namespace polhode {
inline namespace v0 {
namespace {

// Of cos(pitch), below which roll and yaw are one angle.
constexpr double upright = 4.0 * std::numeric_limits<double>::epsilon();

}  // namespace

RollPitchYaw roll_pitch_yaw(const Quaternion& q) {
  // the matrix R of v_S = R v_B, row by row
  const double xx = q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z;
  const double yx = 2.0 * (q.x * q.y + q.w * q.z), zx = 2.0 * (q.x * q.z - q.w * q.y);
  const double cosine = std::hypot(xx, yx);
  const double pitch = std::atan2(-zx, cosine);
  if (cosine <= upright * std::fabs(zx)) {
    const double yy = q.w * q.w - q.x * q.x + q.y * q.y - q.z * q.z;
    return {std::atan2(-2.0 * (q.y * q.z - q.w * q.x), yy), pitch, 0.0};
  }
  const double zy = 2.0 * (q.y * q.z + q.w * q.x);
  const double zz = q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z;
  return {std::atan2(zy, zz), pitch, std::atan2(yx, xx)};
}

Quaternion attitude(const RollPitchYaw& a) {
  const double half = 0.5 * a.pitch;
  return rotation_z(a.yaw) * Quaternion{std::cos(half), 0.0, std::sin(half), 0.0} *
         rotation_x(a.roll);
}

}  // namespace v0
}  // namespace polhode
