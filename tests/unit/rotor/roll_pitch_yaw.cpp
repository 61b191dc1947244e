// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "budgets.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode::test {
namespace {

constexpr double pi = std::numbers::pi;

// R3(yaw) R2(pitch) R1(roll), each written out: columns are the body axes in the frame.
Mat3 matrix(const RollPitchYaw& a) {
  const double cr = std::cos(a.roll), sr = std::sin(a.roll), cp = std::cos(a.pitch),
               sp = std::sin(a.pitch), cy = std::cos(a.yaw), sy = std::sin(a.yaw);
  return {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
           {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
           {-sp, cp * sr, cp * cr}}};
}

void expect_matrix(const Quaternion& q, const RollPitchYaw& angles) {
  const Mat3 R = matrix(angles);
  for (int j = 0; j < 3; ++j) {
    Vec3 e{};
    e[j] = 1.0;
    const Vec3 axis = rotate(q, e);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(axis[i], R(i, j), budget::roll_pitch_yaw);
  }
}

TEST(RollPitchYaw, AreTheSequenceOfFlight) {
  for (const double roll : {-3.0, -0.5, 0.0, 1e-9, 2.0, pi})
    for (const double pitch : {-1.5, -0.3, 0.0, 1e-9, 1.2})
      for (const double yaw : {-2.5, 0.0, 1e-9, 0.7, pi}) {
        const RollPitchYaw angles{roll, pitch, yaw};
        const Quaternion q = attitude(angles);
        expect_matrix(q, angles);
        const RollPitchYaw back = roll_pitch_yaw(q);
        const double budget = budget::roll_pitch_yaw / std::cos(pitch);
        EXPECT_NEAR(std::remainder(back.roll - roll, 2.0 * pi), 0.0, budget);
        EXPECT_NEAR(back.pitch, pitch, budget);
        EXPECT_NEAR(std::remainder(back.yaw - yaw, 2.0 * pi), 0.0, budget);
      }
}

TEST(RollPitchYaw, UprightHasAllOfTheTurnInRoll) {
  const double h = std::sqrt(0.5);
  for (const double side : {1.0, -1.0})
    for (const double turn : {0.0, 1.0, -2.5}) {
      const Quaternion q = rotation_z(turn) * Quaternion{h, 0.0, side * h, 0.0};
      const RollPitchYaw angles = roll_pitch_yaw(q);
      EXPECT_EQ(angles.yaw, 0.0);
      EXPECT_NEAR(angles.pitch, side * 0.5 * pi, budget::roll_pitch_yaw);
      expect_matrix(q, angles);
    }
}

TEST(RollPitchYaw, RebuildTheAttitudeNextToTheLock) {
  for (const double side : {1.0, -1.0})
    for (double away = 1e-17; away < 1.0; away *= 7.0)
      for (const double roll : {-2.0, 0.1, 1.3})
        for (const double yaw : {-3.1, -0.4, 2.2}) {
          const double half = side * (0.25 * pi - 0.5 * away);
          const Quaternion q = rotation_z(yaw) *
                               Quaternion{std::cos(half), 0.0, std::sin(half), 0.0} *
                               rotation_x(roll);
          const Quaternion off = conj(q) * attitude(roll_pitch_yaw(q));
          EXPECT_LE(2.0 * norm(Vec3{off.x, off.y, off.z}), budget::roll_pitch_yaw)
              << side << ' ' << away << ' ' << roll << ' ' << yaw;
        }
}

TEST(RollPitchYaw, TheLengthOfTheQuaternionPlaysNoPartAndNanStays) {
  const RollPitchYaw angles{0.3, -0.2, 0.9};
  const Quaternion q = attitude(angles);
  const RollPitchYaw longer = roll_pitch_yaw({3.0 * q.w, 3.0 * q.x, 3.0 * q.y, 3.0 * q.z});
  EXPECT_NEAR(longer.roll, angles.roll, budget::roll_pitch_yaw);
  EXPECT_NEAR(longer.pitch, angles.pitch, budget::roll_pitch_yaw);
  EXPECT_NEAR(longer.yaw, angles.yaw, budget::roll_pitch_yaw);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(roll_pitch_yaw({nan, 0.0, 0.0, 0.0}).roll));
}

}  // namespace
}  // namespace polhode::test
