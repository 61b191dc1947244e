// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "polhode/error.hpp"
#include "polhode/frame/frame.hpp"
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

// mu is the rate of the axes, by central differences.
void expect_rate(const Frame& frame, double t, double budget) {
  const double d = 0.25;
  const FrameMotion at = frame.at(t);
  const Vec3 w = rotate(at.q_IS, at.mu_S);
  for (const Vec3& axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
    const Vec3 change = rotate(frame.at(t + d).q_IS, axis) - rotate(frame.at(t - d).q_IS, axis);
    EXPECT_LT(distance((0.5 / d) * change, cross(w, rotate(at.q_IS, axis))), budget) << t;
  }
}

// From row to row, over the poles of inertial axes too.
void expect_one_sign(const Frame& frame, double step, int rows, double least) {
  Quaternion before = frame.at(0.0).q_IS;
  double worst = 1.0;
  for (int k = 1; k <= rows; ++k) {
    const Quaternion q = frame.at(step * k).q_IS;
    worst = smaller(worst, q.w * before.w + q.x * before.x + q.y * before.y + q.z * before.z);
    before = q;
  }
  EXPECT_GT(worst, least);
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
    expect_rate(frame, t, budget::local_vertical_differences * norm(at.mu_S));
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
    expect_one_sign(frame, 2.0 * std::numbers::pi / mean_motion(elements) / 400.0, 1599, 0.9);
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

const KeplerElements elements{398600.4418, 6800.0, 0.2, 0.9, 2.0, 5.0, 1.0, 30.0};
// Fast, so that many turns of the node fit into the table.
const SecularRates rates{-2e-4, 1e-4, 0.0, 3e-6, 1e-6};
constexpr PlaneOrigin origins[] = {PlaneOrigin::node, PlaneOrigin::shortest_turn};

// Rows of an orbit with its velocities, from 0 to 1e5.
template <class O>
TableOrbit tabulated(const O& orbit, std::size_t count = 4000) {
  PositionTable table;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = 1e5 * static_cast<double>(k) / static_cast<double>(count - 1);
    table.times.push_back(t);
    table.positions.push_back(orbit.position(t));
    table.velocities.push_back(orbit.velocity(t));
  }
  return TableOrbit(table);
}

KeplerElements tilted(double inclination) {
  KeplerElements k = elements;
  k.inclination = inclination;
  return k;
}

TEST(OrbitPlane, OfElementsIsTheirPlane) {
  const PrecessingKeplerOrbit orbit(elements, rates);
  for (const PlaneOrigin origin : origins) {
    const Frame frame = orbit_plane_frame(orbit, origin);
    for (const double t : {0.0, 500.0, 4e4}) {
      const double age = t - elements.epoch, node = elements.node + rates.node * age,
                   i = elements.inclination + rates.inclination * age;
      const FrameMotion at = frame.at(t);
      const Vec3 normal{std::sin(i) * std::sin(node), -std::sin(i) * std::cos(node), std::cos(i)};
      EXPECT_LT(distance(rotate(at.q_IS, {0.0, 0.0, 1.0}), normal), budget::orbit_plane_axes);
      if (origin == PlaneOrigin::node) {
        EXPECT_LT(distance(rotate(at.q_IS, {1.0, 0.0, 0.0}), {std::cos(node), std::sin(node), 0.0}),
                  budget::orbit_plane_axes);
        // along inertial axis 3 by the node, along the node by the inclination
        const Vec3 w = rates.node * Vec3{0.0, 0.0, 1.0} +
                       rates.inclination * Vec3{std::cos(node), std::sin(node), 0.0};
        EXPECT_LT(distance(rotate(at.q_IS, at.mu_S), w), budget::orbit_plane_axes * norm(w));
      }
      expect_rate(frame, t, budget::orbit_plane_differences);
    }
  }
}

TEST(OrbitPlane, OfATurnedOrbitIsTurned) {
  const PrecessingKeplerOrbit own(elements, rates);
  const TurnedKeplerOrbit orbit = TurnedKeplerOrbit::from_equator(own);
  for (const PlaneOrigin origin : origins) {
    const Frame frame = orbit_plane_frame(orbit, origin);
    for (const double t : {0.0, 500.0, 4e4}) {
      const Vec3 there = rotate(orbit_plane_frame(own).at(t).q_IS, {0.0, 0.0, 1.0});
      const double c = std::cos(obliquity_J2000), s = std::sin(obliquity_J2000);
      const Vec3 normal = rotate(frame.at(t).q_IS, {0.0, 0.0, 1.0});
      EXPECT_LT(distance(normal, {there.x, c * there.y + s * there.z, c * there.z - s * there.y}),
                budget::orbit_plane_axes);
      if (origin == PlaneOrigin::node) {
        EXPECT_LT(std::abs(rotate(frame.at(t).q_IS, {1.0, 0.0, 0.0}).z), budget::orbit_plane_axes);
      }
      expect_rate(frame, t, budget::orbit_plane_differences);
    }
  }
}

// Of a Kepler orbit, whose plane stays, and of one that precesses: that of position and velocity.
TEST(OrbitPlane, OfATableIsThatOfPositionAndVelocity) {
  const TableOrbit still = tabulated(KeplerOrbit(elements));
  for (const double t : {0.0, 500.0, 4e4, 1e5}) {
    const Frame frame = orbit_plane_frame(still), same = orbit_plane_frame(KeplerOrbit(elements));
    EXPECT_LT(distance(rotate(frame.at(t).q_IS, {1.0, 0.0, 0.0}),
                       rotate(same.at(t).q_IS, {1.0, 0.0, 0.0})),
              budget::orbit_plane_table);
    EXPECT_LT(norm(frame.at(t).mu_S), budget::orbit_plane_table_rate);
  }
  const PrecessingKeplerOrbit orbit(elements, rates);
  const TableOrbit table = tabulated(orbit);
  for (const PlaneOrigin origin : origins) {
    const Frame frame = orbit_plane_frame(table, origin);
    for (const double t : {1.0, 500.0, 4e4, 99999.0}) {
      const Vec3 h = cross(orbit.position(t), orbit.velocity(t));
      EXPECT_LT(distance(rotate(frame.at(t).q_IS, {0.0, 0.0, 1.0}), (1.0 / norm(h)) * h),
                budget::orbit_plane_table);
      expect_rate(frame, t, budget::orbit_plane_differences);
    }
    EXPECT_TRUE(std::isnan(frame.at(-1.0).q_IS.w));
  }
}

TEST(OrbitPlane, KeepsItsSignFromTurnToTurn) {
  const PrecessingKeplerOrbit orbit(elements, rates);
  const TableOrbit table = tabulated(orbit);
  // next to the pole of the axes the node runs
  expect_one_sign(orbit_plane_frame(table), 10.0, 10000, 0.5);
  expect_one_sign(local_vertical_frame(table), 10.0, 10000, 0.5);
}

// Tilted by less and by more than the inclination, forwards and backwards, and where the
// inclination passes the tilt.
TEST(OrbitPlane, OfATurnedOrbitKeepsItsSign) {
  for (const double inclination : {0.9, 0.2, 0.35, 2.0, 2.65, 3.0})
    for (const double angle : {obliquity_J2000, -obliquity_J2000, 2.2})
      for (const double rate : {0.0, 1e-6, -1e-5, 5e-5})
        for (const double step : {10.0, -10.0}) {
          SCOPED_TRACE(testing::Message() << inclination << " " << angle << " " << rate);
          SecularRates moving = rates;
          moving.node = 3e-4;
          moving.inclination = rate;
          const TurnedKeplerOrbit orbit(PrecessingKeplerOrbit(tilted(inclination), moving), angle);
          expect_one_sign(orbit_plane_frame(orbit), step, 10000, 0.5);
        }
}

TEST(OrbitPlane, StraightLinesHaveNoFrame) {
  const PositionTable rows{{0.0, 1.0, 2.0}, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {}};
  const TableOrbit lines(rows, 2);
  for (const PlaneOrigin origin : origins)
    EXPECT_THROW(orbit_plane_frame(lines, origin), DomainError);
  EXPECT_THROW(local_vertical_frame(lines), DomainError);
}

// Orbits in inertial axes 1 and 2, either way round, and next to them, too.
TEST(LocalVertical, OfATableIsThatOfPositionAndVelocity) {
  for (const double i : {0.0, 1e-9, 0.9, 1.57, 2.4, std::numbers::pi}) {
    const KeplerOrbit orbit(tilted(i));
    const Frame frame = local_vertical_frame(tabulated(orbit));
    for (const double t : {0.0, 500.0, 4e4, 1e5}) {
      const FrameMotion at = frame.at(t);
      const Vec3 r = orbit.position(t), h = cross(r, orbit.velocity(t));
      const Vec3 z = (-1.0 / norm(r)) * r, y = (-1.0 / norm(h)) * h;
      EXPECT_LT(distance(rotate(at.q_IS, {0.0, 0.0, 1.0}), z), budget::orbit_plane_table);
      EXPECT_LT(distance(rotate(at.q_IS, {0.0, 1.0, 0.0}), y), budget::orbit_plane_table);
      const Vec3 mu{0.0, -norm(h) / dot(r, r), 0.0};
      EXPECT_LT(distance(at.mu_S, mu), budget::orbit_plane_table_rate) << i << " " << t;
    }
  }
}

}  // namespace
}  // namespace polhode::test
