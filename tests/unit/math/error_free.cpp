// SPDX-License-Identifier: MIT
#include "polhode/math/error_free.hpp"

#include <gtest/gtest.h>

#include "unit/math/exact.hpp"

namespace polhode::test {
namespace {

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

}  // namespace
}  // namespace polhode::test
