// SPDX-License-Identifier: MIT
// Lyapunov indicator and MEGNO: regular motions, a known map, the planar rotation of Hyperion by an
// independent integration, and every way to carry a deviation against the others.
#include "polhode/analysis/chaos_indicator.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "unit/analysis/hyperion.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

const Body body(1.0, 1.7, 2.2);
const RotorState tumbling{{0.8, 0.2, -0.4, 0.4}, {0.3, 0.2, 1.9}};
const analysis::Deviation in_plane{{0.0, 0.0, 1.0}, {0.0, 0.0, 0.5}};

Problem free_problem(double stop, const Method& method) {
  return {System(body), tumbling, 0.0, stop, method, {}};
}

TEST(ChaosIndicator, FreeRotationIsRegular) {
  const double stop = 2000.0;
  for (const Method& method :
       {Method(Adaptive{1e-11}), Method(Splitting{0.3}), Method(Collocation{1e-11})}) {
    const analysis::ChaosIndicator found =
        analysis::chaos_indicator(free_problem(stop, method), SaveAt::count(0.0, stop, 5));
    ASSERT_TRUE(found.outcome.ok());
    EXPECT_EQ(found.by, analysis::DeviationBy::variational);
    EXPECT_NEAR(found.mean_megno(), 2.0, budget::chaos_megno_regular);
    const analysis::ChaosSample& last = found.samples.back();
    // a deviation that grows as t: L = ln t + a constant
    EXPECT_NEAR(last.growth - found.samples[1].growth, std::log(4.0), budget::chaos_ln_growth);
    EXPECT_EQ(last.lyapunov, last.growth / stop);
    EXPECT_EQ(found.samples.front().growth, 0.0);
  }
}

// Of the deviation that is taken when none is given, from `tumbling` on.
double growth_by(const Matrix6& M) {
  const analysis::Deviation d = analysis::ChaosOptions().deviation;
  const double g = norm(tumbling.g);
  const double before = std::sqrt(dot(d.turn, d.turn) + dot(d.momentum, d.momentum));
  double square = 0.0;
  for (int i = 0; i < 6; ++i) {
    double x = 0.0;
    for (int j = 0; j < 3; ++j) x += M(i, j) * d.turn[j] + M(i, j + 3) * g * d.momentum[j];
    square += i < 3 ? x * x : x * x / (g * g);
  }
  return std::log(std::sqrt(square) / before);
}

// The growth is that of the exact state transition matrix of the free rotation.
TEST(ChaosIndicator, GrowthIsThatOfTheStateTransitionMatrix) {
  const FreeRotation free(body, tumbling);
  for (const Method& method : {Method(Adaptive{1e-13}), Method(Collocation{1e-13})}) {
    const auto found =
        analysis::chaos_indicator(free_problem(40.0, method), SaveAt::count(0.0, 40.0, 9));
    for (const analysis::ChaosSample& row : found.samples)
      EXPECT_NEAR(row.growth, growth_by(free.state_transition(row.t)), budget::chaos_growth);
  }
}

// About the intermediate axis of a free body a deviation grows as exp(s t), its other parts at most
// as t.
TEST(ChaosIndicator, UnstableAxisGrowsByTheExponentOfEuler) {
  const double A = 1.0, B = 1.7, C = 2.2, g = 2.0;
  const double s = g / B * std::sqrt((C - B) * (B - A) / (A * C));
  const RotorState on_axis{{1.0, 0.0, 0.0, 0.0}, {0.0, g, 0.0}};
  const double stop = 60.0;
  for (const Method& method : {Method(Adaptive{1e-12}), Method(Collocation{1e-12})}) {
    const auto found = analysis::chaos_indicator({System(body), on_axis, 0.0, stop, method, {}},
                                                 SaveAt::times({50.0, stop}));
    ASSERT_EQ(found.samples.size(), 2U);
    const double slope = (found.samples[1].growth - found.samples[0].growth) / 10.0;
    EXPECT_NEAR(slope, s, budget::chaos_unstable_axis);
  }
}

TEST(ChaosIndicator, OfHyperionIsThatOfThePlanarEquation) {
  const double orbits = 12.0;
  const double C = 1.0;
  for (const double angle : {0.0, 1.2, std::numbers::pi / 2.0}) {
    const double spin = 1.0 + 0.3 * angle;
    const RotorState s = hyperion_state(angle, spin);
    const SaveAt last = SaveAt::times({orbits * hyperion_orbit});
    const auto found = analysis::chaos_indicator(hyperion(s, orbits, Adaptive{1e-13}), last,
                                                 {.deviation = in_plane});
    const auto swept = analysis::chaos_indicator(hyperion(s, orbits, Collocation{1e-13}), last,
                                                 {.deviation = in_plane});
    const double scale = spin * C;
    const auto end =
        PlanarSpin::after({angle, spin, 1.0, 0.5 * scale / C}, orbits * hyperion_orbit, 60000);
    const double growth =
        0.5 * std::log((end[2] * end[2] + std::pow(end[3] * C / scale, 2)) / 1.25);
    EXPECT_NEAR(found.samples.back().growth, growth, budget::chaos_planar);
    EXPECT_NEAR(swept.samples.back().growth, growth, budget::chaos_planar);
  }
}

// u_z = -K sin(angle) on a body that turns about b3.
struct PendulumKick {
  static constexpr bool kick = true;
  double K;
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return {{}, {T(0.0), T(0.0), T(-K) * (T(2.0) * (at.s.q.w * at.s.q.z + at.s.q.x * at.s.q.y))}};
  }
};

// A step of order 2 and length 1 of a pendulum is Chirikov's standard map in a shifted momentum.
double growth_of_standard_map(double K, double angle, double p, int steps) {
  double d = 1.0, dp = 0.5, growth = 0.0;
  for (int k = 0; k < steps; ++k) {
    p -= 0.5 * K * std::sin(angle), dp -= 0.5 * K * std::cos(angle) * d;
    angle += p, d += dp;
    p -= 0.5 * K * std::sin(angle), dp -= 0.5 * K * std::cos(angle) * d;
    const double size = std::hypot(d, dp);
    growth += std::log(size);
    d /= size, dp /= size;
  }
  return growth - std::log(std::hypot(1.0, 0.5));
}

TEST(ChaosIndicator, OfTheStandardMap) {
  const double K = 10.0;
  const System system(Body(1.0, 1.0, 1.0), Frame::inertial(),
                      {AnyPerturbation("pendulum", PendulumKick{K})});
  const RotorState s{rotation_z(0.4), {0.0, 0.0, 0.7}};
  const auto growth = [&](double steps, bool neighbour) {
    return analysis::chaos_indicator(
               {system, s, 0.0, steps, Splitting{1.0, SplittingScheme::order2}, {}},
               SaveAt::times({steps}),
               {.deviation = in_plane, .momentum_scale = 1.0, .neighbour = neighbour})
        .samples.back()
        .growth;
  };
  EXPECT_NEAR(growth(8.0, false), growth_of_standard_map(K, 0.4, 0.7, 8), budget::chaos_map);
  EXPECT_NEAR(growth(8.0, true), growth_of_standard_map(K, 0.4, 0.7, 8), budget::chaos_neighbour);
  // ln(K/2) for large K (Chirikov 1979)
  EXPECT_NEAR(growth(20000.0, false) / 20000.0, std::log(K / 2.0), budget::chaos_chirikov);
}

TEST(ChaosIndicator, EveryWayToCarryADeviationAgrees) {
  const RotorState s = hyperion_state(1.2, 1.3, 0.4);
  const SaveAt rows = SaveAt::count(0.0, 5.0 * hyperion_orbit, 6);
  const auto exact = analysis::chaos_indicator(hyperion(s, 5.0, Adaptive{1e-13}), rows);
  const auto near = [&](const analysis::ChaosIndicator& found, double budget) {
    ASSERT_EQ(found.samples.size(), exact.samples.size());
    for (std::size_t k = 1; k < exact.samples.size(); ++k) {
      EXPECT_NEAR(found.samples[k].growth, exact.samples[k].growth, budget);
      EXPECT_NEAR(found.samples[k].megno, exact.samples[k].megno, budget);
      EXPECT_NEAR(found.samples[k].mean_megno, exact.samples[k].mean_megno, budget);
    }
  };
  const analysis::ChaosOptions neighbour{.neighbour = true};
  near(analysis::chaos_indicator(hyperion(s, 5.0, Adaptive{1e-13}), rows, neighbour),
       budget::chaos_neighbour);
  near(analysis::chaos_indicator(hyperion(s, 5.0, VariationOfConstants{1e-13}), rows), 0.0);
  for (const int stages : {4, 8, 16}) {
    near(analysis::chaos_indicator(hyperion(s, 5.0, Collocation{1e-13, stages}), rows),
         budget::chaos_growth);
    near(analysis::chaos_indicator(hyperion(s, 5.0, Collocation{1e-13, stages}), rows, neighbour),
         budget::chaos_neighbour);
  }
  const Splitting fine{hyperion_orbit / 256.0, SplittingScheme::ABA1064};
  near(analysis::chaos_indicator(hyperion(s, 5.0, fine), rows), budget::chaos_trapezoid);
  near(analysis::chaos_indicator(hyperion(s, 5.0, fine), rows, neighbour), budget::chaos_trapezoid);
}

// After 10^5 turns the deviation is a phase, driven by a rest of 10^-5 of it: a neighbour that is
// brought back, and rounded, at every step loses it.
TEST(ChaosIndicator, ANeighbourLastsAlongRegularMotion) {
  const double stop = 1.2e5;
  const Problem problem = free_problem(stop, Splitting{0.3});
  const SaveAt rows = SaveAt::times({stop});
  const analysis::ChaosSample exact = analysis::chaos_indicator(problem, rows).samples.back();
  const analysis::ChaosSample near =
      analysis::chaos_indicator(problem, rows, {.neighbour = true}).samples.back();
  EXPECT_NEAR(near.growth, exact.growth, budget::chaos_long_neighbour);
  EXPECT_NEAR(near.mean_megno, exact.mean_megno, budget::chaos_long_neighbour);
}

TEST(ChaosIndicator, ATermOnDoubleAloneHasANeighbour) {
  const auto plain = [](double, const RotorState& s) { return -0.05 * s.g; };
  const auto any = [](const auto&, const auto& s) {
    return std::decay_t<decltype(s.q.w)>(-0.05) * s.g;
  };
  const auto found = [&](const AnyPerturbation& term) {
    return analysis::chaos_indicator(
        {System(body, Frame::inertial(), {term}), tumbling, 0.0, 20.0, Adaptive{1e-13}, {}},
        SaveAt::times({20.0}));
  };
  const analysis::ChaosIndicator a = found({"plain", TorqueTerm(plain)}),
                                 b = found({"any", TorqueTerm(any)});
  EXPECT_EQ(a.by, analysis::DeviationBy::neighbour);
  EXPECT_EQ(b.by, analysis::DeviationBy::variational);
  EXPECT_THAT(a.method, HasSubstr("a second motion at 1e-08"));
  EXPECT_THAT(b.method, HasSubstr("variational equations"));
  EXPECT_NEAR(a.samples.back().growth, b.samples.back().growth, budget::chaos_neighbour);
  // a flow that is no kick
  const System damped(body, Frame::inertial(),
                      {AnyPerturbation("damping", LinearDamping(Vec3{0.1, 0.1, 0.1}))});
  const auto split = analysis::chaos_indicator({damped, tumbling, 0.0, 20.0, Splitting{0.02}, {}},
                                               SaveAt::times({20.0}));
  const auto adaptive = analysis::chaos_indicator(
      {damped, tumbling, 0.0, 20.0, Adaptive{1e-13}, {}}, SaveAt::times({20.0}));
  EXPECT_EQ(split.by, analysis::DeviationBy::neighbour);
  EXPECT_NEAR(split.samples.back().growth, adaptive.samples.back().growth, budget::chaos_damped);
}

// A frame moves both motions alike; time may run backwards.
TEST(ChaosIndicator, InAMovingFrameAndBackwards) {
  const Frame moving = Frame::precessing({0.1, 0.2, 1.0}, 0.3);
  const KeplerOrbit orbit({.gm = 1.0, .pericentre = 0.9, .eccentricity = 0.1});
  const AnyPerturbation pull("gravity", GravityGradient(1.0, orbit));
  const System inertial(body, Frame::inertial(), {pull}), frame(body, moving, {pull});
  for (const double stop : {12.0, -12.0}) {
    const auto found = [&](const System& system, const Method& method) {
      return analysis::chaos_indicator(
                 {system, reference_state(system, 0.0, tumbling), 0.0, stop, method, {}},
                 SaveAt::times({stop}))
          .samples.back();
    };
    const analysis::ChaosSample a = found(inertial, Adaptive{1e-13});
    for (const analysis::ChaosSample& b :
         {found(frame, Adaptive{1e-13}), found(frame, Collocation{1e-13}),
          found(inertial, Collocation{1e-13}), found(inertial, Collocation{.step = 0.05}),
          found(frame, Splitting{0.01, SplittingScheme::order8}),
          found(inertial, Splitting{0.01, SplittingScheme::order8})}) {
      EXPECT_NEAR(a.growth, b.growth, budget::chaos_growth);
      EXPECT_NEAR(a.mean_megno, b.mean_megno, budget::chaos_trapezoid);
    }
    EXPECT_GT(a.mean_megno, 0.0);
  }
}

// A torque that jumps every 5 s: each step ends at a jump and sees the torque of its own side, so
// that none is tried again. The growth is that of the transition matrices.
TEST(ChaosIndicator, StepsEndWhereATorqueJumps) {
  std::vector<TorqueRow> rows;
  for (int k = 0; k <= 20; ++k)
    rows.push_back({5.0 * k, {0.02 * (k % 3 - 1), 0.01 * (k % 2), 0.03 * (k % 4 - 2)}});
  const AnyPerturbation jets(
      "jets", TorqueTable(rows, {TorqueTable::Between::step, TorqueTable::Outside::zero, {}}));
  for (const bool backwards : {false, true}) {
    const double start = backwards ? 100.0 : 0.0, stop = 100.0 - start;
    Problem problem{
        System(body, Frame::inertial(), {jets}), tumbling, start, stop, Adaptive{1e-13}, {}};
    const SaveAt end = SaveAt::times({stop});
    const double want = growth_by(state_transitions(problem, end).back().transition);
    for (const Method& method : {Method(Adaptive{1e-13}), Method(Collocation{1e-13})}) {
      SCOPED_TRACE(method_text(method));
      problem.method = method;
      const Statistics plain = integrate(problem).statistics();
      EXPECT_NEAR(growth_by(state_transitions(problem, end).back().transition), want,
                  budget::chaos_growth);
      for (const bool neighbour : {false, true}) {
        const auto found = analysis::chaos_indicator(problem, end, {.neighbour = neighbour});
        EXPECT_LE(found.statistics.rejected, plain.rejected + 3) << backwards << neighbour;
        EXPECT_LE(found.statistics.steps, 2 * plain.steps) << backwards << neighbour;
        EXPECT_NEAR(found.samples.back().growth, want,
                    neighbour ? budget::chaos_neighbour : budget::chaos_growth);
      }
    }
  }
}

// In the large chaotic zone, tilted, and far from it.
TEST(ChaosIndicator, TellsHyperionsMotionsApart) {
  const double orbits = 500.0;
  const auto found = [&](double angle, double spin, double tilt) {
    return analysis::chaos_indicator(
        hyperion(hyperion_state(angle, spin, tilt), orbits, Adaptive{1e-9}),
        SaveAt::times({orbits * hyperion_orbit}));
  };
  for (const double spin : {1.0, 1.3, 1.6, 2.0}) {
    const analysis::ChaosIndicator chaotic = found(std::numbers::pi / 2.0, spin, 0.5);
    const double days = chaotic.lyapunov_time() / hyperion_day;
    EXPECT_GT(days, 20.0) << spin;
    EXPECT_LT(days, 100.0) << spin;
    EXPECT_GT(chaotic.mean_megno(), 20.0) << spin;
  }
  const RotorState fast = hyperion_state(0.3, 12.0, 0.3);
  const auto regular = analysis::chaos_indicator(hyperion(fast, 100.0, Adaptive{1e-9}),
                                                 SaveAt::times({100.0 * hyperion_orbit}));
  EXPECT_LT(regular.mean_megno(), 2.5);
}

TEST(ChaosIndicator, WhatCannotGoOnSaysWhy) {
  const AnyPerturbation wall("wall", TorqueTerm([](const auto& t, const auto& s) {
                               using std::sqrt;
                               return sqrt(3.0 - t) * s.g;
                             }));
  for (const Method& method : {Method(Adaptive{1e-10}), Method(Collocation{1e-10})}) {
    const Problem problem{System(body, Frame::inertial(), {wall}), tumbling, 0.0, 5.0, method, {}};
    const auto found = analysis::chaos_indicator(problem, SaveAt::times({1.0, 2.0, 5.0}));
    EXPECT_EQ(found.samples.size(), 2U);
    EXPECT_FALSE(found.outcome.ok());
    EXPECT_THAT(found.outcome.advice, HasSubstr("wall"));
  }
}

TEST(ChaosIndicator, RefusesWhatIsNoProblem) {
  const SaveAt end = SaveAt::times({1.0});
  const auto with = [&](const analysis::ChaosOptions& options) {
    return message_of(
        [&] { analysis::chaos_indicator(free_problem(1.0, Adaptive{}), end, options); });
  };
  EXPECT_THAT(with({.deviation = {}}), HasSubstr("deviation must be finite and not zero"));
  EXPECT_THAT(with({.momentum_scale = -1.0}), HasSubstr("momentum_scale -1 must be positive"));
  EXPECT_THAT(with({.distance = 1.0}), HasSubstr("distance 1 must be positive and at most 0.01"));
  const Problem rest{System(body), {{1.0, 0.0, 0.0, 0.0}, {}}, 0.0, 1.0, Adaptive{}, {}};
  EXPECT_REJECTED(analysis::chaos_indicator(rest, end), "at rest");
  const Problem fine = free_problem(1.0, Adaptive{1e-20, Precision::double_double});
  EXPECT_REJECTED(analysis::chaos_indicator(fine, end), "from 1e-15");
  EXPECT_REJECTED(
      analysis::chaos_indicator(free_problem(1.0, Adaptive{}), SaveAt::times({0.5, 0.2})),
      "chaos_indicator: sample times must run");
}

}  // namespace
