// SPDX-License-Identifier: MIT
#include "polhode/elliptic/jacobi.hpp"

#include "budgets.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "unit/elliptic/support.hpp"

namespace polhode::test {
namespace {

template <class T>
class JacobiFunctions : public ::testing::Test {
 protected:
  // The error of each function over what one rounding of u, and of the function, does to it.
  void check(double u, const ExactModulus& mod) {
    const elliptic::Jacobi<T> j = elliptic::jacobi(T(u), as<T>(mod));
    const ExactJacobi exact = exact_jacobi(u, mod);
    const double s = std::abs(exact.sn.a), c = std::abs(exact.cn.a), d = exact.dn.a;
    const double m = mod.m().hi;
    const std::string at = listed(u, mod.m(), mod.m1());
    const double a = std::abs(u);
    worst_.add(absolute_error(j.sn, exact.sn) / (s + a * c * d), "sn " + at);
    worst_.add(absolute_error(j.cn, exact.cn) / (c + a * s * d), "cn " + at);
    worst_.add(absolute_error(j.dn, exact.dn) / (d + a * m * s * c), "dn " + at);
  }
  void sweep(Near where, int count, double reach, std::uint64_t seed) {
    oracle::Draw draw(seed, 0);
    for (int i = 0; i < count; ++i) {
      const ExactModulus mod = drawn_modulus<T>(draw, where);
      const double k = elliptic::complete_k(elliptic::to_double(mod));
      check(short_number(k * draw.uniform(-reach, reach)), mod);
    }
  }
  void TearDown() override { worst_.expect_within(budget::elliptic_jacobi); }
  WorstUnits<T> worst_;
};
TYPED_TEST_SUITE(JacobiFunctions, Real2);

TYPED_TEST(JacobiFunctions, Generic) { this->sweep(Near::generic, 300, 2.0, 71); }
TYPED_TEST(JacobiFunctions, NearOne) { this->sweep(Near::one, 60, 2.0, 72); }
TYPED_TEST(JacobiFunctions, NearZero) { this->sweep(Near::zero, 60, 2.0, 73); }
TYPED_TEST(JacobiFunctions, ManyPeriods) { this->sweep(Near::generic, 100, 1e6, 74); }
TYPED_TEST(JacobiFunctions, SmallArgument) {
  oracle::Draw draw(75, 0);
  for (int i = 0; i < 60; ++i) {
    this->check(drawn_power(draw, -120, 0), drawn_modulus<TypeParam>(draw, Near::generic));
    this->check(drawn_power(draw, -30, 0), drawn_modulus<TypeParam>(draw, Near::one));
  }
}

TYPED_TEST(JacobiFunctions, Limits) {
  using T = TypeParam;
  const T zero(0.0), one(1.0);
  const auto full = elliptic::BasicModulus<T>::from_ratio(one, zero);
  const auto flat = elliptic::BasicModulus<T>::from_ratio(zero, one);
  const auto some = elliptic::BasicModulus<T>::from_ratio(one, one);
  const elliptic::Jacobi<T> at_zero = elliptic::jacobi(zero, some);
  EXPECT_EQ(at_zero.sn, zero);
  EXPECT_EQ(at_zero.cn, one);
  EXPECT_EQ(at_zero.dn, one);
  using std::cosh;
  using std::sin;
  using std::tanh;
  const T u(1.25);
  EXPECT_EQ(elliptic::jacobi(u, full).sn, tanh(u));
  EXPECT_EQ(elliptic::jacobi(u, full).cn, one / cosh(u));
  EXPECT_EQ(elliptic::jacobi(u, full).dn, one / cosh(u));
  this->worst_.add(std::abs(to_double(elliptic::jacobi(u, flat).sn / sin(u) - one)), "m = 0");
  EXPECT_EQ(elliptic::jacobi(u, flat).dn, one);
  const T infinity(HUGE_VAL);
  EXPECT_TRUE(std::isnan(to_double(elliptic::jacobi(infinity, some).sn)));
  EXPECT_EQ(elliptic::jacobi(-u, some).sn, -elliptic::jacobi(u, some).sn);
}

TYPED_TEST(JacobiFunctions, Amplitude) {
  using T = TypeParam;
  oracle::Draw draw(76, 0);
  for (int i = 0; i < 100; ++i) {
    const ExactModulus mod = drawn_modulus<T>(draw, i % 2 == 0 ? Near::generic : Near::one);
    const elliptic::BasicModulus<T> used = as<T>(mod);
    const T k = elliptic::complete_k(used);
    const T rest = T(draw.uniform(-1.0, 1.0)) * k;
    const double turns = std::round(draw.uniform(-20.0, 20.0));
    const T u = rest + T(2.0 * turns) * k;
    const elliptic::Jacobi<T> j = elliptic::jacobi(rest, used);
    using std::atan2;
    const T want = T(turns) * pi<T>() + atan2(j.sn, j.cn);
    const double scale = std::abs(to_double(want)) + std::abs(to_double(u) * to_double(j.dn));
    this->worst_.add(std::abs(to_double(elliptic::amplitude(u, used) - want)) / scale,
                     listed(u, mod.m1()));
    const elliptic::Jacobi<T> around = elliptic::jacobi(u, used);
    const double sign = std::fmod(turns, 2.0) == 0.0 ? 1.0 : -1.0;
    this->worst_.add(std::abs(to_double(around.dn - j.dn)) /
                         (to_double(j.dn) + std::abs(to_double(u * j.sn * j.cn))),
                     "dn " + listed(u, mod.m1()));
    EXPECT_GT(sign * to_double(around.cn * j.cn), 0.0) << listed(u, mod.m1());
  }
}

// F(am u) = u.
TYPED_TEST(JacobiFunctions, InverseOfF) {
  using T = TypeParam;
  oracle::Draw draw(77, 0);
  for (int i = 0; i < 100; ++i) {
    const ExactModulus mod = drawn_modulus<T>(draw, static_cast<Near>(i % 3));
    const elliptic::BasicModulus<T> used = as<T>(mod);
    const T u = T(draw.uniform(-0.9, 0.9)) * elliptic::complete_k(used);
    const elliptic::Jacobi<T> j = elliptic::jacobi(u, used);
    const double slope = 1.0 + std::abs(to_double(j.sn) / to_double(u * j.dn));
    this->worst_.add(
        std::abs(to_double(elliptic::legendre_f(j.sn, j.cn, used) / u - T(1.0))) / slope,
        listed(u, mod.m1()));
  }
}

template <class T>
class JacobiDerivatives : public ::testing::Test {
 protected:
  using D2 = Dual<T, 2>;
  static elliptic::BasicModulus<D2> moving(const elliptic::BasicModulus<T>& base) {
    const D2 m = D2::variable(base.m(), 1);
    return elliptic::BasicModulus<D2>::from_pair(m, D2(base.m1(), (-m).derivative));
  }
  void check(double u, const ExactModulus& mod) {
    const elliptic::Jacobi<D2> j = elliptic::jacobi(D2::variable(T(u), 0), moving(as<T>(mod)));
    const std::string at = listed(u, mod.m(), mod.m1());
    const ExactJacobi by_u = exact_jacobi(u, mod, Along::argument);
    const ExactJacobi by_m = exact_jacobi(u, mod, Along::modulus);
    const double slack = 1.0 + std::abs(u);  // one rounding of u, relative
    worst_.add(relative_error(wide(j.sn.derivative[0]), by_u.sn) / slack, "sn/du " + at);
    worst_.add(relative_error(wide(j.cn.derivative[0]), by_u.cn) / slack, "cn/du " + at);
    worst_.add(relative_error(wide(j.dn.derivative[0]), by_u.dn) / slack, "dn/du " + at);
    worst_.add(relative_error(wide(j.sn.derivative[1]), by_m.sn) / slack, "sn/dm " + at);
    worst_.add(relative_error(wide(j.cn.derivative[1]), by_m.cn) / slack, "cn/dm " + at);
    worst_.add(relative_error(wide(j.dn.derivative[1]), by_m.dn) / slack, "dn/dm " + at);
  }
  void TearDown() override { worst_.expect_within(budget::elliptic_jacobi_derivative); }
  WorstUnits<T> worst_;
};
TYPED_TEST_SUITE(JacobiDerivatives, Real2);

TYPED_TEST(JacobiDerivatives, Generic) {
  oracle::Draw draw(78, 0);
  for (int i = 0; i < 60; ++i) {
    const ExactModulus mod = drawn_modulus<TypeParam>(draw, Near::generic);
    const double k = elliptic::complete_k(elliptic::to_double(mod));
    this->check(short_number(k * draw.uniform(0.1, 0.9) + 2.0 * k * (i % 4)), mod);
  }
}
TYPED_TEST(JacobiDerivatives, NearOne) {
  oracle::Draw draw(79, 0);
  for (int i = 0; i < 16; ++i) {
    this->check(drawn(draw, 0.2, 3.0) * draw.sign(), drawn_modulus<TypeParam>(draw, Near::one));
  }
}

// At m1 = 0 exactly: d sn/dm = -(1/4)(sinh u cosh u - u) sech^2 u  [A&S 16.15].
TYPED_TEST(JacobiDerivatives, AtOne) {
  using T = TypeParam;
  using std::cosh;
  using std::sinh;
  for (const double u0 : {-3.0, 0.5, 1.0, 4.0}) {
    const T u(u0);
    const auto j = elliptic::jacobi(
        Dual<T, 2>(u), this->moving(elliptic::BasicModulus<T>::from_ratio(T(1.0), T(0.0))));
    const T s = sinh(u), c = cosh(u);
    const T exact = T(-0.25) * (s * c - u) / (c * c);
    this->worst_.add(std::abs(to_double(-j.sn.derivative[1] / exact + T(1.0))), listed(u));
    const T exact_dn = T(-0.25) * (s * c + u) * s / (c * c);
    this->worst_.add(std::abs(to_double(j.dn.derivative[1] / exact_dn - T(1.0))),
                     "dn " + listed(u));
  }
}

TYPED_TEST(JacobiDerivatives, Amplitude) {
  using T = TypeParam;
  oracle::Draw draw(80, 0);
  for (int i = 0; i < 40; ++i) {
    const ExactModulus mod = drawn_modulus<T>(draw, Near::generic);
    const T u(drawn(draw, -30.0, 30.0));
    const auto used = this->moving(as<T>(mod));
    const auto am = elliptic::amplitude(Dual<T, 2>::variable(u, 0), used);
    // F(am u, m) = u along the curve: 1 = F_phi am_u and 0 = F_phi am_m + F_m.
    using std::cos;
    using std::round;
    using std::sin;
    const T turns = round(am.value / pi<T>());
    const auto inside = am - turns * pi<T>();
    const auto back = elliptic::legendre_f(sin(inside), cos(inside), used) +
                      T(2.0) * turns * elliptic::complete_k(used);
    const double slack = 1.0 + std::abs(to_double(u));
    this->worst_.add(std::abs(to_double(back.derivative[0] - T(1.0))) / slack, listed(u, mod.m()));
    this->worst_.add(std::abs(to_double(back.derivative[1])) / slack, listed(u, mod.m()));
  }
}

}  // namespace
}  // namespace polhode::test
