// SPDX-License-Identifier: MIT
// Zeros of functions of time whose zeros are known.
#include "dynamics/detail/time_zeros.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "budgets.hpp"

namespace {

using namespace polhode;
using namespace polhode::detail;
using testing::IsEmpty;

constexpr double pi = std::numbers::pi;

void expect_zeros(const std::vector<Zero>& found, const std::vector<Zero>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].t, wanted[i].t,
                wanted[i].direction == 0 ? budget::time_of_touch : budget::time_of_zero)
        << i;
    EXPECT_EQ(found[i].direction, wanted[i].direction) << i;
  }
}

TEST(TimeZeros, EveryChangeOfSignInOrderBothWays) {
  const TimeFunction f = [](double t) { return std::cos(t); };
  expect_zeros(zeros_between(f, 0.0, 10.0, 8), {{0.5 * pi, -1}, {1.5 * pi, 1}, {2.5 * pi, -1}});
  expect_zeros(zeros_between(f, 0.0, -6.0, 5), {{-0.5 * pi, -1}, {-1.5 * pi, 1}});
}

// A dip of this depth between two looks has two zeros; where it just fails to reach zero there are
// none, and where it touches, one.
TEST(TimeZeros, DoubleZerosBetweenTwoLooks) {
  for (const double lowest : {-0.5, -0.1, -1e-3, -1e-6, -1e-10}) {
    for (double centre = 0.02; centre < 1.0; centre += 0.0571) {
      const TimeFunction f = [&](double t) {
        const double s = std::sin(0.5 * (t - centre));  // 1 - cos (t - centre) does not cancel
        return lowest + 2.0 * s * s;
      };
      const double half = 2.0 * std::asin(std::sqrt(-0.5 * lowest));
      std::vector<Zero> wanted = {{centre - half, -1}, {centre + half, 1}};
      if (centre - half < -1.0) wanted.erase(wanted.begin());
      if (centre + half <= 3.0) expect_zeros(zeros_between(f, -1.0, 3.0, 4), wanted);
    }
  }
}

TEST(TimeZeros, AMissIsNoZeroAndATouchIsOne) {
  for (double centre = 0.02; centre < 1.0; centre += 0.0571) {
    const auto over = [centre](double lowest) {
      return [centre, lowest](double t) {
        const double s = std::sin(0.5 * (t - centre));
        return -lowest - 2.0 * s * s;
      };
    };
    for (const double lowest : {1e-12, 1e-6, 0.1, 1.0})
      EXPECT_THAT(zeros_between(over(lowest), -1.0, 3.0, 4), IsEmpty()) << centre << " " << lowest;
    expect_zeros(zeros_between(over(0.0), -1.0, 3.0, 4), {{centre, 0}});
  }
}

TEST(TimeZeros, AZeroAtALookIsFoundOnce) {
  const TimeFunction line = [](double t) { return t - 2.0; };
  expect_zeros(zeros_between(line, 0.0, 4.0, 4), {{2.0, 1}});
  expect_zeros(zeros_between([](double t) { return (t - 2.0) * (t - 2.0); }, 0.0, 4.0, 4),
               {{2.0, 0}});
  // between two runs: it is that of the run that ends there
  expect_zeros(zeros_between(line, 0.0, 2.0, 2), {{2.0, 1}});
  EXPECT_THAT(zeros_between(line, 2.0, 4.0, 2), IsEmpty());
  // a look that is zero hides none beside it
  const TimeFunction cubic = [](double t) { return t * (t - 0.9) * (t - 3.5); };
  expect_zeros(zeros_between(cubic, -1.0, 4.0, 5), {{0.0, 1}, {0.9, -1}, {3.5, 1}});
}

TEST(TimeZeros, AZeroAtTheStartCountsWhereItIsAskedFor) {
  const TimeFunction f = [](double t) { return t; };
  for (const bool reports : {true, false}) {
    ZeroSearch search;
    std::vector<Zero> found;
    search.begin(0.0, 0.0, reports);
    search.between(f, {0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, found);
    search.end(found);
    EXPECT_EQ(found.size(), reports ? 1U : 0U);
  }
}

TEST(TimeZeros, AStretchOfZerosCountsWhereTheSignChangesOverIt) {
  const auto pulse = [](double rest) {
    return [rest](double t) { return t < 1.5 ? t - 1.5 : (t < 3.5 ? 0.0 : rest * (t - 3.5)); };
  };
  EXPECT_EQ(zeros_between(pulse(1.0), 0.0, 6.0, 6).size(), 1U);
  EXPECT_THAT(zeros_between(pulse(-1.0), 0.0, 6.0, 6), IsEmpty());
  EXPECT_THAT(zeros_between([](double) { return 0.0; }, 0.0, 6.0, 6), IsEmpty());
}

TEST(TimeZeros, TheJumpOfAFoldedAngleIsNone) {
  // one turn in 5: looks are 2 radians apart
  const TimeFunction f = [](double t) { return std::remainder(0.4 * pi * t - 1.0, 2.0 * pi); };
  const auto between = [&](double period) {
    int zeros = 0;
    for (int k = 0; k < 100; ++k) {
      const double a = 1.59 * k, b = 1.59 * (k + 1);
      if (f(a) * f(b) < 0.0 &&
          crossing_between(f, {a, f(a), 0.0}, {b, f(b), 0.0}, period).has_value())
        ++zeros;
    }
    return zeros;
  };
  EXPECT_EQ(between(2.0 * pi), 32);  // 1.59 * 100 / 5
  EXPECT_GT(between(0.0), 60);
}

TEST(TimeZeros, NaNIsNoZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(zeros_between([nan](double) { return nan; }, 0.0, 1.0, 4), IsEmpty());
}

}  // namespace
