// SPDX-License-Identifier: MIT
// Elliptic functions beyond the ordinary: any angle, m below 0 and above 1, n above 1, arguments at
// the ends of double's range.
#include <algorithm>
#include <string>

#include "budgets.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "polhode/error.hpp"
#include "unit/elliptic/support.hpp"
#include "unit/elliptic/typed_values.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using polhode::test::larger;
template <class T>
elliptic::BasicModulus<T> any_modulus(double m) {
  return elliptic::BasicModulus<T>::from_any_pair(T(m), T(1.0) - T(m));
}

// What the library gives for a row of the table.
template <class T>
T computed(const TypedValue& row) {
  const std::string name = row.function;
  const T a(row.at[0]), b(row.at[1]), c(row.at[2]), d(row.at[3]);
  if (name == "carlson_rf") return elliptic::carlson_rf(a, b, c);
  if (name == "carlson_rd") return elliptic::carlson_rd(a, b, c);
  if (name == "carlson_rj") return elliptic::carlson_rj(a, b, c, d);
  if (name == "nome") return elliptic::nome(any_modulus<T>(row.at[0]));
  if (name == "legendre_pi") return elliptic::legendre_pi(a, b, any_modulus<T>(row.at[2]));
  const elliptic::BasicModulus<T> mod = any_modulus<T>(row.at[1]);
  if (name == "complete_pi") return elliptic::complete_pi(a, mod);
  if (name == "legendre_f") return elliptic::legendre_f(a, mod);
  if (name == "legendre_e") return elliptic::legendre_e(a, mod);
  if (name == "legendre_d") return elliptic::legendre_d(a, mod);
  if (name == "legendre_b") return elliptic::legendre_b(a, mod);
  if (name == "jacobi_zeta") return elliptic::jacobi_zeta(a, mod);
  const elliptic::Jacobi<T> j = elliptic::jacobi(a, mod);
  return name == "sn" ? j.sn : (name == "cn" ? j.cn : j.dn);
}

template <class T>
class BeyondTheOrdinary : public ::testing::Test {
 protected:
  void near(const T& got, const T& want, const std::string& where) {
    worst_.add(std::abs(to_double(got / want - T(1.0))), where);
  }
  void TearDown() override { worst_.expect_within(budget::elliptic_beyond); }
  WorstUnits<T> worst_;
};
TYPED_TEST_SUITE(BeyondTheOrdinary, Real2);

TYPED_TEST(BeyondTheOrdinary, TypedValues) {
  using T = TypeParam;
  for (const TypedValue& row : typed_values) {
    const double size = std::abs(row.hi);
    const bool edge = size < 1e-230 || std::any_of(row.at.begin(), row.at.end(), [](double x) {
                        return x != 0.0 && (std::abs(x) < 1e-230 || std::abs(x) > 1e280);
                      });
    if (std::is_same_v<T, DoubleDouble> && edge) continue;  // no room for a low part
    this->worst_.add(relative_error(wide(computed<T>(row)), {row.hi, row.lo, 0.0}),
                     row.function + (" " + listed(row.at[0], row.at[1], row.at[2], row.at[3])));
  }
}

// Homogeneity: all arguments times 4^k, exactly.
TYPED_TEST(BeyondTheOrdinary, Homogeneity) {
  using T = TypeParam;
  oracle::Draw draw(201, 0);
  for (int i = 0; i < 100; ++i) {
    const T x(drawn_power(draw, -20, 20)), y(drawn_power(draw, -20, 20)),
        z(drawn_power(draw, -20, 20)), p(drawn_power(draw, -20, 20) * (i % 4 == 0 ? -1.0 : 1.0));
    const T positive(std::abs(to_double(p)));
    for (const int k : {-230, 230}) {
      const double up = std::ldexp(1.0, 2 * k), root = std::ldexp(1.0, -k);
      const std::string at = listed(x, y, z, p) + " 4^" + std::to_string(k);
      const auto same = [&](const T& got, const T& base, int power) {
        T want = base;
        for (int j = 0; j < power; ++j) want = want * root;
        EXPECT_EQ(got, want) << at;
      };
      same(elliptic::carlson_rf(x * up, y * up, z * up), elliptic::carlson_rf(x, y, z), 1);
      // -3/2: what a double can hold
      const int less = k / 3;
      const double up3 = std::ldexp(1.0, 6 * less), root9 = std::ldexp(1.0, -9 * less);
      EXPECT_EQ(elliptic::carlson_rd(x * up3, y * up3, positive * up3),
                elliptic::carlson_rd(x, y, positive) * root9);
      this->near(elliptic::carlson_rj(x * up3, y * up3, z * up3, p * up3),
                 elliptic::carlson_rj(x, y, z, p) * root9, at);
      EXPECT_EQ(elliptic::agm(x * up, y * up), elliptic::agm(x, y) * up) << at;
    }
  }
}

TYPED_TEST(BeyondTheOrdinary, CarlsonLimits) {
  using T = TypeParam;
  const T zero(0.0), one(1.0), infinity(HUGE_VAL);
  EXPECT_EQ(elliptic::carlson_rf(one, one, infinity), zero);
  EXPECT_EQ(elliptic::carlson_rc(one, infinity), zero);
  EXPECT_EQ(elliptic::carlson_rc(infinity, one), zero);
  EXPECT_EQ(elliptic::carlson_rd(one, one, infinity), zero);
  EXPECT_EQ(elliptic::carlson_rj(one, one, one, infinity), zero);
  EXPECT_EQ(elliptic::carlson_rc(zero, -one), zero);
  // RJ(x, x, x, -q) = 3 (RC(x, -q) - 1/sqrt x)/(x + q)  [DLMF 19.20.8]
  const T x(1.5), q(0.75);
  using std::sqrt;
  this->near(elliptic::carlson_rj(x, x, x, -q),
             T(3.0) * (elliptic::carlson_rc(x, -q) - one / sqrt(x)) / (x + q), "equal");
}

// Where the old formulas failed: P^2 and c^2 + m s^2 underflow.
TYPED_TEST(BeyondTheOrdinary, HeumanNextToTheQuarter) {
  using T = TypeParam;
  const T one(1.0);
  for (const double m1 : {1e-200, 1e-290, 1e-300, 1e-320}) {
    if (std::is_same_v<T, DoubleDouble> && m1 < 1e-230) continue;
    const auto mod = elliptic::BasicModulus<T>::from_ratio(one, T(m1));
    // As m1 -> 0, 2 psi/pi.
    for (const double psi : {1.5707963267948966, 1.0, 1e-200}) {
      this->near(elliptic::heuman_lambda0(T(psi), mod), T(2.0 * psi) / pi<T>(), listed(psi, m1));
    }
  }
  this->near(elliptic::heuman_lambda0(one, T(1e-170), any_modulus<T>(0.25)), one, "m = 0.25");
  this->near(elliptic::heuman_lambda0(one, T(1e-170), any_modulus<T>(0.0)), one, "m = 0");
  // next to m = 0 and pi/2 it is a function of m / cos^2 psi
  this->near(elliptic::heuman_lambda0(one, T(0x1p-500), any_modulus<T>(0x3p-1000)),
             elliptic::heuman_lambda0(one, T(0x1p-400), any_modulus<T>(0x3p-800)), "m = 3 cos^2");
  EXPECT_TRUE(std::isnan(to_double(elliptic::heuman_lambda0(one, any_modulus<T>(2.0)))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::heuman_lambda0(one, any_modulus<T>(-2.0)))));
}

TEST(BeyondTheOrdinaryNome, NextToOne) {
  // exp(pi^2/ln(m1/16)): 16-digit values of mpmath
  EXPECT_DOUBLE_EQ(elliptic::nome(elliptic::Modulus::from_ratio(1.0, 5e-324)), 0.98687828871339054);
  EXPECT_DOUBLE_EQ(elliptic::nome(elliptic::Modulus::from_ratio(1.0, 1e-300)), 0.98587017841455351);
}

// Pi(n) behind the pole: the difference of two primitives in closed form at m = 0,
// artanh-like.
TYPED_TEST(BeyondTheOrdinary, PrincipalValueAtZeroModulus) {
  using T = TypeParam;
  using std::abs;
  using std::log;
  using std::sqrt;
  using std::tan;
  oracle::Draw draw(202, 0);
  for (int i = 0; i < 60; ++i) {
    const T n(drawn(draw, 1.1, 9.0)), phi(drawn(draw, 0.05, 1.5));
    const T w = sqrt(n - T(1.0)), t = w * tan(phi);
    if (abs(to_double(t) - 1.0) < 0.05) continue;  // the quotient below cancels
    const T want = log(abs((T(1.0) + t) / (T(1.0) - t))) / (T(2.0) * w);
    const double slack = 1.0 + 1.0 / std::abs(to_double(T(1.0) - t) * to_double(w * want));
    this->worst_.add(
        std::abs(to_double(elliptic::legendre_pi(phi, n, any_modulus<T>(0.0)) / want - T(1.0))) /
            slack,
        listed(phi, n));
  }
}

TYPED_TEST(BeyondTheOrdinary, PolesAndEnds) {
  using T = TypeParam;
  const T zero(0.0), one(1.0);
  const auto generic = any_modulus<T>(0.25);
  EXPECT_EQ(elliptic::legendre_pi(one, zero, one, generic), T(HUGE_VAL));
  // exactly at the pole, and next to it: s^2 n = 1 but for the rounding of c
  const T half = sqrt(T(0.5));
  for (const double m : {-3.0, 0.0, 0.25, 1.5}) {
    EXPECT_EQ(elliptic::legendre_pi(half, half, T(2.0), any_modulus<T>(m)), T(HUGE_VAL)) << m;
    EXPECT_EQ(elliptic::legendre_pi(-half, half, T(2.0), any_modulus<T>(m)), T(-HUGE_VAL)) << m;
  }
  EXPECT_EQ(elliptic::legendre_pi(T(0.5), sqrt(T(0.75)), T(4.0), any_modulus<T>(0.0)) > T(1.0),
            true);
  this->near(elliptic::legendre_pi(one, zero, T(2.0), generic),
             elliptic::complete_pi(T(2.0), generic), "end");
  this->near(elliptic::legendre_pi(-one, zero, T(2.0), generic),
             -elliptic::complete_pi(T(2.0), generic), "-end");
  const auto beyond = any_modulus<T>(4.0);  // |phi| <= pi/6
  EXPECT_FALSE(std::isnan(to_double(elliptic::legendre_f(T(0.5), beyond))));
  for (const double phi : {0.53, -0.53, 1.7, 3.0, 4.0}) {
    EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_f(T(phi), beyond)))) << phi;
    EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_e(T(phi), beyond)))) << phi;
    EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_d(T(phi), beyond)))) << phi;
    EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_b(T(phi), beyond)))) << phi;
    EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_pi(T(phi), T(0.5), beyond)))) << phi;
    EXPECT_TRUE(std::isnan(to_double(elliptic::legendre_pi(T(phi), T(9.0), beyond)))) << phi;
  }
  EXPECT_TRUE(std::isnan(to_double(elliptic::complete_k(beyond))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::complete_pi(T(3.0), beyond))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::jacobi_zeta(one, beyond))));
  EXPECT_TRUE(std::isnan(to_double(elliptic::nome(beyond))));
  EXPECT_THROW(elliptic::Modulus::from_any_pair(2.0, -1.1), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_any_pair(HUGE_VAL, -HUGE_VAL), DomainError);
  EXPECT_EQ(elliptic::jacobi_zeta(T(2.0), elliptic::BasicModulus<T>::from_ratio(one, zero)),
            -sincos(T(2.0)).sin);
}

// The inverse, over all moduli: F(am u) = u.
TYPED_TEST(BeyondTheOrdinary, AmplitudeInvertsF) {
  using T = TypeParam;
  oracle::Draw draw(203, 0);
  for (int i = 0; i < 60; ++i) {
    const T u(drawn(draw, -4.0, 4.0));
    const auto mod = any_modulus<T>(-drawn_power(draw, -3, 3));
    const double slope = 1.0 + std::abs(to_double(elliptic::amplitude(u, mod) / u));
    this->worst_.add(
        std::abs(to_double(elliptic::legendre_f(elliptic::amplitude(u, mod), mod) / u - T(1.0))) /
            slope,
        listed(u));
  }
  for (int i = 0; i < 60; ++i) {
    const auto mod = any_modulus<T>(1.0 + drawn_power(draw, -3, 2));
    using std::sqrt;
    const T u = T(drawn(draw, -0.7, 0.7)) / sqrt(mod.m());
    this->near(elliptic::legendre_f(elliptic::amplitude(u, mod), mod), u,
               "m > 1 " + listed(u, mod.m()));
  }
}

// Z(u + v) = Z(u) + Z(v) - m sn u sn v sn(u + v)  [A&S 17.4.35], relative to the terms.
TYPED_TEST(BeyondTheOrdinary, ZetaAddition) {
  using T = TypeParam;
  oracle::Draw draw(204, 0);
  for (int i = 0; i < 60; ++i) {
    const auto mod = any_modulus<T>(i % 2 == 0 ? drawn(draw, 0.01, 0.99) : -drawn(draw, 0.1, 5.0));
    const T u(drawn(draw, 0.1, 1.0)), v(drawn(draw, 0.1, 1.0));
    const auto z = [&](const T& x) {
      return elliptic::jacobi_zeta(elliptic::amplitude(x, mod), mod);
    };
    const auto s = [&](const T& x) { return elliptic::jacobi(x, mod).sn; };
    const T product = mod.m() * s(u) * s(v) * s(u + v);
    const double scale = std::abs(to_double(z(u))) + std::abs(to_double(z(v))) +
                         std::abs(to_double(product)) + std::abs(to_double(mod.m()));
    this->worst_.add(std::abs(to_double(z(u + v) - (z(u) + z(v) - product))) / scale,
                     listed(u, v, mod.m()));
  }
}

// Derivatives of Dual<double> against central differences in DoubleDouble.
class BeyondDerivatives : public ::testing::Test {
 protected:
  using D = Dual<double, 3>;
  // f(phi, n, mod) at phi, n, m as variables.
  template <class F>
  void check(const char* name, double phi, double n, double m, const F& f) {
    const D dm = D::variable(m, 2);
    const auto mod = elliptic::BasicModulus<D>::from_any_pair(dm, 1.0 - dm);
    const D got = f(D::variable(phi, 0), D::variable(n, 1), mod);
    const std::array<double, 3> at{phi, n, m};
    for (std::size_t i = 0; i < 3; ++i) {
      const double h = 1e-9 * std::abs(at[i]);
      const auto moved = [&](double by) {
        std::array<DoubleDouble, 3> x{at[0], at[1], at[2]};
        x[i] = x[i] + by;
        return f(x[0], x[1], elliptic::BasicModulus<DoubleDouble>::from_any_pair(x[2], 1.0 - x[2]));
      };
      const double want = to_double((moved(h) - moved(-h)) / (2.0 * DoubleDouble(h)));
      const double size = larger(std::abs(want), std::abs(got.value / at[i]));
      const double scale = size * (1.0 + std::abs(phi));  // one rounding of phi, relative
      worst_.add(std::abs(got.derivative[i] - want) / scale,
                 name + std::to_string(i) + ": " + listed(phi, n, m));
    }
  }
  void TearDown() override { worst_.expect_within(budget::elliptic_beyond_derivative); }
  WorstUnits<double> worst_;
};

TEST(AgmOutsideItsDomain, IsNotANumber) {
  for (const double a : {-1.0, 2.0, -HUGE_VAL, -1e-320})
    for (const double b : {-1.0, -2.0, -1e300}) {
      EXPECT_TRUE(std::isnan(elliptic::agm(a, b)) && std::isnan(elliptic::agm(b, a)))
          << a << " " << b;
    }
  EXPECT_EQ(elliptic::agm(0.0, 2.0), 0.0);
}

TEST_F(BeyondDerivatives, AnyModulus) {
  oracle::Draw draw(205, 0);
  for (int i = 0; i < 24; ++i) {
    const double m = i % 2 == 0 ? -drawn(draw, 0.1, 9.0) : drawn(draw, 1.1, 5.0);
    const double phi = i % 2 == 0 ? drawn(draw, -9.0, 9.0) : drawn(draw, 0.05, 0.4);
    const double n = drawn(draw, -3.0, 0.9);
    check("F ", phi, n, m, [](auto x, auto, auto mod) { return elliptic::legendre_f(x, mod); });
    check("E ", phi, n, m, [](auto x, auto, auto mod) { return elliptic::legendre_e(x, mod); });
    check("D ", phi, n, m, [](auto x, auto, auto mod) { return elliptic::legendre_d(x, mod); });
    check("B ", phi, n, m, [](auto x, auto, auto mod) { return elliptic::legendre_b(x, mod); });
    check("Pi ", phi, n, m,
          [](auto x, auto k, auto mod) { return elliptic::legendre_pi(x, k, mod); });
    check("sn ", phi, n, m, [](auto x, auto, auto mod) { return elliptic::jacobi(x, mod).sn; });
    check("dn ", phi, n, m, [](auto x, auto, auto mod) { return elliptic::jacobi(x, mod).dn; });
    check("am ", phi, n, m, [](auto x, auto, auto mod) { return elliptic::amplitude(x, mod); });
  }
}

TEST_F(BeyondDerivatives, BehindThePole) {
  oracle::Draw draw(206, 0);
  for (int i = 0; i < 24; ++i) {
    const double m = i % 2 == 0 ? drawn(draw, 0.1, 0.9) : -drawn(draw, 0.1, 4.0);
    const double n = drawn(draw, 2.0, 9.0);
    check("Pi ", drawn(draw, 1.0, 1.5), n, m,
          [](auto x, auto k, auto mod) { return elliptic::legendre_pi(x, k, mod); });
    check("complete ", 1.0, n, m,
          [](auto, auto k, auto mod) { return elliptic::complete_pi(k, mod); });
    check("Z ", drawn(draw, -4.0, 4.0), n, m,
          [](auto x, auto, auto mod) { return elliptic::jacobi_zeta(x, mod); });
  }
}

}  // namespace
}  // namespace polhode::test
