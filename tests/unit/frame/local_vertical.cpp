// SPDX-License-Identifier: MIT
#include "polhode/frame/local_vertical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "polhode/math/double_double.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

const KeplerElements ellipse{398600.4418, 6800.0, 0.4, 0.9, 2.0, 5.0, 1.0, 30.0};
const KeplerElements hyperbola{398600.4418, 6800.0, 1.5, 2.4, -1.0, 0.7, 0.0, 10.0};
const double times[] = {-90000.0, -1234.5, 0.0, 30.0, 4000.0, 5000.0, 6000.0, 7000.0, 8000.0, 1e6};

double distance(const Vec3& a, const Vec3& b) { return norm(a - b); }

// Axes of the frame in inertial axes, and those of a position and a velocity.
void expect_axes(const FrameMotion& at, const Vec3& r, const Vec3& v, double budget) {
  const Vec3 z = (-1.0 / norm(r)) * r, h = cross(r, v), y = (-1.0 / norm(h)) * h;
  EXPECT_LT(distance(rotate(at.q_IS, {0.0, 0.0, 1.0}), z), budget);
  EXPECT_LT(distance(rotate(at.q_IS, {0.0, 1.0, 0.0}), y), budget);
  EXPECT_LT(distance(rotate(at.q_IS, {1.0, 0.0, 0.0}), cross(y, z)), budget);
  // h/r^2, against axis 2
  const Vec3 mu{0.0, -norm(h) / dot(r, r), 0.0};
  EXPECT_LT(distance(at.mu_S, mu), budget * norm(mu));
}

TEST(LocalVertical, IsThatOfPositionAndVelocity) {
  for (const KeplerElements& elements : {ellipse, hyperbola}) {
    const KeplerOrbit orbit(elements);
    const Frame frame = local_vertical_frame(orbit);
    for (const double t : times)
      expect_axes(frame.at(t), orbit.position(t), orbit.velocity(t), budget::local_vertical_axes);
  }
}

TEST(LocalVertical, AnOrbitThatPrecessesHasThePlaneOfItsElements) {
  const SecularRates rates{-1e-6, 2e-6, 1e-7};
  const PrecessingKeplerOrbit orbit(ellipse, rates);
  const Frame frame = local_vertical_frame(orbit);
  for (const double t : times) {
    const FrameMotion at = frame.at(t);
    const Vec3 r = orbit.position(t);
    const double node = ellipse.node + rates.node * (t - ellipse.epoch), i = ellipse.inclination;
    const Vec3 normal{std::sin(i) * std::sin(node), -std::sin(i) * std::cos(node), std::cos(i)};
    EXPECT_LT(distance(rotate(at.q_IS, {0.0, 0.0, 1.0}), (-1.0 / norm(r)) * r),
              budget::local_vertical_axes);
    EXPECT_LT(distance(rotate(at.q_IS, {0.0, 1.0, 0.0}), -1.0 * normal),
              budget::local_vertical_axes);
    // mu is the rate of the axes, by central differences
    const double d = 0.25;
    const Vec3 w = rotate(at.q_IS, at.mu_S);
    for (const Vec3& axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
      const Vec3 change = rotate(frame.at(t + d).q_IS, axis) - rotate(frame.at(t - d).q_IS, axis);
      EXPECT_LT(distance((0.5 / d) * change, cross(w, rotate(at.q_IS, axis))),
                budget::local_vertical_differences * norm(w));
    }
  }
}

TEST(LocalVertical, OfATurnedOrbitIsTurned) {
  const TurnedKeplerOrbit orbit =
      TurnedKeplerOrbit::from_equator(PrecessingKeplerOrbit(ellipse, {}));
  const Frame frame = local_vertical_frame(orbit);
  for (const double t : times)
    expect_axes(frame.at(t), orbit.position(t), orbit.velocity(t), budget::local_vertical_axes);
}

TEST(LocalVertical, KeepsItsSignFromTurnToTurn) {
  for (const double argument : {0.0, 1.5, 3.1, 5.0}) {
    KeplerElements elements = ellipse;
    elements.argument = argument;
    const Frame frame = local_vertical_frame(KeplerOrbit(elements));
    const double step = 2.0 * std::numbers::pi / mean_motion(elements) / 400.0;
    Quaternion before = frame.at(0.0).q_IS;
    double worst = 1.0;
    for (int k = 1; k < 1600; ++k) {
      const Quaternion q = frame.at(k * step).q_IS;
      worst = smaller(worst, q.w * before.w + q.x * before.x + q.y * before.y + q.z * before.z);
      before = q;
    }
    EXPECT_GT(worst, 0.9);
  }
}

TEST(LocalVertical, DoubleAndDoubleDoubleAgree) {
  const Frame frame = local_vertical_frame(KeplerOrbit(ellipse));
  for (const double t : times) {
    const FrameMotion near = frame.at(t);
    const BasicFrameMotion<DoubleDouble> wide = frame.at(DoubleDouble(t));
    const Quaternion q{wide.q_IS.w.hi, wide.q_IS.x.hi, wide.q_IS.y.hi, wide.q_IS.z.hi};
    const Quaternion d = conj(q) * near.q_IS;
    EXPECT_LT(norm(Vec3{d.x, d.y, d.z}), budget::local_vertical_axes);
    EXPECT_GT(d.w, 0.0);
  }
}

}  // namespace
}  // namespace polhode::test
