// SPDX-License-Identifier: MIT
// What kernels ask of numbers and of packs of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "lanes.hpp"
#include "oracle/wide_real.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/real.hpp"
#include "unit/math/exact.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using Pack = Lanes<double, 3>;

static_assert(Number<double> && Real<double>);
static_assert(Number<DoubleDouble> && Number<Dual<double, 2>>);
static_assert(Number<Pack> && !Real<Pack>);
static_assert(std::same_as<Mask<double>, bool>);
static_assert(std::same_as<Mask<Pack>, LaneMask<3>>);

Pack pack(double a, double b, double c) {
  Pack p;
  p.lane = {a, b, c};
  return p;
}

TEST(Number, ScalarsSelectByBool) {
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(false, Vec3{1.0, 2.0, 3.0}, Vec3{}), Vec3{});
  EXPECT_TRUE(any(true) && all(true));
  EXPECT_EQ(any(false) || all(false), false);
}

TEST(Number, PacksSelectLaneByLane) {
  const Pack a = pack(1.0, 5.0, 3.0), b = pack(2.0, 4.0, 3.0);
  const Pack less = select(a < b, a, b);
  EXPECT_EQ(less.lane, (std::array<double, 3>{1.0, 4.0, 3.0}));
  EXPECT_TRUE(any(a < b));
  EXPECT_EQ(all(a < b), false);
  const BasicVec3<Pack> v = select(a < b, BasicVec3<Pack>{a, a, a}, BasicVec3<Pack>{b, b, b});
  EXPECT_EQ(v.y.lane, less.lane);
}

// A side that no lane takes is not computed.
TEST(Number, WhereLeavesOutWhatNobodyTakes) {
  int first = 0, second = 0;
  const auto f = [&] { return ++first, pack(1.0, 1.0, 1.0); };
  const auto g = [&] { return ++second, pack(2.0, 2.0, 2.0); };
  const Pack zero = pack(0.0, 0.0, 0.0), mixed = pack(-1.0, 0.0, 1.0);
  EXPECT_EQ(where(zero < zero, f, g).lane[0], 2.0);
  EXPECT_EQ(first, 0);
  EXPECT_EQ(where(zero == zero, f, g).lane[0], 1.0);
  EXPECT_EQ(second, 1);
  EXPECT_EQ(where(mixed < zero, f, g).lane, (std::array<double, 3>{1.0, 2.0, 2.0}));
  EXPECT_EQ(where(
                true, [] { return 1.0; }, [] { return 2.0; }),
            1.0);
}

TEST(Number, EachLaneGoesAlone) {
  const Pack sum =
      each_lane([](double x, double y) { return x + y; }, pack(1.0, 2.0, 3.0), pack(4.0, 5.0, 6.0));
  EXPECT_EQ(sum.lane, (std::array<double, 3>{5.0, 7.0, 9.0}));
}

// Angles beyond the reduction in 32 digits keep those of double: no table is read past its end.

TEST(DoubleDouble, SinesOfLargeAnglesHaveTheDigitsOfDouble) {
  for (const double size : {1.1e10, 1e15, 1e17, 1e100, 1e300, std::numeric_limits<double>::max()})
    for (const double x : {size, -size}) {
      const SinCos<DoubleDouble> r = sincos(DoubleDouble(x));
      EXPECT_EQ(r.sin.hi, std::sin(x)) << x;
      EXPECT_EQ(r.cos.hi, std::cos(x)) << x;
    }
}

TEST(DoubleDouble, TheLowPartOfALargeAngleCounts) {
  const DoubleDouble x{1e17, 5.0};  // half an ulp of 1e17 is 8
  const SinCos<DoubleDouble> r = sincos(x);
  EXPECT_NEAR(r.sin.hi, std::sin(1e17) * std::cos(5.0) + std::cos(1e17) * std::sin(5.0),
              budget::large_angle);
  EXPECT_NEAR(r.cos.hi, std::cos(1e17) * std::cos(5.0) - std::sin(1e17) * std::sin(5.0),
              budget::large_angle);
}

double wild(oracle::Draw& draw) { return draw.sign() * draw.power_of_ten(-60.0, 60.0); }

// Neighbours in magnitude, where rounding errors are not zero.
double close_to(oracle::Draw& draw, double x) {
  return draw.sign() * x *
         std::ldexp(draw.uniform(1.0, 2.0), static_cast<int>(draw.index(60)) - 30);
}

TEST(ErrorFree, SumsAreExact) {
  oracle::Draw draw(11, 0);
  int inexact = 0;
  for (int i = 0; i < 2000; ++i) {
    const double a = wild(draw), b = close_to(draw, a);
    const TwoTerms<double> s = two_sum(a, b);
    EXPECT_EQ(s.hi, a + b);
    EXPECT_EQ(exact(s.hi) + exact(s.lo), exact(a) + exact(b)) << a << ' ' << b;
    const TwoTerms<double> q =
        std::abs(a) < std::abs(b) ? quick_two_sum(b, a) : quick_two_sum(a, b);
    EXPECT_EQ(q.hi, s.hi);
    EXPECT_EQ(q.lo, s.lo) << a << ' ' << b;
    inexact += s.lo != 0.0;
  }
  EXPECT_GT(inexact, 1000);
}

TEST(ErrorFree, ProductsAreExactAndTheSameWithAndWithoutFma) {
  oracle::Draw draw(12, 0);
  for (int i = 0; i < 2000; ++i) {
    const double a = wild(draw), b = wild(draw);
    const TwoTerms<double> p = two_prod(a, b);
    EXPECT_EQ(p.hi, a * b);
    EXPECT_EQ(exact(p.hi) + exact(p.lo), exact(a) * exact(b)) << a << ' ' << b;
    const TwoTerms<double> f = two_prod_fma(a, b);
    EXPECT_EQ(f.hi, p.hi);
    EXPECT_EQ(f.lo, p.lo) << a << ' ' << b;
  }
}

TEST(ErrorFree, PartsHaveHalfTheBits) {
  oracle::Draw draw(13, 0);
  for (int i = 0; i < 500; ++i) {
    const double a = wild(draw);
    const TwoTerms<double> s = split(a);
    EXPECT_EQ(s.hi + s.lo, a);
    EXPECT_EQ(exact(s.hi) * exact(s.hi), exact(s.hi * s.hi));
    EXPECT_EQ(exact(s.lo) * exact(s.lo), exact(s.lo * s.lo));
    EXPECT_EQ(exact(s.hi) * exact(s.lo), exact(s.hi * s.lo));
  }
}

// The accumulator of the tests' errors sees a NaN wherever it comes, and an empty loop.

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
