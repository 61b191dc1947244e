// SPDX-License-Identifier: MIT
// Events of the closed form: how many there are, and that their times are right to rounding,
// however far from the epoch.
#include "polhode/dynamics/free_events.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace polhode {
namespace {

using testing::HasSubstr;

const Body wing_nut(30.53, 83.87, 113.3);
const RotorState spinning{{1.0, 0.0, 0.0, 0.0}, {0.01 * 30.53, 6.28 * 83.87, 0.0}};
const FreeRotation motion(wing_nut, spinning);
const Event flip{"flip", [](double, const RotorState& s) { return s.g.y; }};

// g2 vanishes twice in a period. Between the doubles next to the time found it changes its sign.
TEST(FreeEvents, AreThereAfterAnyNumberOfTurns) {
  const double half = 0.5 * motion.polhode_period();
  for (const double start : {0.0, 1e3, 1e6, 1e9, -1e9, 1e12}) {
    const double span = 100.0 * half;
    const FreeEvents found = free_events(motion, {flip}, start, start + span);
    EXPECT_EQ(found.outcome.status, Outcome::Status::completed);
    ASSERT_EQ(found.events.size(), 100U) << start;
    for (const EventRecord& event : found.events) {
      const double inf = std::numeric_limits<double>::infinity();
      double before = event.t, after = event.t;
      for (int ulp = 0; ulp < 2; ++ulp) {
        before = std::nextafter(before, -inf);
        after = std::nextafter(after, inf);
      }
      const double rate = 0.1 * norm(event.s.g);  // of g2 at a flip, at least
      const double noise = budget::free_state * norm(event.s.g) / rate;
      EXPECT_LT(event.direction * motion.at(before - noise).g.y, 0.0) << event.t;
      EXPECT_GT(event.direction * motion.at(after + noise).g.y, 0.0) << event.t;
      EXPECT_EQ(event.s, motion.at(event.t));
    }
    for (std::size_t i = 1; i < found.events.size(); ++i)
      EXPECT_NEAR(found.events[i].t - found.events[i - 1].t, half,
                  4.0 * std::numeric_limits<double>::epsilon() * std::fabs(start) +
                      budget::time_of_zero * span);
  }
}

TEST(FreeEvents, BackwardsTheyAreTheSame) {
  const FreeEvents there = free_events(motion, {flip}, 10.0, 50.0);
  const FreeEvents back = free_events(motion, {flip}, 50.0, 10.0);
  ASSERT_EQ(there.events.size(), back.events.size());
  for (std::size_t i = 0; i < there.events.size(); ++i) {
    const EventRecord& same = back.events[there.events.size() - 1 - i];
    EXPECT_NEAR(there.events[i].t, same.t, budget::time_of_zero * 50.0);
    EXPECT_EQ(there.events[i].direction, -same.direction);
  }
}

TEST(FreeEvents, AreThoseOfARunBySteps) {
  const Event across{"across", [](double, const RotorState& s) { return s.q.w; }};
  const Frame frame = Frame::precessing({0.0, 0.6, 0.8}, 1.3, 0.0);
  const System system(wing_nut, frame);
  const FreeRotation inertial(wing_nut, inertial_state(system, 0.0, spinning));
  const FreeEvents found = free_events(inertial, {flip, across}, 0.0, 20.0, frame);
  const Trajectory run =
      integrate({system, spinning, 0.0, 20.0, Adaptive{.tolerance = 1e-14}, {flip, across}});
  ASSERT_EQ(found.events.size(), run.events().size());
  for (std::size_t i = 0; i < found.events.size(); ++i) {
    EXPECT_EQ(found.events[i].name, run.events()[i].name);
    EXPECT_NEAR(found.events[i].t, run.events()[i].t, budget::event_time);
  }
}

// 8e8: seconds since J2000.
TEST(FreeEvents, AtStartAndStopTheyCountAtAnyTime) {
  const Event across{"across", [](double, const RotorState& s) { return s.q.x; }};
  for (const double t0 : {0.0, 1e6, 1e8, 8e8, 1e10}) {
    const double stop = t0 + 0.125;
    const FreeRotation fast(Body(1.0, 1.7, 2.1), {{1.0, 0.0, 0.0, 0.0}, {10.0, 40.0, 8.0}}, t0);
    const Event end{"end", [stop](double t, const RotorState&) { return t - stop; }};
    const FreeEvents found = free_events(fast, {across, end}, t0, stop);
    ASSERT_EQ(found.events.size(), 2U) << t0;
    EXPECT_EQ(found.events[0].t, t0);
    EXPECT_EQ(found.events[1].t, stop);
  }
}

TEST(FreeEvents, AStretchOfZerosIsTwo) {
  const Event stretch{.name = "stretch", .function = [](double t, const RotorState&) {
                        return t < 1.0 ? t - 1.0 : (t < 50.0 ? 0.0 : t - 50.0);
                      }};
  const Event other{"other", [](double t, const RotorState&) { return std::sin(t); }};
  const FreeEvents found = free_events(motion, {stretch, other}, 0.1, 100.0);
  ASSERT_EQ(found.events.size(), 33U);  // 31 half turns
  EXPECT_EQ(found.events[0].name, "stretch");
  EXPECT_NEAR(found.events[0].t, 1.0, budget::time_of_zero);
  EXPECT_EQ(found.events[16].name, "stretch");
  EXPECT_NEAR(found.events[16].t, 50.0, budget::time_of_zero * 50.0);
  for (std::size_t i = 1; i < found.events.size(); ++i)
    EXPECT_LT(found.events[i - 1].t, found.events[i].t);
}

TEST(FreeEvents, TheFirstThatStopsIsTheLast) {
  Event end = flip;
  end.stops = true;
  const FreeEvents found = free_events(motion, {end}, 0.0, 1e9);
  EXPECT_EQ(found.outcome.status, Outcome::Status::stopped_by_event);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.outcome.t, found.events[0].t);
}

TEST(FreeEvents, ABodyAtRestHasThoseOfTime) {
  const FreeRotation rest(wing_nut, {{1.0, 0.0, 0.0, 0.0}, {}});
  Event alarm{"alarm", [](double t, const RotorState&) { return t - 7.25; }};
  const FreeEvents found = free_events(rest, {alarm}, 0.0, 1e9);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].t, 7.25);
}

TEST(FreeEvents, WhatCannotBeSaysWhy) {
  const FreeEvents found = free_events(
      motion, {{"root", [](double t, const RotorState&) { return std::sqrt(5.0 - t); }}}, 0.0, 9.0);
  EXPECT_EQ(found.outcome.status, Outcome::Status::failed);
  EXPECT_THAT(found.outcome.advice, HasSubstr("event \"root\" is NaN after t = "));
  EXPECT_LE(found.outcome.t, 5.0);
  EXPECT_GT(found.outcome.t, 4.5);  // the look before
  EXPECT_THAT(found.outcome.advice, HasSubstr("after t = 4."));
  EXPECT_REJECTED(free_events(motion, {flip}, 0.0, std::nan("")), "stop nan must be finite");
  EXPECT_REJECTED(free_events(motion, {{"none", {}}}, 0.0, 1.0),
                  "event \"none\" must have a function");
  int calls = 0;
  EXPECT_THROW(free_events(motion, {flip}, 0.0, 1e12, Frame::inertial(),
                           [&calls](double) {
                             if (++calls == 3) throw std::runtime_error("enough");
                           }),
               std::runtime_error);
}

// Events of an angle: its jump from one end of a turn to the other is no crossing.

constexpr double turn = 2.0 * std::numbers::pi;

// A sphere that spins with 1 rad/s about axis 3: the angle is t, folded.
Trajectory spin(double period, Crossing crossing, double stop) {
  const Event event{.name = "node",
                    .function =
                        [](double, const RotorState& s) {
                          return std::remainder(2.0 * std::atan2(s.q.z, s.q.w) - 0.5, turn);
                        },
                    .crossing = crossing,
                    .period = period};
  return integrate({System(Body(1.0, 1.0, 1.0)),
                    RotorState{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},
                    0.0,
                    stop,
                    Adaptive{},
                    {event}});
}

TEST(AngleEvent, JumpsAreNoCrossings) {
  for (const Crossing crossing : {Crossing::both, Crossing::rising}) {
    const Trajectory run = spin(turn, crossing, 20.0);
    ASSERT_EQ(run.events().size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(run.events()[k].t, 0.5 + turn * static_cast<double>(k), budget::adaptive_dense);
      EXPECT_EQ(run.events()[k].direction, 1);
    }
  }
  EXPECT_TRUE(spin(turn, Crossing::falling, 20.0).events().empty());
}

TEST(AngleEvent, BackwardsTheAngleFalls) {
  const Trajectory run = spin(turn, Crossing::both, -20.0);
  ASSERT_EQ(run.events().size(), 3U);
  for (const EventRecord& event : run.events()) EXPECT_EQ(event.direction, -1);
}

// What the period is for: without it each jump is taken for a crossing.
TEST(AngleEvent, WithoutAPeriodTheyAre) {
  EXPECT_EQ(spin(0.0, Crossing::both, 20.0).events().size(), 7U);
}

}  // namespace
}  // namespace polhode
