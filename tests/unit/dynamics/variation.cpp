// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "dynamics/variation/variation_collocation.hpp"
#include "polhode/free/free_rotation.hpp"
#include "splitting_support.hpp"

namespace polhode {
namespace {

using namespace splitting_test;

constexpr VariationOfConstants sharp{1e-15};

System gravity(const Body& body, const Frame& frame = Frame::inertial()) {
  return System(body, frame, {AnyPerturbation("gravity gradient", PointMassTorque{1.0, 0.1})});
}

TEST(GaussTableau, IntegratesPolynomials) {
  const detail::GaussTableau& g = detail::gauss_tableau();
  for (int power = 0; power < 24; ++power) {
    double whole = 0.0;
    for (std::size_t j = 0; j < detail::gauss_nodes; ++j) whole += g.b[j] * std::pow(g.c[j], power);
    EXPECT_NEAR(whole, 1.0 / (power + 1), budget::collocation_tableau);
    if (power >= 12) continue;
    for (std::size_t i = 0; i < detail::gauss_nodes; ++i) {
      double part = 0.0;
      for (std::size_t j = 0; j < detail::gauss_nodes; ++j)
        part += g.a[i][j] * std::pow(g.c[j], power);
      EXPECT_NEAR(part, std::pow(g.c[i], power + 1) / (power + 1), budget::collocation_tableau);
    }
  }
}

TEST(GaussTableau, GivesTheLastLegendreCoefficients) {
  const detail::GaussTableau& g = detail::gauss_tableau();
  const auto P = [](unsigned k, double c) { return std::legendre(k, 2.0 * c - 1.0); };
  for (unsigned k = 0; k < 12; ++k) {
    double last[2] = {0.0, 0.0};
    for (std::size_t j = 0; j < detail::gauss_nodes; ++j)
      for (std::size_t m = 0; m < 2; ++m) last[m] += g.last[m][j] * P(k, g.c[j]);
    EXPECT_NEAR(last[0], k == 11 ? 1.0 : 0.0, budget::collocation_legendre);
    EXPECT_NEAR(last[1], k == 10 ? 1.0 : 0.0, budget::collocation_legendre);
  }
}

TEST(VariationOfConstants, IsFreeRotationWhereThereIsNoTorque) {
  const auto methods = [](double time) {
    return std::vector{VariationOfConstants{1e-12, time / 97.3},
                       VariationOfConstants{1e-12, 2.0 * time}};
  };
  expect_free_rotation(methods, budget::variation_free);
}

TEST(VariationOfConstants, AndSplittingAgreeWithDoubleDoubleAfterTenOrbits) {
  const double stop = 20.0 * std::numbers::pi;
  const System system = gravity(workload_body());
  const RotorState s = workload_state();
  const RotorState exact = end_of(system, s, 0.0, stop, reference);
  EXPECT_LE(distance(end_of(system, s, 0.0, stop, sharp), exact), budget::variation_ten_orbits);
  const Splitting splitting{0.01, SplittingScheme::order8};
  EXPECT_LE(distance(end_of(system, s, 0.0, stop, splitting), exact), budget::splitting_ten_orbits);
}

TEST(VariationOfConstants, ErrsByLessForASmallerTolerance) {
  const System system = gravity(workload_body(), precessing_frame());
  const RotorState s = workload_state();
  const RotorState exact = end_of(system, s, 0.0, turns_10, reference);
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
    const RotorState end = end_of(system, s, 0.0, turns_10, VariationOfConstants{tolerance});
    EXPECT_LE(distance(end, exact), budget::variation_per_tolerance * tolerance);
  }
}

TEST(VariationOfConstants, AgreesWithDoubleDoubleForEveryBody) {
  expect_double_double_for_every_body(sharp, budget::variation_bodies);
}

// The energy over that of rotation about the middle axis with the same |g| changes its sign.
TEST(VariationOfConstants, CrossesTheSeparatrix) {
  const Body body(1.0, 2.0, 2.9);
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("gravity gradient", PointMassTorque{1.0, 0.1, 0.2})});
  const RotorState s{{1, 0, 0, 0}, {0.02, 2.0, 0.03}};
  const auto side = [&](const RotorState& x) {
    return dot(x.g, x.g) - 2.0 * kinetic_energy(body, x) * 2.0 > 0.0;
  };
  const auto stepper = detail::make_stepper(Problem{system, s, 0.0, 30.0, sharp, {}}, sharp);
  int crossings = 0;
  for (bool now = side(s); stepper->time() != 30.0;) {
    ASSERT_EQ(stepper->advance(30.0), "");
    const bool next = side(stepper->state());
    if (next != now) ++crossings;
    now = next;
  }
  EXPECT_GT(crossings, 1);
  EXPECT_LE(distance(stepper->state(), end_of(system, s, 0.0, 30.0, reference)),
            budget::variation_separatrix);
}

TEST(VariationOfConstants, RunsBackToWhereItStartedAndIsTheSameInAMovingFrame) {
  const System inertial = gravity(workload_body());
  const System moving = gravity(workload_body(), precessing_frame());
  const RotorState s = workload_state();
  const RotorState there = end_of(moving, s, 0.0, turns_10, sharp);
  EXPECT_LE(distance(end_of(moving, there, turns_10, 0.0, sharp), s), budget::variation_free);
  const double far = 10.0 * turns_10;
  const RotorState farther = end_of(moving, s, 0.0, far, sharp);
  EXPECT_LE(distance(end_of(moving, farther, far, 0.0, sharp), s), budget::hundred_turns_back);
  const RotorState same = end_of(inertial, s, 0.0, turns_10, sharp);
  EXPECT_LE(distance(inertial_state(moving, turns_10, there), same), budget::variation_free);
}

TEST(VariationOfConstants, DenseOutputIsAsGoodAsAStep) {
  const System system = gravity(workload_body(), precessing_frame());
  const RotorState s = workload_state();
  const auto stepper = detail::make_stepper(Problem{system, s, 0.0, 3.0, sharp, {}}, sharp);
  for (int i = 0; i < 6; ++i) {
    ASSERT_EQ(stepper->advance(3.0), "");
    const auto dense = stepper->dense(true);
    EXPECT_EQ(dense->t1(), stepper->time());
    EXPECT_EQ(dense->at(dense->t1()), stepper->state());
    for (const double part : {0.0, 0.37}) {
      const double t = dense->t0() + part * (dense->t1() - dense->t0());
      EXPECT_LE(distance(dense->at(t), end_of(system, s, 0.0, t, reference)),
                budget::variation_dense);
    }
  }
}

TEST(VariationOfConstants, StartsFromRest) {
  const System system = gravity(workload_body());
  const RotorState s{normalized(Quaternion{0.3, -0.4, 0.5, 0.6}), {}};
  EXPECT_LE(distance(end_of(system, s, 0.0, 5.0, sharp), end_of(system, s, 0.0, 5.0, reference)),
            budget::variation_bodies);
}

TEST(VariationOfConstants, SaysWhyItCannotGoOn) {
  const System system(workload_body(), Frame::inertial(),
                      {AnyPerturbation("broken", BreaksAt{1.0})});
  const auto stepper =
      detail::make_stepper(Problem{system, workload_state(), 0.0, 3.0, sharp, {}}, sharp);
  std::string advice;
  while (stepper->time() != 3.0 && advice.empty()) advice = stepper->advance(3.0);
  EXPECT_NEAR(stepper->time(), 1.0, budget::variation_last_time);
  EXPECT_THAT(advice, testing::HasSubstr("term \"broken\" is not finite at t = 1"));
  EXPECT_TRUE(std::isfinite(stepper->state().q.w));
}

TEST(VariationOfConstants, PassesOnWhatATermThrows) {
  const System system(workload_body(), Frame::inertial(), {AnyPerturbation("throws", Throws{})});
  const auto run = [&] { end_of(system, workload_state(), 0.0, 1.0, sharp); };
  EXPECT_THROW(run(), std::runtime_error);
}

}  // namespace
}  // namespace polhode
