// SPDX-License-Identifier: MIT
#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "polhode/error.hpp"
#include "unit/elliptic/support.hpp"

namespace polhode::test {
namespace {

TEST(Modulus, Factories) {
  const elliptic::Modulus mod = elliptic::Modulus::from_ratio(1.0, 3.0);
  EXPECT_EQ(mod.m(), 0.25);
  EXPECT_EQ(mod.m1(), 0.75);
  EXPECT_EQ(mod.complement().m(), 0.75);
  EXPECT_EQ(elliptic::Modulus::from_ratio(2.0, 0.0).m1(), 0.0);
  EXPECT_EQ(elliptic::Modulus::from_ratio(1.0, 1e-300).m1(), 1e-300);
  EXPECT_EQ(to_double(elliptic::BasicModulus<DoubleDouble>::from_ratio(1.0, 3.0)).m1(), 0.75);
}

TEST(Modulus, Refuses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(elliptic::Modulus::from_ratio(-1.0, 3.0), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_ratio(0.0, 0.0), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_ratio(nan, 1.0), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_ratio(1.0, HUGE_VAL), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_ratio(1e308, 1e308), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_pair(0.5, 0.500001), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_pair(1.5, -0.5), DomainError);
  EXPECT_THROW(elliptic::Modulus::from_pair(nan, 0.5), DomainError);
  EXPECT_MESSAGE(elliptic::Modulus::from_ratio(-1.0, 3.0),
                 "Modulus: ratio (-1, 3) breaks 0 <= a, b and 0 < a + b < inf");
}

template <class T>
class CompleteIntegrals : public ::testing::Test {
 protected:
  void sweep(Near where, int count, std::uint64_t seed) {
    oracle::Draw draw(seed, 0);
    for (int i = 0; i < count; ++i) {
      const ExactModulus mod = drawn_modulus<T>(draw, where);
      const elliptic::BasicModulus<T> used = as<T>(mod);
      const std::string at = listed(mod.m(), mod.m1());
      worst_.add(relative_error(elliptic::complete_k(used), exact_complete(Complete::k, mod)),
                 "K " + at);
      worst_.add(relative_error(elliptic::complete_e(used), exact_complete(Complete::e, mod)),
                 "E " + at);
      worst_.add(relative_error(elliptic::complete_b(used), exact_complete(Complete::b, mod)),
                 "B " + at);
      worst_.add(relative_error(elliptic::complete_d(used), exact_complete(Complete::d, mod)),
                 "D " + at);
      nome_.add(relative_error(elliptic::nome(used), exact_nome(mod)), "q " + at);
      nome_.add(relative_error(elliptic::complementary_nome(used), exact_nome(mod.complement())),
                "q1 " + at);
    }
  }
  void TearDown() override {
    worst_.expect_within(budget::elliptic_complete);
    nome_.expect_within(budget::elliptic_nome);
  }
  WorstUnits<T> worst_, nome_;
};
TYPED_TEST_SUITE(CompleteIntegrals, Real2);

TYPED_TEST(CompleteIntegrals, Generic) { this->sweep(Near::generic, 200, 51); }
TYPED_TEST(CompleteIntegrals, NearOne) { this->sweep(Near::one, 40, 52); }
TYPED_TEST(CompleteIntegrals, NearZero) { this->sweep(Near::zero, 40, 53); }

TYPED_TEST(CompleteIntegrals, Pi) {
  using T = TypeParam;
  oracle::Draw draw(54, 0);
  for (int i = 0; i < 200; ++i) {
    const double n = i % 2 == 0 ? drawn(draw, -2.0, 0.99) : -drawn_power(draw, -10, 10);
    const ExactModulus mod = i % 3 == 0
                                 ? ExactModulus::from_pair(1.0 - DoubleDouble(0x1p-60), 0x1p-60)
                                 : drawn_modulus<T>(draw, Near::generic);
    this->worst_.add(
        relative_error(elliptic::complete_pi(T(n), as<T>(mod)), exact_complete_pi(n, mod)),
        "Pi " + listed(n, mod.m(), mod.m1()));
  }
}

// Moduli so imaginary that cel alone has no room in double. Values: mpmath, K - Pi(m/n) and [DLMF
// 19.7.8] at 700 digits.
TYPED_TEST(CompleteIntegrals, PiOfHugeModuli) {
  using T = TypeParam;
  const auto mod = [](double m) {
    return elliptic::BasicModulus<T>::from_any_pair(T(m), T(1.0 - m));
  };
  const auto check = [&](const T& got, double expected, const std::string& what) {
    EXPECT_LT(std::abs(to_double(got) / expected - 1.0), budget::elliptic_python) << what;
  };
  struct Row {
    double n, m, pi;
  };
  for (const Row& row :
       {Row{2, -1e220, 2.5342420411018445528e-108}, Row{2, -1e205, 7.4678709870199936513e-101},
        Row{2, -1e300, 3.4552760782994627315e-148},
        Row{1.0000001, -1e250, 2.8820943095204228043e-123},
        Row{1e10, -1e230, 2.5397750740931965433e-113},
        Row{1e200, -1e220, 2.3718998110500402205e-109}, Row{3, -1e100, 1.1511172704566681875e-48}})
    check(elliptic::complete_pi(T(row.n), mod(row.m)), row.pi, "complete " + listed(row.n, row.m));
  struct Incomplete {
    double phi, n, m, pi;
  };
  for (const Incomplete& row : {Incomplete{1.2, 2, -1e220, 2.5384511997669122547e-108},
                                Incomplete{4.0, 2, -1e220, 7.6177974061641710062e-108},
                                Incomplete{0.3, 2, -1e220, 2.5287932100215448001e-108},
                                Incomplete{1.2, 2, -1e300, 3.4594852369645304333e-148},
                                Incomplete{-2.5, 3, -1e215, -7.7716165625982665111e-106}})
    check(elliptic::legendre_pi(T(row.phi), T(row.n), mod(row.m)), row.pi,
          listed(row.phi, row.n, row.m));
}

TYPED_TEST(CompleteIntegrals, Cel) {
  using T = TypeParam;
  oracle::Draw draw(55, 0);
  for (int i = 0; i < 24; ++i) {
    const double kc = i % 2 == 0 ? drawn(draw, 0.01, 1.0) : drawn_power(draw, -150, 0);
    const double p = drawn_power(draw, -8, 8);
    const double a = drawn(draw, 0.0, 2.0);
    const double b = i % 4 == 0 ? 0.0 : drawn(draw, 0.0, 2.0);
    this->worst_.add(relative_error(elliptic::cel(T(kc), T(p), T(a), T(b)), exact_cel(kc, p, a, b)),
                     "cel " + listed(kc, p, a, b));
  }
}

TYPED_TEST(CompleteIntegrals, Limits) {
  using T = TypeParam;
  const T zero(0.0), one(1.0), half_pi = T(0.5) * pi<T>();
  const auto flat = elliptic::BasicModulus<T>::from_ratio(zero, one);
  const auto full = elliptic::BasicModulus<T>::from_ratio(one, zero);
  EXPECT_EQ(elliptic::complete_k(flat), half_pi);
  EXPECT_EQ(elliptic::complete_e(flat), half_pi);
  EXPECT_EQ(elliptic::complete_b(flat), T(0.5) * half_pi);
  EXPECT_EQ(elliptic::complete_d(flat), T(0.5) * half_pi);
  EXPECT_EQ(elliptic::complete_k(full), T(HUGE_VAL));
  EXPECT_EQ(elliptic::complete_d(full), T(HUGE_VAL));
  EXPECT_EQ(elliptic::complete_pi(T(-2.0), full), T(HUGE_VAL));
  EXPECT_EQ(elliptic::complete_e(full), one);
  EXPECT_EQ(elliptic::complete_b(full), one);
  EXPECT_EQ(elliptic::cel(zero, one, one, -one), T(-HUGE_VAL));
  // int cos / (cos^2 + p sin^2) = arctan(sqrt(p - 1)) / sqrt(p - 1)
  this->worst_.add(
      std::abs(to_double(elliptic::cel(zero, T(2.0), T(3.0), zero) / (T(0.75) * pi<T>()) - one)),
      "cel(0, 2, 3, 0)");
  EXPECT_TRUE(std::isnan(to_double(elliptic::cel(one, -one, one, one))));
  EXPECT_EQ(elliptic::complete_pi(T(1.5), flat), zero);  // the principal value
  EXPECT_EQ(elliptic::complete_pi(one, flat), T(HUGE_VAL));
  EXPECT_EQ(elliptic::complete_pi(T(1.5), full), T(-HUGE_VAL));
  EXPECT_EQ(elliptic::nome(flat), zero);
  EXPECT_EQ(elliptic::nome(full), one);
  EXPECT_EQ(elliptic::complementary_nome(flat), one);
  EXPECT_EQ(elliptic::agm(one, zero), zero);
  EXPECT_EQ(elliptic::agm(one, one), one);
}

TYPED_TEST(CompleteIntegrals, Heuman) {
  using T = TypeParam;
  oracle::Draw draw(56, 0);
  WorstUnits<T> worst;
  for (int i = 0; i < 60; ++i) {
    const Near where = i % 3 == 0 ? Near::generic : (i % 3 == 1 ? Near::one : Near::zero);
    const ExactModulus mod = drawn_modulus<T>(draw, where);
    const double psi = drawn(draw, 0.0, 1.5) * draw.sign();
    worst.add(relative_error(elliptic::heuman_lambda0(T(psi), as<T>(mod)),
                             exact_heuman_lambda0(psi, mod)),
              listed(psi, mod.m(), mod.m1()));
  }
  // Where Boost's is wrong by 3e-9.
  const DoubleDouble k = 1.0 - DoubleDouble(1e-9);
  const auto mod = ExactModulus::from_pair(k * k, (1.0 - k) * (1.0 + k));
  worst.add(
      relative_error(elliptic::heuman_lambda0(T(1.5), as<T>(mod)), exact_heuman_lambda0(1.5, mod)),
      "k = 1 - 1e-9");
  EXPECT_LE(worst.units(), budget::elliptic_heuman) << worst.where();
}

TYPED_TEST(CompleteIntegrals, HeumanLimits) {
  using T = TypeParam;
  const T zero(0.0), one(1.0), half_pi = T(0.5) * pi<T>();
  const auto generic = elliptic::BasicModulus<T>::from_ratio(one, T(3.0));
  const auto full = elliptic::BasicModulus<T>::from_ratio(one, zero);
  const auto flat = elliptic::BasicModulus<T>::from_ratio(zero, one);
  EXPECT_EQ(elliptic::heuman_lambda0(zero, generic), zero);
  EXPECT_EQ(elliptic::heuman_lambda0(one, zero, generic), one);
  EXPECT_EQ(elliptic::heuman_lambda0(-one, zero, flat), -one);
  EXPECT_EQ(elliptic::heuman_lambda0(half_pi, full), one);
  // not 2: pi<T>() is no half turn
  this->worst_.add(std::abs(to_double(elliptic::heuman_lambda0(pi<T>(), generic) / T(2.0) - one)),
                   "pi");
  using std::sin;
  this->worst_.add(std::abs(to_double(elliptic::heuman_lambda0(T(0.7), flat) / sin(T(0.7)) - one)),
                   "m = 0");
  // Quasi-period.
  const T inside = elliptic::heuman_lambda0(T(0.25), generic);
  this->worst_.add(
      std::abs(to_double(elliptic::heuman_lambda0(T(0.25) + T(3.0) * pi<T>(), generic) - inside)) /
              6.0 -
          1.0,
      "psi + 3 pi");
}

// d/dm of K, E, B, D, Pi, q and Lambda0 by Dual.
template <class T>
class CompleteDerivatives : public ::testing::Test {};
TYPED_TEST_SUITE(CompleteDerivatives, Real2);

TYPED_TEST(CompleteDerivatives, ByModulus) {
  using T = TypeParam;
  using D = Dual<T, 2>;
  oracle::Draw draw(57, 0);
  WorstUnits<T> worst;
  for (int i = 0; i < 60; ++i) {
    const ExactModulus mod =
        i % 3 == 0 ? drawn_modulus<T>(draw, Near::one) : drawn_modulus<T>(draw, Near::generic);
    const elliptic::BasicModulus<T> base = as<T>(mod);
    const D m = D::variable(base.m(), 0);
    const auto used = elliptic::BasicModulus<D>::from_pair(m, D(base.m1(), (-m).derivative));
    const std::string at = listed(mod.m(), mod.m1());
    const auto check = [&](const char* name, const D& got, const Exact& exact) {
      worst.add(relative_error(wide(got.derivative[0]), exact), name + at);
    };
    check("K ", elliptic::complete_k(used), exact_complete(Complete::k, mod, Along::modulus));
    check("E ", elliptic::complete_e(used), exact_complete(Complete::e, mod, Along::modulus));
    check("D ", elliptic::complete_d(used), exact_complete(Complete::d, mod, Along::modulus));
    check("q ", elliptic::nome(used), exact_nome(mod, Along::modulus));
    if (i % 3 == 0) continue;
    check("B ", elliptic::complete_b(used), exact_complete(Complete::b, mod, Along::modulus));
    const double n = drawn(draw, -2.0, 0.9);
    const D pi_n = elliptic::complete_pi(D::variable(T(n), 1), used);
    check("Pi ", pi_n, exact_complete_pi(n, mod, Along::modulus));
    worst.add(
        relative_error(wide(pi_n.derivative[1]), exact_complete_pi(n, mod, Along::characteristic)),
        "dPi/dn " + listed(n) + at);
  }
  EXPECT_LE(worst.units(), budget::elliptic_complete_derivative) << worst.where();
}

// At m = 0, where (E - m1 K)/(2 m m1) is 0/0: dK/dm = pi/8.
TYPED_TEST(CompleteDerivatives, AtZero) {
  using T = TypeParam;
  using D = Dual<T, 1>;
  const D m = D::variable(T(0.0), 0);
  const auto mod = elliptic::BasicModulus<D>::from_pair(m, T(1.0) - m);
  WorstUnits<T> worst;
  worst.add(std::abs(to_double(elliptic::complete_k(mod).derivative[0] / pi<T>() - T(0.125))), "K");
  worst.add(std::abs(to_double(elliptic::complete_e(mod).derivative[0] / pi<T>() + T(0.125))), "E");
  worst.add(std::abs(to_double(elliptic::nome(mod).derivative[0] - T(0.0625))), "q");
  EXPECT_LE(worst.units(), budget::elliptic_complete_derivative) << worst.where();
}

}  // namespace
}  // namespace polhode::test
