// SPDX-License-Identifier: MIT
// Torques that are not smooth in time: no pulse is stepped over, and none costs the order.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/torque_table.hpp"

namespace polhode {
namespace {

using Between = TorqueTable::Between;
using Outside = TorqueTable::Outside;

constexpr double day = 86400.0;
constexpr double pulse = 43210.25;  // when a second of torque begins

System spinning(const TorqueTable& table) {
  return System(Body(1.0, 1.0, 2.0), Frame::inertial(), {{"thruster", table}});
}

// About its axis 3, one turn in an hour, with 1e-3 for a second: rate and angle at the end by hand.
void expect_pulse(const Trajectory& run, const RotorState& end, double budget_angle) {
  ASSERT_EQ(run.outcome().status, Outcome::Status::completed) << run.outcome().advice;
  const double rate = 2.0 * 3.141592653589793 / 3600.0, more = 0.5e-3;
  EXPECT_NEAR(end.g.z / (2.0 * (rate + more)), 1.0, budget::pulse_momentum);
  const double angle = rate * day + more * (0.5 + (day - pulse - 1.0));
  const Quaternion turned = rotation_z(angle);
  const Quaternion miss = conj(turned) * end.q;
  EXPECT_LE(2.0 * std::abs(miss.z), budget_angle);
}

Problem day_long(const Method& method) {
  const TorqueTable table({{pulse, {0.0, 0.0, 1e-3}}, {pulse + 1.0, {}}},
                          {Between::step, Outside::zero, {}});
  return {spinning(table), {{}, {0.0, 0.0, 4.0 * 3.141592653589793 / 3600.0}}, 0.0, day, method};
}

TEST(Breakpoints, OneSecondOfTorqueInADay) {
  const Trajectory run = integrate(day_long(Adaptive{}));
  expect_pulse(run, run.samples().back().s, budget::pulse_angle);
  const double rate = 2.0 * 3.141592653589793 / 3600.0;
  // what a smooth day takes, with a faster second half, and some more around the pulse
  Problem smooth = day_long(Adaptive{});
  smooth.system = System(Body(1.0, 1.0, 2.0));
  const Trajectory quiet = integrate(smooth);
  const double steps = static_cast<double>(quiet.statistics().steps);
  EXPECT_LE(static_cast<double>(run.statistics().steps), steps * (1.0 + 0.5 * 0.5e-3 / rate) + 12);
  // dense output on both sides of the jump
  EXPECT_NEAR(run.at(pulse + 0.5).g.z, 2.0 * rate + 0.5e-3, budget::pulse_momentum);
  EXPECT_NEAR(run.at(pulse - 0.5).g.z, 2.0 * rate, budget::pulse_momentum);
}

TEST(Breakpoints, OtherMethods) {
  const Trajectory accurate = integrate(day_long(Adaptive{.precision = Precision::double_double}));
  expect_pulse(accurate, accurate.samples().back().s, budget::pulse_angle);
  const Trajectory constants = integrate(day_long(VariationOfConstants{}));
  expect_pulse(constants, constants.samples().back().s, budget::pulse_angle);
  const auto transitions = state_transitions(day_long(Adaptive{}), SaveAt::times({day}));
  ASSERT_EQ(transitions.size(), 1U);
  EXPECT_NEAR(transitions[0].s.g.z, constants.samples().back().s.g.z, budget::pulse_momentum);
  EXPECT_THROW(integrate(day_long(Splitting{.step = 10.0})), DomainError);
}

TEST(Breakpoints, BackwardsIsTheSameWay) {
  const Trajectory there = integrate(day_long(Adaptive{}));
  Problem back = day_long(Adaptive{});
  back.initial = there.samples().back().s;
  std::swap(back.start, back.stop);
  const Trajectory again = integrate(back);
  ASSERT_EQ(again.outcome().status, Outcome::Status::completed) << again.outcome().advice;
  const RotorState s = again.samples().back().s;
  EXPECT_NEAR(s.g.z / back.initial.g.z, 2.0 * 2.0 * 3.141592653589793 / 3600.0 / back.initial.g.z,
              budget::pulse_momentum);
  EXPECT_LE(2.0 * std::abs(s.q.z / s.q.w), budget::pulse_angle);
}

// A step that a breakpoint cuts short says little of the next one, in either direction.
TEST(Breakpoints, BackwardsTakesNoMoreStepsOfVariation) {
  std::vector<TorqueRow> rows;
  for (int k = 0; k <= 20; ++k) {  // a millisecond every two seconds
    rows.push_back({2.0 * k, {0.0, 0.0, 1e-3}});
    rows.push_back({2.0 * k + 1e-3, {}});
  }
  const System system(Body(1.0, 1.5, 2.0), Frame::inertial(),
                      {{"thruster", TorqueTable(rows, {Between::step, Outside::zero, {}})}});
  const auto steps = [&](double start, double stop) {
    return integrate({system, {{}, {0.1, 0.4, 2.5}}, start, stop, VariationOfConstants{}})
        .statistics()
        .steps;
  };
  const auto there = steps(-50.0, 60.0), back = steps(60.0, -50.0);
  EXPECT_NEAR(static_cast<double>(back) / static_cast<double>(there), 1.0,
              budget::steps_of_either_direction);
}

// Kinks of straight lines: the momentum in space is the integral of the table, whatever turns.
TEST(Breakpoints, TumblerUnderATableInSpace) {
  const TorqueTable table({{1.0, {0.0, 0.0, 0.0}},
                           {2.0, {0.3, -0.2, 0.1}},
                           {2.5, {0.0, 0.4, 0.0}},
                           {7.0, {0.1, 0.0, 0.0}}},
                          {Between::linear, Outside::zero, SpaceAxes::inertial});
  const System system(Body(1.0, 2.0, 2.5), Frame::inertial(), {{"thruster", table}});
  const Problem problem{system, {{}, {0.4, 0.5, 0.6}}, 0.0, 10.0, Adaptive{.tolerance = 1e-13}};
  const Trajectory run = integrate(problem);
  const Vec3 got = rotate(run.samples().back().s.q, run.samples().back().s.g);
  const Vec3 want{0.4 + 0.15 + 0.075 + 0.225, 0.5 - 0.1 + 0.05 + 0.9, 0.6 + 0.05 + 0.025};
  EXPECT_LE(norm(got - want), budget::table_momentum);
  EXPECT_LE(run.statistics().rejected, 3);
}

TEST(Breakpoints, NoRowsForAllOfTheRun) {
  const TorqueTable table({{0.0, {}}, {5.0, {}}}, {Between::linear, Outside::refuse, {}});
  const Problem inside{spinning(table), {{}, {0.0, 0.0, 1.0}}, 0.0, 5.0};
  EXPECT_EQ(integrate(inside).outcome().status, Outcome::Status::completed);
  Problem beyond = inside;
  beyond.stop = 6.0;
  EXPECT_THROW(integrate(beyond), DomainError);
}

// ---- internal damping, along a run ----

double energy_of(const Body& body, const RotorState& s) { return kinetic_energy(body, s); }

// tan J falls by the law of the header; the momentum in space stays; the energy never grows.
TEST(InternalDampingRun, AxisymmetricBodyByItsLaw) {
  for (const double C : {1.5, 0.6}) {  // towards axis 3, and away from it
    const Body body(1.0, 1.0, C);
    const System system(body, Frame::inertial(), {{"friction", InternalDamping(0.05)}});
    const double J0 = 1.0, G = 2.0;
    const RotorState start{{}, {G * std::sin(J0), 0.0, G * std::cos(J0)}};
    const Trajectory run = integrate({system, start, 0.0, 20.0, Adaptive{.tolerance = 1e-13}});
    double before = energy_of(body, start);
    for (const Sample& sample : run.samples()) {
      const double J = std::atan2(std::hypot(sample.s.g.x, sample.s.g.y), sample.s.g.z);
      const double rate = 0.05 * (C - 1.0) * G * G / C;
      EXPECT_NEAR(std::tan(J), std::tan(J0) * std::exp(-rate * sample.t),
                  budget::internal_damping_law * std::tan(J));
      EXPECT_LE(norm(rotate(sample.s.q, sample.s.g) - start.g), budget::internal_damping_momentum);
      const double now = energy_of(body, sample.s);
      EXPECT_LE(now, before + budget::internal_damping_energy);
      before = now;
    }
    EXPECT_LT(before, energy_of(body, start));
  }
}

// A small wobble of three different moments falls by e in the time asked for.
TEST(InternalDampingRun, SmallWobbleInItsTime) {
  const Body body(1.0, 1.5, 2.0);
  const DampedMaterial rock{3e4, 100.0, 1.0, 10.0, 0.1};
  const double G = 3.0, time = wobble_time(rock, G / 2.0);
  for (const InternalDamping& friction :
       {InternalDamping::of_wobble(body, time, G), InternalDamping::of_material(body, rock)}) {
    const System system(body, Frame::inertial(), {{"friction", friction}});
    const RotorState start{{}, {G * 1e-4, 0.0, G * std::sqrt(1.0 - 1e-8)}};
    const Trajectory run = integrate({system, start, 0.0, time, Adaptive{.tolerance = 1e-13}});
    const Vec3& g = run.samples().back().s.g;
    // (1/A - 1/C) g1^2 + (1/B - 1/C) g2^2, twice the energy of the wobble
    const double left = (0.5 * g.x * g.x + g.y * g.y / 6.0) / (0.5 * 1e-8 * G * G);
    EXPECT_NEAR(0.5 * std::log(left), -1.0, budget::internal_damping_wobble);
  }
}

}  // namespace
}  // namespace polhode
