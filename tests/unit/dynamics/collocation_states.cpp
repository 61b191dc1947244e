// SPDX-License-Identifier: MIT
// States of every kind by Collocation: their lanes, what fixed steps conserve, jumps and kinks
// inside a run, torques that are weak. Adaptive at a tight tolerance is the oracle, or a law.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "budgets.hpp"
#include "dynamics/collocation/collocation_solver.hpp"
#include "dynamics/collocation/damper_stages.hpp"
#include "dynamics/collocation/generic_stages.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "splitting_support.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::Worst;
using splitting_test::distance;

const Body body(1.0, 1.6, 2.1);
const RotorState start{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}};
const Vec3 rate{0.4, -0.7, 0.2};

Problem damped(const std::vector<AnyPerturbation>& terms, double stop, const Method& method,
               double friction = 0.4) {
  return {System(body, Frame::precessing({0.1, 0.2, 1.0}, 0.3), terms, KaneDamper(0.3, friction)),
          {start.q, start.g, rate},
          0.0,
          stop,
          method};
}
SystemState end_of(const Problem& problem) {
  const Trajectory run = integrate(problem, {SaveAt::times({problem.stop})});
  EXPECT_TRUE(run.outcome().ok()) << run.outcome().advice;
  return run.samples().back().s;
}
double apart(const SystemState& a, const SystemState& b) {
  return distance(a, b) + norm(a.damper_rate - b.damper_rate);
}

// Bits of a solver after 20 units of time, by one set of instructions.
template <class Stages>
auto bits_after(const std::shared_ptr<const typename Stages::Field>& field,
                const typename Stages::Values& y, std::size_t stages, InstructionSet set) {
  detail::BasicCollocationSolver<Stages> solver(field, stages, set, 0.0, y, {{1e-12}, false});
  while (solver.time().hi < 20.0) EXPECT_EQ(solver.advance(20.0), StepOutcome::made);
  solver.refined();
  return std::pair(solver.state().y, solver.state().carry);
}

struct Spinning final : detail::NumberField {
  void rates(const DoubleDouble& t, std::span<const double> y,
             std::span<double> to) const override {
    for (std::size_t n = 0; n < y.size(); ++n)
      to[n] = std::sin(t.hi) * y[(n + 1) % y.size()] - 0.1 * y[n];
  }
  double error_size(std::span<const double> error, std::span<const double> y,
                    std::span<const double>) const override {
    double a = 0.0, b = 0.0;
    for (const double x : error) a += std::abs(x);
    for (const double x : y) b += std::abs(x);
    return a / b;
  }
};

TEST(CollocationStates, DoNotDependOnTheProcessor) {
  const auto with_damper = std::make_shared<const detail::SweptDamper>(damped({}, 1.0, {}).system);
  const auto first = detail::SweptDamper::start({start.q, start.g, rate});
  const auto numbers = std::make_shared<const Spinning>();
  const std::vector<double> eleven{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  for (const std::size_t stages : {4U, 8U, 16U})
    for (const InstructionSet set : supported_instruction_sets()) {
      SCOPED_TRACE(instruction_set_name(set));
      constexpr InstructionSet base = InstructionSet::baseline;
      EXPECT_EQ(bits_after<detail::DamperStages>(with_damper, first, stages, set),
                bits_after<detail::DamperStages>(with_damper, first, stages, base));
      EXPECT_EQ(bits_after<detail::GenericStages>(numbers, eleven, stages, set),
                bits_after<detail::GenericStages>(numbers, eleven, stages, base));
    }
}

// A torque that jumps with time at breakpoints, one that jumps where a function of time is zero,
// and one with a kink that the attitude decides.
TEST(CollocationStates, EndTheirStepsWhereATorqueSwitches) {
  const TorqueTable jets(
      {{0.0, {}}, {2.7, {0.3, 0.0, 0.0}}, {2.9, {}}, {5.5, {0.0, 0.2, 0.0}}, {11.0, {}}},
      {TorqueTable::Between::step, TorqueTable::Outside::hold, std::nullopt});
  const auto push = [](const double&, const RotorState& s, std::span<const double> sides) {
    return Vec3{0.05 * sides[0], 0.0, sides[1] > 0.0 ? 0.2 * (s.g.z - 0.2) : 0.0};
  };
  const auto sides = [](double t, const RotorState& s) {
    return std::vector{std::sin(0.7 * t), s.g.z - 0.2};
  };
  const std::vector<AnyPerturbation> terms{
      AnyPerturbation("jets", jets), AnyPerturbation("push", SwitchedTorqueTerm(push, sides))};
  for (const double stop : {20.0, -3.0}) {
    const SystemState exact = end_of(damped(terms, stop, Adaptive{1e-14}));
    for (const int stages : {4, 8, 16})
      EXPECT_LE(apart(end_of(damped(terms, stop, Collocation{1e-13, stages})), exact),
                budget::collocation_switches)
          << stages << " " << stop;
  }
}

// Derivatives across breakpoints, and across a kink at which the attitude switches a torque.
TEST(CollocationStates, CarryDerivativesAcrossKinks) {
  const auto push = [](const auto&, const auto& s, std::span<const double> sides) {
    using T = std::decay_t<decltype(s.q.w)>;
    return BasicVec3<T>{T(0.05 * sides[0]), T(0.0),
                        sides[1] > 0.0 ? T(0.2) * (s.g.z - T(0.2)) : T(0.0)};
  };
  const auto sides = [](double t, const RotorState& s) {
    return std::vector{std::sin(0.7 * t), s.g.z - 0.2};
  };
  const System system(body, Frame::precessing({0.1, 0.2, 1.0}, 0.3),
                      {AnyPerturbation("push", SwitchedTorqueTerm(push, sides))});
  for (const double stop : {20.0, -20.0}) {
    const SaveAt times = SaveAt::count(0.0, stop, 7);
    const auto exact = state_transitions({system, start, 0.0, stop, Adaptive{1e-13}}, times);
    for (const int stages : {4, 8, 16}) {
      const auto rows =
          state_transitions({system, start, 0.0, stop, Collocation{1e-13, stages}}, times);
      ASSERT_EQ(rows.size(), exact.size());
      Worst off;
      double size = 0.0;
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j) {
            size = detail::larger(size, std::abs(exact[k].transition(i, j)));
            off.add(std::abs(rows[k].transition(i, j) - exact[k].transition(i, j)));
          }
      EXPECT_LE(off.value(), budget::collocation_transition * size) << stages << " " << stop;
    }
  }
}

// Where a torque jumps as the state decides, as Adaptive says it.
TEST(CollocationStates, CarryNoDerivativesAcrossJumps) {
  const auto push = [](const auto&, const auto& s, std::span<const double> sides) {
    using T = std::decay_t<decltype(s.q.w)>;
    return BasicVec3<T>{T(0.0), T(0.0), T(sides[0] > 0.0 ? 0.04 : 0.0)};
  };
  const auto sides = [](double, const RotorState& s) { return std::vector{s.g.z - 0.2}; };
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("push", SwitchedTorqueTerm(push, sides))});
  const auto refusal = [&](const Method& method) {
    return test::message_of([&] {
      state_transitions({system, start, 0.0, 40.0, method}, SaveAt::times({40.0}));
    });
  };
  const std::string said = refusal(Adaptive{});
  EXPECT_THAT(said, testing::HasSubstr("its transition matrix is not known"));
  const std::string where = said.substr(0, said.find(" at t = "));
  EXPECT_THAT(refusal(Collocation{}), testing::StartsWith(where));
}

// The states of a run with derivatives are those of the run without, to the last bit: the same
// steps, wherever samples lie.
TEST(CollocationStates, DerivativesLeaveTheMotionAlone) {
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("gravity", splitting_test::PointMassTorque{1.0, 0.1, 0.2})});
  const Problem problem{system, start, 0.0, 30.0, Collocation{.step = 0.2}};
  const SaveAt times = SaveAt::times({0.1, 3.0, 17.77, 30.0});
  const auto rows = state_transitions(problem, times);
  const Trajectory run = integrate(problem, {times});
  ASSERT_EQ(rows.size(), run.samples().size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].s.g, run.samples()[k].s.g);
    EXPECT_LE(distance(rows[k].s, run.samples()[k].s), budget::collocation_tableau);
  }
}

// Next to the rotation a weak torque hardly shows, and no step may pass over what it does not
// resolve.
TEST(CollocationStates, ResolveWeakTorques) {
  const auto fast = [](double t, const RotorState&) {
    return Vec3{1e-6 * std::sin(40.0 * t), 0.0, 0.0};
  };
  const std::vector<AnyPerturbation> terms{AnyPerturbation("torque", TorqueTerm(fast))};
  const SystemState exact = end_of(damped(terms, 40.0, Adaptive{1e-14}, 0.01));
  for (const int stages : {4, 8, 16})
    EXPECT_LE(apart(end_of(damped(terms, 40.0, Collocation{.stages = stages}, 0.01)), exact),
              budget::collocation_weak)
        << stages;
}

struct Pair {
  double x = 1.0;
  double v = 0.0;
  bool operator==(const Pair&) const = default;
};
template <class Visit>
void each_number(Pair& s, Visit&& visit) {
  visit(s.x);
  visit(s.v);
}

// x'' = -x + 1e-6 sin 40 t, of which the closed form is known.
struct Driven {
  using State = Pair;
  using Values = std::array<double, 2>;
  static constexpr std::string_view name = "a driven oscillator";
  template <class T>
    requires std::is_same_v<T, double>
  Values values(const State& s) const {
    return {s.x, s.v};
  }
  State state(const Values& y) const { return {y[0], y[1]}; }
  Values rates(const DoubleDouble& t, const Values& y) const {
    return {y[1], 1e-6 * std::sin(40.0 * t.hi) - y[0]};
  }
  double error_size(const Values& error, const Values& y, const Values&) const {
    return std::hypot(error[0], error[1]) / std::hypot(y[0], y[1]);
  }
};

TEST(CollocationStates, OfModelsResolveWeakTorques) {
  const double t = 100.0, a = 1e-6 / (1.0 - 40.0 * 40.0);
  const double x = std::cos(t) - 40.0 * a * std::sin(t) + a * std::sin(40.0 * t);
  for (const int stages : {4, 8, 16}) {
    const BasicProblem<Driven> p{{}, {}, 0.0, t, Collocation{.stages = stages}};
    const auto run = integrate(p, {SaveAt::times({t})});
    EXPECT_NEAR(run.samples().back().s.x, x, budget::collocation_weak) << stages;
  }
}

// A sphere that follows closely: the body says how long steps are, not the friction.
TEST(CollocationStates, OfADamperTakeLongStepsUnderStrongFriction) {
  const auto run = [](const Method& method) {
    const Trajectory found =
        integrate(damped({}, 20.0, method, 300.0), {SaveAt::times({20.0}), false});
    EXPECT_TRUE(found.outcome().ok()) << found.outcome().advice;
    return found;
  };
  const Trajectory exact = run(Adaptive{1e-13});
  for (const int stages : {4, 8, 16}) {
    const Trajectory found = run(Collocation{1e-13, stages});
    EXPECT_LE(apart(found.samples().back().s, exact.samples().back().s),
              budget::collocation_friction)
        << stages;
    EXPECT_LE(found.statistics().steps, exact.statistics().steps / 10) << stages;
  }
}

// Energy and momentum of a hub whose sphere slides freely: no drift by fixed steps.
TEST(CollocationStates, OfADamperKeepQuadraticInvariants) {
  const auto field = std::make_shared<const detail::SweptDamper>(
      System(body, Frame::inertial(), {}, KaneDamper(0.3, 0.0)));
  detail::BasicCollocationSolver<detail::DamperStages> solver(
      field, 8, widest_instruction_set(), 0.0, detail::SweptDamper::start({start.q, start.g, rate}),
      {{1e-12, 0.3}, true});
  const auto square = [&](std::size_t first, std::size_t last) {
    DoubleDouble sum;
    for (std::size_t i = first; i < last; ++i) {
      const DoubleDouble x = DoubleDouble::sum(solver.state().y[i], solver.state().carry[i]);
      sum += x * x;
    }
    return sum;
  };
  const DoubleDouble q2 = square(0, 4), g2 = square(4, 7);
  const double stop = 15000.0;
  while (solver.time().hi < stop) ASSERT_EQ(solver.advance(stop), StepOutcome::made);
  EXPECT_NEAR((square(0, 4) - q2).hi, 0.0, budget::collocation_invariant);
  EXPECT_NEAR((square(4, 7) - g2).hi / g2.hi, 0.0, budget::collocation_invariant);
}

}  // namespace
}  // namespace polhode
