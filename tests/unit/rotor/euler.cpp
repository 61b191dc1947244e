// SPDX-License-Identifier: MIT
#include "polhode/rotor/euler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/math/double_double.hpp"
#include "property/chart_support.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace chart_test;
using polhode::test::smaller;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double eps = std::numeric_limits<double>::epsilon();
const Quaternion half_turn{0.0, 1.0, 0.0, 0.0};

double difference(const EulerState& a, const EulerState& b) {
  return numbers_difference({a.phi, a.theta, a.psi, a.Phi, a.Theta, a.Psi},
                            {b.phi, b.theta, b.psi, b.Phi, b.Theta, b.Psi}, 3);
}
bool in_range(double phi, double theta, double psi) {
  return phi > -pi<double>() && phi <= pi<double>() && psi > -pi<double>() && psi <= pi<double>() &&
         theta >= 0.0 && theta <= pi<double>();
}
std::string message_of(const EulerState& e) {
  return test::message_of([&] { euler_state(e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi); });
}

TEST(EulerState, MomentaAreProjectionsOnTheAxesOfTheAngles) {
  Sampler sample(1);
  for (int k = 0; k < 1000; ++k) {
    const RotorState s = sample.generic();
    const EulerState e = to_euler(s);
    const Vec3 G = inertial_momentum(s);
    EXPECT_NEAR(e.Phi, G.z, budget::chart_rounding);
    EXPECT_EQ(e.Psi, s.g.z);
    EXPECT_NEAR(e.Theta, G.x * std::cos(e.phi) + G.y * std::sin(e.phi), budget::chart_rounding);
    EXPECT_TRUE(in_range(e.phi, e.theta, e.psi));
  }
}

// The formulas [SA (25)-(27)] as printed.
TEST(EulerState, BodyMomentumIsThatOfThePaper) {
  Sampler sample(2);
  for (int k = 0; k < 1000; ++k) {
    const EulerState e{sample.angle(),          sample.uniform(0.3, 2.8), sample.angle(),
                       sample.uniform(-1., 1.), sample.uniform(-1., 1.),  sample.uniform(-1., 1.)};
    const double A = (e.Phi - e.Psi * std::cos(e.theta)) / std::sin(e.theta);
    const Vec3 g{A * std::sin(e.psi) + e.Theta * std::cos(e.psi),
                 A * std::cos(e.psi) - e.Theta * std::sin(e.psi), e.Psi};
    EXPECT_LE(norm(to_rotor(e).g - g), budget::chart_rounding * norm(g));
  }
}

TEST(EulerState, ThetaOutsideItsRangeIsAnAngleLikeAnyOther) {
  const EulerState e{0.3, -0.4, 0.5, 0.6, 0.7, 0.8};
  const EulerState f = to_euler(to_rotor(e));
  EXPECT_TRUE(in_range(f.phi, f.theta, f.psi));
  EXPECT_LE(hub_difference(to_rotor(f), to_rotor(e)), budget::chart_rounding);
  EXPECT_NEAR(f.theta, 0.4, budget::chart_rounding);
}

// theta = -(pi - d) is the mirrored pole: Phi + Psi is what is divided there, not Phi - Psi.
TEST(EulerState, NextToAPoleOutsideTheRangeAsWithin) {
  Sampler sample(2);
  for (int k = 0; k < 100; ++k) {
    EulerState e = to_euler(sample.generic());
    const double rest = std::pow(10.0, sample.uniform(-6.0, -1.0));
    e.theta = std::numbers::pi - rest;
    e.Phi = -e.Psi + rest * sample.uniform(-1.0, 1.0);
    // turned by half a turn about the node's normal: (phi + pi, -theta, psi + pi)
    const Vec3 g = to_rotor(e).g;
    const EulerState mirrored{e.phi, -e.theta, e.psi, e.Phi, -e.Theta, e.Psi};
    const Vec3 m = to_rotor(mirrored).g;
    EXPECT_LE(norm(Vec3{-m.x, -m.y, m.z} - g), budget::chart_rounding * norm(g)) << k;
  }
}

// At a pole the node goes along the transverse momentum: nothing is lost.
TEST(EulerState, ExactPolesGiveTheStateBack) {
  Sampler sample(3);
  for (int k = 0; k < 1000; ++k) {
    const RotorState generic = sample.generic();
    const Quaternion spin = rotation_z(sample.angle());
    const RotorState zero{spin, generic.g};
    const EulerState e = to_euler(zero);
    EXPECT_EQ(e.theta, 0.0);
    EXPECT_EQ(e.Phi, e.Psi);
    EXPECT_GE(e.Theta, 0.0);
    EXPECT_LE(hub_difference(to_rotor(e), zero), budget::chart_rounding);
    const RotorState flipped{spin * half_turn, generic.g};
    const EulerState f = to_euler(flipped);
    EXPECT_EQ(f.theta, pi<double>());
    EXPECT_EQ(f.Phi, -f.Psi);
    EXPECT_LE(hub_difference(to_rotor(f), flipped), budget::chart_rounding);
  }
}

TEST(EulerState, PolesWithoutTransverseMomentumHavePsiZero) {
  for (const double z : {0.0, -0.0}) {
    const EulerState e = to_euler({{1, z, z, z}, {z, -z, 2}});
    EXPECT_EQ(e, (EulerState{0, 0, 0, 2, 0, 2}));
    const EulerState f = to_euler({{z, 1, z, z}, {-z, z, 2}});
    EXPECT_EQ(f, (EulerState{0, pi<double>(), 0, -2, 0, 2}));
    const EulerState r = to_euler({{z, z, z, -1}, {z, z, z}});
    EXPECT_EQ(r, (EulerState{pi<double>(), 0, 0, 0, 0, 0}));
    EXPECT_TRUE(finite(to_rotor(EulerState{z, z, z, 2, z, 2})));
    EXPECT_TRUE(finite(to_rotor(EulerState{z, pi<double>(), z, -2, z, 2})));
  }
  const EulerState e = to_euler({rotation_z(0.7), {0, 0, 1}});
  EXPECT_EQ(e.psi, 0.0);
  EXPECT_NEAR(e.phi, 0.7, budget::chart_rounding);
}

// Near a pole the momentum loses about eps |Psi|/sin theta, at most the transverse part itself.
TEST(EulerState, NearThePolesLosesWhatItsNumbersCannotHold) {
  Sampler sample(4);
  for (const double d : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-150, 1e-300}) {
    for (int k = 0; k < 500; ++k) {
      const RotorState s = sample.near_euler_poles(d);
      const EulerState e = to_euler(s);
      const RotorState back = to_rotor(e);
      EXPECT_TRUE(in_range(e.phi, e.theta, e.psi));
      EXPECT_LE(attitude_difference(back.q, s.q), budget::chart_rounding);
      EXPECT_LE(norm(back.g - s.g),
                budget::chart_rounding + smaller(budget::euler_pole_eps * eps / std::sin(e.theta),
                                                 2.0 * std::hypot(s.g.x, s.g.y)));
    }
  }
}

// Phi and Psi a few ulps apart say what the transverse momentum is, to full relative accuracy.
TEST(EulerState, DifferencesOfMomentaKeepTheirDigits) {
  using Wide = DoubleDouble;
  Sampler sample(10);
  for (int k = 0; k < 500; ++k) {
    const double Psi = sample.uniform(1.0, 7.0), Phi = Psi * (1.0 + (1 + k % 7) * eps);
    const double theta = sample.log_uniform(1e-16, 1e-12);
    const EulerState e{sample.angle(), theta, sample.angle(), Phi, 0.0, Psi};
    const RotorState s = to_rotor(e);
    const auto w = to_rotor(BasicEulerState<Wide>{e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi});
    const double size = std::hypot(s.g.x, s.g.y);
    EXPECT_LE(std::abs((Wide(s.g.x) - w.g.x).hi), budget::chart_rounding * size);
    EXPECT_LE(std::abs((Wide(s.g.y) - w.g.y).hi), budget::chart_rounding * size);
  }
}

TEST(EulerState, MomentaThatAreNoStateAreInfiniteAndRefused) {
  const RotorState s = to_rotor(EulerState{0.1, 0.0, 0.0, 2.0, 0.5, 1.0});
  EXPECT_EQ(s.g, (Vec3{0.5, inf, 1.0}));
  EXPECT_EQ(message_of({0.1, 0.0, 0.0, 2.0, 0.5, 1.0}),
            "euler_state: momenta (Phi, Psi) = (2, 1) at theta = 0 must satisfy Phi = Psi");
  EXPECT_EQ(message_of({0.1, pi<double>(), 0.0, 2.0, 0.5, 1.0}),
            "euler_state: momenta (Phi, Psi) = (2, 1) at theta = 3.141592653589793 must satisfy "
            "Phi = -Psi");
  EXPECT_EQ(message_of({0.1, nan, 0.0, 2.0, 0.5, 1.0}),
            "euler_state: (0.1, nan, 0, 2, 0.5, 1) must be finite");
  EXPECT_EQ(message_of({0.1, 0.0, 0.0, 1.0, 0.5, 1.0}), "");
}

TEST(EulerState, ExtremeScalesAndNotANumber) {
  Sampler sample(5);
  for (const double G : {1e-300, 1e-200, 1e200, 1e300}) {
    for (int k = 0; k < 100; ++k) {
      const RotorState s = sample.generic(G);
      EXPECT_LE(hub_difference(to_rotor(to_euler(s)), s),
                budget::chart_rounding / std::sin(to_euler(s).theta));
    }
  }
  EXPECT_TRUE(std::isnan(to_euler({{1, 0, 0, 0}, {nan, 0, 0}}).Theta));
  EXPECT_TRUE(std::isnan(to_euler({{1, nan, 0, 0}, {0, 0, 1}}).theta));
  EXPECT_TRUE(std::isnan(to_rotor(EulerState{0, nan, 0, 1, 1, 1}).q.w));
}

TEST(EulerState, RoundTripFromTheAngles) {
  Sampler sample(6);
  for (int k = 0; k < 1000; ++k) {
    const EulerState e{sample.angle(),          sample.uniform(0.1, 3.0), sample.angle(),
                       sample.uniform(-1., 1.), sample.uniform(-1., 1.),  sample.uniform(-1., 1.)};
    EXPECT_LE(difference(to_euler(to_rotor(e)), e), budget::chart_rounding / std::sin(e.theta));
  }
}

// [SA (5)-(7)] as printed.
TEST(EulerRates, AngularVelocityIsThatOfThePaper) {
  const Body body(1, 2, 2.5);
  Sampler sample(7);
  for (int k = 0; k < 1000; ++k) {
    const EulerRates e{sample.angle(),          sample.uniform(-3., 3.), sample.angle(),
                       sample.uniform(-1., 1.), sample.uniform(-1., 1.), sample.uniform(-1., 1.)};
    const Vec3 w = angular_velocity(body, to_rotor(body, e));
    const double st = std::sin(e.theta), ct = std::cos(e.theta), sp = std::sin(e.psi),
                 cp = std::cos(e.psi);
    EXPECT_NEAR(w.x, e.phi_dot * sp * st + e.theta_dot * cp, budget::chart_rounding);
    EXPECT_NEAR(w.y, e.phi_dot * cp * st - e.theta_dot * sp, budget::chart_rounding);
    EXPECT_NEAR(w.z, e.psi_dot + e.phi_dot * ct, budget::chart_rounding);
    const EulerRates f = to_euler_rates(body, to_rotor(body, e));
    EXPECT_TRUE(in_range(f.phi, f.theta, f.psi));
    EXPECT_LE(hub_difference(to_rotor(body, f), to_rotor(body, e)),
              budget::chart_rounding / std::abs(st));
  }
}

TEST(EulerRates, PolesGiveTheStateBack) {
  const Body body(1, 2, 2.5);
  Sampler sample(8);
  for (int k = 0; k < 1000; ++k) {
    const Quaternion spin = rotation_z(sample.angle());
    const RotorState s{k % 2 == 0 ? spin : spin * half_turn, sample.generic().g};
    const EulerRates e = to_euler_rates(body, s);
    EXPECT_EQ(e.psi_dot, 0.0);
    EXPECT_LE(hub_difference(to_rotor(body, e), s), budget::chart_rounding);
  }
  EXPECT_EQ(to_euler_rates(body, {{1, 0, 0, 0}, {0, 0, 5}}), (EulerRates{0, 0, 0, 2, 0, 0}));
}

TEST(EulerRates, NearThePolesStaysFinite) {
  const Body body(1, 2, 2.5);
  Sampler sample(9);
  for (const double d : {1e-6, 1e-12, 1e-150, 1e-300, 1e-308, 1e-320}) {
    for (int k = 0; k < 200; ++k) {
      const RotorState s = sample.near_euler_poles(d);
      const EulerRates e = to_euler_rates(body, s);
      EXPECT_TRUE(std::isfinite(e.phi_dot) && std::isfinite(e.psi_dot));
      // phi_dot + psi_dot cancels: the axial rate loses eps phi_dot, at most all of itself
      const Vec3 lost = to_rotor(body, e).g - s.g;
      if (d > 1e-300) {
        EXPECT_LE(std::hypot(lost.x, lost.y), budget::chart_rounding);
        EXPECT_LE(std::abs(lost.z), budget::chart_rounding + smaller(budget::euler_pole_eps * eps *
                                                                         2.5 * std::abs(e.phi_dot),
                                                                     2.0 * std::abs(s.g.z)));
      }
      EXPECT_TRUE(finite(to_rotor(body, e)));
      EXPECT_LE(attitude_difference(to_rotor(body, e).q, s.q), budget::chart_rounding);
    }
  }
}

}  // namespace
