// SPDX-License-Identifier: MIT
#include "polhode/math/dual.hpp"

#include <gtest/gtest.h>

#include "budgets.hpp"
#include "polhode/math/double_double.hpp"
#include "unit/math/exact.hpp"

namespace polhode::test {
namespace {

template <class T>
class Derivatives : public ::testing::Test {
 protected:
  using D = Dual<T, 2>;
  // f as a Dual against a difference of f at 70 digits, over x, y in the given ranges.
  template <class Function>
  void check(const char* name, const Function& f, double lo, double hi) {
    oracle::Draw draw(31, 0);
    const Exact h = 1e-25;
    for (int i = 0; i < 50; ++i) {
      const double x = draw.uniform(lo, hi), y = draw.uniform(lo, hi);
      const D got = f(D::variable(T(x), 0), D::variable(T(y), 1));
      const Exact a = x, b = y;
      const Exact by_x = (f(Exact(a + h), b) - f(Exact(a - h), b)) / (2 * h);
      const Exact by_y = (f(a, Exact(b + h)) - f(a, Exact(b - h))) / (2 * h);
      EXPECT_EQ(got.value, f(T(x), T(y))) << name;
      EXPECT_LE(error_units(got.derivative[0], by_x), budget::dual_derivative) << name << ' ' << x;
      EXPECT_LE(error_units(got.derivative[1], by_y), budget::dual_derivative) << name << ' ' << y;
    }
  }
};
using Reals = ::testing::Types<double, DoubleDouble>;
TYPED_TEST_SUITE(Derivatives, Reals);

TYPED_TEST(Derivatives, Arithmetic) {
  this->check(
      "sum", [](const auto& x, const auto& y) { return x * (2.0 * y - 3) + (1 - x); }, 1.0, 2.0);
  this->check(
      "product", [](const auto& x, const auto& y) { return 3.0 * x * y * x; }, 1.0, 2.0);
  this->check(
      "quotient", [](const auto& x, const auto& y) { return x / y - 2.0 / x - y / 4; }, 1.0, 2.0);
  this->check(
      "in place",
      [](auto x, const auto& y) {
        x += y;
        x *= y;
        x -= 1.0;
        x /= y;
        return x;
      },
      1.0, 2.0);
}

#define POLHODE_OF_X(function)       \
  [](const auto& x, const auto& y) { \
    using std::function;             \
    return function(x) + y;          \
  }
TYPED_TEST(Derivatives, ElementaryFunctions) {
  this->check("sqrt", POLHODE_OF_X(sqrt), 0.1, 5.0);
  this->check("exp", POLHODE_OF_X(exp), 0.1, 5.0);
  this->check("log", POLHODE_OF_X(log), 1.5, 5.0);
  this->check("sin", POLHODE_OF_X(sin), 0.1, 1.4);
  this->check("cos", POLHODE_OF_X(cos), 0.1, 1.4);
  this->check("tan", POLHODE_OF_X(tan), 0.1, 1.4);
  this->check("atan", POLHODE_OF_X(atan), 0.1, 5.0);
  this->check("asin", POLHODE_OF_X(asin), 0.1, 0.9);
  this->check("acos", POLHODE_OF_X(acos), 0.1, 0.9);
  this->check("sinh", POLHODE_OF_X(sinh), 0.1, 5.0);
  this->check("cosh", POLHODE_OF_X(cosh), 0.1, 5.0);
  this->check("tanh", POLHODE_OF_X(tanh), 0.1, 5.0);
  this->check("abs", POLHODE_OF_X(abs), 0.1, 5.0);
  this->check("abs of negative", POLHODE_OF_X(abs), -5.0, -0.1);
}

TYPED_TEST(Derivatives, TwoArguments) {
  this->check(
      "atan2",
      [](const auto& x, const auto& y) {
        using std::atan2;
        return atan2(x, y);
      },
      0.1, 3.0);
  this->check(
      "atan2 behind",
      [](const auto& x, const auto& y) {
        using std::atan2;
        return atan2(x, y);
      },
      -3.0, -0.1);
  this->check(
      "hypot",
      [](const auto& x, const auto& y) {
        using std::sqrt;
        if constexpr (requires { hypot(x, y); }) {
          return hypot(x, y);
        } else {
          return sqrt(x * x + y * y);
        }
      },
      0.1, 3.0);
}

TYPED_TEST(Derivatives, Expm1AndLog1p) {
  using T = TypeParam;
  using One = Dual<T, 1>;
  using std::exp;
  const T x(0.375);
  EXPECT_EQ(log1p(One::variable(x, 0)).derivative[0], T(1.0) / (T(1.0) + x));
  const double difference = to_double(expm1(One::variable(x, 0)).derivative[0] / exp(x) - T(1.0));
  EXPECT_LE(std::abs(difference), budget::dual_derivative * epsilon<T>());
}

// What a constant is at a branch point stays a constant; a variable has no derivative there.
TYPED_TEST(Derivatives, AtBranchPoints) {
  using T = TypeParam;
  using Number = typename TestFixture::D;
  const Number zero(T(0.0)), one(T(1.0));
  const Number x = Number::variable(T(0.0), 0);
  EXPECT_EQ(sqrt(zero).derivative[0], T(0.0));
  EXPECT_EQ(sqrt(x).derivative[0], T(HUGE_VAL));
  EXPECT_EQ(sqrt(x).derivative[1], T(0.0));
  EXPECT_EQ(hypot(zero, zero).derivative[0], T(0.0));
  EXPECT_EQ(atan2(zero, zero).derivative[1], T(0.0));
  EXPECT_TRUE(std::isnan(to_double(hypot(x, zero).derivative[0])));
  EXPECT_EQ(asin(one).derivative[0], T(0.0));
  EXPECT_EQ(acos(-one).derivative[1], T(0.0));
  EXPECT_EQ(asin(Number::variable(T(1.0), 1)).derivative[1], T(HUGE_VAL));
  EXPECT_EQ(abs(x).derivative[0], T(1.0));
  EXPECT_EQ(floor(Number::variable(T(2.5), 0)).value, T(2.0));
  EXPECT_EQ(floor(Number::variable(T(2.5), 0)).derivative[0], T(0.0));
  EXPECT_EQ(round(Number::variable(T(2.5), 0)).value, T(3.0));
  EXPECT_EQ(rint(Number::variable(T(2.5), 0)).value, T(2.0));
  EXPECT_EQ(rint(Number::variable(T(2.5), 0)).derivative[0], T(0.0));
}

TYPED_TEST(Derivatives, OrderLooksAtTheValue) {
  using T = TypeParam;
  using Number = typename TestFixture::D;
  const Number a = Number::variable(T(1.0), 0), b = Number::variable(T(1.0), 1);
  EXPECT_TRUE(a == b && a <= b && a >= b && a < 2.0 && a > 0.5 && a != 3.0);
  EXPECT_EQ(to_double(a), 1.0);
  EXPECT_EQ(epsilon<Number>(), epsilon<T>());
  EXPECT_EQ(pi<Number>().value, pi<T>());
  EXPECT_TRUE(isfinite(a) && !isnan(a) && signbit(-a));
  EXPECT_EQ(copysign(a, -b).derivative[0], T(-1.0));
  EXPECT_EQ(ldexp(a, 2).derivative[0], T(4.0));
}

TEST(Derivatives, OfDerivatives) {
  using Inner = Dual<double, 1>;
  using Outer = Dual<Inner, 1>;
  const Outer x = Outer::variable(Inner::variable(2.0, 0), 0);
  const Outer y = x * x * x + 1.0 / x;
  EXPECT_EQ(y.value.value, 8.5);
  EXPECT_EQ(y.derivative[0].value, 11.75);
  EXPECT_EQ(y.derivative[0].derivative[0], 12.25);
  EXPECT_EQ(derivative_order<Outer>, 2U);
}

}  // namespace
}  // namespace polhode::test
