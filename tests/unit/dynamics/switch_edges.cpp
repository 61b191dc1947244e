// SPDX-License-Identifier: MIT
// Edges that are hard to see: dips between the samples of a step, NaN, zeros at the start, jumps
// that the state decides where derivatives are asked for, a pericentre that is passed in no time.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "dynamics/adaptive/switching_functions.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/user_terms.hpp"

namespace polhode {
namespace {

using testing::HasSubstr;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- the search itself ----

template <class F>
class Curve final : public detail::SwitchCurve {
 public:
  explicit Curve(F f) : f_(std::move(f)) {}
  std::vector<double> along(double x) const override {
    ++calls;
    return {f_(x)};
  }
  double truly(std::size_t, double x) const override { return f_(x); }
  double rounding(std::size_t) const override { return 0x1p-46; }

  mutable int calls = 0;

 private:
  F f_;
};

TEST(EdgeSearch, FindsADipWhereverItLies) {
  for (const double width : {1e-3, 1e-2, 0.1})
    for (int k = 0; k <= 1000; ++k) {
      // not over the ends: those are other cases
      const double middle = 1.1 * width + (1.0 - 2.2 * width) * k / 1000.0;
      const Curve vee([&](double x) { return std::fabs(x - middle) - width; });
      const Curve round([&](double x) { return (x - middle) * (x - middle) - width * width; });
      const Curve uneven(
          [&](double x) { return (x < middle ? 3.0 * (middle - x) : 0.5 * (x - middle)) - width; });
      for (const auto& edge :
           {detail::search_edges(vee).first, detail::search_edges(round).first}) {
        ASSERT_TRUE(edge) << width << " " << middle;
        EXPECT_NEAR(edge->x, middle - width, budget::bang_floor);
      }
      const auto edge = detail::search_edges(uneven).first;
      if (middle + 2.0 * width < 1.0) {
        ASSERT_TRUE(edge) << width << " " << middle;
        EXPECT_NEAR(edge->x, middle - width / 3.0, budget::bang_floor);
      }
    }
}

TEST(EdgeSearch, NoDipIsInventedAndMostStepsAreCheap) {
  for (int k = -10; k <= 1010; ++k) {
    const double middle = k / 1000.0;
    const Curve above([&](double x) { return (x - middle) * (x - middle) + 1e-9; });
    EXPECT_FALSE(detail::search_edges(above).first) << middle;
    // one that has just been crossed, and rises
    const Curve rises([&](double x) { return std::sin((0.2 + std::fabs(middle)) * x); });
    EXPECT_FALSE(detail::search_edges(rises).first);
    EXPECT_LE(rises.calls, 7);
  }
}

TEST(EdgeSearch, NaNIsSaidUnlessAnEdgeIsBefore) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Curve late([&](double x) { return x > 0.6 ? nan : 1.0; });
  const auto at_nan = detail::search_edges(late).first;
  ASSERT_TRUE(at_nan && at_nan->is_nan);
  EXPECT_EQ(at_nan->x, 0.75);
  const Curve before([&](double x) { return x > 0.6 ? nan : 0.375 - x; });
  const auto edge = detail::search_edges(before).first;
  ASSERT_TRUE(edge && !edge->is_nan);
  EXPECT_NEAR(edge->x, 0.375, budget::bang_floor);
}

// ---- dips in a run ----

template <class S>
Problem pulsed(const S& switches, double stop, double tolerance = 1e-12) {
  const auto torque = [](const auto&, const auto& s, std::span<const double> sides) {
    using T = std::decay_t<decltype(s.g.x)>;
    return BasicVec3<T>{T(0.0), T(0.0), T(sides[0] < 0.0 ? 0.125 : 0.0)};
  };
  return {System(Body(1.0, 1.0, 2.0), Frame::inertial(),
                 {{"pulse", SwitchedTorqueTerm(torque, switches)}}),
          {{}, {0.0, 0.0, 0.01}},
          0.0,
          stop,
          Adaptive{.tolerance = tolerance}};
}

RotorState end_of(const Problem& problem) {
  const Trajectory run = integrate(problem, {SaveAt::times({problem.stop}), false});
  EXPECT_EQ(run.outcome().status, Outcome::Status::completed)
      << run.outcome().advice << " at " << run.outcome().t;
  return run.samples().back().s;
}

TEST(Switches, APulseIsNotSteppedOver) {
  for (const double w : {0.1, 1.0})
    for (int k = 0; k <= 100; ++k) {
      const double c = 1.5 + 0.97 * k;
      const auto vee = [=](double t, const RotorState&) {
        return std::vector{std::fabs(t - c) - w};
      };
      EXPECT_NEAR(end_of(pulsed(vee, 100.0)).g.z, 0.01 + 0.25 * w, budget::bang_floor)
          << w << " " << c;
    }
}

// High orbits in the plane of the Sun: an eclipse is a hundredth of a turn, and the body turns
// slowly, so that steps are long.
TEST(Switches, NoEclipseOfAConeIsMissed) {
  const double gm = 398600.4418, radius = 6378.137, a = 120000.0, far = 1.496e8;
  const double period = turn * std::sqrt(a * a * a / gm);
  const Surface plate = Surface::of_plate({0.5, 0.3, 0.0}, {0.0, 0.1, 1.0}, 1e-5, {}, true);
  const AnyOrbit sun("sun", KeplerOrbit(KeplerElements{1.327e11, far, 0.0}));
  const Shadow cone = Shadow::cone(radius, 696000.0);
  for (int k = 0; k < 40; ++k) {
    KeplerElements elements{gm, a, 0.0};
    elements.mean_anomaly = k * turn / 40.0;
    const AnyOrbit orbit("orbit", KeplerOrbit(elements));
    const auto end = [&](std::optional<Shadow> shadow, double tolerance, double largest) {
      const SolarPressure light(plate, {4.56e-6, far}, {orbit}, {sun}, shadow);
      return end_of({System(Body(1000.0, 1200.0, 1500.0), Frame::inertial(), {{"sun", light}}),
                     {{}, {1e-3, 2e-3, 1e-3}},
                     0.0,
                     period,
                     Adaptive{.tolerance = tolerance, .largest_step = largest}})
          .g;
    };
    const Vec3 seen = end(cone, 1e-12, period / 400.0);
    const double eclipse = norm(end({}, 1e-12, period / 400.0) - seen);
    for (const double tolerance : {1e-12, 1e-9, 1e-6})  // one that is missed is apart by all of it
      EXPECT_LT(norm(end(cone, tolerance, infinity) - seen), 0.25 * eclipse) << k;
  }
}

// ---- NaN ----

TEST(Switches, NaNHasNoSide) {
  const auto root = [](double t, const RotorState&) {
    return std::vector{std::sqrt(1.0 - t) + 0.5};
  };
  Trajectory run = integrate(pulsed(root, 3.0));
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_NEAR(run.outcome().t, 1.0, budget::bang_floor);
  EXPECT_THAT(run.outcome().advice, HasSubstr("switching function 1 of term \"pulse\" is NaN at"));
  // through a zero first
  const auto edge = [](double t, const RotorState&) {
    return std::vector{std::sqrt(1.0 - t) - 0.5};
  };
  run = integrate(pulsed(edge, 3.0));
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_NEAR(run.outcome().t, 1.0, budget::bang_floor);
  EXPECT_THAT(run.outcome().advice, HasSubstr("term \"pulse\" is NaN at t = "));
  // from the start
  const auto never = [](double, const RotorState& s) { return std::vector{std::sqrt(-s.g.z)}; };
  run = integrate(pulsed(never, 3.0));
  EXPECT_EQ(run.outcome().advice,
            "switching function 1 of term \"pulse\" is NaN at t = 0: give it a value there, or "
            "stop before");
}

// NaN next to a change of sign: the edge is found or the run fails, and no step goes past it.
TEST(Switches, NaNAtAnEdgeLosesNoEdge) {
  for (const double width : {1e-9, 1e-7, 0.03})
    for (const bool is_sine : {false, true})
      for (const Method& method : {Method(Adaptive{}), Method(Collocation{})}) {
        const auto gap = [=](double t, const RotorState&) {
          const double d = t - 0.5;
          return std::vector{std::fabs(d) > width ? (is_sine ? std::sin(-d) : -d)
                                                  : std::numeric_limits<double>::quiet_NaN()};
        };
        Problem problem = pulsed(gap, 2.0);
        problem.method = method;
        const Trajectory run = integrate(problem);
        if (run.outcome().ok())
          EXPECT_NEAR(run.samples().back().s.g.z, 0.01 + 0.125 * 1.5, 0.125 * width) << width;
        else
          EXPECT_NEAR(run.outcome().t, 0.5, width + 1e-6);
      }
}

// ---- at the start ----

TEST(Switches, HeldAtZeroFromTheStart) {
  const auto brake = [](const double&, const RotorState&, std::span<const double> sides) {
    return Vec3{0.0, 0.0, -0.1 * sides[0]};
  };
  const auto rate = [](double, const RotorState& s) { return std::vector{s.g.z}; };
  for (const double start : {0.0, 4.0, -3.0}) {
    const System system(Body(1.0, 1.5, 2.0), Frame::inertial(),
                        {{"brake", SwitchedTorqueTerm(brake, rate)}});
    const Trajectory run = integrate({system, {}, start, start + 10.0, Adaptive{}});
    EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
    EXPECT_EQ(run.outcome().t, start);
    EXPECT_THAT(run.outcome().advice, HasSubstr("of term \"brake\" stays at zero after t = "));
    EXPECT_LT(run.statistics().steps, 10);
  }
}

// ---- derivatives across a jump ----

// The sign of `value` times a torque about axis 3.
using AngleOrTime = double (*)(double, const RotorState&);
struct Bang {
  static constexpr bool kick = true;
  AngleOrTime value;
  std::vector<double> switches(const Setting& at) const { return {value(at.t, at.s)}; }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const RotorState s{
        {to_double(at.s.q.w), to_double(at.s.q.x), to_double(at.s.q.y), to_double(at.s.q.z)}, {}};
    const double side = at.sides.empty() ? side_of(value(to_double(at.t), s)) : at.sides[0];
    return {{}, {T(0.0), T(0.0), T(0.1 * side)}};
  }
};
Problem bang(AngleOrTime value, const Method& method = Adaptive{}) {
  return {System(Body(1.0, 1.0, 1.5), Frame::inertial(), {{"bang", Bang{value}}}),
          {{}, {0.0, 0.0, 1.5}},
          0.0,
          3.0,
          method};
}
double half_turned(double, const RotorState& s) { return s.q.w * s.q.w - s.q.z * s.q.z; }
double clock_value(double t, const RotorState&) { return std::cos(2.0 * t); }

TEST(Switches, AJumpByTheStateHasNoKnownTransition) {
  for (const Method& method : {Method(Adaptive{}), Method(Splitting{.step = 0.03})}) {
    const Problem problem = bang(half_turned, method);
    EXPECT_THAT([&] { state_transitions(problem, SaveAt::times({3.0})); },
                testing::ThrowsMessage<DomainError>(testing::AllOf(
                    HasSubstr("state_transitions: the torque of term \"bang\" jumps where the "
                              "state says so, at t = 1.4961"),
                    HasSubstr("its transition matrix is not known; take differences of runs"))));
    EXPECT_EQ(state_transitions(problem, SaveAt::times({1.0})).size(), 1U);  // no jump until there
    for (const bool neighbour : {false, true}) {
      const analysis::ChaosIndicator result =
          analysis::chaos_indicator(problem, SaveAt::times({0.5, 3.0}), {.neighbour = neighbour});
      EXPECT_EQ(result.outcome.status, Outcome::Status::failed);
      EXPECT_THAT(
          result.outcome.advice,
          HasSubstr("the torque of term \"bang\" jumps where the state says so, at t = 1.4961"));
      EXPECT_THAT(result.outcome.advice, HasSubstr("how a deviation crosses that is not known"));
    }
  }
}

// The last part of a step, up to a sample, is looked at too.
TEST(Switches, AJumpInTheLastPartOfAStepHasNoKnownTransition) {
  const Problem problem = bang(half_turned, Splitting{.step = 0.9});
  EXPECT_THROW(state_transitions(problem, SaveAt::times({1.6})), DomainError);
  EXPECT_EQ(analysis::chaos_indicator(problem, SaveAt::times({1.6})).outcome.status,
            Outcome::Status::failed);
}

TEST(Switches, AJumpByTheTimeAloneHasATransition) {
  const auto rows = state_transitions(bang(clock_value), SaveAt::times({3.0}));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(rows[0].transition(5, 5), 1.0, budget::bang_floor);
  EXPECT_NEAR(rows[0].transition(5, 2), 0.0, budget::bang_floor);
  for (const Method& method : {Method(Adaptive{}), Method(Splitting{.step = 0.03})}) {
    const Problem problem = bang(clock_value, method);
    EXPECT_EQ(state_transitions(problem, SaveAt::times({3.0})).size(), 1U);
    for (const bool neighbour : {false, true})
      EXPECT_TRUE(analysis::chaos_indicator(problem, SaveAt::times({3.0}), {.neighbour = neighbour})
                      .outcome.ok());
  }
}

// A plate with two faces that turns in the light: kinks, twice a turn.
TEST(Switches, KinksByTheStateHaveDeviations) {
  const Surface plate = Surface::of_plate({0.5, 0.3, 0.0}, {0.0, 0.1, 1.0}, 1.0, {}, false);
  const AnyOrbit path("path", KeplerOrbit(KeplerElements{1e-6, 1.0, 0.0}));
  const SolarPressure light(plate, {1e-2, 1.0}, {path});
  Problem problem{System(Body(1.0, 1.2, 1.5), Frame::inertial(), {{"light", light}}),
                  {{}, {1.0, 0.2, 0.1}},
                  0.0,
                  40.0,
                  Adaptive{}};
  for (const Method& method : {Method(Adaptive{}), Method(Splitting{.step = 0.05})}) {
    problem.method = method;
    EXPECT_EQ(state_transitions(problem, SaveAt::times({40.0})).size(), 1U);
    for (const bool neighbour : {false, true}) {
      const auto result =
          analysis::chaos_indicator(problem, SaveAt::times({40.0}), {.neighbour = neighbour});
      EXPECT_TRUE(result.outcome.ok()) << result.outcome.advice;
    }
  }
}

// A kink whose torque is zero at both ends of a step that leads from one to the next.
struct Gate {
  static constexpr bool kick = true;
  double value(const RotorState& s) const { return s.q.z * s.q.z - 2e-3; }
  std::vector<double> switches(const Setting& at) const { return {value(at.s)}; }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const T depth = at.s.q.z * at.s.q.z - T(2e-3);
    const double side = at.sides.empty() ? side_of(to_double(depth)) : at.sides[0];
    return {{}, {T(0.0), T(0.0), side < 0.0 ? T(0.1) * depth : T(0.0)}};
  }
};

TEST(Switches, AKinkFromZeroToZeroHasDeviations) {
  const Problem problem{System(Body(1.0, 1.0, 1.5), Frame::inertial(), {{"gate", Gate{}}}),
                        {rotation_z(-0.7), {0.0, 0.0, 1.5}},
                        0.0,
                        3.0,
                        Adaptive{.tolerance = 1e-9}};
  EXPECT_EQ(state_transitions(problem, SaveAt::times({3.0})).size(), 1U);
}

// ---- a pericentre beyond use ----

// A pericentre of 1e-13 is passed in 1e-20: a run at that pace would never get there.
TEST(LargestStep, ACollisionIsReached) {
  KeplerElements elements{1.0, 1e-13, 1.0000000000000002};
  elements.epoch = 1.0;
  const Problem problem{System(Body(1.0, 2.0, 2.5), Frame::inertial(),
                               {{"gravity", GravityGradient(1.0, KeplerOrbit(elements))}}),
                        {{}, {0.1, 0.4, 2.5}},
                        0.0,
                        2.0,
                        Adaptive{}};
  const Trajectory run = integrate(problem, {.dense = false});
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_GT(run.outcome().t, 0.99999);
  EXPECT_LT(run.outcome().t, 1.0);
}

}  // namespace
}  // namespace polhode
