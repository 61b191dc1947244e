// SPDX-License-Identifier: MIT
// Sines, cosines and angles of packs against 40 digits of MPFR.
#include "math/pack_functions.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "oracle/random_draw.hpp"
#include "worst.hpp"

namespace {

namespace budget = polhode::budget;
using oracle::Draw;
using polhode::test::Worst;
using Wide = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<40>,
                                           boost::multiprecision::et_off>;
using P = polhode::Pack<polhode::InstructionSet::baseline>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// In units of the last place of the exact value.
double units(double got, const Wide& exact) {
  const double size = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(size, infinite) - size;
  return std::abs(static_cast<double>(Wide(Wide(got) - exact))) / unit;
}

double angle_of(double y, double x) { return atan2(P(y), P(x)).lanes[1]; }

TEST(PackFunctions, SinesAndCosinesAreRightToTheLastPlace) {
  Draw draw(601, 0);
  Worst worst;
  for (int i = 0; i < 40000; ++i) {
    double x = draw.sign() * draw.power_of_ten(-12.0, 5.99);
    if (i % 3 == 0) x = draw.uniform(-7.0, 7.0);
    // next to multiples of pi/2, where one of the two is small
    if (i % 5 == 0) x = std::rint(draw.uniform(-6e5, 6e5)) * 1.5707963267948966;
    const auto s = sincos(P(x));
    worst.add(units(s.sin.lanes[0], sin(Wide(x))));
    worst.add(units(s.cos.lanes[1], cos(Wide(x))));
  }
  EXPECT_LE(worst.value(), budget::pack_sincos_ulp);
}

TEST(PackFunctions, ThoseOfSmallAnglesAreTheSameToTheLastBit) {
  Draw draw(605, 0);
  for (int i = 0; i < 20000; ++i) {
    P x(draw.sign() * draw.power_of_ten(-320.0, 0.0));
    if (i % 3 == 0) x = P(draw.uniform(-1.0, 1.0));
    if (i % 7 == 0) x.lanes[1] = draw.uniform(-7.0, 7.0);
    if (i % 1000 == 0) x.lanes[0] = i % 2000 == 0 ? -0.0 : not_a_number;
    const auto small = sincos_of_small(x), any = sincos(x);
    for (std::size_t lane = 0; lane < P::width; ++lane) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(small.sin.lanes[lane]),
                std::bit_cast<std::uint64_t>(any.sin.lanes[lane]));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(small.cos.lanes[lane]),
                std::bit_cast<std::uint64_t>(any.cos.lanes[lane]));
    }
  }
}

TEST(PackFunctions, AnglesAreRightToTheLastPlace) {
  Draw draw(602, 0);
  Worst worst;
  for (int i = 0; i < 40000; ++i) {
    double x = draw.normal(), y = draw.normal();
    if (i % 3 == 0) y *= draw.power_of_ten(-40.0, 40.0);
    if (i % 5 == 0) y = x * draw.sign() * (0.25 + 1e-3 * draw.normal());  // where reductions meet
    if (i % 7 == 0) x = y * draw.sign() * (0.71875 + 1e-3 * draw.normal());
    if (i % 11 == 0) x = y * draw.sign() * (1.0 + 1e-15 * draw.normal());
    worst.add(units(angle_of(y, x), atan2(Wide(y), Wide(x))));
  }
  EXPECT_LE(worst.value(), budget::pack_atan2_ulp);
}

TEST(PackFunctions, ExponentialsLogarithmsAndSmallAngles) {
  Draw draw(604, 0);
  Worst exponential, logarithm, small;
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? draw.uniform(-700.0, 0.0) : -draw.power_of_ten(-20.0, 1.0);
    exponential.add(units(exp_of_negative(P(x)).lanes[0], exp(Wide(x))));
    const double y = i % 2 == 0 ? draw.power_of_ten(-300.0, 300.0) : draw.uniform(0.5, 2.0);
    const double size = std::abs(std::log(y));
    logarithm.add(std::abs(static_cast<double>(Wide(log_of(P(y)).lanes[0] - log(Wide(y))))) /
                  (size > 1.0 ? size : 1.0));
    const double t = draw.uniform(-0.25, 0.25);
    small.add(units(small_atan(P(t)).lanes[0], atan(Wide(t))));
  }
  EXPECT_LE(exponential.value(), budget::pack_exp_ulp);
  EXPECT_LE(logarithm.value(), budget::pack_log);
  EXPECT_LE(small.value(), budget::pack_small_atan_ulp);
  EXPECT_EQ(exp_of_negative(P(0.0)).lanes[0], 1.0);
  EXPECT_EQ(exp_of_negative(P(-1e300)).lanes[0], exp_of_negative(P(-700.0)).lanes[0]);
  EXPECT_EQ(log_of(P(1.0)).lanes[0], 0.0);
}

TEST(PackFunctions, OddArgumentsAreThoseOfTheCLibrary) {
  std::vector<double> odd{0.0, 5e-324, 1e-310, 1e-200, 1e200, 1e308, infinite, not_a_number, 2.0};
  for (std::size_t i = 0, n = odd.size(); i < n; ++i) odd.push_back(-odd[i]);
  const auto expect_same = [](double got, double expected) {
    if (std::isnan(expected))
      EXPECT_TRUE(std::isnan(got));
    else
      EXPECT_EQ(std::pair(got, std::signbit(got)), std::pair(expected, std::signbit(expected)));
  };
  for (const double y : odd)
    for (const double x : odd)
      if (std::abs(y) != 2.0 || std::abs(x) != 2.0) expect_same(angle_of(y, x), std::atan2(y, x));
  for (const double x : odd)
    if (!(std::abs(x) > 1.0 && std::abs(x) < 1e6)) {
      expect_same(sin(P(x)).lanes[0], x == 0.0 ? 0.0 : std::sin(x));  // of -0 too
      expect_same(cos(P(x)).lanes[0], std::cos(x));
    }
}

// An odd one leaves its neighbour alone.
TEST(PackFunctions, LanesDoNotKnowEachOther) {
  Draw draw(603, 0);
  for (int i = 0; i < 200; ++i) {
    const double a = draw.normal(), b = draw.normal();
    for (const double odd : {0.0, 1e7, 1e300, not_a_number}) {
      P y(b), x(a);
      y.lanes[1] = odd;
      x.lanes[1] = i % 2 == 0 ? odd : -1e-300;
      EXPECT_EQ(atan2(y, x).lanes[0], angle_of(b, a));
      EXPECT_EQ(sin(y).lanes[0], sin(P(b)).lanes[0]);
      EXPECT_EQ(cos(y).lanes[0], cos(P(b)).lanes[0]);
    }
  }
}

}  // namespace
