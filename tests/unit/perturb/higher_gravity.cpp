// SPDX-License-Identifier: MIT
#include "polhode/perturb/higher_gravity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

std::vector<PointMass> drawn_points(std::uint64_t seed) {
  Draw draw(seed, 0);
  std::vector<PointMass> points;
  for (int i = 0; i < 8; ++i) {
    const double mass = draw.uniform(0.1, 1.0);
    points.push_back({mass, drawn_vector(draw)});
  }
  return points;
}

// Unit masses whose centre of mass is the origin and whose tensor is diagonal, without rounding;
// the third-degree moments are not zero.
const std::vector<PointMass> lopsided = {{1.0, {2.0, 0.0, 0.0}},   {2.0, {-1.0, 0.0, 0.0}},
                                         {1.0, {0.0, 3.0, 0.0}},   {3.0, {0.0, -1.0, 0.0}},
                                         {1.0, {0.0, 0.0, 1.0}},   {0.5, {0.0, 0.0, -2.0}},
                                         {1.0, {1.0, 1.0, 1.0}},   {1.0, {1.0, -1.0, -1.0}},
                                         {1.0, {-1.0, 1.0, -1.0}}, {1.0, {-1.0, -1.0, 1.0}}};

Body body_of(const std::vector<PointMass>& points) {
  Vec3 I;
  for (const PointMass& p : points) {
    const Vec3& x = p.position;
    I = I + p.mass * Vec3{x.y * x.y + x.z * x.z, x.z * x.z + x.x * x.x, x.x * x.x + x.y * x.y};
  }
  return {I.x, I.y, I.z};
}

// Legendre's series of one point mass, differentiated: no tensor of moments.
struct BySeries {
  WideVec3 torque;
  Wide energy;
};
BySeries by_series(const std::vector<PointMass>& points, const WideVec3& r, double gm) {
  BySeries sum{{}, 0};
  const Wide distance = sqrt(dot(r, r));
  for (const PointMass& p : points) {
    const WideVec3 x = wide(p.position);
    const Wide size = sqrt(dot(x, x)), c = dot(x, r) / (size * distance);
    Wide P[5] = {1, c}, D[5] = {0, 1};
    for (int n = 1; n < 4; ++n) {
      P[n + 1] = ((2 * n + 1) * c * P[n] - n * P[n - 1]) / (n + 1);
      D[n + 1] = D[n - 1] + (2 * n + 1) * P[n];
    }
    for (int n = 3; n <= 4; ++n) {
      const Wide scale = Wide(gm) * Wide(p.mass) * pow(size, n) / pow(distance, n + 1);
      sum.energy -= scale * P[n];
      // force on the point: gm m grad(|x|^n P_n / r^(n+1)); torque x cross that
      sum.torque = sum.torque + (scale * D[n] / (size * distance)) * cross(x, r);
    }
  }
  return sum;
}

TEST(HigherGravity, SeriesOfEveryPointMass) {
  Worst worst, worst_energy, worst_wide;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const std::vector<PointMass> points = drawn_points(600 + i);
    const MassMoments moments = mass_moments<double>(points);
    const Case c = drawn_case(700, i);
    Draw draw(701, i);
    const Vec3 r = drawn_vector(draw);
    for (const OrbitOf of : {OrbitOf::attractor, OrbitOf::body}) {
      const BasicSetting<Wide> at = c.on<Wide>();
      const WideVec3 seen = seen_in_body(at, wide(r));
      const BySeries want = by_series(points, of == OrbitOf::body ? -seen : seen, 0.7);
      const HigherGravity term(0.7, Still{r}, moments, of);
      double size = 0.0;  // the torque of all masses at their distance, at right angles
      for (const PointMass& p : points) {
        const double x = norm(p.position), d = norm(r);
        size += 0.7 * p.mass * (std::pow(x / d, 3) + std::pow(x / d, 4)) / d;
      }
      worst.add(largest(wide(term.effect(c.on<double>()).u) - want.torque) / size);
      worst_wide.add(largest(wide(term.effect(c.on<DoubleDouble>()).u) - want.torque) / size);
      worst_energy.add(
          std::abs(static_cast<double>(Wide(term.energy(c.on<double>())) - want.energy)) / size);
    }
  }
  EXPECT_LE(worst.value(), budget::higher_gravity_eps * eps);
  EXPECT_LE(worst_energy.value(), budget::higher_gravity_eps * eps);
  // the moments are rounded to double, whatever the number type
  EXPECT_LE(worst_wide.value(), budget::higher_gravity_eps * eps);
}

TEST(HigherGravity, IsTheDerivativeOfItsEnergy) {
  for (const SpaceAxes axes : {SpaceAxes::inertial, SpaceAxes::reference}) {
    const HigherGravity term(1.7, Curve{}, mass_moments<double>(drawn_points(602)), OrbitOf::body,
                             axes);
    Worst worst;
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Case c = drawn_case(603, i);
      BasicSetting<Wide> at = c.on<Wide>();
      at.s.q = normalized(at.s.q);
      at.q_IS = normalized(at.q_IS);
      const BasicEffect<Wide> want = effect_by_differences(term, at);
      worst.add(largest(term.effect(at).u - want.u) / largest(want.u));
      EXPECT_EQ(largest(want.v), 0.0);
      EXPECT_EQ(term.effect(c.on<double>()).v, Vec3{});
    }
    EXPECT_LE(worst.value(), budget::higher_gravity_difference);
  }
}

// The pull of the mass on every point, summed: what GravityGradient and HigherGravity leave out is
// of degree 5, so that it falls as r^-6; without HigherGravity it falls as r^-4.
TEST(HigherGravity, WithGravityGradientIsTheForceOnEveryPoint) {
  const Body body = body_of(lopsided);
  const MassMoments moments = mass_moments<double>(lopsided);
  const auto missing = [&](double distance) {
    const Vec3 r = (distance / 3.0) * Vec3{1.0, 2.0, 2.0};
    const BasicSetting<Wide> at{body, 0, {{}, {}}, {}};
    WideVec3 direct;
    for (const PointMass& p : lopsided) {
      const WideVec3 x = wide(p.position), d = wide(r) - x;
      const Wide d2 = dot(d, d);
      direct = direct + (Wide(p.mass) / (d2 * sqrt(d2))) * cross(x, d);
    }
    const WideVec3 second = GravityGradient(1.0, Still{r}).effect(at).u;
    const WideVec3 rest = direct - second;
    const WideVec3 higher = HigherGravity(1.0, Still{r}, moments, OrbitOf::attractor).effect(at).u;
    return std::pair(largest(rest), largest(rest - higher));
  };
  const auto near = missing(1e3), far = missing(2e3);
  EXPECT_NEAR(std::log2(near.first / far.first), 4.0, budget::higher_gravity_slope);
  EXPECT_NEAR(std::log2(near.second / far.second), 6.0, budget::higher_gravity_slope);
  EXPECT_LT(near.second, near.first / 1e4);
}

TEST(HigherGravity, SphereHasNone) {
  // of a cube's corners and faces, the octahedral mean of degree 4 vanishes for 8 w / 9 = 6 W / 4
  std::vector<PointMass> points;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) points.push_back({1.0, {x, y, z}});
  // corners: sum x^4 = 8, sum x^2 y^2 = 8; isotropic needs x^4 = 3 x^2 y^2: faces add 2 w a^4 = 16
  for (int i = 0; i < 3; ++i)
    for (const double s : {-2.0, 2.0}) {
      Vec3 x;
      x[i] = s;
      points.push_back({0.5, x});
    }
  const MassMoments moments = mass_moments<double>(points);
  const Case c = drawn_case(604, 0);
  const HigherGravity term(1.0, Curve{}, moments, OrbitOf::attractor);
  EXPECT_EQ(term.effect(c.on<double>()), Effect{});
  EXPECT_EQ(term.energy(c.on<double>()), 0.0);
}

TEST(HigherGravity, RefusesWhatIsNoGravity) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_MESSAGE(HigherGravity(0.0, Curve{}, MassMoments{}, OrbitOf::body),
                 "HigherGravity: gm 0 must be positive and finite");
  MassMoments m;
  m.fourth[3] = nan;
  EXPECT_MESSAGE(HigherGravity(1.0, Curve{}, m, OrbitOf::body),
                 "HigherGravity: fourth-degree moment nan must be finite");
}

}  // namespace
}  // namespace perturb_test
