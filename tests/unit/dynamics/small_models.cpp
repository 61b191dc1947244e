// SPDX-License-Identifier: MIT
// The least that a model must have: two numbers, and none of the optional members. And what single
// optional members do. Its oracle is the circle that an oscillator runs through.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "budgets.hpp"
#include "polhode/dynamics/detail/sample_queue.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::Worst;

struct Pair {
  double x = 0.0;
  double v = 0.0;

  bool operator==(const Pair&) const = default;
};

template <class Visit>
void each_number(Pair& s, Visit&& visit) {
  visit(s.x);
  visit(s.v);
}

// x'' = -k^2 x, v = x' / k.
struct Oscillator {
  using State = Pair;
  using Values = std::array<double, 2>;
  static constexpr std::string_view name = "an oscillator";

  double k = 1.0;

  template <class T>
    requires std::is_same_v<T, double>
  Values values(const State& s) const {
    return {s.x, s.v};
  }
  State state(const Values& y) const { return {y[0], y[1]}; }
  Values rates(const DoubleDouble&, const Values& y) const { return {k * y[1], -k * y[0]}; }
  double error_size(const Values& error, const Values& y, const Values&) const {
    return std::hypot(error[0], error[1]) / std::hypot(y[0], y[1]);
  }
};

static_assert(Model<Oscillator> && !ModelOn<Oscillator, DoubleDouble>);
static_assert(Integrable<Oscillator> && !Integrable<Pair>);

using OscillatorProblem = BasicProblem<Oscillator>;

double off_the_circle(const BasicSample<Pair>& at, double k) {
  return std::hypot(at.s.x - std::cos(k * at.t), at.s.v + std::sin(k * at.t));
}

TEST(SmallModels, TwoNumbersMoveAsTheClosedForm) {
  for (const Method& method :
       {Method(Adaptive{.tolerance = 1e-14}), Method(Collocation{.tolerance = 1e-14})}) {
    SCOPED_TRACE(method_text(method));
    const OscillatorProblem p{{2.5}, {1.0, 0.0}, 0.0, -20.0, method};
    const BasicTrajectory<Pair> run = integrate(p);
    ASSERT_TRUE(run.outcome().ok()) << run.outcome().advice;
    Worst off;
    for (const double t : {-0.3, -11.1, -20.0}) off.add(off_the_circle({t, run.at(t)}, 2.5));
    for (const BasicSample<Pair>& at : run.samples()) off.add(off_the_circle(at, 2.5));
    EXPECT_LE(off.value(), budget::small_model_motion);
  }
}

TEST(SmallModels, GoByAdaptiveWhereNoMethodIsNamed) {
  const BasicProblem<Oscillator> problem{Oscillator{}, {1.0, 0.0}, 0.0, 1.0};
  EXPECT_EQ(problem.method, Method(Adaptive{}));
}

TEST(SmallModels, TwoNumbersIntoASink) {
  const OscillatorProblem p{{2.5}, {1.0, 0.0}, 0.0, 20.0, Adaptive{.tolerance = 1e-14}};
  const SaveAt times = SaveAt::count(0.0, 20.0, 3001);
  std::vector<BasicSample<Pair>> rows;
  std::size_t blocks = 0;
  const auto sink = [&](std::span<const BasicSample<Pair>> block) {
    ++blocks;
    rows.insert(rows.end(), block.begin(), block.end());
  };
  const BasicTrajectory<Pair> run = integrate(p, times, sink);
  EXPECT_TRUE(run.samples().empty());
  EXPECT_GT(blocks, 1U);
  EXPECT_EQ(rows, integrate(p, {.samples = times, .dense = false}).samples());
  ASSERT_EQ(rows.size(), 3001U);
  Worst off;
  for (const BasicSample<Pair>& at : rows) off.add(off_the_circle(at, 2.5));
  EXPECT_LE(off.value(), budget::small_model_motion);
}

// Without turning_rate steps say how often events are looked at.
TEST(SmallModels, TwoNumbersHaveEvents) {
  for (const Method& method :
       {Method(Adaptive{.tolerance = 1e-14}), Method(Collocation{.tolerance = 1e-14})}) {
    OscillatorProblem p{{2.5}, {1.0, 0.0}, 0.0, 20.0, method};
    p.events = {{"x", [](double, const Pair& s) { return s.x; }}};
    const BasicTrajectory<Pair> run = integrate(p);
    ASSERT_EQ(run.events().size(), 16U);
    for (std::size_t i = 0; i < 16; ++i)
      EXPECT_NEAR(run.events()[i].t, (static_cast<double>(i) + 0.5) * std::numbers::pi / 2.5,
                  budget::small_model_motion);
  }
}

// Slow, so that nothing but the time scale makes steps short.
struct Paced : Oscillator {
  static double time_scale(double t) { return t < 1.0 ? 0.1 : 0.001; }
};

// The longest step that begins before t = 1, and after it.
std::array<double, 2> longest_steps(double start, double stop, const Method& method) {
  const BasicProblem<Paced> p{{{0.01}}, {1.0, 0.0}, start, stop, method};
  const auto run = integrate(p, {.samples = std::nullopt, .dense = false});
  EXPECT_TRUE(run.outcome().ok());
  std::array<double, 2> longest{0.0, 0.0};
  for (std::size_t i = 1; i < run.samples().size(); ++i) {
    const double t = run.samples()[i - 1].t;
    double& so_far = longest[t < 1.0 ? 0 : 1];
    so_far = larger(so_far, std::abs(run.samples()[i].t - t));
  }
  return longest;
}

TEST(SmallModels, NoStepIsLongerThanTheTimeScaleWhereItBegins) {
  for (const bool forward : {true, false})
    for (const Method& method :
         {Method(Adaptive{.tolerance = 1e-9}), Method(Collocation{.tolerance = 1e-9})}) {
      const auto [slow, fast] = longest_steps(forward ? 0.0 : 1.5, forward ? 1.5 : 0.0, method);
      // steps of Collocation grow by and by
      if (forward || std::holds_alternative<Adaptive>(method)) {
        EXPECT_NEAR(slow, 0.1, budget::length_of_last_step);
      }
      EXPECT_LE(slow, 0.1 + budget::length_of_last_step);
      EXPECT_NEAR(fast, 0.001, budget::length_of_last_step);
    }
  for (const Method& method : {Method(Adaptive{.tolerance = 1e-9, .largest_step = 0.5}),
                               Method(Collocation{.tolerance = 1e-9, .largest_step = 0.5})}) {
    const auto [slow, fast] = longest_steps(0.0, 9.0, method);
    EXPECT_GT(slow, 0.1 + budget::length_of_last_step);
    EXPECT_GT(fast, 0.001 + budget::length_of_last_step);
    EXPECT_LE(larger(slow, fast), 0.5 + budget::length_of_last_step);
  }
}

// A state in units in which it is small, and which is brought to a circle.
struct Normalised : Oscillator {
  double radius = 1.0;

  Pair started(const Pair& s) const {
    const double r = radius / std::hypot(s.x, s.v);
    return {r * s.x, r * s.v};
  }
};

// The state that is given lies one part in a hundred outside: its side of an event says nothing.
TEST(SmallModels, EventsBeginAtTheNormalisedStateInAnyUnits) {
  for (const double radius : {1.0, 1e-30, 1e30}) {
    BasicProblem<Normalised> p{
        {{1.0}, radius}, {1.01 * radius, 0.0}, 0.0, 1.0, Adaptive{.tolerance = 1e-12}};
    p.events = {{"outside", [radius](double, const Pair& s) { return s.x / radius - 1.005; }}};
    EXPECT_TRUE(integrate(p).events().empty()) << radius;
  }
}

TEST(SmallModels, ListsOfNumbersAreComparedBySizeFirst) {
  using detail::equal_but_for_rounding;
  EXPECT_FALSE(equal_but_for_rounding({1.0, 2.0}, {1.0}));
  EXPECT_FALSE(equal_but_for_rounding({1.0}, {1.0, 2.0}));
  EXPECT_FALSE(equal_but_for_rounding({1e-20}, {2e-20}));
  EXPECT_FALSE(equal_but_for_rounding({std::nan("")}, {std::nan("")}));
  EXPECT_TRUE(equal_but_for_rounding({1e-20, 0.0}, {std::nextafter(1e-20, 1.0), 0.0}));
  EXPECT_TRUE(equal_but_for_rounding({}, {}));
}

TEST(SmallModels, WithoutTimesTheEndOfEveryStepIsASample) {
  const BasicSampleSink<Pair> nowhere = [](std::span<const BasicSample<Pair>>) {};
  const detail::SampleQueue<Pair> every(0.0, 1.0, std::nullopt, nowhere);
  EXPECT_TRUE(every.is_due(0.5));
  EXPECT_FALSE(every.wants_dense(0.5));
  EXPECT_EQ(every.next(1.0), 1.0);
  const detail::SampleQueue<Pair> none(0.0, 1.0, SaveAt::times({}), nowhere);
  EXPECT_FALSE(none.is_due(0.5));
  EXPECT_EQ(none.next(1.0), 1.0);
}

}  // namespace
