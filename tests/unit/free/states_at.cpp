// SPDX-License-Identifier: MIT
// Many states in the lanes of the processor: bit for bit those of one at a time, by every set of
// instructions that there is, for any number of times.
#include "polhode/free/states_at.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using polhode::InstructionSet;

void expect_scalar_bits(const FreeRotation& m, const std::vector<double>& times,
                        const std::string& what) {
  const RotorState unset{{7.0, 7.0, 7.0, 7.0}, {7.0, 7.0, 7.0}};
  for (const InstructionSet set : polhode::supported_instruction_sets()) {
    // one more, which must stay as it is
    std::vector<RotorState> states(times.size() + 1, unset);
    states_at(m.kernel(), times, std::span(states).first(times.size()), set);
    EXPECT_EQ(bits(states.back()), bits(unset));
    for (std::size_t i = 0; i < times.size(); ++i)
      ASSERT_EQ(bits(states[i]), bits(m.at(times[i])))
          << what << ", " << instruction_set_name(set) << ", t = " << times[i] << ", " << i
          << " of " << times.size();
  }
}

TEST(StatesAt, HaveTheBitsOfOneAtATimeForDrawnBodies) {
  Draw draw(91, 0);
  for (const FreeCase& c : drawn_cases(90, 300)) {
    std::vector<double> times{c.t0, c.t};
    for (int k = 0; k < 40; ++k) times.push_back(draw.sign() * draw.power_of_ten(-3.0, 12.0));
    for (int k = 0; k < 8; ++k) times.push_back(draw.sign() * draw.power_of_ten(12.0, 308.0));
    expect_scalar_bits(motion_of(c), times, description(c));
  }
}

TEST(StatesAt, HaveTheBitsOfOneAtATimeInEveryRegimeAtAnyTime) {
  Draw draw(92, 0);
  for (const NamedMotion& n : motions()) {
    std::vector<double> times{0.0,   -0.0,   1e18,     -1e100,    1e300,
                              1e308, -1e308, infinite, -infinite, not_a_number};
    for (int k = 0; k < 200; ++k) times.push_back(draw.sign() * draw.power_of_ten(-300, 308));
    expect_scalar_bits(n.motion(), times, n.name);
  }
}

TEST(StatesAt, TakeAnyNumberOfTimes) {
  Draw draw(93, 0);
  for (const NamedMotion& n : motions())
    for (const std::size_t count :
         {0U, 1U, 2U, 3U, 7U, 8U, 9U, 15U, 16U, 17U, 31U, 63U, 64U, 65U, 127U, 128U, 129U, 300U}) {
      std::vector<double> times(count);
      for (double& t : times) t = draw.uniform(-1e4, 1e4);
      expect_scalar_bits(n.motion(), times, n.name);
    }
}

TEST(StatesAt, DoNotDependOnTheirNeighbours) {
  const FreeRotation m(Body(1.0, 1.5, 2.2), {{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}});
  std::vector<double> times(64, 3.25);
  std::vector<RotorState> states(times.size());
  m.at(times, states);
  for (const RotorState& s : states) EXPECT_EQ(bits(s), bits(states[0]));
  times[5] = not_a_number;
  m.at(times, states);
  for (std::size_t i = 0; i < states.size(); ++i) EXPECT_EQ(std::isnan(states[i].q.w), i == 5) << i;
  EXPECT_EQ(bits(states[4]), bits(m.at(3.25)));
}

TEST(StatesAt, RefuseAnotherNumberOfStates) {
  const FreeRotation m(Body(1.0, 1.5, 2.2), {{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}});
  const std::vector<double> times(9);
  std::vector<RotorState> states(8);
  EXPECT_MESSAGE(m.at(times, states),
                 "states_at: got room for 8 states at 9 times; expected as many");
}

TEST(StatesAt, RefuseInstructionsThatTheProcessorLacks) {
  const FreeRotation m(Body(1.0, 1.5, 2.2), {{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}});
  const std::vector<double> times(9);
  std::vector<RotorState> states(9);
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (polhode::supports(set))
      EXPECT_NO_THROW(states_at(m.kernel(), times, states, set));
    else
      EXPECT_THROW(states_at(m.kernel(), times, states, set), polhode::DomainError);
  }
  EXPECT_TRUE(polhode::supports(polhode::widest_instruction_set()));
}

}  // namespace
