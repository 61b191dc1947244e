// SPDX-License-Identifier: MIT
// Points that are listed: a grid in its order, the rows of a table.
#include "polhode/ensemble/draw_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "message_of.hpp"
#include "polhode/ensemble/counter_random.hpp"
#include "statistics.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;

TEST(DrawGrid, CountsTheLastAxisTheFastest) {
  const DrawGrid grid({{1.0, 3.0, 3}, {5.0, 5.0, 1}, {0.0, -1.0, 2}});
  ASSERT_EQ(grid.size(), 6u);
  const double want[6][3] = {{1, 5, 0}, {1, 5, -1}, {2, 5, 0}, {2, 5, -1}, {3, 5, 0}, {3, 5, -1}};
  for (std::uint64_t index = 6; index-- > 0;) {
    std::vector<double> x(3);
    grid.at(index, x);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(x[i], want[index][i]) << index << ", " << i;
  }
}

TEST(DrawGrid, EndsAreExactAndPointsRoundedOnce) {
  const DrawGrid grid({{0.1, 0.7, 7}});
  for (int k = 0; k < 7; ++k) {
    double x = 0.0;
    grid.at(static_cast<std::uint64_t>(k), {&x, 1});
    EXPECT_EQ(x, SaveAt::count(0.1, 0.7, 7)[k]);
  }
}

TEST(DrawGrid, WhatIsNoneIsRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_MESSAGE(DrawGrid({}), "DrawGrid: 0 axes must be one or more");
  EXPECT_MESSAGE(DrawGrid({{0, 1, 2}, {0, infinity, 2}}),
                 "DrawGrid: axis[1]: to inf must be finite");
  EXPECT_MESSAGE(DrawGrid({{0, 1, 0}}), "DrawGrid: axis[0]: count 0 must be 1 or more");
  EXPECT_MESSAGE(DrawGrid({{0, 1, -3}, {0, 1, -4}}),
                 "DrawGrid: axis[0]: count -3 must be 1 or more");
  EXPECT_MESSAGE(
      DrawGrid({{0, 1, 1LL << 40}, {0, 1, 1LL << 40}}),
      "DrawGrid: axis[1]: count 1099511627776 makes more points than 2^53, which must be the most");
  double x = 0.0;
  EXPECT_MESSAGE(DrawGrid({{0, 1, 2}}).at(2, {&x, 1}), "DrawGrid::at: index 2 must be below 2");
}

TEST(DrawTable, HasItsRows) {
  const DrawTable table(2, {1, 2, 3, 4, 5, 6}, RowOrder::in_order);
  EXPECT_EQ(table.rows(), 3u);
  EXPECT_EQ(table.row(2)[0], 5.0);
  EXPECT_EQ(table.row(2)[1], 6.0);
  EXPECT_EQ(DrawTable(table).row(0).data(), table.row(0).data());  // shared
}

TEST(DrawTable, DrawsEveryRowAsOften) {
  std::vector<double> numbers(37);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i);
  const DrawTable table(1, numbers, RowOrder::with_replacement);
  EXPECT_EQ(table.from_uniform(0x1p-53)[0], 0.0);
  EXPECT_EQ(table.from_uniform(1.0 - 0x1p-53)[0], 36.0);
  expect_as_it_should_be(over_seeds(12, [&](std::uint64_t seed) {
    const CounterRandom random(seed, key_of("clone"));
    std::vector<double> counts(37);
    for (std::uint64_t m = 0; m < 8192; ++m)
      ++counts[static_cast<std::size_t>(table.from_uniform(random.uniform(m, 0))[0])];
    return evenness(counts);
  }));
}

TEST(DrawTable, WhatIsNoneIsRefused) {
  constexpr RowOrder any = RowOrder::in_order;
  EXPECT_MESSAGE(DrawTable(0, {1}, any), "DrawTable: 0 columns must be one or more");
  EXPECT_MESSAGE(DrawTable(2, {}, any), "DrawTable: 0 rows must be one or more");
  EXPECT_MESSAGE(DrawTable(2, {1, 2, 3}, any), "DrawTable: 3 numbers must be whole rows of 2");
  EXPECT_MESSAGE(DrawTable(2, {1, 2, 3, std::nan("")}, any),
                 "DrawTable: row 1, column 1: nan must be finite");
  EXPECT_MESSAGE(DrawTable(1, {1, 2}, any).row(2), "DrawTable::row: index 2 must be below 2");
}

}  // namespace
