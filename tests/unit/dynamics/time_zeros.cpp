// SPDX-License-Identifier: MIT
// Zeros of functions of time whose zeros are known.
#include "polhode/dynamics/detail/time_zeros.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "budgets.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::detail;
using testing::IsEmpty;

constexpr double pi = std::numbers::pi;

// With that many equal intervals between looks: zeros in (t0, t1].
std::vector<Zero> zeros_between(const TimeFunction& f, double t0, double t1, int intervals) {
  const double h = (t1 - t0) / intervals;
  const auto look = [&](double t, double side) {
    const double value = f(t), move = side * (0x1p-10 * h);
    return Look{t, value, (f(t + move) - value) / move};
  };
  std::vector<Zero> found;
  ZeroSearch search;
  Look a = look(t0, 1.0);
  search.begin(t0, a.value, false);
  for (int k = 1; k <= intervals; ++k) {
    const Look b = look(k == intervals ? t1 : t0 + k * h, k == intervals ? -1.0 : 1.0);
    search.between(f, a, b, found);
    a = b;
  }
  search.end(found);
  return found;
}

void expect_zeros(const std::vector<Zero>& found, const std::vector<Zero>& wanted,
                  double time = budget::time_of_zero) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].t, wanted[i].t, wanted[i].direction == 0 ? budget::time_of_touch : time)
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

// Symmetric about the middle as far as its ends and their slopes tell: the parabola's vertex is
// where the search stands already, and the dip lies next to it.
TEST(TimeZeros, ADipNextToAParabolasVertex) {
  for (const double tilt : {0.3, -0.3}) {
    const TimeFunction f = [tilt](double t) {
      const double x = t - 4.0, rest = 1.0 - x * x;
      return 0.01 + x * x + tilt * x * std::pow(rest, 6);
    };
    for (const double from : {3.0, 5.0}) {
      const std::vector<Zero> found = zeros_between(f, from, 8.0 - from, 1);
      ASSERT_EQ(found.size(), 2U) << from;
      for (const Zero& zero : found) EXPECT_NEAR(f(zero.t), 0.0, budget::time_of_zero);
      EXPECT_EQ(found[0].direction, -1);
      EXPECT_EQ(found[1].direction, 1);
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
  // a rounding away from a look
  for (const double centre : {std::nextafter(3.0, 2.0), std::nextafter(3.0, 4.0)})
    expect_zeros(zeros_between([=](double t) { return (t - centre) * (t - centre); }, 1.0, 5.0, 4),
                 {{centre, 0}});
}

TEST(TimeZeros, AZeroAtALookIsFoundOnce) {
  const TimeFunction line = [](double t) { return t - 2.0; };
  expect_zeros(zeros_between(line, 0.0, 4.0, 4), {{2.0, 1}});
  expect_zeros(zeros_between([](double t) { return (t - 2.0) * (t - 2.0); }, 0.0, 4.0, 4),
               {{2.0, 0}});
  // between two runs: it is that of the run that ends there
  expect_zeros(zeros_between(line, 0.0, 2.0, 2), {{2.0, 1}});
  EXPECT_THAT(zeros_between(line, 2.0, 4.0, 2), IsEmpty());
  // a look that is zero hides none next to it
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

// Where looks are only some doubles apart.
TEST(TimeZeros, AtLargeTimesAZeroAtAnEndIsNoStretch) {
  for (const double t0 : {1e6, 8e8, -8e8, 1e15}) {
    const double ulp = std::nextafter(std::fabs(t0), 2e15) - std::fabs(t0);
    for (const double ulps : {1.0, 2.0, 3.0, 4.0, 1e3}) {
      const double t1 = t0 + ulps * ulp;
      for (const double at : {t0, t1}) {
        const TimeFunction f = [at](double t) { return t - at; };
        ZeroSearch search;
        std::vector<Zero> found;
        search.begin(t0, f(t0));
        search.between(f, {t0, f(t0), 1.0}, {t1, f(t1), 1.0}, found);
        search.end(found);
        ASSERT_EQ(found.size(), 1U) << t0 << " " << ulps;
        EXPECT_EQ(found[0].t, at);
        EXPECT_EQ(found[0].direction, 1);
      }
    }
  }
}

// |t - t0|^n, as V, parabola and flatter, wherever the looks are.
TEST(TimeZeros, TouchesOfAnyPower) {
  for (const double power : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0}) {
    for (double centre = 0.02; centre < 1.0; centre += 0.0571) {
      const auto over = [&](double lowest) {
        return [=](double t) {
          return lowest + std::pow(std::fabs(2.0 * std::sin(0.5 * (t - centre))), power);
        };
      };
      const std::vector<Zero> found = zeros_between(over(0.0), -1.0, 3.0, 4);
      ASSERT_EQ(found.size(), 1U) << power << " " << centre;
      EXPECT_EQ(found[0].direction, 0);
      const double least = test::larger(power, 2.0);  // roundings of f: 1e-14
      EXPECT_NEAR(found[0].t, centre, std::pow(budget::value_of_touch, 1.0 / least));
      EXPECT_THAT(zeros_between(over(1e-9), -1.0, 3.0, 4), IsEmpty()) << power << " " << centre;
      EXPECT_EQ(zeros_between(over(-1e-9), -1.0, 3.0, 4).size(), 2U) << power << " " << centre;
    }
  }
}

// A V is met at the bottom from either side, far from t = 0 where times are coarse.
TEST(TimeZeros, TouchesOfAKinkWhereverItLies) {
  for (const double from : {0.0, 1e4}) {
    for (int k = 0; k < 4000; ++k) {
      const double centre = from + 0.02 + 0.96 * k / 4000;
      const auto kink = [=](double t) { return std::fabs(2.0 * std::sin(0.5 * (t - centre))); };
      const std::vector<Zero> found = zeros_between(kink, from - 1.0, from + 3.0, 4);
      ASSERT_EQ(found.size(), 1U) << centre;
      EXPECT_EQ(found[0].direction, 0);
    }
  }
}

// Its first instant and its last, whichever looks meet it: also none.
TEST(TimeZeros, AStretchOfZerosIsTwo) {
  const auto pulse = [](double rest) {
    return [rest](double t) { return t < 1.5 ? t - 1.5 : (t < 3.5 ? 0.0 : rest * (t - 3.5)); };
  };
  for (const int intervals : {1, 2, 3, 6, 8, 12, 60}) {
    expect_zeros(zeros_between(pulse(1.0), 0.0, 6.0, intervals), {{1.5, 1}, {3.5, 1}});
    expect_zeros(zeros_between(pulse(-1.0), 0.0, 6.0, intervals), {{1.5, 1}, {3.5, -1}});
    expect_zeros(zeros_between(pulse(1.0), 6.0, 0.0, intervals), {{3.5, -1}, {1.5, -1}});
    // up to the end, from the start, and all along
    expect_zeros(zeros_between(pulse(1.0), 0.0, 3.0, intervals), {{1.5, 1}, {3.0, 0}});
    expect_zeros(zeros_between(pulse(1.0), 2.0, 6.0, intervals), {{3.5, 1}});
    expect_zeros(zeros_between([](double) { return 0.0; }, 0.0, 6.0, intervals), {{6.0, 0}});
  }
  ZeroSearch search;
  std::vector<Zero> found;
  search.begin(2.0, 0.0);
  search.between(pulse(1.0), {2.0, 0.0, 0.0}, {6.0, 2.5, 1.0}, found);
  expect_zeros(found, {{2.0, 0}, {3.5, 1}});
}

// What stays next to zero, by roundings of what it is made of, is there: 0.1 + 0.2 - 0.3.
TEST(TimeZeros, AStretchMayBeOfRoundings) {
  const auto despun = [](double t) {
    const double g = t < 2.3 ? 0.3 + 0.25 * (2.3 - t) : (t < 7.1 ? 0.1 + 0.2 : 0.3 + (t - 7.1));
    return g - 0.3;
  };
  for (const int intervals : {8, 10, 20, 100})
    expect_zeros(zeros_between(despun, 0.0, 10.0, intervals), {{2.3, -1}, {7.1, 1}},
                 budget::time_of_stretch);
  // an oscillation that dies away has each of its zeros once, however small it is
  const auto dying = [](double t) { return std::exp(-4.0 * t) * std::cos(t); };
  std::vector<Zero> wanted;
  for (int k = 0; k < 16; ++k) wanted.push_back({(0.5 + k) * pi, k % 2 == 0 ? -1 : 1});
  expect_zeros(zeros_between(dying, 0.0, 50.0, 60), wanted);
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
  const TimeFunction gap = [nan](double t) { return std::fabs(t - 0.5) < 0.1 ? nan : t - 0.5; };
  EXPECT_THAT(zeros_between(gap, 0.0, 1.0, 1), IsEmpty());
}

}  // namespace
