// SPDX-License-Identifier: MIT
// G^2 - 2 T I2 against 4096-bit arithmetic: where everything cancels, and at the ends of double
// range.
#include "polhode/free/detail/separatrix_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <string>

#include "budgets.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/free/detail/reduced_sincos.hpp"
#include "polhode/math/double_double.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using oracle::Draw;
using polhode::detail::exact_separatrix_distance;
using polhode::detail::FloatingDoubleDouble;
using polhode::test::larger;
using polhode::test::Worst;

using Exact = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<1233>,
                                            boost::multiprecision::et_off>;

Exact exact_distance(const Vec3& I, double g1, double g3) {
  const Exact I1(I.x), I2(I.y), I3(I.z);
  const Exact plus = Exact(g3) * g3 * (I3 - I2) * I1, minus = Exact(g1) * g1 * (I2 - I1) * I3;
  return (plus - minus) / (I1 * I3);
}

// |got / exact - 1|; infinite for a zero or a sign that is wrong.
double relative_error(const FloatingDoubleDouble& got, const Exact& exact) {
  const Exact value = ldexp(Exact(got.mantissa.hi) + Exact(got.mantissa.lo), got.exponent);
  if (exact == 0 || value == 0) return exact == value ? 0.0 : HUGE_VAL;
  return std::abs(static_cast<double>(Exact(value / exact - 1)));
}

void expect_exact(const Vec3& I, double g1, double g3) {
  EXPECT_LE(relative_error(exact_separatrix_distance(I, g1, g3), exact_distance(I, g1, g3)),
            budget::separatrix_distance)
      << testing::PrintToString(std::array{I.x, I.y, I.z, g1, g3});
}

Vec3 moments(Draw& draw) {
  std::array<double, 3> mass{draw.uniform(0.02, 1.0), draw.uniform(0.02, 1.0),
                             draw.uniform(0.02, 1.0)};
  std::sort(mass.begin(), mass.end());
  return {mass[0] + mass[1], mass[0] + mass[2], mass[1] + mass[2]};
}

TEST(SeparatrixDistance, KeepsEveryDigitThatCancels) {
  for (unsigned i = 0; i < 2000; ++i) {
    Draw draw(11, i);
    const Vec3 I = moments(draw);
    const double g1 = draw.uniform(0.1, 1.0);
    double g3 = g1 * std::sqrt(I.z * (I.y - I.x) / (I.x * (I.z - I.y)));
    expect_exact(I, g1, g3);
    expect_exact(I, g1, std::nextafter(g3, 2.0 * g3));
    g3 = std::ldexp(g3, static_cast<int>(draw.index(5)) - 2);
    expect_exact(I, -g1, g3);
  }
}

TEST(SeparatrixDistance, HoldsOverTheWholeRangeOfDouble) {
  for (unsigned i = 0; i < 2000; ++i) {
    Draw draw(12, i);
    const Vec3 I = std::ldexp(1.0, static_cast<int>(draw.uniform(-1000, 1000))) * moments(draw);
    expect_exact(I, draw.power_of_ten(-307, 307), draw.power_of_ten(-307, 307));
    const double unit = draw.power_of_ten(-300, 300);
    expect_exact(I, unit * draw.uniform(-1.0, 1.0), unit * draw.uniform(-1.0, 1.0));
  }
}

TEST(SeparatrixDistance, HoldsForNeedlesAndNearlyEqualMoments) {
  for (unsigned i = 0; i < 2000; ++i) {
    Draw draw(13, i);
    const double thin = draw.power_of_ten(-300, -1);
    expect_exact({thin, 1.0, 1.0 + thin}, draw.normal(), draw.power_of_ten(-160, 0));
    expect_exact({thin, 1.0, 1.0}, draw.normal(), draw.normal());
    const double next = 1.0 + draw.power_of_ten(-16, -1);
    expect_exact({1.0, next, next + draw.power_of_ten(-16, -1)}, draw.normal(), draw.normal());
  }
}

TEST(SeparatrixDistance, IsZeroOnlyOnTheSeparatrix) {
  EXPECT_EQ(exact_separatrix_distance({3.0, 4.0, 6.0}, 0.3, -0.3).mantissa, DoubleDouble(0.0));
  EXPECT_EQ(exact_separatrix_distance({3.0, 4.0, 6.0}, 0x1p-1000, 0x1p-1000).mantissa,
            DoubleDouble(0.0));
  EXPECT_EQ(exact_separatrix_distance({1.0, 2.0, 3.0}, 0.0, 0.0).mantissa, DoubleDouble(0.0));
  const double next = std::nextafter(0.3, 1.0);
  EXPECT_GT(exact_separatrix_distance({3.0, 4.0, 6.0}, 0.3, next).mantissa, DoubleDouble(0.0));
  EXPECT_LT(exact_separatrix_distance({3.0, 4.0, 6.0}, next, 0.3).mantissa, DoubleDouble(0.0));
}

// I1 = 2^-500: the two large products are equal, and the difference is 2^-500 of either.
TEST(SeparatrixDistance, FindsWhatIsLeftOfTwoEqualProducts) {
  const double thin = 0x1p-500;
  expect_exact({thin, 1.0, 1.5}, 0x1p-250, std::sqrt(3.0));
  expect_exact({thin, 1.0, 1.25}, 0x1p-250, std::sqrt(5.0));
  expect_exact({thin, 1.0, 2.0}, 0x1p-250, 0x1.6a09e667f3bcdp0);
  expect_exact({thin, 2.0, 4.0}, 0x1p-250, 2.0);
}

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Errors {
  double absolute = 0.0;  // largest of sin and cos, in eps
  double relative = 0.0;
};

Errors errors_of(const TwoTerms<double>& a) {
  const SinCos<double> v = polhode::detail::reduced_sincos(a);
  const auto exact = sincos(DoubleDouble::sum(a.hi, a.lo));
  const double s = std::abs((exact.sin - v.sin).hi) / eps;
  const double c = std::abs((exact.cos - v.cos).hi) / eps;
  const double sin_size = std::abs(exact.sin.hi), cos_size = std::abs(exact.cos.hi);
  return {larger(s, c), larger(sin_size > 0.0 ? s / sin_size : s, c / cos_size)};
}

TEST(ReducedSincos, RandomAngles) {
  oracle::Draw draw(3, 0);
  Worst absolute, relative;
  for (int i = 0; i < 200000; ++i) {
    const double hi = draw.uniform(-4.0, 4.0);
    const Errors e = errors_of({hi, draw.uniform(-0.5, 0.5) * eps * std::abs(hi)});
    absolute.add(e.absolute);
    relative.add(e.relative);
  }
  EXPECT_LE(absolute.value(), budget::reduced_sincos_eps);
  EXPECT_LE(relative.value(), budget::reduced_sincos_relative_eps);
}

// Where one of the two is almost zero, its digits come from the low part of the angle. (Closer than
// 1e-16 the double-double value to compare with runs out of digits of pi.)
TEST(ReducedSincos, AtQuarterTurns) {
  for (int quarter = -2; quarter <= 2; ++quarter) {
    for (const double offset : {1e-16, -1e-16, 3e-16, -1e-13, 1e-10, -1e-5, 0.0625}) {
      const DoubleDouble a = DoubleDouble::pi() * (0.5 * quarter) + DoubleDouble(offset);
      EXPECT_LE(errors_of({a.hi, a.lo}).relative, budget::reduced_sincos_relative_eps)
          << quarter << " " << offset;
    }
  }
}

TEST(ReducedSincos, OctantBorders) {
  for (int odd = -5; odd <= 5; odd += 2) {
    const double border = odd * 0.7853981633974483;
    for (double a = border - 32 * eps; a <= border + 32 * eps; a = std::nextafter(a, 10.0))
      EXPECT_LE(errors_of({a, 0.0}).absolute, budget::reduced_sincos_eps) << a;
  }
}

TEST(ReducedSincos, ExactAtZero) {
  const SinCos<double> v = polhode::detail::reduced_sincos(TwoTerms<double>{0.0, 0.0});
  EXPECT_EQ(v.sin, 0.0);
  EXPECT_EQ(v.cos, 1.0);
}

TEST(ReducedSincos, NanStaysNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SinCos<double> v = polhode::detail::reduced_sincos(TwoTerms<double>{nan, 0.0});
  EXPECT_TRUE(std::isnan(v.sin));
  EXPECT_TRUE(std::isnan(v.cos));
}

}  // namespace
