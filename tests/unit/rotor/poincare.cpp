// SPDX-License-Identifier: MIT
#include "polhode/rotor/poincare.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "property/chart_support.hpp"

namespace {

using namespace polhode;
using namespace chart_test;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double eps = std::numeric_limits<double>::epsilon();

std::string message_of(const PoincareState& p) {
  return test::message_of(
      [&] { poincare_state(p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2, p.pole_J, p.pole_I); });
}

// The definitions through Andoyer's variables, far from their singularities.
TEST(Poincare, IsItsDefinitionThroughAndoyer) {
  Sampler sample(1);
  for (int k = 0; k < 500; ++k) {
    const RotorState s =
        inclined_state({sample.uniform(0.3, 2.8), false, sample.uniform(0.3, 2.8), false},
                       sample.angle(), sample.angle(), sample.angle(), 2.0);
    const AndoyerState a = to_andoyer(s);
    for (const Pole pole_J : poles) {
      for (const Pole pole_I : poles) {
        const PoincareState p = to_poincare(s, pole_J, pole_I);
        const double sJ = pole_J == Pole::zero ? 1.0 : -1.0;
        const double sI = pole_I == Pole::zero ? 1.0 : -1.0;
        EXPECT_NEAR(p.Q1, -sJ * std::sqrt(2 * (a.G - sJ * a.L)) * std::sin(a.l),
                    budget::andoyer_generic);
        EXPECT_NEAR(p.P1, std::sqrt(2 * (a.G - sJ * a.L)) * std::cos(a.l), budget::andoyer_generic);
        EXPECT_NEAR(p.Q2, -sI * std::sqrt(2 * (a.G - sI * a.H)) * std::sin(a.h),
                    budget::andoyer_generic);
        EXPECT_NEAR(p.P2, std::sqrt(2 * (a.G - sI * a.H)) * std::cos(a.h), budget::andoyer_generic);
        EXPECT_EQ(p.G, a.G);
        EXPECT_LE(std::abs(angle_difference(p.sigma, a.g + sJ * a.l + sI * a.h)),
                  budget::andoyer_generic);
      }
    }
  }
}

TEST(Poincare, NothingIsLostWithin90DegreesOfThePoles) {
  Sampler sample(2);
  for (const double d : {1.5, 1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-150, 0.0}) {
    for (int k = 0; k < 1000; ++k) {
      const Inclined c{d * sample.uniform(0.5, 1.0), sample.coin(), d * sample.uniform(0.5, 1.0),
                       sample.coin()};
      const RotorState s = inclined_state(c, sample.angle(), sample.angle(), sample.angle());
      const PoincareState p = nearest_poincare(s);
      EXPECT_EQ(p.pole_J, c.J_flip ? Pole::pi : Pole::zero);
      EXPECT_EQ(p.pole_I, c.I_flip ? Pole::pi : Pole::zero);
      EXPECT_LE(hub_difference(to_rotor(p), s), budget::poincare);
      // the small momentum keeps its relative accuracy
      const RotorState back = to_rotor(p);
      EXPECT_LE(std::hypot(back.g.x - s.g.x, back.g.y - s.g.y),
                budget::poincare * std::hypot(s.g.x, s.g.y));
      EXPECT_TRUE(p.sigma > -pi<double>() && p.sigma <= pi<double>());
    }
  }
}

TEST(Poincare, PolesAreOrdinaryPoints) {
  for (const double z : {0.0, -0.0}) {
    const PoincareState p = nearest_poincare(RotorState{rotation_z(0.7), {z, -z, 2.0}});
    EXPECT_EQ(p.Q1, 0.0);
    EXPECT_EQ(p.P1, 0.0);
    EXPECT_EQ(p.Q2, 0.0);
    EXPECT_EQ(p.P2, 0.0);
    EXPECT_EQ(p.G, 2.0);
    EXPECT_NEAR(p.sigma, 0.7, budget::chart_rounding);
  }
}

TEST(Poincare, FarPolesHaveTheLimitOfAndoyer) {
  Sampler sample(3);
  for (int k = 0; k < 200; ++k) {
    const RotorState s{rotation_z(sample.angle()), {0.0, 0.0, k % 2 == 0 ? 2.0 : -2.0}};
    const Pole far = k % 2 == 0 ? Pole::pi : Pole::zero;
    const PoincareState p = to_poincare(s, far, far);
    EXPECT_EQ(p.Q1, 0.0);
    EXPECT_EQ(p.Q2, 0.0);
    EXPECT_NEAR(p.P1, 2.0 * std::sqrt(2.0), 2.0 * budget::chart_rounding);
    EXPECT_NEAR(p.P2, 2.0 * std::sqrt(2.0), 2.0 * budget::chart_rounding);
    const RotorState back = to_rotor(p);
    EXPECT_LE(hub_difference(back, s), budget::poincare_far_pole);
  }
}

TEST(Poincare, WithoutMomentumSigmaRemains) {
  Sampler sample(4);
  for (const Pole pole_J : poles) {
    for (const Pole pole_I : poles) {
      const RotorState s{sample.generic().q, {0.0, 0.0, 0.0}};
      const PoincareState p = to_poincare(s, pole_J, pole_I);
      EXPECT_TRUE(std::isfinite(p.sigma));
      EXPECT_EQ(p.Q1 * p.Q1 + p.P1 * p.P1 + p.Q2 * p.Q2 + p.P2 * p.P2 + p.G, 0.0);
      const RotorState back = to_rotor(p);
      EXPECT_TRUE(finite(back));
      EXPECT_EQ(back.g, Vec3{});
      const PoincareState again = to_poincare(back, pole_J, pole_I);
      EXPECT_LE(std::abs(angle_difference(again.sigma, p.sigma)), budget::chart_rounding);
    }
  }
}

TEST(Poincare, FactoryChecksItsDisc) {
  EXPECT_EQ(message_of({0.1, 1.0, 0.0, 1.0, 1.0, 0.0, Pole::zero, Pole::pi}), "");
  EXPECT_EQ(message_of({0.1, 2.0 * (1 + 2 * eps), 0.0, 1.0, 0.0, 0.0, Pole::zero, Pole::pi}), "");
  EXPECT_EQ(message_of({0.1, 2.0, 0.0, 1.0, 1.0, 0.0, Pole::zero, Pole::pi}),
            "poincare_state: (Q1, P1) = (2, 1) must have Q^2 + P^2 <= 4 G, G = 1");
  EXPECT_EQ(message_of({0.1, 0.0, 3.0, 1.0, 0.0, 0.0, Pole::zero, Pole::pi}),
            "poincare_state: (Q2, P2) = (3, 0) must have Q^2 + P^2 <= 4 G, G = 1");
  EXPECT_EQ(message_of({0.1, 0.0, 0.0, -1.0, 0.0, 0.0, Pole::zero, Pole::pi}),
            "poincare_state: G = -1 must not be negative");
  EXPECT_EQ(message_of({nan, 0.0, 0.0, 1.0, 0.0, 0.0, Pole::zero, Pole::pi}),
            "poincare_state: (nan, 0, 0, 1, 0, 0) must be finite");
}

TEST(Poincare, ExtremeScalesAndNotANumber) {
  Sampler sample(5);
  for (const double G : {1e-300, 1e-200, 1e200, 1e300}) {
    for (int k = 0; k < 100; ++k) {
      const RotorState s = sample.generic(G);
      EXPECT_LE(hub_difference(to_rotor(nearest_poincare(s)), s), budget::poincare);
    }
  }
  EXPECT_TRUE(std::isnan(nearest_poincare(RotorState{{1, 0, 0, 0}, {nan, 0, 1}}).G));
  EXPECT_TRUE(std::isnan(to_rotor(PoincareState{nan, 0, 0, 1, 0, 0, Pole::zero, Pole::zero}).q.w));
}

}  // namespace
