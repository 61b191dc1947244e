// SPDX-License-Identifier: MIT
// Many states in the lanes of the processor: bit for bit those of one at a time, by every set of
// instructions that there is, for any number of times.
#include "polhode/detail/free/states_at.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/free_accuracy.hpp"
#include "polhode/detail/free/states_on_grid.hpp"
#include "polhode/error.hpp"
#include "unit/free/support.hpp"
#include "worst.hpp"

namespace {

using namespace free_test;
using polhode::InstructionSet;
using namespace oracle;
using namespace polhode;
using polhode::test::Worst;

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

// States on an even grid: their bits depend on the grid and the index alone, and they are as right
// as those of one time.

const RotorState unset{{7.0, 7.0, 7.0, 7.0}, {7.0, 7.0, 7.0}};

std::vector<RotorState> some(const FreeRotation& m, const TimeGrid& grid, std::uint64_t first,
                             std::size_t count, InstructionSet set) {
  std::vector<RotorState> states(count + 1, unset);  // one more, which must stay as it is
  states_on_grid(m.kernel(), grid, first, std::span(states).first(count), set);
  EXPECT_EQ(bits(states.back()), bits(unset));
  states.pop_back();
  return states;
}

TEST(StatesOnGrid, HaveTheSameBitsByEverySetFromAnyFirstStateForAnyNumber) {
  for (const NamedMotion& n : motions()) {
    const FreeRotation m = n.motion(0.3);
    const TimeGrid grid{-17.25, 0.71};
    const std::uint64_t origin = 960;  // 64 states share their angles, 1024 are prepared at a time
    const std::vector<RotorState> all = some(m, grid, origin, 300, InstructionSet::baseline);
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t first : {0U, 1U, 7U, 63U, 64U, 65U, 100U})
        for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 8U, 9U, 63U, 64U, 65U, 129U, 200U}) {
          const std::vector<RotorState> got = some(m, grid, origin + first, count, set);
          for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(bits(got[i]), bits(all[first + i]))
                << n.name << ", " << instruction_set_name(set) << ", " << first << " + " << i
                << " of " << count;
        }
  }
}

// Large results go past the caches, line by line, wherever they begin.
TEST(StatesOnGrid, AreTheSameWhereTheyAreStreamed) {
  const FreeRotation m(Body(1.0, 1.5, 2.2), {{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}});
  const TimeGrid grid{0.0, 0.01};
  const std::size_t count = 40000;
  std::vector<RotorState> alone;
  for (std::size_t done = 0; done < count + 8; done += 1000)
    for (const RotorState& s : some(m, grid, done, 1000, InstructionSet::baseline))
      alone.push_back(s);
  for (const InstructionSet set : supported_instruction_sets())
    for (std::size_t shift = 0; shift < 8; ++shift) {
      std::vector<RotorState> room(count + 9, unset);
      states_on_grid(m.kernel(), grid, shift, std::span(room).subspan(shift, count), set);
      for (std::size_t i = 0; i < room.size(); ++i)
        ASSERT_EQ(bits(room[i]), bits(i < shift || i >= shift + count ? unset : alone[i]))
            << instruction_set_name(set) << ", " << shift << ", " << i;
    }
}

// Steps of so few digits that times are doubles, at which the oracle knows the state.
TEST(StatesOnGrid, AreAsRightAsThoseOfOneTime) {
  const std::size_t of_each = std::getenv("POLHODE_TEST_FULL") != nullptr ? 40 : 4;
  for (const FreeCase& c : drawn_cases(4242, of_each)) {
    const FreeRotation m = motion_of(c);
    FreeBody body(c.moments, c.start.q, c.start.g);
    int e = 0;
    const double part = std::frexp(0.0137 * (c.t - c.t0), &e);
    const TimeGrid grid{c.t0, std::ldexp(std::rint(std::ldexp(part, 12)), e - 12)};
    Worst angle, momentum;
    for (const std::uint64_t i : {0U, 1U, 17U, 64U, 73U}) {
      const RotorState s = some(m, grid, i, 1, widest_instruction_set())[0];
      // since the epoch, which need not add up to a double
      const auto e_i = error_at(body, s, static_cast<double>(i) * grid.step, 0.0);
      angle.add(e_i.angle);
      momentum.add(e_i.momentum);
    }
    EXPECT_LE(angle.value(), budget::free_state) << description(c);
    EXPECT_LE(momentum.value(), budget::free_state) << description(c);
  }
}

// In every component of the attitude.
TEST(StatesOnGrid, KeepTheirDigitsForABillionTurns) {
  for (const double x : {0.04, 0.4, 0.6, 0.76, 0.7822}) {
    const RotorState start{normalized(Quaternion{0.9, 0.1, -0.3, 0.2}), {x, 0.1, 1.5}};
    const FreeRotation m(Body(1.0, 1.7, 2.1), start);
    FreeBody body({1.0, 1.7, 2.1}, start.q, start.g);
    const TimeGrid grid{0.0, 0x1.9p-2};
    for (const std::uint64_t first : {160'003UL, 16'000'003'000UL}) {  // 1e4 and 1e9 turns
      Worst worst;
      const std::vector<RotorState> states = some(m, grid, first, 65, widest_instruction_set());
      for (std::size_t i = 0; i < states.size(); i += 16) {
        const double t = static_cast<double>(first + i) * grid.step;
        worst.add(error_at(body, states[i], t, 0.0).angle);
      }
      EXPECT_LE(worst.value(), budget::free_state) << x << ", " << first;
    }
  }
}

TEST(StatesOnGrid, AreNotANumberAtTimesThatAreNone) {
  for (const NamedMotion& n : motions()) {
    const FreeRotation m = n.motion();
    for (const TimeGrid& grid : {TimeGrid{not_a_number, 1.0}, TimeGrid{0.0, infinite},
                                 TimeGrid{-infinite, 1.0}, TimeGrid{0.0, not_a_number}})
      for (const RotorState& s : some(m, grid, 3, 9, widest_instruction_set()))
        EXPECT_TRUE(std::isnan(s.q.w) && std::isnan(s.q.x)) << n.name << " " << grid.step;
  }
}

TEST(StatesOnGrid, RefuseIndicesThatNoDoubleCounts) {
  const FreeRotation m(Body(1.0, 1.5, 2.2), {{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}});
  std::vector<RotorState> states(9);
  EXPECT_MESSAGE(m.at(TimeGrid{0.0, 1.0}, states, std::uint64_t{1} << 53),
                 "states_on_grid: got states 9007199254740992 to 9007199254741001; expected "
                 "indices up to 2^53");
}

TEST(StatesOnGrid, RefuseInstructionsThatTheProcessorLacks) {
  const FreeRotation m(Body(1.0, 1.5, 2.2), {{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}});
  std::vector<RotorState> states(9);
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    const auto ask = [&] { states_on_grid(m.kernel(), TimeGrid{0.0, 1.0}, 0, states, set); };
    if (supports(set))
      EXPECT_NO_THROW(ask());
    else
      EXPECT_THROW(ask(), DomainError);
  }
}

}  // namespace
