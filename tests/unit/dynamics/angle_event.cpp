// SPDX-License-Identifier: MIT
// Events of an angle: its jump from one end of a turn to the other is no crossing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace polhode {
namespace {

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
