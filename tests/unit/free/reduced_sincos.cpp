// SPDX-License-Identifier: MIT
#include "polhode/free/detail/reduced_sincos.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "budgets.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/math/double_double.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::Worst;

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
