// SPDX-License-Identifier: MIT
#include "budgets.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "unit/elliptic/support.hpp"

namespace polhode::test {
namespace {

struct Point {
  double s;
  double c;
  double n;
  ExactModulus mod;
};

std::string text(const Point& at) { return listed(at.s, at.c, at.n, at.mod.m(), at.mod.m1()); }

// Amplitudes over the whole circle when `around`, otherwise over the right half of it.
template <class T>
Point drawn_point(oracle::Draw& draw, Near where, bool around) {
  const double phi = draw.uniform(0.0, around ? 3.1 : 1.57) * draw.sign();
  const double n = draw.chance(0.5) ? drawn(draw, -2.0, 0.95) : -drawn_power(draw, -10, 10);
  return {std::sin(phi), std::cos(phi), n, drawn_modulus<T>(draw, where)};
}

template <class T>
class LegendreIntegrals : public ::testing::Test {
 protected:
  void check(const Point& at) {
    const T s(at.s), n(at.n);
    // On the circle to the last digit of T.
    DoubleDouble c_exact = sqrt((1.0 - DoubleDouble(at.s)) * (1.0 + DoubleDouble(at.s)));
    if (at.c < 0.0) c_exact = -c_exact;
    const T c = as<T>(c_exact);
    const elliptic::BasicModulus<T> mod = as<T>(at.mod);
    const auto exact = [&](Legendre kind) {
      return exact_legendre(kind, at.s, wide(c), at.n, at.mod);
    };
    worst_.add(relative_error(elliptic::legendre_f(s, c, mod), exact(Legendre::f)),
               "F " + text(at));
    worst_.add(relative_error(elliptic::legendre_e(s, c, mod), exact(Legendre::e)),
               "E " + text(at));
    worst_.add(relative_error(elliptic::legendre_d(s, c, mod), exact(Legendre::d)),
               "D " + text(at));
    worst_.add(relative_error(elliptic::legendre_pi(s, c, n, mod), exact(Legendre::pi)),
               "Pi " + text(at));
  }
  void TearDown() override { worst_.expect_within(budget::elliptic_legendre); }
  WorstUnits<T> worst_;
};
TYPED_TEST_SUITE(LegendreIntegrals, Real2);

TYPED_TEST(LegendreIntegrals, Generic) {
  oracle::Draw draw(61, 0);
  for (int i = 0; i < 200; ++i) this->check(drawn_point<TypeParam>(draw, Near::generic, false));
}
TYPED_TEST(LegendreIntegrals, AroundTheCircle) {
  oracle::Draw draw(62, 0);
  for (int i = 0; i < 100; ++i) this->check(drawn_point<TypeParam>(draw, Near::generic, true));
}
TYPED_TEST(LegendreIntegrals, NearOne) {
  oracle::Draw draw(63, 0);
  for (int i = 0; i < 10; ++i) this->check(drawn_point<TypeParam>(draw, Near::one, false));
}
TYPED_TEST(LegendreIntegrals, NearZero) {
  oracle::Draw draw(64, 0);
  for (int i = 0; i < 10; ++i) this->check(drawn_point<TypeParam>(draw, Near::zero, false));
}
TYPED_TEST(LegendreIntegrals, SmallAmplitude) {
  oracle::Draw draw(65, 0);
  for (int i = 0; i < 40; ++i) {
    const double s = drawn_power(draw, -60, -1);
    this->check({s, 1.0, drawn(draw, -3.0, 0.9), drawn_modulus<TypeParam>(draw, Near::generic)});
  }
}

TYPED_TEST(LegendreIntegrals, Limits) {
  using T = TypeParam;
  const T zero(0.0), one(1.0), n(-0.5);
  const auto mod = elliptic::BasicModulus<T>::from_ratio(T(3.0), one);
  const auto full = elliptic::BasicModulus<T>::from_ratio(one, zero);
  const auto near = [&](const T& a, const T& b, const char* what) {
    this->worst_.add(std::abs(to_double(a / b - one)), what);
  };
  near(elliptic::legendre_f(one, zero, mod), elliptic::complete_k(mod), "K");
  near(elliptic::legendre_e(-one, zero, mod), -elliptic::complete_e(mod), "-E");
  near(elliptic::legendre_d(one, zero, mod), elliptic::complete_d(mod), "D");
  near(elliptic::legendre_pi(one, zero, n, mod), elliptic::complete_pi(n, mod), "Pi");
  near(elliptic::legendre_f(zero, -one, mod), T(2.0) * elliptic::complete_k(mod), "2K");
  near(elliptic::legendre_pi(T(-0.0), -one, n, mod), T(2.0) * elliptic::complete_pi(n, mod), "2Pi");
  EXPECT_EQ(elliptic::legendre_f(zero, one, mod), zero);
  EXPECT_EQ(elliptic::legendre_pi(zero, one, T(-1e6), full), zero);
  EXPECT_EQ(elliptic::legendre_e(one, zero, full), one);
  EXPECT_EQ(elliptic::legendre_f(one, zero, full), T(HUGE_VAL));
  EXPECT_EQ(elliptic::legendre_pi(one, zero, n, full), T(HUGE_VAL));
  const auto beyond = elliptic::BasicModulus<T>::from_any_pair(T(2.0), -one);
  EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_pi(T(0.8), T(0.6), T(0.5), beyond))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_pi(T(0.8), T(0.6), T(5.0), beyond))));
  // At m1 = 0: F = artanh(s), E = s.
  using std::log;
  near(elliptic::legendre_f(T(3.0) / T(5.0), T(4.0) / T(5.0), full), log(T(2.0)), "artanh");
}

template <class T>
class LegendreDerivatives : public ::testing::Test {
 protected:
  // phi, m, n are the variables.
  void check(const Point& at) {
    using D = Dual<T, 3>;
    const elliptic::BasicModulus<T> base = as<T>(at.mod);
    DoubleDouble c_exact = sqrt((1.0 - DoubleDouble(at.s)) * (1.0 + DoubleDouble(at.s)));
    if (at.c < 0.0) c_exact = -c_exact;
    const T c0 = as<T>(c_exact);
    const T zero(0.0);
    const D s(T(at.s), {c0, zero, zero});
    const D c(c0, {-T(at.s), zero, zero});
    const D m = D::variable(base.m(), 1);
    const auto mod = elliptic::BasicModulus<D>::from_pair(m, D(base.m1(), (-m).derivative));
    const D n = D::variable(T(at.n), 2);
    const auto one = [&](Legendre kind, const D& got, const char* name) {
      const auto by = [&](Along along) {
        return exact_legendre(kind, at.s, wide(c0), at.n, at.mod, along);
      };
      worst_.add(relative_error(wide(got.derivative[0]), by(Along::amplitude)),
                 name + ("/dphi " + text(at)));
      worst_.add(relative_error(wide(got.derivative[1]), by(Along::modulus)),
                 name + ("/dm " + text(at)));
      if (kind == Legendre::pi) {
        worst_.add(relative_error(wide(got.derivative[2]), by(Along::characteristic)),
                   name + ("/dn " + text(at)));
      }
    };
    one(Legendre::f, elliptic::legendre_f(s, c, mod), "F");
    one(Legendre::e, elliptic::legendre_e(s, c, mod), "E");
    one(Legendre::d, elliptic::legendre_d(s, c, mod), "D");
    one(Legendre::pi, elliptic::legendre_pi(s, c, n, mod), "Pi");
  }
  void TearDown() override { worst_.expect_within(budget::elliptic_legendre_derivative); }
  WorstUnits<T> worst_;
};
TYPED_TEST_SUITE(LegendreDerivatives, Real2);

TYPED_TEST(LegendreDerivatives, Generic) {
  oracle::Draw draw(66, 0);
  for (int i = 0; i < 60; ++i) {
    Point at = drawn_point<TypeParam>(draw, Near::generic, false);
    at.n = drawn(draw, -3.0, 0.9);
    this->check(at);
  }
}
TYPED_TEST(LegendreDerivatives, NearOne) {
  oracle::Draw draw(67, 0);
  for (int i = 0; i < 3; ++i) {
    Point at = drawn_point<TypeParam>(draw, Near::one, false);
    at.n = drawn(draw, -3.0, 0.9);
    this->check(at);
  }
}
// n = m makes two arguments of RJ equal; s = 1 makes one of them 0.
TYPED_TEST(LegendreDerivatives, EqualAndZeroArguments) {
  oracle::Draw draw(68, 0);
  for (int i = 0; i < 20; ++i) {
    Point at = drawn_point<TypeParam>(draw, Near::generic, false);
    at.n = at.mod.m().hi;
    this->check(at);
    at.n = -drawn(draw, 0.1, 3.0);
    at.s = 1.0;
    this->check(at);
  }
}

}  // namespace
}  // namespace polhode::test
