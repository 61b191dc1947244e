// SPDX-License-Identifier: MIT
#include "polhode/elliptic/carlson.hpp"

#include <algorithm>

#include "budgets.hpp"
#include "unit/elliptic/support.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using polhode::test::larger;
using polhode::test::smaller;
template <class T>
class Carlson : public ::testing::Test {
 protected:
  void check(double x, double y, double z, double p) {
    const std::string where = listed(x, y, z, p);
    const T a(x), b(y), c(z), d(p);
    rf_.add(relative_error(elliptic::carlson_rf(a, b, c), exact_rf(x, y, z)), where);
    rc_.add(relative_error(elliptic::carlson_rc(a, d), exact_rc(x, p)), where);
    rd_.add(relative_error(elliptic::carlson_rd(a, b, d), exact_rd(x, y, p)), where);
    rj_.add(relative_error(elliptic::carlson_rj(a, b, c, d), exact_rj(x, y, z, p)), where);
  }
  void TearDown() override {
    rf_.expect_within(budget::elliptic_carlson, "RF");
    rc_.expect_within(budget::elliptic_carlson, "RC");
    rd_.expect_within(budget::elliptic_carlson, "RD");
    rj_.expect_within(budget::elliptic_carlson, "RJ");
  }
  WorstUnits<T> rf_, rc_, rd_, rj_;
};
TYPED_TEST_SUITE(Carlson, Real2);

TYPED_TEST(Carlson, Generic) {
  oracle::Draw draw(41, 0);
  for (int i = 0; i < 400; ++i) {
    this->check(drawn(draw, 0.0, 2.0), drawn(draw, 0.0, 2.0), drawn(draw, 0.0, 2.0),
                drawn(draw, 0.01, 2.0));
  }
}

// As they come from a rotation: RF(c^2, c^2 + m1 s^2, 1), RJ(c^2, c^2 + m1 s^2, 1, 1 + nu s^2).
TYPED_TEST(Carlson, FromRotations) {
  oracle::Draw draw(42, 0);
  for (int i = 0; i < 400; ++i) {
    const double s = drawn(draw, 0.0, 1.0);
    const double c2 = short_number(1.0 - s * s);
    const double m1 = drawn_power(draw, -30, 0);
    this->check(c2, short_number(c2 + m1 * s * s), 1.0,
                short_number(1.0 + drawn_power(draw, -12, 8) * s * s));
  }
}

TYPED_TEST(Carlson, EqualArguments) {
  oracle::Draw draw(43, 0);
  for (int i = 0; i < 60; ++i) {
    const double x = drawn(draw, 0.1, 3.0), y = drawn(draw, 0.1, 3.0), p = drawn(draw, 0.1, 3.0);
    this->check(x, x, y, p);
    this->check(x, y, y, p);
    this->check(x, y, p, x);
    this->check(x, x, y, x);
    this->check(x, x, x, p);
    this->check(x, x, x, x);
    this->check(x, std::nextafter(x, 0.0), y, std::nextafter(x, 9.0));
  }
}

TYPED_TEST(Carlson, ZeroArgument) {
  oracle::Draw draw(44, 0);
  for (int i = 0; i < 100; ++i) {
    this->check(0.0, drawn(draw, 0.01, 3.0), drawn(draw, 0.01, 3.0), drawn(draw, 0.01, 3.0));
    this->check(0.0, drawn_power(draw, -60, 0), 1.0, drawn_power(draw, -8, 8));
  }
}

TYPED_TEST(Carlson, ExtremeRatios) {
  oracle::Draw draw(45, 0);
  for (int i = 0; i < 200; ++i) {
    this->check(drawn_power(draw, -30, 30), drawn_power(draw, -30, 30), drawn_power(draw, -30, 30),
                drawn_power(draw, -30, 30));
  }
}

// Every exponent, mixed. Boost's RJ at 60 digits needs p next to the largest or above.
TYPED_TEST(Carlson, WholeRange) {
  using T = TypeParam;
  oracle::Draw draw(207, 0);
  const double end = -least_exponent<T>();
  const auto any = [&] { return drawn_power(draw, -end, end); };
  const auto add = [](WorstUnits<T>& worst, const T& got, const Exact& exact,
                      const std::string& at) {
    const double size = std::abs(exact.a);
    const bool held = std::is_same_v<T, double> ? size >= 0x1p-1022 && size < HUGE_VAL
                                                : size > 1e-230 && size < 1e280;
    if (held) worst.add(relative_error(got, exact), at);
  };
  for (int i = 0; i < 150; ++i) {
    const double x = any(), y = any(), z = any();
    const double p = short_number(larger(x, y, z) * drawn_power(draw, -1, 20));
    const std::string at = listed(x, y, z, p);
    add(this->rf_, elliptic::carlson_rf(T(x), T(y), T(z)), exact_rf(x, y, z), at);
    add(this->rc_, elliptic::carlson_rc(T(x), T(y)), exact_rc(x, y), at);
    add(this->rd_, elliptic::carlson_rd(T(x), T(y), T(z)), exact_rd(x, y, z), at);
    if (p < 1e290)
      add(this->rj_, elliptic::carlson_rj(T(x), T(y), T(z), T(p)), exact_rj(x, y, z, p), at);
  }
}

// Principal values. That of RJ has a zero: in DoubleDouble the error is relative to its terms.
TYPED_TEST(Carlson, PrincipalValues) {
  using T = TypeParam;
  oracle::Draw draw(208, 0);
  for (int i = 0; i < 150; ++i) {
    const double x = drawn_power(draw, -6, 6), y = drawn_power(draw, -6, 6),
                 z = drawn_power(draw, -6, 6), p = -drawn_power(draw, -6, 6);
    const std::string at = listed(x, y, z, p);
    this->rc_.add(relative_error(elliptic::carlson_rc(T(x), T(p)), exact_rc(x, p)), at);
    const Exact exact = exact_rj(x, y, z, p);
    const double error = absolute_error(elliptic::carlson_rj(T(x), T(y), T(z), T(p)), exact);
    const double middle = larger(smaller(x, y), smaller(larger(x, y), z));
    const double term = std::is_same_v<T, double> ? 0.0 : 3.0 * exact_rf(x, y, z).a / (middle - p);
    this->rj_.add(error / larger(std::abs(exact.a), term), at);
  }
}

TYPED_TEST(Carlson, Limits) {
  const TypeParam zero(0.0), one(1.0);
  EXPECT_TRUE(std::isinf(to_double(elliptic::carlson_rf(zero, zero, one))));
  EXPECT_TRUE(std::isinf(to_double(elliptic::carlson_rc(one, zero))));
  EXPECT_TRUE(std::isinf(to_double(elliptic::carlson_rd(one, one, zero))));
  EXPECT_TRUE(std::isinf(to_double(elliptic::carlson_rd(zero, zero, one))));
  EXPECT_TRUE(std::isinf(to_double(elliptic::carlson_rj(one, one, one, zero))));
  EXPECT_TRUE(std::isinf(to_double(elliptic::carlson_rj(zero, zero, one, one))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::carlson_rf(one, -one, one))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::carlson_rc(-one, one))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::carlson_rd(one, one, -one))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::carlson_rj(-one, one, one, one))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::carlson_rj(one, -one, one, -one))));
  // where p far above the others would be exchanged without an end
  const TypeParam far(-0x1p64), below(-10.5), above(0x1p18);
  EXPECT_TRUE(std::isnan(to_double(elliptic::carlson_rj(far, below, one, above))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::carlson_rf(one, zero / zero, one))));
}

// Derivatives by the duplication, against differences at 60 digits.
template <class T>
class CarlsonDerivative : public ::testing::Test {
 protected:
  using D = Dual<T, 4>;
  void check(double x, double y, double z, double p) {
    const D a = D::variable(T(x), 0), b = D::variable(T(y), 1), c = D::variable(T(z), 2),
            d = D::variable(T(p), 3);
    const D rf = elliptic::carlson_rf(a, b, c), rc = elliptic::carlson_rc(a, d),
            rd = elliptic::carlson_rd(a, b, d), rj = elliptic::carlson_rj(a, b, c, d);
    for (std::size_t i = 0; i < 4; ++i) {
      const By by = static_cast<By>(i + 1);
      const std::string where = std::to_string(i + 1) + ": " + listed(x, y, z, p);
      if (i < 3) rf_.add(relative_error(rf.derivative[i], exact_rf(x, y, z, by)), where);
      rj_.add(relative_error(rj.derivative[i], exact_rj(x, y, z, p, by)), where);
    }
    rc_.add(relative_error(rc.derivative[0], exact_rc(x, p, By::first)), "1: " + listed(x, p));
    rc_.add(relative_error(rc.derivative[3], exact_rc(x, p, By::second)), "2: " + listed(x, p));
    rd_.add(relative_error(rd.derivative[0], exact_rd(x, y, p, By::first)),
            "1: " + listed(x, y, p));
    rd_.add(relative_error(rd.derivative[1], exact_rd(x, y, p, By::second)),
            "2: " + listed(x, y, p));
    rd_.add(relative_error(rd.derivative[3], exact_rd(x, y, p, By::third)),
            "3: " + listed(x, y, p));
  }
  void TearDown() override {
    rf_.expect_within(budget::elliptic_carlson_derivative, "RF");
    rc_.expect_within(budget::elliptic_carlson_derivative, "RC");
    rd_.expect_within(budget::elliptic_carlson_derivative, "RD");
    rj_.expect_within(budget::elliptic_carlson_derivative, "RJ");
  }
  WorstUnits<T> rf_, rc_, rd_, rj_;
};
TYPED_TEST_SUITE(CarlsonDerivative, Real2);

TYPED_TEST(CarlsonDerivative, Generic) {
  oracle::Draw draw(46, 0);
  for (int i = 0; i < 100; ++i) {
    this->check(drawn(draw, 0.01, 2.0), drawn(draw, 0.01, 2.0), drawn(draw, 0.01, 2.0),
                drawn(draw, 0.01, 2.0));
  }
}

TYPED_TEST(CarlsonDerivative, EqualArguments) {
  oracle::Draw draw(47, 0);
  for (int i = 0; i < 20; ++i) {
    const double x = drawn(draw, 0.1, 3.0), y = drawn(draw, 0.1, 3.0), p = drawn(draw, 0.1, 3.0);
    this->check(x, x, y, p);
    this->check(x, y, p, x);
    this->check(x, x, y, x);
    this->check(x, std::nextafter(x, 0.0), y, std::nextafter(x, 9.0));
  }
}

// Boost's own branch for equal arguments spoils differences there: closed values instead.
TYPED_TEST(CarlsonDerivative, AllEqual) {
  using T = TypeParam;
  using std::sqrt;
  using Four = Dual<T, 4>;
  oracle::Draw draw(50, 0);
  WorstUnits<T> worst;
  for (int i = 0; i < 20; ++i) {
    const T x(drawn(draw, 0.1, 3.0));
    const T power = sqrt(x) * x;
    const Four a = Four::variable(x, 0), b = Four::variable(x, 1), c = Four::variable(x, 2),
               d = Four::variable(x, 3);
    const auto check = [&](const T& slope, double numerator, double denominator, const T& scale) {
      const T exact = T(numerator) / (T(denominator) * scale);
      worst.add(std::abs(to_double(slope / exact - T(1.0))), listed(x));
    };
    check(elliptic::carlson_rf(a, b, c).derivative[1], -1.0, 6.0, power);
    check(elliptic::carlson_rc(a, b).derivative[1], -1.0, 3.0, power);
    check(elliptic::carlson_rd(a, b, c).derivative[0], -3.0, 10.0, power * x);
    check(elliptic::carlson_rd(a, b, c).derivative[2], -9.0, 10.0, power * x);
    check(elliptic::carlson_rj(a, b, c, d).derivative[2], -3.0, 10.0, power * x);
    check(elliptic::carlson_rj(a, b, c, d).derivative[3], -3.0, 5.0, power * x);
  }
  EXPECT_LE(worst.units(), budget::elliptic_carlson_derivative) << worst.where();
}

TYPED_TEST(CarlsonDerivative, ExtremeRatios) {
  oracle::Draw draw(48, 0);
  for (int i = 0; i < 60; ++i) {
    this->check(drawn_power(draw, -10, 10), drawn_power(draw, -10, 10), drawn_power(draw, -10, 10),
                drawn_power(draw, -10, 10));
  }
}

// The closed rules of Carlson that hold without a quotient 0/0.
TYPED_TEST(CarlsonDerivative, ClosedRules) {
  using T = TypeParam;
  using Three = Dual<T, 3>;
  oracle::Draw draw(49, 0);
  WorstUnits<T> worst;
  for (int i = 0; i < 100; ++i) {
    const T x(drawn(draw, 0.01, 2.0)), y(drawn(draw, 0.01, 2.0)), z(drawn(draw, 0.01, 2.0));
    const Three rf =
        elliptic::carlson_rf(Three::variable(x, 0), Three::variable(y, 1), Three::variable(z, 2));
    const T rule = -elliptic::carlson_rd(y, z, x) / T(6.0);
    worst.add(std::abs(to_double(rf.derivative[0] / rule - T(1.0))), listed(x, y, z));
    // RJ is homogeneous of degree -3/2.
    const T p(drawn(draw, 0.01, 2.0));
    using Four = Dual<T, 4>;
    const Four rj = elliptic::carlson_rj(Four::variable(x, 0), Four::variable(y, 1),
                                         Four::variable(z, 2), Four::variable(p, 3));
    const T euler =
        x * rj.derivative[0] + y * rj.derivative[1] + z * rj.derivative[2] + p * rj.derivative[3];
    worst.add(std::abs(to_double(euler / (T(-1.5) * rj.value) - T(1.0))), listed(x, y, z, p));
  }
  EXPECT_LE(worst.units(), budget::elliptic_carlson_derivative) << worst.where();
}

}  // namespace
}  // namespace polhode::test
