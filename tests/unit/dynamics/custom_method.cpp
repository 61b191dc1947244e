// SPDX-License-Identifier: MIT
// A method from outside is one like the others: order, both directions, dense output, events,
// streams, and what it refuses. That it resumes to the bit: tests/unit/dynamics/resume.cpp.
#include "polhode/dynamics/custom_method.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "adaptive_support.hpp"
#include "budgets.hpp"
#include "message_of.hpp"
#include "own_steps.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace {

using namespace polhode;
using polhode::test::distance;
using polhode::test::runge_kutta_4;
using polhode::test::w1;
using testing::HasSubstr;

const Frame turning = Frame::precessing({0.0, 0.6, 0.8}, 0.2, 0.0);

RotorState end_by(const Method& method, double start, double stop) {
  return integrate(w1(method, start, stop, test::w1_state, turning)).samples().back().s;
}

// A torque and a frame that precesses: the error falls by 2^4 with half the step.
TEST(CustomMethod, HasTheOrderOfItsMap) {
  for (const double stop : {3.0, -3.0}) {
    const RotorState exact = end_by(Adaptive{.tolerance = 1e-15}, 0.0, stop);
    const double coarse = distance(end_by(runge_kutta_4(0.01), 0.0, stop), exact);
    const double fine = distance(end_by(runge_kutta_4(0.005), 0.0, stop), exact);
    EXPECT_NEAR(std::log2(coarse / fine), 4.0, budget::custom_method_order) << stop;
    EXPECT_LE(fine, budget::custom_method_fine);
  }
}

TEST(CustomMethod, StepsAreOfOneLengthAndTheLastEndsAtTheStop) {
  const Trajectory run = integrate(w1(runge_kutta_4(0.3), 0.0, 1.0));
  ASSERT_EQ(run.samples().size(), 5U);
  EXPECT_EQ(run.samples().back().t, 1.0);
  EXPECT_EQ(run.statistics().steps, 4);
  EXPECT_EQ(run.samples()[1].t, 0.3);
}

// Inside a step the state is that of a shorter step, as exact as its end.
TEST(CustomMethod, IsDense) {
  const Trajectory run = integrate(w1(runge_kutta_4(0.01), 0.0, 2.0));
  const Trajectory exact = integrate(w1(Adaptive{.tolerance = 1e-14}, 0.0, 2.0));
  for (int i = 0; i < 100; ++i) {
    const double t = 0.0199 * i;
    EXPECT_LE(distance(run.at(t), exact.at(t)), budget::custom_method_dense) << t;
  }
}

TEST(CustomMethod, FindsEvents) {
  const Event event{"height", [](double, const RotorState& s) { return s.g.z - 7.0; }};
  Problem own = w1(runge_kutta_4(0.01), 0.0, 5.0);
  Problem sharp = w1(Adaptive{.tolerance = 1e-14}, 0.0, 5.0);
  own.events = {event};
  sharp.events = {event};
  const auto found = integrate(own).events();
  const auto expected = integrate(sharp).events();
  ASSERT_GE(expected.size(), 2U);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i].t, expected[i].t, budget::custom_method_event);
}

TEST(CustomMethod, SaysWhatItIs) {
  const Method method = runge_kutta_4(0.25);
  EXPECT_EQ(method_text(method), "runge-kutta-4, step 0.25");
  const MethodTraits traits = method_traits(method);
  EXPECT_EQ(traits.kind, "runge-kutta-4");
  EXPECT_EQ(traits.step, 0.25);
  EXPECT_FALSE(traits.needs_flows);
  EXPECT_FALSE(moves_any_state(method));
  EXPECT_EQ(method, Method(runge_kutta_4(0.25)));
  EXPECT_NE(method, Method(runge_kutta_4(0.5)));
  EXPECT_EQ(integrate(w1(method, 0.0, 1.0)).method(), "runge-kutta-4, step 0.25");
}

TEST(CustomMethod, ACheckpointOfOtherNumbersIsRefused) {
  const auto method = [](double damping) {
    return custom_method({"half-made",
                          0.1,
                          [](const System& system, double t, const RotorState& s, double h) {
                            return test::runge_kutta_4(system, t, s, h);
                          },
                          {damping}});
  };
  const SaveAt times = SaveAt::count(0.0, 5.0, 51);
  std::vector<Checkpoint> kept;
  Streams streams{[](std::span<const Sample>) {}, [](const EventRecord&) {},
                  [](double) { return true; }, [&](const Checkpoint& now) { kept.push_back(now); }};
  integrate(w1(method(0.5), 0.0, 5.0), times, streams);
  ASSERT_FALSE(kept.empty());
  EXPECT_NO_THROW(resume(w1(method(0.5), 0.0, 5.0), times, kept[0], streams));
  EXPECT_REJECTED(resume(w1(method(0.6), 0.0, 5.0), times, kept[0], streams), "method");
}

TEST(CustomMethod, AStateThatIsNotFiniteEndsTheRun) {
  const CustomMethod breaks =
      custom_method({"breaks", 0.1, [](const System&, double t, const RotorState& s, double h) {
                       return RotorState{s.q, t + h > 1.05 ? Vec3{NAN, 0.0, 0.0} : s.g};
                     }});
  const Outcome outcome = integrate(w1(breaks, 0.0, 2.0)).outcome();
  EXPECT_FALSE(outcome.ok());
  EXPECT_NEAR(outcome.t, 1.0, budget::custom_method_event);
  EXPECT_THAT(outcome.advice, HasSubstr("not finite after the step from t = "));
}

TEST(CustomMethod, AStepBelowRoundingEndsTheRun) {
  const Outcome outcome = integrate(w1(runge_kutta_4(1e-3), 1e16, 1.1e16)).outcome();
  EXPECT_THAT(outcome.advice, HasSubstr("step 0.001 is below the rounding of t = 1e+16"));
}

TEST(CustomMethod, RefusesWhatMakesNoMethod) {
  const StepMap map = [](const System&, double, const RotorState& s, double) { return s; };
  const double inf = std::numeric_limits<double>::infinity();
  for (const double step : {0.0, -1.0, inf, std::nan("")})
    EXPECT_REJECTED(custom_method({"a", step, map}), "must be positive and finite");
  EXPECT_REJECTED(custom_method({"", 1.0, map}), "got an empty kind");
  EXPECT_REJECTED(custom_method({"a", 1.0, {}}), "got no map");
  EXPECT_REJECTED(require_valid(CustomMethod{}), "use custom_method");
}

// It moves a rotor, and knows no derivatives.
TEST(CustomMethod, IsRefusedForOtherStates) {
  const Problem problem = w1(runge_kutta_4(0.1), 0.0, 1.0);
  const SaveAt times = SaveAt::count(0.0, 1.0, 3);
  EXPECT_MESSAGE(state_transitions(problem, times),
                 "state_transitions: method \"runge-kutta-4\" carries no derivatives: take "
                 "Adaptive, Collocation, Splitting or VariationOfConstants");
  EXPECT_MESSAGE(analysis::chaos_indicator(problem, times, {}),
                 "chaos_indicator: method \"runge-kutta-4\" carries no deviations: take Adaptive, "
                 "Collocation, Splitting or VariationOfConstants");
  const System damped(test::w1_body, Frame::inertial(), {}, KaneDamper(0.1, 0.1));
  EXPECT_REJECTED(integrate(Problem{damped, test::w1_state, 0.0, 1.0, runge_kutta_4(0.1)}),
                  "method must be Adaptive");
}

}  // namespace
