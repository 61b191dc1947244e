// SPDX-License-Identifier: MIT
#include "polhode/math/double_double.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "budgets.hpp"
#include "polhode/math/dual.hpp"
#include "unit/math/exact.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

static_assert(Real<double>);
static_assert(Real<DoubleDouble>);
static_assert(Real<Dual<double, 3>>);
static_assert(Real<Dual<DoubleDouble, 6>>);
static_assert(Real<Dual<Dual<double, 2>, 2>>);
static_assert(DoubleDouble(1.0) / 3.0 * 3.0 == 1.0, "arithmetic is constexpr");
static_assert(std::numeric_limits<DoubleDouble>::epsilon() == 0x1p-104);

const double inf = std::numeric_limits<double>::infinity();
const double nan = std::numeric_limits<double>::quiet_NaN();

using Sampled = std::function<DoubleDouble(oracle::Draw&)>;

// The function named Function over 2000 arguments.
#define POLHODE_WORST(Function, sampled)                                \
  [](const Sampled& argument) {                                         \
    oracle::Draw draw(21, 0);                                           \
    Worst largest;                                                      \
    for (int i = 0; i < 2000; ++i) {                                    \
      const DoubleDouble x = argument(draw);                            \
      largest.add(error_units(Function(x), Exact(Function(exact(x))))); \
    }                                                                   \
    return largest.value();                                             \
  }(sampled)

Sampled powers(double lo, double hi) {
  return [lo, hi](oracle::Draw& draw) { return drawn(draw, lo, hi); };
}
Sampled positive(double lo, double hi) {
  return [lo, hi](oracle::Draw& draw) { return abs(drawn(draw, lo, hi)); };
}
Sampled between(double lo, double hi) {
  return [lo, hi](oracle::Draw& draw) {
    return DoubleDouble::sum(draw.uniform(lo, hi), std::ldexp(draw.uniform(-1.0, 1.0), -60));
  };
}

TEST(DoubleDouble, ArithmeticToTheLastDigits) {
  oracle::Draw draw(22, 0);
  Worst worst;
  for (int i = 0; i < 5000; ++i) {
    const DoubleDouble a = drawn(draw, -40.0, 40.0);
    // Every third pair cancels in the sum.
    const DoubleDouble b =
        i % 3 == 0 ? -a * (1.0 + drawn(draw, -25.0, 0.0)) : drawn(draw, -40.0, 40.0);
    const Exact x = exact(a), y = exact(b), z = exact(b.hi);
    worst.add(larger(error_units(a + b, x + y), error_units(a - b, x - y),
                     error_units(a * b, x * y), error_units(a / b, x / y)));
    worst.add(larger(error_units(a + b.hi, x + z), error_units(b.hi - a, z - x),
                     error_units(a * b.hi, x * z), error_units(a / b.hi, x / z)));
    worst.add(error_units(sqrt(abs(a)), Exact(sqrt(abs(x)))));
    worst.add(error_units(hypot(a, b), Exact(sqrt(x * x + y * y))));
    EXPECT_EQ(exact(DoubleDouble::sum(a.hi, b.hi)), exact(a.hi) + exact(b.hi));
    EXPECT_EQ(exact(DoubleDouble::product(a.hi, b.hi)), exact(a.hi) * exact(b.hi));
    const DoubleDouble c = a + b;
    EXPECT_EQ(c.hi, c.hi + c.lo) << "not normalised";
  }
  EXPECT_LE(worst.value(), budget::double_double_arithmetic);
}

TEST(DoubleDouble, ElementaryFunctions) {
  using boost::math::expm1;
  using boost::math::log1p;
  Worst worst;
  const auto add = [&](const char* name, double error) {
    EXPECT_LE(error, budget::double_double_functions) << name;
    worst.add(error);
  };
  add("exp", POLHODE_WORST(exp, between(-600.0, 700.0)));
  add("exp small", POLHODE_WORST(exp, powers(-30.0, 0.0)));
  add("expm1 small", POLHODE_WORST(expm1, powers(-30.0, 0.0)));
  add("expm1", POLHODE_WORST(expm1, between(-100.0, 100.0)));
  add("log", POLHODE_WORST(log, positive(-250.0, 250.0)));
  add("log near 1", POLHODE_WORST(log, between(0.4, 2.5)));
  add("log nearer 1", POLHODE_WORST(log, between(1.0 - 1e-9, 1.0 + 1e-9)));
  add("log1p", POLHODE_WORST(log1p, positive(-30.0, 30.0)));
  add("log1p negative", POLHODE_WORST(log1p, between(-0.999, 0.1)));
  add("sin", POLHODE_WORST(sin, powers(-30.0, 3.0)));
  add("sin to 1e10", POLHODE_WORST(sin, powers(3.0, 10.0)));
  add("cos", POLHODE_WORST(cos, powers(-3.0, 10.0)));
  add("tan", POLHODE_WORST(tan, powers(-10.0, 3.0)));
  add("atan", POLHODE_WORST(atan, powers(-30.0, 30.0)));
  add("asin", POLHODE_WORST(asin, between(-1.0, 1.0)));
  add("asin small", POLHODE_WORST(asin, powers(-30.0, -0.1)));
  add("acos", POLHODE_WORST(acos, between(-1.0, 1.0)));
  add("acos near 1", POLHODE_WORST(acos, between(1.0 - 1e-9, 1.0)));
  add("sinh", POLHODE_WORST(sinh, powers(-30.0, 2.8)));
  add("cosh", POLHODE_WORST(cosh, powers(-3.0, 2.8)));
  add("tanh", POLHODE_WORST(tanh, powers(-30.0, 2.0)));
}

TEST(DoubleDouble, ArcTangentOfTwo) {
  oracle::Draw draw(23, 0);
  Worst worst;
  for (int i = 0; i < 2000; ++i) {
    const DoubleDouble y = drawn(draw, -60.0, 60.0), x = drawn(draw, -60.0, 60.0);
    worst.add(error_units(atan2(y, x), Exact(atan2(exact(y), exact(x)))));
    const DoubleDouble near = x * (1.0 + drawn(draw, -30.0, 0.0));
    worst.add(error_units(atan2(near, x), Exact(atan2(exact(near), exact(x)))));
  }
  EXPECT_LE(worst.value(), budget::double_double_functions);
}

TEST(DoubleDouble, ZerosOfSineAndCosine) {
  for (const double k : {1.0, 2.0, 113.0, 1e6}) {
    const DoubleDouble x = k * DoubleDouble::half_pi();
    for (const DoubleDouble& y : {x, DoubleDouble(x.hi)}) {
      EXPECT_LE(error_units(sin(y), Exact(sin(exact(y)))), budget::double_double_functions) << k;
      EXPECT_LE(error_units(cos(y), Exact(cos(exact(y)))), budget::double_double_functions) << k;
    }
  }
}

TEST(DoubleDouble, Constants) {
  const Exact pi_exact = boost::math::constants::pi<Exact>();
  const double half = budget::double_double_constant;
  EXPECT_LE(error_units(DoubleDouble::pi(), pi_exact), half);
  EXPECT_LE(error_units(DoubleDouble::two_pi(), Exact(2 * pi_exact)), half);
  EXPECT_LE(error_units(DoubleDouble::half_pi(), Exact(pi_exact / 2)), half);
  EXPECT_EQ(pi<DoubleDouble>(), DoubleDouble::pi());
  EXPECT_EQ(epsilon<DoubleDouble>(), 0x1p-104);
  EXPECT_EQ(to_double(DoubleDouble::pi()), pi<double>());
}

TEST(DoubleDouble, WholeNumbers) {
  EXPECT_EQ(floor(DoubleDouble(3.0, -1e-20)), 2.0);
  EXPECT_EQ(floor(DoubleDouble(3.0, 1e-20)), 3.0);
  EXPECT_EQ(floor(DoubleDouble(-2.5)), -3.0);
  EXPECT_EQ(ceil(DoubleDouble(3.0, 1e-20)), 4.0);
  EXPECT_EQ(round(DoubleDouble(2.5)), 3.0);
  EXPECT_EQ(round(DoubleDouble(-2.5)), -3.0);
  EXPECT_EQ(round(DoubleDouble(2.5, -1e-20)), 2.0);
  EXPECT_EQ(round(DoubleDouble(0.5, -0x1p-110)), 0.0);
  EXPECT_EQ(round(DoubleDouble(0x1p60, 0.75)), DoubleDouble(0x1p60, 1.0));
  EXPECT_EQ(floor(DoubleDouble(0x1p60, -0.25)), DoubleDouble(0x1p60, -1.0));
  EXPECT_EQ(ldexp(DoubleDouble(1.0, 1e-20), 3), DoubleDouble(8.0, 8e-20));
}

TEST(DoubleDouble, NearestWholeNumber) {
  const double tiny = 0x1p-60;
  EXPECT_EQ(rint(DoubleDouble(2.5)), 2.0);
  EXPECT_EQ(rint(DoubleDouble(3.5)), 4.0);
  EXPECT_EQ(rint(DoubleDouble(2.5, tiny)), 3.0);
  EXPECT_EQ(rint(DoubleDouble(3.5, -tiny)), 3.0);
  EXPECT_EQ(rint(DoubleDouble(-2.5, -tiny)), -3.0);
  EXPECT_EQ(rint(DoubleDouble(2.25, tiny)), 2.0);
  EXPECT_EQ(rint(DoubleDouble(3.0, -tiny)), 3.0);
  EXPECT_EQ(rint(DoubleDouble(0x1p60, 0.75)), DoubleDouble(0x1p60, 1.0));
  EXPECT_EQ(rint(DoubleDouble(-inf)), -inf);
  EXPECT_TRUE(isnan(rint(DoubleDouble(nan))));
}

TEST(DoubleDouble, Order) {
  const DoubleDouble a(1.0), b(1.0, 1e-20), c(nan);
  EXPECT_TRUE(a < b && b > a && a <= b && b >= a && a != b && a <= 1.0 && a >= 1.0);
  EXPECT_EQ(b < a || b <= a || a > b || a >= b || a == b, false);
  EXPECT_EQ(c < a || c > a || c <= a || c >= a || c == c, false);
  EXPECT_EQ(abs(DoubleDouble(-1.0, 1e-20)), DoubleDouble(1.0, -1e-20));
  EXPECT_EQ(copysign(b, DoubleDouble(-0.0)), -b);
  EXPECT_EQ(static_cast<double>(b), 1.0);
}

void expect_value(DoubleDouble got, double hi) {
  EXPECT_EQ(got.hi, hi);
  EXPECT_EQ(std::signbit(got.hi), std::signbit(hi));
  EXPECT_EQ(got.lo, 0.0);
}
void expect_nan(DoubleDouble got) { EXPECT_TRUE(isnan(got) && !isfinite(got)); }

TEST(DoubleDouble, InfinityAndZero) {
  const DoubleDouble zero(0.0), minus_zero(-0.0), one(1.0), infinity(inf), minus(-inf);
  expect_value(infinity + one, inf);
  expect_value(one - infinity, -inf);
  expect_value(infinity * 2.0, inf);
  expect_value(minus * infinity, -inf);
  expect_value(DoubleDouble(1e308) * 10.0, inf);
  expect_value(one / zero, inf);
  expect_value(one / minus_zero, -inf);
  expect_value(one / infinity, 0.0);
  expect_value(minus_zero * 2.0, -0.0);
  expect_value(zero / -3.0, -0.0);
  expect_value(sqrt(zero), 0.0);
  expect_value(sqrt(minus_zero), -0.0);
  expect_value(sqrt(infinity), inf);
  expect_value(hypot(zero, zero), 0.0);
  expect_value(hypot(one, minus), inf);
  expect_value(exp(infinity), inf);
  expect_value(exp(DoubleDouble(710.0)), inf);
  expect_value(exp(minus), 0.0);
  expect_value(expm1(minus), -1.0);
  expect_value(expm1(minus_zero), -0.0);
  expect_value(log(zero), -inf);
  expect_value(log(infinity), inf);
  expect_value(log1p(-one), -inf);
  expect_value(log1p(minus_zero), -0.0);
  expect_value(sin(minus_zero), -0.0);
  expect_value(cos(zero), 1.0);
  expect_value(tanh(infinity), 1.0);
  expect_value(sinh(minus), -inf);
  expect_value(cosh(minus), inf);
  expect_nan(infinity - infinity);
  expect_nan(zero * infinity);
  expect_nan(zero / zero);
  expect_nan(sqrt(-one));
  expect_nan(log(-one));
  expect_nan(sin(infinity));
  expect_nan(asin(DoubleDouble(1.5)));
  const DoubleDouble none(nan);
  for (const DoubleDouble& y : {exp(none),   expm1(none), log(none),
                                log1p(none), sin(none),   cos(none),
                                tan(none),   atan(none),  asin(none),
                                acos(none),  sinh(none),  cosh(none),
                                tanh(none),  sqrt(none),  abs(none),
                                floor(none), round(none), hypot(none, DoubleDouble(1.0)),
                                none + 1.0,  none * 2.0}) {
    expect_nan(y);
  }
}

TEST(DoubleDouble, QuadrantsOfTheArcTangent) {
  const DoubleDouble zero(0.0), minus_zero(-0.0), one(1.0), infinity(inf);
  const DoubleDouble pi = DoubleDouble::pi();
  expect_value(atan2(zero, one), 0.0);
  expect_value(atan2(minus_zero, one), -0.0);
  expect_value(atan2(zero, zero), 0.0);
  EXPECT_EQ(atan2(zero, -one), pi);
  EXPECT_EQ(atan2(minus_zero, -one), -pi);
  EXPECT_EQ(atan2(minus_zero, minus_zero), -pi);
  EXPECT_EQ(atan2(one, zero), ldexp(pi, -1));
  EXPECT_EQ(atan2(-one, zero), -ldexp(pi, -1));
  EXPECT_EQ(atan(infinity), ldexp(pi, -1));
  EXPECT_EQ(atan2(infinity, -infinity), pi * 0.75);
  EXPECT_EQ(atan2(one, infinity), 0.0);
  EXPECT_EQ(atan2(one, -infinity), pi);
  EXPECT_EQ(acos(-one), pi);
  expect_nan(atan2(one, DoubleDouble(nan)));
  expect_nan(atan2(DoubleDouble(nan), one));
}

}  // namespace
}  // namespace polhode::test
