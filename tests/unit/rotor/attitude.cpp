// SPDX-License-Identifier: MIT
#include "polhode/rotor/attitude.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "property/chart_support.hpp"

namespace {

using namespace polhode;
using chart_test::attitude_difference;
using chart_test::Sampler;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// R of [SA (2)], written out.
Mat3 printed_matrix(const EulerAngles& e) {
  const double cf = std::cos(e.phi), sf = std::sin(e.phi), ct = std::cos(e.theta),
               st = std::sin(e.theta), cp = std::cos(e.psi), sp = std::sin(e.psi);
  return {{{cp * cf - sp * ct * sf, cp * sf + sp * ct * cf, sp * st},
           {-sp * cf - cp * ct * sf, -sp * sf + cp * ct * cf, cp * st},
           {st * sf, -st * cf, ct}}};
}

TEST(Attitude, MatrixIsThatOfThePaper) {
  Sampler sample(1);
  for (int k = 0; k < 1000; ++k) {
    const EulerAngles e{sample.angle(), sample.uniform(0.0, 3.1), sample.angle()};
    const Mat3 R = attitude_matrix(attitude(e)), expected = printed_matrix(e);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(R(i, j), expected(i, j), budget::chart_rounding);
    }
  }
}

TEST(Attitude, QuaternionOfAMatrixInEveryQuadrant) {
  Sampler sample(2);
  for (int k = 0; k < 4000; ++k) {
    Quaternion q = sample.generic().q;
    // one component dominates, or two, or one vanishes
    const double small = k % 3 == 0 ? 1e-9 : (k % 3 == 1 ? 0.0 : 1.0);
    if (k % 4 == 0) q = {q.w, small * q.x, small * q.y, small * q.z};
    if (k % 4 == 1) q = {small * q.w, q.x, small * q.y, small * q.z};
    if (k % 4 == 2) q = {small * q.w, small * q.x, q.y, small * q.z};
    if (k % 4 == 3) q = {small * q.w, small * q.x, small * q.y, q.z};
    EXPECT_LE(attitude_difference(attitude(attitude_matrix(q)), q), budget::chart_rounding);
  }
}

TEST(Attitude, MatrixWithSevenDigitsIsARotation) {
  const Quaternion q = normalized(Quaternion{0.3, -0.4, 0.5, 0.6});
  Mat3 R = attitude_matrix(q);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) R(i, j) = static_cast<double>(static_cast<float>(R(i, j)));
  }
  EXPECT_LE(attitude_difference(attitude(R), q), budget::float_matrix);
}

TEST(Attitude, ErrorsNameValueAndRequirement) {
  EXPECT_MESSAGE(attitude(Mat3{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}),
                 "attitude: matrix with determinant -1 must be a proper rotation");
  EXPECT_MESSAGE(attitude(Mat3{{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}}),
                 "attitude: matrix with R R^T off the identity by 3 must be orthogonal to 1e-06");
  EXPECT_MESSAGE(attitude(Mat3{{{1, 0, 0}, {0, nan, 0}, {0, 0, 1}}}),
                 "attitude: matrix row (0, nan, 0) must be finite");
  EXPECT_MESSAGE(unit_quaternion(0, 0, -0.0, 0), "unit_quaternion: (0, 0, 0, 0) must not be zero");
  EXPECT_MESSAGE(unit_quaternion(1, inf, 0, 0), "unit_quaternion: (1, inf, 0, 0) must be finite");
  const Body body(1, 2, 2.5);
  EXPECT_MESSAGE(rotor_state(body, {}, {0, nan, 1}),
                 "rotor_state: omega_B (0, nan, 1) must be finite");
  EXPECT_MESSAGE(rotor_state_inertial(body, {}, {0, 1, -inf}),
                 "rotor_state_inertial: omega_I (0, 1, -inf) must be finite");
  EXPECT_THROW(rotor_state(body, {0, 0, 0, 0}, {0, 0, 1}), DomainError);
}

TEST(Attitude, UnitQuaternionKeepsTheBitsOfUnitInput) {
  Sampler sample(3);
  for (int k = 0; k < 1000; ++k) {
    const Quaternion q = sample.generic().q;
    EXPECT_EQ(unit_quaternion(q.w, q.x, q.y, q.z), q);
    const double scale = k % 2 == 0 ? 0x1p-700 : 0x1p700;
    const Quaternion s = unit_quaternion(scale * q.w, scale * q.x, scale * q.y, scale * q.z);
    EXPECT_LE(attitude_difference(s, q), budget::chart_rounding);
    EXPECT_NEAR(s.w * s.w + s.x * s.x + s.y * s.y + s.z * s.z, 1.0, budget::chart_rounding);
  }
}

TEST(Attitude, StatesFromBodyAndInertialRatesAgree) {
  const Body body(1, 2, 2.5);
  Sampler sample(4);
  for (int k = 0; k < 1000; ++k) {
    const RotorState s = sample.generic();
    const Vec3 w_B = angular_velocity(body, s);
    EXPECT_EQ(rotor_state(body, s.q, w_B).q, s.q);
    EXPECT_LE(norm(rotor_state(body, s.q, w_B).g - s.g), budget::chart_rounding);
    const Vec3 w_I = inertial_angular_velocity(body, s);
    EXPECT_LE(norm(rotor_state_inertial(body, s.q, w_I).g - s.g), budget::chart_rounding);
  }
}

TEST(EulerAngles, RoundTripAtAndNearThePoles) {
  Sampler sample(5);
  for (const double d : {1.0, 1e-4, 1e-8, 1e-12, 1e-150, 1e-320, 0.0}) {
    for (int k = 0; k < 500; ++k) {
      const Quaternion z1 = rotation_z(sample.angle()), z2 = rotation_z(sample.angle());
      const Quaternion tilt = rotation_x(d * sample.uniform(0.5, 1.5));
      const Quaternion q = z1 * (k % 2 == 0 ? tilt : Quaternion{0.0, 1.0, 0.0, 0.0} * tilt) * z2;
      const EulerAngles e = euler_angles(q);
      EXPECT_LE(attitude_difference(attitude(e), q), budget::chart_rounding);
      EXPECT_TRUE(e.phi > -pi<double>() && e.phi <= pi<double>());
      EXPECT_TRUE(e.psi > -pi<double>() && e.psi <= pi<double>());
      EXPECT_TRUE(e.theta >= 0.0 && e.theta <= pi<double>());
    }
  }
}

TEST(EulerAngles, LimitsAtThePoles) {
  const double a = 0.7;
  const EulerAngles zero = euler_angles(rotation_z(a));
  EXPECT_EQ(zero.theta, 0.0);
  EXPECT_EQ(zero.psi, 0.0);
  EXPECT_NEAR(zero.phi, a, budget::chart_rounding);
  const EulerAngles at_pi = euler_angles(rotation_z(a) * Quaternion{0.0, 1.0, 0.0, 0.0});
  EXPECT_EQ(at_pi.theta, pi<double>());
  EXPECT_EQ(at_pi.psi, 0.0);
  EXPECT_NEAR(at_pi.phi, a, budget::chart_rounding);
  for (const double z : {0.0, -0.0}) {
    EXPECT_EQ(euler_angles(Quaternion{1, z, z, z}), (EulerAngles{0, 0, 0}));
    EXPECT_EQ(euler_angles(Quaternion{-1, z, -z, z}), (EulerAngles{0, 0, 0}));
    EXPECT_EQ(euler_angles(Quaternion{z, 1, -z, z}), (EulerAngles{0, pi<double>(), 0}));
    EXPECT_EQ(euler_angles(Quaternion{z, z, z, 1}), (EulerAngles{pi<double>(), 0, 0}));
    EXPECT_EQ(euler_angles(Quaternion{z, -z, z, -1}), (EulerAngles{pi<double>(), 0, 0}));
  }
}

TEST(EulerAngles, NotANumberStaysOne) {
  EXPECT_TRUE(std::isnan(euler_angles(Quaternion{1, nan, 0, 0}).theta));
  EXPECT_TRUE(std::isnan(euler_angles(Quaternion{0, 0, 0, 0}).theta));
}

}  // namespace
