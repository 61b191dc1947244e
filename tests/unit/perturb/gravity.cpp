// SPDX-License-Identifier: MIT
// Gravity of a point, of higher moments of the body, and of an oblate primary.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

// The tensor form of the torque and of the potential: r x I r and r.I r as printed everywhere.
BasicEffect<Wide> textbook(const WideVec3& r_B, const Vec3& I, double gm) {
  const WideVec3 Ir{I.x * r_B.x, I.y * r_B.y, I.z * r_B.z};
  const Wide r2 = dot(r_B, r_B);
  return {{}, Wide(3 * gm / (r2 * r2 * sqrt(r2))) * cross(r_B, Ir)};
}

TEST(GravityGradient, IsTheDerivativeOfItsEnergy) {
  for (const SpaceAxes axes : {SpaceAxes::inertial, SpaceAxes::reference}) {
    const GravityGradient term(1.7, Curve{}, axes);
    Worst worst, worst_wide;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Case c = drawn_case(501, i);
      BasicSetting<Wide> at = c.on<Wide>();
      at.s.q = normalized(at.s.q);
      at.q_IS = normalized(at.q_IS);
      const BasicEffect<Wide> want = effect_by_differences(term, at);
      const double r2 = largest(Curve{}.position(at.t));
      const double scale = 1.7 * 3.0 / (r2 * r2 * r2);
      worst.add(largest(wide(term.effect(c.on<double>()).u) - want.u) / scale);
      worst_wide.add(largest(wide(term.effect(c.on<DoubleDouble>()).u) - want.u) / scale);
      EXPECT_EQ(largest(want.v), 0.0);
      EXPECT_EQ(term.effect(c.on<double>()).v, Vec3{});
    }
    EXPECT_LE(worst.value(), budget::perturb_eps * eps);
    EXPECT_LE(worst_wide.value(), budget::perturb_difference);
  }
}

TEST(GravityGradient, TextbookTorque) {
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = drawn_case(502, i);
    Draw draw(503, i);
    const Vec3 r = drawn_vector(draw);
    const BasicSetting<Wide> at = c.on<Wide>();
    const WideVec3 r_B = seen_in_body(at, wide(r));
    const BasicEffect<Wide> want = textbook(r_B, c.body.moments(), 0.3);
    const Effect got = GravityGradient(0.3, Still{r}).effect(c.on<double>());
    worst.add(largest(wide(got.u) - want.u) / (0.9 / std::pow(norm(r), 3)));
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

// Pitch of 45 degrees: 3 n^2 (I2 - I1)/2 about the third axis, towards the axis of least moment.
TEST(GravityGradient, PitchByHand) {
  const Body body(1.0, 2.0, 2.5);
  const double half = std::sqrt(0.5);
  const Effect e = GravityGradient(8.0, Still{{2.0 * half, 2.0 * half, 0.0}})
                       .effect(Setting{body, 0.0, {{}, {}}, {}});
  EXPECT_NEAR(e.u.z, 1.5, 3.0 * budget::perturb_eps * eps);
  EXPECT_EQ(e.u.x, 0.0);
  EXPECT_EQ(e.u.y, 0.0);
  // gm/(2 r^3) (3 n.I n - tr I) = (4.5 - 5.5)/2
  EXPECT_NEAR(GravityGradient(8.0, Still{{2.0 * half, 2.0 * half, 0.0}})
                  .energy(Setting{body, 0.0, {{}, {}}, {}}),
              -0.5, budget::perturb_eps * eps);
}

// <n n / r^3> = (1 - k k)/(2 b^3) on any ellipse, k its normal, b its small half axis.
TEST(GravityGradient, AveragedOverAnEllipse) {
  for (const double e : {0.0, 0.3}) {
    const KeplerOrbit orbit({1.0, 1.0 - e, e, 0.7, 0.4, 1.0});
    const Case c = drawn_case(504, 0);
    const GravityGradient term(1.0, orbit);
    Setting at = c.on<double>();
    Vec3 mean;
    constexpr int samples = 128;
    for (int i = 0; i < samples; ++i) {
      at.t = 2.0 * 3.141592653589793 * i / samples;
      mean = mean + (1.0 / samples) * term.effect(at).u;
    }
    const Vec3 k_I{std::sin(0.7) * std::sin(0.4), -std::sin(0.7) * std::cos(0.4), std::cos(0.7)};
    const Vec3 k = rotate(conj(c.s.q), rotate(conj(c.q_IS), k_I));
    const Vec3& I = c.body.moments();
    const Vec3 want =
        (-1.5 / std::pow(1.0 - e * e, 1.5)) * cross(k, Vec3{I.x * k.x, I.y * k.y, I.z * k.z});
    EXPECT_LE(norm(mean - want), budget::perturb_average) << e;
  }
}

TEST(GravityGradient, DoesNotSeeTheLengthOfQuaternions) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Case c = drawn_case(505, i);
    const GravityGradient term(1.0, Curve{});
    Case longer = c;
    const double factor = 1.0 + 1e-3;
    longer.s.q = {factor * c.s.q.w, factor * c.s.q.x, factor * c.s.q.y, factor * c.s.q.z};
    longer.q_IS = {c.q_IS.w / factor, c.q_IS.x / factor, c.q_IS.y / factor, c.q_IS.z / factor};
    const Vec3 u = term.effect(c.on<double>()).u;
    EXPECT_LE(norm(term.effect(longer.on<double>()).u - u), budget::perturb_eps * eps * 3.0);
  }
}

TEST(GravityGradient, AndOblateGravityOfASphereAreNone) {
  const Body sphere(2.0, 2.0, 2.0);
  const Case c = drawn_case(506, 0);
  const Setting at{sphere, c.t, c.s, c.q_IS};
  for (const AnyPerturbation& term :
       {AnyPerturbation("point", GravityGradient(1.0, Curve{})),
        AnyPerturbation("oblate", OblateGravity(1.0, Curve{}, {0.1, 1.0}))}) {
    EXPECT_EQ(term.effect(at), Effect{});
    EXPECT_EQ(term.energy(at), 0.0);
  }
}

// A Tangent state: derivative of the torque by a turn, against a difference; time moves nothing.
TEST(GravityGradient, TangentOfTheTorque) {
  const Case c = drawn_case(507, 1);
  const GravityGradient term(1.3, AnyOrbit("curve", Curve{}));
  BasicSetting<Tangent> at = c.on<Tangent>();
  const Tangent half(0.5);
  at.s.q = at.s.q * BasicQuaternion<Tangent>{Tangent(1.0), half * Tangent::variable(0.0, 0),
                                             half * Tangent::variable(0.0, 1),
                                             half * Tangent::variable(0.0, 2)};
  const BasicEffect<Tangent> e = term.effect(at);
  const GravityGradient wide_term(1.3, Curve{});
  const Wide h = 1e-25;
  for (int i = 0; i < 3; ++i) {
    const auto turned = [&](const Wide& angle) {
      BasicSetting<Wide> w = c.on<Wide>();
      WideVec3 axis;
      axis[i] = sin(angle / 2);
      w.s.q = w.s.q * WideQuaternion{cos(angle / 2), axis.x, axis.y, axis.z};
      return wide_term.effect(w).u;
    };
    const WideVec3 want = Wide(1 / (2 * h)) * (turned(h) - turned(-h));
    const auto place = static_cast<std::size_t>(i);
    const Vec3 got{e.u.x.derivative[place], e.u.y.derivative[place], e.u.z.derivative[place]};
    EXPECT_LE(largest(wide(got) - want), budget::perturb_eps * eps * 8.0 * largest(want)) << i;
  }
}

TEST(GravityGradient, RefusesGmThatIsNotPositive) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_MESSAGE(GravityGradient(0.0, Curve{}),
                 "GravityGradient: gm 0 must be positive and finite");
  for (const double gm : {-1.0, nan, HUGE_VAL}) {
    EXPECT_NE(message_of([&] { GravityGradient(gm, Curve{}); }), "") << gm;
  }
}

std::vector<shape::PointMass> drawn_points(std::uint64_t seed) {
  Draw draw(seed, 0);
  std::vector<shape::PointMass> points;
  for (int i = 0; i < 8; ++i) {
    const double mass = draw.uniform(0.1, 1.0);
    points.push_back({mass, drawn_vector(draw)});
  }
  return points;
}

// Unit masses whose centre of mass is the origin and whose tensor is diagonal, without rounding;
// the third-degree moments are not zero.
const std::vector<shape::PointMass> lopsided = {{1.0, {2.0, 0.0, 0.0}},   {2.0, {-1.0, 0.0, 0.0}},
                                                {1.0, {0.0, 3.0, 0.0}},   {3.0, {0.0, -1.0, 0.0}},
                                                {1.0, {0.0, 0.0, 1.0}},   {0.5, {0.0, 0.0, -2.0}},
                                                {1.0, {1.0, 1.0, 1.0}},   {1.0, {1.0, -1.0, -1.0}},
                                                {1.0, {-1.0, 1.0, -1.0}}, {1.0, {-1.0, -1.0, 1.0}}};

Body body_of(const std::vector<shape::PointMass>& points) {
  Vec3 I;
  for (const shape::PointMass& p : points) {
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
BySeries by_series(const std::vector<shape::PointMass>& points, const WideVec3& r, double gm) {
  BySeries sum{{}, 0};
  const Wide distance = sqrt(dot(r, r));
  for (const shape::PointMass& p : points) {
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
    const std::vector<shape::PointMass> points = drawn_points(600 + i);
    const shape::MassMoments moments = shape::mass_moments<double>(points);
    const Case c = drawn_case(700, i);
    Draw draw(701, i);
    const Vec3 r = drawn_vector(draw);
    for (const OrbitOf of : {OrbitOf::attractor, OrbitOf::body}) {
      const BasicSetting<Wide> at = c.on<Wide>();
      const WideVec3 seen = seen_in_body(at, wide(r));
      const BySeries want = by_series(points, of == OrbitOf::body ? -seen : seen, 0.7);
      const HigherGravity term(0.7, Still{r}, moments, of);
      double size = 0.0;  // the torque of all masses at their distance, at right angles
      for (const shape::PointMass& p : points) {
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
    const HigherGravity term(1.7, Curve{}, shape::mass_moments<double>(drawn_points(602)),
                             OrbitOf::body, axes);
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
  const shape::MassMoments moments = shape::mass_moments<double>(lopsided);
  const auto missing = [&](double distance) {
    const Vec3 r = (distance / 3.0) * Vec3{1.0, 2.0, 2.0};
    const BasicSetting<Wide> at{body, 0, {{}, {}}, {}};
    WideVec3 direct;
    for (const shape::PointMass& p : lopsided) {
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
  std::vector<shape::PointMass> points;
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
  const shape::MassMoments moments = shape::mass_moments<double>(points);
  const Case c = drawn_case(604, 0);
  const HigherGravity term(1.0, Curve{}, moments, OrbitOf::attractor);
  EXPECT_EQ(term.effect(c.on<double>()), Effect{});
  EXPECT_EQ(term.energy(c.on<double>()), 0.0);
}

TEST(HigherGravity, RefusesWhatIsNoGravity) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_MESSAGE(HigherGravity(0.0, Curve{}, shape::MassMoments{}, OrbitOf::body),
                 "HigherGravity: gm 0 must be positive and finite");
  shape::MassMoments m;
  m.fourth[3] = nan;
  EXPECT_MESSAGE(HigherGravity(1.0, Curve{}, m, OrbitOf::body),
                 "HigherGravity: fourth-degree moment nan must be finite");
}

// -grad of U = -gm/r (1 - J2 (R/r)^2 (3 s^2 - 1)/2), s the sine of the latitude, differentiated by
// its two arguments: dU/dr along r, and dU/ds (k - s n) / r.
WideVec3 pull(const WideVec3& r, const WideVec3& k, double gm, const Oblateness& of) {
  const Wide d = sqrt(dot(r, r)), s = dot(r, k) / d, q = Wide(of.J2) * pow(of.radius / d, 2);
  const WideVec3 n = (1 / d) * r;
  const Wide by_r = Wide(gm) / (d * d) * (1 - Wide(1.5) * q * (3 * s * s - 1));
  const Wide by_s = Wide(gm) / d * q * 3 * s;
  return -by_r * n - (by_s / d) * (k - s * n);
}

// Six points whose tensor is diagonal; so small that their moments of degree 4 do not show.
TEST(OblateGravity, WithGravityGradientIsThePullOnEveryPoint) {
  const double tiny = 0x1p-60;
  const Vec3 arms{1.0, 2.0, 3.0}, masses{1.0, 0.5, 0.25};
  const Vec3 J{2.0 * masses.x * arms.x * arms.x, 2.0 * masses.y * arms.y * arms.y,
               2.0 * masses.z * arms.z * arms.z};
  const Body body(J.y + J.z, J.z + J.x, J.x + J.y);
  Worst worst;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Draw draw(801, i);
    const Vec3 r = drawn_vector(draw), pole = drawn_vector(draw);
    const Oblateness of{draw.uniform(-0.5, 0.5), draw.uniform(0.1, 2.0), pole};
    const Case c = drawn_case(802, i);
    const BasicSetting<Wide> at = c.on<Wide>();
    const WideVec3 r_B = seen_in_body(at, wide(r));
    const WideVec3 k_B = (1 / sqrt(dot(wide(pole), wide(pole)))) * seen_in_body(at, wide(pole));
    WideVec3 direct;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        WideVec3 x;
        x[axis] = Wide(side * arms[axis]) * Wide(tiny);
        direct = direct + (Wide(masses[axis]) / (Wide(tiny) * Wide(tiny))) *
                              cross(x, pull(r_B + x, k_B, 0.7, of));
      }
    }
    const BasicSetting<Wide> same{body, at.t, at.s, at.q_IS};
    const WideVec3 point = GravityGradient(0.7, Still{r}).effect(same).u;
    const Setting set{body, c.t, c.s, c.q_IS};
    const Vec3 got = OblateGravity(0.7, Still{r}, of).effect(set).u;
    const double size =
        0.7 * 15.0 * std::abs(of.J2) * of.radius * of.radius / std::pow(norm(r), 5) * 6.0;
    worst.add(largest(wide(got) - (direct - point)) / size);
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

TEST(OblateGravity, IsTheDerivativeOfItsEnergy) {
  for (const SpaceAxes axes : {SpaceAxes::inertial, SpaceAxes::reference}) {
    const OblateGravity term(1.7, Curve{}, {0.3, 0.8, {0.2, -0.3, 0.9}}, axes);
    Worst worst;
    for (std::uint64_t i = 0; i < 100; ++i) {
      BasicSetting<Wide> at = drawn_case(803, i).on<Wide>();
      const Body body = drawn_case(803, i).body;
      const BasicSetting<Wide> unit{body, at.t, {normalized(at.s.q), at.s.g}, normalized(at.q_IS)};
      const BasicEffect<Wide> want = effect_by_differences(term, unit);
      worst.add(largest(term.effect(unit).u - want.u) / largest(want.u));
    }
    EXPECT_LE(worst.value(), budget::higher_gravity_difference);
  }
}

// Above the equator with the long axis at 45 degrees in the orbit plane: 3 gm/r^3 grows by (5/2)
// J2 (R/r)^2, as does the slope of the field's radial gradient.
TEST(OblateGravity, PitchInTheEquatorByHand) {
  const Body body(1.0, 2.0, 2.5);
  const double half = std::sqrt(0.5);
  const Still r{{2.0 * half, 2.0 * half, 0.0}};
  const Setting at{body, 0.0, {{}, {}}, {}};
  const Effect point = GravityGradient(8.0, r).effect(at);
  const Effect oblate = OblateGravity(8.0, r, {0.1, 0.5}).effect(at);
  EXPECT_NEAR(oblate.u.z / point.u.z, 2.5 * 0.1 * 0.0625, budget::perturb_eps * eps);
  EXPECT_EQ(oblate.u.x, 0.0);
  EXPECT_EQ(oblate.u.y, 0.0);
}

TEST(OblateGravity, RefusesWhatIsNoPlanet) {
  EXPECT_MESSAGE((Oblateness{1e-3, -1.0}), "Oblateness: radius -1 must be positive and finite");
  EXPECT_MESSAGE(OblateGravity(-1.0, Curve{}, {0.1, 1.0}),
                 "OblateGravity: gm -1 must be positive and finite");
  EXPECT_MESSAGE(OblateGravity(1.0, Curve{}, {0.1, 0.0}),
                 "Oblateness: radius 0 must be positive and finite");
  EXPECT_MESSAGE(OblateGravity(1.0, Curve{}, {HUGE_VAL, 1.0}), "Oblateness: J2 inf must be finite");
  EXPECT_MESSAGE(OblateGravity(1.0, Curve{}, {0.1, 1.0, {0.0, 0.0, 0.0}}),
                 "Oblateness: pole (0, 0, 0) must be a direction: finite and not 0");
}

}  // namespace
}  // namespace perturb_test
