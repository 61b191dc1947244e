// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "dynamics/collocation/collocation_solver.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "splitting_support.hpp"

namespace polhode {
namespace {

using namespace splitting_test;
using testing::HasSubstr;

System gravity(const Frame& frame = Frame::inertial()) {
  const AnyOrbit orbit("orbit", KeplerOrbit({1.0, 0.9, 0.1}));
  return System(workload_body(), frame,
                {AnyPerturbation("gravity gradient", GravityGradient(1.0, orbit))});
}

class Schemes : public testing::TestWithParam<std::size_t> {};

TEST_P(Schemes, IntegratePolynomials) {
  const detail::GaussScheme& g = detail::gauss_scheme(GetParam());
  for (std::size_t power = 0; power < 2 * g.stages; ++power) {
    const auto n = static_cast<double>(power);
    double whole = 0.0;
    for (std::size_t j = 0; j < g.stages; ++j) whole += g.b[j] * std::pow(g.c[j], n);
    EXPECT_NEAR(whole, 1.0 / (n + 1.0), budget::collocation_tableau);
    if (power >= g.stages) continue;
    for (std::size_t i = 0; i < g.stages; ++i) {
      double part = 0.0;
      for (std::size_t j = 0; j < g.stages; ++j) part += g.mu[j][i] * g.b[j] * std::pow(g.c[j], n);
      EXPECT_NEAR(part, std::pow(g.c[i], n + 1.0) / (n + 1.0), budget::collocation_tableau);
    }
  }
}

// To the last bit: else invariants drift.
TEST_P(Schemes, AreSymplecticAndSymmetricInDoubles) {
  const detail::GaussScheme& g = detail::gauss_scheme(GetParam());
  for (std::size_t i = 0; i < g.stages; ++i) {
    EXPECT_EQ(g.b[i], g.b[g.stages - 1 - i]);
    for (std::size_t j = 0; j < g.stages; ++j) {
      const DoubleDouble pair = DoubleDouble::sum(g.mu[j][i], g.mu[i][j]);
      EXPECT_EQ(pair.hi, 1.0);
      EXPECT_EQ(pair.lo, 0.0);
    }
  }
  const detail::StepWeights w = detail::step_weights(g, 0.1);
  EXPECT_NEAR((w.length - 0.1).hi, 0.0, budget::collocation_tableau * 0.1);
}

TEST_P(Schemes, GiveLegendreCoefficients) {
  const detail::GaussScheme& g = detail::gauss_scheme(GetParam());
  for (unsigned k = 0; k < g.stages; ++k)
    for (std::size_t m = 0; m < g.stages; ++m) {
      double coefficient = 0.0;
      for (std::size_t j = 0; j < g.stages; ++j)
        coefficient += g.coefficient[j][m] * std::legendre(k, 2.0 * g.c[j] - 1.0);
      EXPECT_NEAR(coefficient, k == m ? 1.0 : 0.0, budget::collocation_legendre);
    }
}

INSTANTIATE_TEST_SUITE_P(Gauss, Schemes, testing::Values(4, 8, 16, 32));

TEST(Collocation, IsFreeRotationWhereThereIsNoTorque) {
  expect_free_rotation([](double) { return std::vector{Collocation{}}; }, budget::collocation_free);
}

TEST(Collocation, AgreesWithDoubleDoubleAfterTenOrbits) {
  const double stop = 20.0 * std::numbers::pi;
  const RotorState s = workload_state();
  for (const Frame& frame : {Frame::inertial(), precessing_frame()}) {
    const RotorState exact = end_of(gravity(frame), s, 0.0, stop, reference);
    for (const int stages : {4, 8, 16})
      EXPECT_LE(distance(end_of(gravity(frame), s, 0.0, stop, Collocation{1e-13, stages}), exact),
                budget::collocation_ten_orbits)
          << stages;
  }
}

TEST(Collocation, ErrsByLessForASmallerTolerance) {
  const System system = gravity(precessing_frame());
  const RotorState s = workload_state();
  const RotorState exact = end_of(system, s, 0.0, turns_10, reference);
  for (const int stages : {4, 8, 16})
    for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
      const RotorState end = end_of(system, s, 0.0, turns_10, Collocation{tolerance, stages});
      EXPECT_LE(distance(end, exact), budget::collocation_per_tolerance * tolerance)
          << stages << " " << tolerance;
    }
}

TEST(Collocation, IsOfTwiceItsStages) {
  const System system = gravity();
  const RotorState s = workload_state();
  const RotorState exact = end_of(system, s, 0.0, 8.0, reference);
  const auto slope = [&](int stages, double h, double smaller) {
    const auto error = [&](double step) {
      return distance(end_of(system, s, 0.0, 8.0, Collocation{.stages = stages, .step = step}),
                      exact);
    };
    return std::log(error(h) / error(smaller)) / std::log(h / smaller);
  };
  EXPECT_NEAR(slope(4, 0.2, 0.1), 8.0, budget::collocation_order);
  EXPECT_NEAR(slope(8, 0.32, 0.2), 16.0, budget::collocation_order);
}

TEST(Collocation, AgreesWithDoubleDoubleForEveryBody) {
  expect_double_double_for_every_body(Collocation{}, budget::collocation_bodies);
}

TEST(Collocation, RunsBackToWhereItStarted) {
  const System system = gravity(precessing_frame());
  const RotorState s = workload_state();
  for (const Collocation& method : {Collocation{}, Collocation{.step = 0.12}}) {
    const RotorState there = end_of(system, s, 0.0, turns_10, method);
    EXPECT_LE(distance(end_of(system, there, turns_10, 0.0, method), s), budget::collocation_back);
  }
}

// The lanes of every set of instructions give the same bits.
TEST(Collocation, DoesNotDependOnTheProcessor) {
  const auto field =
      std::make_shared<const detail::RotorField<double>>(gravity(precessing_frame()));
  const auto end = [&](std::size_t stages, InstructionSet set) {
    detail::CollocationSolver solver(field, stages, set, 0.0,
                                     detail::RotorField<double>::start(workload_state()),
                                     {{1e-12}, false});
    while (solver.time().hi < 20.0) EXPECT_EQ(solver.advance(20.0), StepOutcome::made);
    solver.refined();
    return std::pair(solver.state().y, solver.state().carry);
  };
  for (const std::size_t stages : {4U, 8U, 16U})
    for (const InstructionSet set : supported_instruction_sets())
      EXPECT_EQ(end(stages, set), end(stages, InstructionSet::baseline))
          << stages << " " << instruction_set_name(set);
}

// |q| is never brought back to 1, and |g| of a sphere nowhere told: both walk by rounding alone.
TEST(Collocation, KeepsQuadraticInvariants) {
  const auto field =
      std::make_shared<const detail::RotorField<double>>(System(Body(0.9, 1.0, 1.1)));
  const RotorState s = workload_state();
  detail::CollocationSolver solver(field, 8, widest_instruction_set(), 0.0,
                                   detail::RotorField<double>::start(s), {{1e-12, 0.15}, true});
  const double stop = 15000.0;
  while (solver.time().hi < stop) ASSERT_EQ(solver.advance(stop), StepOutcome::made);
  const auto sum = [&](std::size_t i) {
    return DoubleDouble::sum(solver.state().y[i], solver.state().carry[i]);
  };
  DoubleDouble q2, g2, energy;
  const Vec3& I = field->system().body().moments();
  for (std::size_t i = 0; i < 4; ++i) q2 += sum(i) * sum(i);
  for (std::size_t i = 4; i < 7; ++i) {
    g2 += sum(i) * sum(i);
    energy += sum(i) * sum(i) / I[static_cast<int>(i) - 4];
  }
  const double G2 = dot(s.g, s.g),
               E = s.g.x * s.g.x / I.x + s.g.y * s.g.y / I.y + s.g.z * s.g.z / I.z;
  EXPECT_NEAR((q2 - 1.0).hi, 0.0, budget::collocation_invariant);
  EXPECT_NEAR((g2 - G2).hi / G2, 0.0, budget::collocation_invariant);
  EXPECT_NEAR((energy - E).hi / E, 0.0, budget::collocation_invariant);
}

// Inside a step as accurate as at its ends, by the polynomial that a trajectory keeps.
TEST(Collocation, IsAccurateInsideItsSteps) {
  const System system = gravity(precessing_frame());
  const RotorState s = workload_state();
  const Trajectory run = integrate({system, s, 0.0, 6.0, Collocation{}});
  for (int k = 0; k <= 60; ++k) {
    const double t = 0.1 * k;
    const RotorState exact = k == 0 ? s : end_of(system, s, 0.0, t, reference);
    EXPECT_LE(distance(run.at(t), exact), budget::collocation_dense) << t;
  }
}

TEST(Collocation, FindsEvents) {
  const auto height = [](double, const RotorState& x) { return x.g.z - 8.0; };
  const auto events = [&](const Method& method) {
    Problem p{gravity(), workload_state(), 0.0, 20.0, method, {}};
    p.events.push_back({"height", height, Crossing::both, false, 0.0});
    return integrate(p, {SaveAt::times({20.0})}).events();
  };
  const auto found = events(Collocation{}), exact = events(Adaptive{1e-14});
  ASSERT_EQ(found.size(), exact.size());
  ASSERT_GT(found.size(), 4U);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i].t, exact[i].t, budget::collocation_event);
}

// A torque whose side the attitude decides, and one that jumps with time.
TEST(Collocation, EndsItsStepsWhereATorqueSwitches) {
  const auto push = [](const double&, const RotorState&, std::span<const double> sides) {
    return Vec3{0.05 * sides[0], 0.0, sides[1] > 0.0 ? 0.04 : 0.0};
  };
  const auto sides = [](double t, const RotorState& s) {
    return std::vector{std::sin(0.7 * t), s.g.z - 0.2};
  };
  const System system(Body(1.0, 2.0, 2.7), precessing_frame(),
                      {AnyPerturbation("push", SwitchedTorqueTerm(push, sides))});
  const RotorState s{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}};
  const RotorState exact = end_of(system, s, 0.0, 40.0, Adaptive{1e-14});
  EXPECT_LE(distance(end_of(system, s, 0.0, 40.0, Collocation{}), exact),
            budget::collocation_switches);
}

// A torque that is weak and fast, a pulse, and a kink that nothing names: next to the free rotation
// they hardly show, and no step may pass over what it does not resolve.
TEST(Collocation, ResolvesWeakTorques) {
  const auto error = [](const auto& torque, const Method& method) {
    const System system(Body(1.0, 2.0, 2.7), Frame::inertial(),
                        {AnyPerturbation("torque", TorqueTerm(torque))});
    const RotorState s{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}};
    const auto end = [&](const Method& by) {
      return integrate({system, s, 0.0, 100.0, by}, {SaveAt::times({100.0})}).samples().back().s;
    };
    return distance(end(method), end(Adaptive{1e-14}));
  };
  const auto along_1 = [](const auto& f) {
    return [f](double t, const RotorState&) { return Vec3{f(t), 0.0, 0.0}; };
  };
  const auto fast = along_1([](double t) { return 1e-6 * std::sin(40.0 * t); });
  const auto pulse = along_1([](double t) {
    const double x = (std::fmod(t, 7.0) - 3.0) / 0.2;
    return 1e-6 * std::exp(-x * x);
  });
  const auto kink = along_1([](double t) { return 1e-6 * std::abs(std::sin(1.3 * t)); });
  for (const int stages : {4, 8, 16}) {
    const Collocation method{.stages = stages};
    EXPECT_LE(error(fast, method), budget::collocation_weak) << stages;
    EXPECT_LE(error(pulse, method), budget::collocation_weak) << stages;
    EXPECT_LE(error(kink, method), budget::collocation_kink) << stages;
  }
}

// Noise of a torque ends no sweep at rounding: a loose tolerance does not ask for that.
TEST(Collocation, PassesOverNoiseBelowTheTolerance) {
  std::uint64_t seed = 1;
  const auto noisy = [&seed](double, const RotorState& s) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return 1e-10 * (static_cast<double>(seed >> 11) * 0x1p-53 - 0.5) * s.g;
  };
  const System system(Body(1.0, 2.0, 2.7), Frame::inertial(),
                      {AnyPerturbation("noise", TorqueTerm(noisy))});
  const Trajectory run =
      integrate({system, {{1, 0, 0, 0}, {0.8, 1.9, 0.3}}, 0.0, 60.0, Collocation{1e-4}},
                {SaveAt::times({60.0})});
  EXPECT_EQ(run.outcome().status, Outcome::Status::completed);
  EXPECT_LE(run.statistics().steps, 200);
}

TEST(Collocation, MakesNoSliverOfAFixedStep) {
  const Trajectory run =
      integrate({gravity(), workload_state(), 0.0, 0.1 * 3.0, Collocation{.step = 0.1}});
  EXPECT_EQ(run.statistics().steps, 3);
}

TEST(Collocation, RefusesAStepThatDoesNotConverge) {
  const Trajectory run =
      integrate({gravity(), workload_state(), 0.0, 100.0, Collocation{.step = 20.0}},
                {SaveAt::times({100.0})});
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice, HasSubstr("do not converge: take a shorter step"));
}

TEST(Collocation, RefusesValuesOutOfRange) {
  const auto refused = [](const Collocation& m) { EXPECT_THROW(require_valid(m), DomainError); };
  refused({.tolerance = 1e-16});
  refused({.stages = 5});
  refused({.step = -1.0});
  refused({.step = 0.1, .largest_step = 1.0});
  refused({.tolerance = 1e-9, .step = 0.1});
  refused({.largest_step = 0.0});
}

}  // namespace
}  // namespace polhode
