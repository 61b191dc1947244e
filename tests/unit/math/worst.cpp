// SPDX-License-Identifier: MIT
// The accumulator of the tests' errors sees a NaN wherever it comes, and an empty loop.
#include "worst.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/wide_real.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode::test {
namespace {

const double nan = std::nan("");

TEST(Worst, IsTheLargestWithItsWords) {
  Worst worst;
  worst.add(-3.0, "first");
  EXPECT_EQ(worst.value(), -3.0);
  worst.add(2.0, "second");
  worst.add(2.0, "equal");
  worst.add(1.0, "smaller");
  EXPECT_EQ(worst.value(), 2.0);
  EXPECT_EQ(worst.where(), "second");
}

TEST(Worst, IsNaNAfterANaN) {
  std::array<double, 4> order{nan, 1.0, 2.0, HUGE_VAL};
  for (int k = 0; k < 4; ++k) {
    Worst worst;
    for (const double x : order) worst.add(x, std::isnan(x) ? "here" : "elsewhere");
    EXPECT_TRUE(std::isnan(worst.value())) << k;
    EXPECT_EQ(worst.where(), "here");
    std::rotate(order.begin(), order.begin() + 1, order.end());
  }
}

// EXPECT_LE of a NaN fails: so does a test that measured nothing.
TEST(Worst, IsNaNBeforeTheFirst) { EXPECT_FALSE(std::isfinite(Worst<>().value())); }

TEST(Worst, OfOtherNumbers) {
  Worst<oracle::Wide> wide;
  wide.add(oracle::Wide(2));
  wide.add(oracle::Wide(0) / 0);
  wide.add(oracle::Wide(3));
  EXPECT_TRUE(isnan(wide.value()));
}

TEST(Larger, AndSmallerKeepNaN) {
  EXPECT_EQ(larger(1.0, 2.0), 2.0);
  EXPECT_EQ(larger(2.0, 1.0, -1.0), 2.0);
  EXPECT_EQ(smaller(2.0, 1.0), 1.0);
  EXPECT_EQ(smaller(-2.0, 1.0, -3.0), -3.0);
  EXPECT_TRUE(std::isnan(larger(nan, 1.0)) && std::isnan(larger(1.0, nan)));
  EXPECT_TRUE(std::isnan(smaller(nan, 1.0)) && std::isnan(smaller(1.0, nan)));
  EXPECT_TRUE(std::isnan(larger(1.0, nan, 2.0)) && std::isnan(smaller(1.0, nan, 0.0)));
}

}  // namespace
}  // namespace polhode::test
