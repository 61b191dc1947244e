// SPDX-License-Identifier: MIT
// The time left of cells is right within a factor of two, up to the last ones.
#include "run/time_left.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "worst.hpp"

namespace polhode {
namespace {

struct Case {
  const char* name;
  std::int64_t cells;
  int workers;
  double seconds;     // of a cell
  double scatter;     // a part of them
  double last = 1.0;  // the last cell, in parts of one
};

// When each cell has ended and those before it, by workers that take cells in order.
std::vector<double> ends_of(const Case& one) {
  std::vector<double> free(static_cast<std::size_t>(one.workers), 0.0), ends;
  double latest = 0.0;
  std::uint32_t draw = 7;
  for (std::int64_t cell = 0; cell < one.cells; ++cell) {
    draw = draw * 1664525U + 1013904223U;
    const double drawn = 2.0 * static_cast<double>(draw >> 8) / 0x1p24 - 1.0;
    std::size_t next = 0;
    for (std::size_t k = 1; k < free.size(); ++k)
      if (free[k] < free[next]) next = k;
    free[next] +=
        one.seconds * (1.0 + one.scatter * drawn) * (cell + 1 < one.cells ? 1.0 : one.last);
    latest = test::larger(latest, free[next]);
    ends.push_back(latest);
  }
  return ends;
}

const Case cases[] = {
    {"8 chunks of 22 s on 2 threads", 8, 2, 22.0, 0.02},
    {"7 chunks of 22 s on 2 threads", 7, 2, 22.0, 0.02},
    {"300 chunks of 20 ms on 1 thread", 300, 1, 0.02, 0.1},
    {"300 chunks of 20 ms on 4 threads", 300, 4, 0.02, 0.1},
    {"a map of 1240 cells on 2 threads", 1240, 2, 0.05, 0.5},
    {"more threads than half of the chunks", 9, 8, 10.0, 0.02},
    {"more threads than chunks", 3, 16, 10.0, 0.02},
    {"64 chunks on 16 ranks", 64, 16, 100.0, 0.05},
    {"a last chunk of one member", 4, 1, 22.0, 0.0, 0.01},
    {"a last chunk of one member on 2 threads", 5, 2, 22.0, 0.0, 0.01},
};

// After every cell. An error that is short against the duration of a cell does not matter.
TEST(SecondsLeft, AreRightWithinAFactorOfTwo) {
  for (const Case& one : cases) {
    const std::vector<double> ends = ends_of(one);
    const double slack = 2.0 * one.scatter * one.seconds;
    std::vector<double> last(static_cast<std::size_t>(one.workers), 0.0);
    for (std::int64_t done = 1; done < one.cells; ++done) {
      const double now = ends[static_cast<std::size_t>(done - 1)];
      std::rotate(last.begin(), last.begin() + 1, last.end());
      last.back() = now;
      const double left = static_cast<double>(one.cells - done - 1) + one.last;
      const double told = io::seconds_left(last, done, left), really = ends.back() - now;
      EXPECT_LE(told, 2.0 * really + slack + 1e-9) << one.name << ", after " << done;
      EXPECT_GE(told, 0.5 * really - slack - 1e-9) << one.name << ", after " << done;
    }
  }
}

// 8 cells of 22 s on 2 threads, by hand: the last two begin at 66.
TEST(SecondsLeft, OfTwoThreadsByHand) {
  EXPECT_EQ(io::seconds_left(std::vector{0.0, 22.0}, 1, 7.0), 66.0);
  EXPECT_EQ(io::seconds_left(std::vector{22.0, 22.0}, 2, 6.0), 66.0);
  EXPECT_EQ(io::seconds_left(std::vector{66.0, 66.0}, 6, 2.0), 22.0);
  EXPECT_EQ(io::seconds_left(std::vector{66.0, 88.0}, 7, 1.0), 0.0);
  EXPECT_EQ(io::seconds_left(std::vector{66.0, 66.0}, 6, 1.5), 22.0);  // the last one is a half
  EXPECT_EQ(io::seconds_left(std::vector{66.0, 66.0}, 6, 3.0), 44.0);
  EXPECT_EQ(io::seconds_left(std::vector{66.0, 66.0}, 6, 2.5), 33.0);
  EXPECT_EQ(io::seconds_left(std::vector{66.0, 66.0}, 6, 0.0), 0.0);
}

TEST(CellClock, KnowsNothingBeforeTheFirstCellAndEndsAtOne) {
  io::CellClock clock(2);
  EXPECT_EQ(clock.part(2.0), 0.0);
  clock.ended();
  const double part = clock.part(1.0);
  EXPECT_TRUE(part > 0.0 && part <= 1.0) << part;
  clock.begin(1);
  EXPECT_EQ(clock.part(1.0), 0.0);
  clock.ended();
  EXPECT_EQ(clock.part(0.0), 1.0);
}

}  // namespace
}  // namespace polhode
