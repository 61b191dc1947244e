// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>

#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Of cos(pitch), below which roll and yaw are one angle.
constexpr double upright = 4.0 * std::numeric_limits<double>::epsilon();

double within_half_turn(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped == -std::numbers::pi ? std::numbers::pi : wrapped;
}

}  // namespace

// With p = pitch/2 and half the sum and half the difference of yaw and roll, q has
// z + x = (cos p - sin p) sin(sum), w - y = (cos p - sin p) cos(sum),
// z - x = (cos p + sin p) sin(difference), w + y = (cos p + sin p) cos(difference).
// Next to +-90 degrees one of the two angles is ill-determined, and enters the attitude times a
// factor that is as small. The elements of the matrix mix both.
RollPitchYaw roll_pitch_yaw(const Quaternion& q) {
  const double below = std::hypot(q.z + q.x, q.w - q.y), above = std::hypot(q.z - q.x, q.w + q.y);
  const double cosine = below * above, sine = 2.0 * (q.w * q.y - q.x * q.z);
  const double pitch = std::atan2(sine, cosine);
  const double sum = std::atan2(q.z + q.x, q.w - q.y);
  const double difference = std::atan2(q.z - q.x, q.w + q.y);
  if (cosine <= upright * std::fabs(sine)) {
    const double roll = sine > 0.0 ? -2.0 * difference : 2.0 * sum;
    return {within_half_turn(roll), pitch, 0.0};
  }
  return {within_half_turn(sum - difference), pitch, within_half_turn(sum + difference)};
}

Quaternion attitude(const RollPitchYaw& a) {
  const double half = 0.5 * a.pitch;
  return rotation_z(a.yaw) * Quaternion{std::cos(half), 0.0, std::sin(half), 0.0} *
         rotation_x(a.roll);
}

}  // namespace v0
}  // namespace polhode
