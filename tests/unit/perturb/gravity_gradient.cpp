// SPDX-License-Identifier: MIT
#include "polhode/perturb/gravity_gradient.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
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

TEST(GravityGradient, SphereHasNone) {
  const Body sphere(2.0, 2.0, 2.0);
  const Case c = drawn_case(506, 0);
  const GravityGradient term(1.0, Curve{});
  const Setting at{sphere, c.t, c.s, c.q_IS};
  EXPECT_EQ(term.effect(at), Effect{});
  EXPECT_EQ(term.energy(at), 0.0);
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

}  // namespace
}  // namespace perturb_test
