// SPDX-License-Identifier: MIT
#include "polhode/detail/math/wide_range.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "budgets.hpp"
#include "oracle/random_draw.hpp"

namespace polhode::test {
namespace {

using Wide = WideRange<double>;

// Where double holds every step, the bits are those of double.
TEST(WideRangeNumber, BitsOfDouble) {
  oracle::Draw draw(301, 0);
  for (int i = 0; i < 2000; ++i) {
    const double a = draw.power_of_ten(-140, 140) * draw.sign();
    const double b =
        draw.chance(0.5) ? draw.power_of_ten(-140, 140) * draw.sign() : a * draw.uniform(-2.0, 2.0);
    EXPECT_EQ((Wide(a) + Wide(b)).narrow(), a + b);
    EXPECT_EQ((Wide(a) - Wide(b)).narrow(), a - b);
    EXPECT_EQ((Wide(a) * Wide(b)).narrow(), a * b);
    EXPECT_EQ((Wide(a) / Wide(b)).narrow(), a / b);
    EXPECT_EQ(sqrt(Wide(std::abs(a))).narrow(), std::sqrt(std::abs(a)));
    EXPECT_EQ(Wide(a) < Wide(b), a < b);
    EXPECT_EQ(Wide(a) <= Wide(b), a <= b);
    EXPECT_EQ(Wide(a) == Wide(a), true);
    EXPECT_EQ(abs(Wide(a)).narrow(), std::abs(a));
    EXPECT_EQ(ldexp(Wide(a), 40).narrow(), std::ldexp(a, 40));
    EXPECT_EQ(Wide(a).binary_exponent(), std::ilogb(a) + 1);
  }
}

TEST(WideRangeNumber, BeyondDouble) {
  const Wide huge = Wide(3e300) * Wide(5e300) * Wide(7e200), one(1.0);
  EXPECT_EQ(to_double(huge), HUGE_VAL);
  EXPECT_EQ(to_double(one / huge), 0.0);
  EXPECT_EQ((huge / Wide(3e300) / Wide(5e300)).narrow(), 7e200);
  EXPECT_TRUE(one < huge && -huge < one && one / huge > Wide(0.0));
  EXPECT_EQ((huge - huge).narrow(), 0.0);
  EXPECT_EQ((huge + one - huge).narrow(), 0.0);
  const Wide root = sqrt(huge);
  EXPECT_NEAR((root * root / huge).narrow(), 1.0, budget::wide_range);
  EXPECT_NEAR(log(huge).narrow(), std::log(105.0) + 800.0 * std::log(10.0),
              800.0 * budget::wide_range);
  EXPECT_EQ(log1p(one / huge), one / huge);
  EXPECT_EQ(atan(huge).narrow(), std::atan(HUGE_VAL));
  EXPECT_EQ(ldexp(ldexp(huge, 3000), -3000), huge);
  // A subnormal number comes in and goes out exactly.
  EXPECT_EQ((Wide(5e-324) * Wide(0.5) * Wide(2.0)).narrow(), 5e-324);
}

TEST(WideRangeNumber, EveryQuadrant) {
  const std::array<double, 9> sizes{0.0, 1e-300, 1e-100, 1e-80, 1.0, 1.5, 1e80, 1e100, 1e300};
  for (const double y : sizes) {
    for (const double x : sizes) {
      for (const double sy : {1.0, -1.0}) {
        for (const double sx : {1.0, -1.0}) {
          if (y == 0.0 && x == 0.0) continue;
          const double want = std::atan2(sy * y + 0.0, sx * x + 0.0);
          const double got = to_double(atan2(Wide(sy * y + 0.0), Wide(sx * x + 0.0)));
          EXPECT_NEAR(got, want, std::abs(want) * budget::wide_range) << sy * y << " " << sx * x;
        }
      }
    }
  }
}

TEST(WideRangeNumber, NotFinite) {
  const Wide infinity(HUGE_VAL), zero(0.0), one(1e200), nan(std::nan(""));
  EXPECT_EQ((infinity + one).narrow(), HUGE_VAL);
  EXPECT_EQ((one + infinity).narrow(), HUGE_VAL);
  EXPECT_EQ((one / zero).narrow(), HUGE_VAL);
  EXPECT_EQ((one / infinity).narrow(), 0.0);
  EXPECT_EQ((zero + one).narrow(), 1e200);
  EXPECT_TRUE(isnan(infinity - infinity) && isnan(nan + one) && isnan(one + nan));
  EXPECT_TRUE(isnan(sqrt(-one)) && isnan(log(-one)));
  const bool ordered = nan < one || one < nan || nan == nan;
  EXPECT_FALSE(ordered);
  EXPECT_TRUE(isfinite(one) && !isfinite(infinity) && signbit(-one));
}

TEST(WideRangeNumber, OfDoubleDoubleAndDual) {
  using DD = WideRange<DoubleDouble>;
  const DoubleDouble third = DoubleDouble(1.0) / 3.0;
  EXPECT_EQ((DD(third) * DD(1e300) * DD(1e300) / DD(1e300) / DD(1e300)).narrow().hi, third.hi);
  using D = Dual<double, 1>;
  const D x = D::variable(1e-200, 0);
  const auto cube = widened(x) * widened(x) * widened(x);
  const auto back = cube / widened(x) / widened(x);
  EXPECT_NEAR(Widening<D>::narrowed(back).derivative[0], 1.0, 2.0 * budget::wide_range);
  EXPECT_EQ(Widening<D>::narrowed(cube).value, 0.0);
}

}  // namespace
}  // namespace polhode::test
