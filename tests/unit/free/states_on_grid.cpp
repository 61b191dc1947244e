// SPDX-License-Identifier: MIT
// States on an even grid: their bits depend on the grid and the index alone, and they are as right
// as those of one time.
#include "polhode/free/states_on_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/free_accuracy.hpp"
#include "polhode/error.hpp"
#include "unit/free/support.hpp"
#include "worst.hpp"

namespace {

using namespace oracle;
using namespace free_test;
using namespace polhode;
using polhode::test::Worst;

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
