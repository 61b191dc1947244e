// SPDX-License-Identifier: MIT
// Canonical rates: torques without energy, every chart against the motion itself, and what is
// answered at the singularities.
#include "polhode/system/canonical_rates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode/system/andoyer_method.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using polhode::test::larger;
using Six = std::array<double, 6>;

constexpr CanonicalChart euler{CanonicalSet::euler};
constexpr CanonicalChart andoyer{CanonicalSet::andoyer};

// A torque with no energy: damping, and a push that turns with time.
struct Push {
  template <Real T>
  BasicVec3<T> operator()(const T& t, const BasicRotorState<T>& s) const {
    using std::sin;
    return BasicVec3<T>{T(0.3) * T(sin(t)), T(-0.1), T(0.2)} - T(0.05) * s.g;
  }
};

System pushed_in_a_frame() {
  return System(Body(3, 4, 6), Frame::precessing({1, 2, -1}, 0.2),
                {AnyPerturbation("push", TorqueTerm(Push{}))});
}

const RotorState generic{normalized(Quaternion{0.5, -0.7, 0.3, 0.4}), {1.2, -0.7, 2.1}};

// One small step of the hub rates as they stand: q exp(w h/2), g + h dg/dt. A central difference of
// it is good to h^2.
RotorState stepped(const rates::HubRates& rates, const RotorState& s, double h) {
  const Vec3 half = 0.5 * h * rates.theta;
  const double angle = norm(half), sinc = angle == 0.0 ? 1.0 : std::sin(angle) / angle;
  const Quaternion turn{std::cos(angle), sinc * half.x, sinc * half.y, sinc * half.z};
  return {s.q * turn, s.g + h * rates.g};
}

Six numbers(const EulerState& e) { return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi}; }
Six numbers(const AndoyerState& a) { return {a.l, a.g, a.h, a.L, a.G, a.H}; }
Six numbers(const PoincareState& p) { return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2}; }

// Fourth-order differences of a chart along the step.
template <class F>
void expect_differences(const rates::CanonicalRates& rates, const System& system, double t,
                        F chart) {
  const double h = 1e-3;
  const rates::HubRates hub = rates::hub_rates(system, t, generic);
  const auto at = [&](double x) { return numbers(chart(stepped(hub, generic, x))); };
  const Six m2 = at(-2 * h), m1 = at(-h), p1 = at(h), p2 = at(2 * h);
  for (std::size_t i = 0; i < 6; ++i) {
    const double difference = (8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12.0 * h);
    EXPECT_NEAR(rates[i], difference, budget::rates_by_differences) << i;
  }
}

TEST(CanonicalRates, TorquesWithoutEnergyInEveryChart) {
  const System system = pushed_in_a_frame();
  const double t = 0.7;
  expect_differences(rates::canonical_rates(system, t, generic, euler), system, t,
                     [](const RotorState& s) { return to_euler(s); });
  expect_differences(rates::canonical_rates(system, t, generic, andoyer), system, t,
                     [](const RotorState& s) { return to_andoyer(s); });
  for (const Pole J : {Pole::zero, Pole::pi}) {
    for (const Pole I : {Pole::zero, Pole::pi}) {
      expect_differences(rates::canonical_rates(system, t, generic, {CanonicalSet::poincare, J, I}),
                         system, t, [&](const RotorState& s) { return to_poincare(s, J, I); });
    }
  }
}

TEST(CanonicalRates, HubRatesAreThoseOfTheSystem) {
  const System system = pushed_in_a_frame();
  const rates::HubRates hub = rates::hub_rates(system, 0.7, generic);
  const RotorRates rates = rotor_rates(system, 0.7, generic);
  const Quaternion half = conj(generic.q) * rates.q;
  const Vec3 w{2 * half.x, 2 * half.y, 2 * half.z};
  EXPECT_LT(norm(hub.theta - w), budget::rates_rounding);
  EXPECT_LT(norm(hub.g - rates.g), budget::rates_rounding);
  const rates::HubRates added = rates::perturbation_rates(system, 0.7, generic);
  const rates::HubRates unperturbed = rates::hub_rates(System(system.body()), 0.7, generic);
  EXPECT_LT(norm(added.theta + unperturbed.theta - hub.theta), budget::rates_rounding);
  EXPECT_LT(norm(added.g + unperturbed.g - hub.g), budget::rates_rounding);
  EXPECT_EQ(rates::perturbation_rates(System(system.body()), 0.7, generic), rates::HubRates{});
}

// A torque moves Andoyer's angles, but makes no convective term in Euler's: v = 0.
TEST(CanonicalRates, ConvectiveTermOfATorque) {
  const System system(Body(3, 4, 6), Frame::inertial(),
                      {AnyPerturbation("push", TorqueTerm(Push{}))});
  for (const double rate : rates::convective_term(system, 0.7, generic, euler))
    EXPECT_EQ(rate, 0.0);
  EXPECT_NE(rates::convective_term(system, 0.7, generic, andoyer)[0], 0.0);
  EXPECT_EQ(effect(system, 0.7, generic).v, Vec3{});
}

// Spin about b3 (J = 0) whose momentum leans: l and g do not exist, h and the momenta do.
TEST(CanonicalRates, AtTheSingularities) {
  const System system = pushed_in_a_frame();
  const RotorState spin{generic.q, {0.0, 0.0, 2.0}};
  const rates::AndoyerRates a = rates::andoyer_rates(system, 0.7, spin);
  EXPECT_TRUE(std::isnan(a.l));
  EXPECT_TRUE(std::isnan(a.g));
  const rates::HubRates hub = rates::hub_rates(system, 0.7, spin);
  EXPECT_NEAR(a.L, hub.g.z, budget::rates_rounding);
  EXPECT_NEAR(a.G, hub.g.z, budget::rates_rounding);  // g is along b3
  const auto of_poincare = rates::canonical_rates(system, 0.7, spin, {CanonicalSet::poincare});
  for (const double rate : of_poincare) EXPECT_TRUE(std::isfinite(rate));
  const rates::AndoyerRates next_to_it =
      rates::andoyer_rates(system, 0.7, RotorState{spin.q, {1e-7, 0.0, 2.0}});
  EXPECT_NEAR(a.h, next_to_it.h, budget::rates_next_to_pole);
  EXPECT_NEAR(a.H, next_to_it.H, budget::rates_next_to_pole);

  // I = J = 0 and I = pi, J = 0: what is left is the momenta
  for (const Quaternion& q : {Quaternion{1, 0, 0, 0}, Quaternion{0, 1, 0, 0}}) {
    const rates::AndoyerRates b = rates::andoyer_rates(system, 0.7, RotorState{q, {0.0, 0.0, 2.0}});
    EXPECT_TRUE(std::isnan(b.l) && std::isnan(b.g) && std::isnan(b.h));
    const double sign = rotate(q, Vec3{0.0, 0.0, 1.0}).z;
    const Vec3 u = rates::hub_rates(system, 0.7, RotorState{q, {0.0, 0.0, 2.0}}).g;
    EXPECT_NEAR(b.L, u.z, budget::rates_rounding);
    EXPECT_NEAR(b.G, u.z, budget::rates_rounding);
    EXPECT_NEAR(b.H, sign * u.z, budget::rates_rounding);
  }

  // at rest: L and H move with the torque
  const RotorState rest{generic.q, {}};
  const rates::AndoyerRates c = rates::andoyer_rates(system, 0.7, rest);
  const Vec3 u = Push{}(0.7, rest);
  EXPECT_TRUE(std::isnan(c.l) && std::isnan(c.g) && std::isnan(c.h) && std::isnan(c.G));
  EXPECT_NEAR(c.L, u.z, budget::rates_rounding);
  EXPECT_NEAR(c.H, rotate(generic.q, u).z, budget::rates_rounding);
  for (const double rate : rates::canonical_rates(system, 0.7, rest, {CanonicalSet::poincare}))
    EXPECT_TRUE(std::isnan(rate));

  // theta = 0: phi and psi do not exist
  const RotorState upright{{1, 0, 0, 0}, {0.5, 0.2, 1.0}};
  const rates::EulerPhaseRates e = rates::euler_phase_rates(system, 0.7, upright);
  EXPECT_TRUE(std::isnan(e.phi));
  EXPECT_TRUE(std::isnan(e.psi));
  EXPECT_TRUE(std::isfinite(e.theta));
  EXPECT_TRUE(std::isfinite(e.Psi));
}

TEST(CanonicalRates, NaNInNaNOut) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const rates::AndoyerRates a =
      rates::andoyer_rates(pushed_in_a_frame(), 0.0, RotorState{generic.q, {none, 0.0, 1.0}});
  EXPECT_TRUE(std::isnan(a.l) && std::isnan(a.G) && std::isnan(a.H));
}

// canonical_defect is a number that users read: the largest |[z_k, z_l] - J| over the sum of the
// magnitudes of the terms of [z_k, z_l], here term by term in the indices.

// The Levi-Civita symbol.
int parity(int i, int j, int k) { return (i - j) * (j - k) * (k - i) / 2; }

struct Bracket {
  long double value = 0, size = 0;

  void add(long double term) {
    value += term;
    size += std::abs(term);
  }
};

// theta_k . g_l - g_k . theta_l - theta_k . (g x theta_l), columns of B.
Bracket bracket(const rates::detail::VariablesAt& at, int k, int l) {
  Bracket b;
  for (int i = 0; i < 3; ++i) {
    b.add(static_cast<long double>(at.B(i, k)) * at.B(3 + i, l));
    b.add(-static_cast<long double>(at.B(3 + i, k)) * at.B(i, l));
    for (int m = 0; m < 3; ++m)
      for (int n = 0; n < 3; ++n)
        if (parity(i, m, n) != 0)
          b.add(-static_cast<long double>(at.B(i, k)) * parity(i, m, n) * at.s.g[m] * at.B(n, l));
  }
  return b;
}

TEST(AndoyersMethod, DefectIsOfTheSizeOfItsTerms) {
  std::mt19937_64 random(2024);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int draw = 0; draw < 40; ++draw) {
    rates::detail::VariablesAt at{
        {{}, {uniform(random), uniform(random), uniform(random)}}, {}, {}};
    // A column alone stands out, so that every pair is the worst in some draw.
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) at.B(i, j) = uniform(random) * (j == draw % 6 ? 30.0 : 1.0);
    long double worst = 0;
    for (int k = 0; k < 6; ++k) {
      for (int l = k + 1; l < 6; ++l) {
        const Bracket b = bracket(at, k, l);
        EXPECT_NEAR(rates::detail::lagrange_brackets(at)(k, l), static_cast<double>(b.value),
                    budget::andoyer_method * static_cast<double>(b.size));
        const long double J = l == k + 3 ? 1 : 0;
        const long double defect = std::abs(b.value - J) / larger(J, b.size);
        worst = larger(worst, defect);
      }
    }
    EXPECT_NEAR(rates::detail::canonical_defect(at), static_cast<double>(worst),
                budget::andoyer_method);
  }
}

// Andoyer's method: brackets of canonical and other sets, sets that depend on time, torques without
// energy. Whatever the variables, the hub must move as the system says.

struct Euler {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z) const {
    return to_rotor(BasicEulerState<T>{z[0], z[1], z[2], z[3], z[4], z[5]});
  }
};
struct Andoyer {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z) const {
    return to_rotor(BasicAndoyerState<T>{z[0], z[1], z[2], z[3], z[4], z[5]});
  }
};
struct Poincare {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z) const {
    return to_rotor(BasicPoincareState<T>{z[0], z[1], z[2], z[3], z[4], z[5], {}, {}});
  }
};
// (l, g, h, J, G, I): angles in place of two momenta, not canonical.
struct Inclinations {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z) const {
    using std::cos;
    return to_rotor(BasicAndoyerState<T>{z[0], z[1], z[2], T(z[4] * T(cos(z[3]))), z[4],
                                         T(z[4] * T(cos(z[5])))});
  }
};
// Quaternion by a rotation vector (through tan of a quarter), and the angular velocity, in odd
// units.
struct RatesAndVector {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z) const {
    return {{T(1.0), z[0], z[1], z[2]}, {T(3e6) * z[3], T(4e6) * z[4], T(6e6) * z[5]}};
  }
};
// Initial values of an axisymmetric free body, a set that depends on time and is canonical: l = l0
// + L (1/I3 - 1/I1) t, g = g0 + G t/I1.
struct InitialValues {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z, const T& t) const {
    const T slow(1.0 / 6.0 - 1.0 / 4.0), fast(0.25);
    return to_rotor(BasicAndoyerState<T>{T(z[0] + slow * z[3] * t), T(z[1] + fast * z[4] * t), z[2],
                                         z[3], z[4], z[5]});
  }
};
// Elements as seen from axes that turn about the third: depends on time, and the angle is scaled.
struct TurningScaled {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z, const T& t) const {
    return to_rotor(BasicAndoyerState<T>{T(T(2.0) * z[0]), z[1], T(z[2] + T(0.7) * t * t), z[3],
                                         z[4], T(z[5] * (T(1.0) + T(0.1) * t))});
  }
};

const rates::Variables<double> variables{0.7, -1.1, 2.0, 0.4, 1.3, -0.5};
const rates::Variables<double> generic_euler{0.7, 1.1, 2.0, 0.4, 0.6, -0.5};
const rates::Variables<double> generic_poincare{0.7, 0.3, -0.4, 1.3, 0.6, 0.5};
const rates::Variables<double> generic_inclinations{0.7, -1.1, 2.0, 1.2, 1.3, 0.8};

struct Energy {
  template <class T>
  T operator()(const T& t, const BasicRotorState<T>& s) const {
    const BasicVec3<T> G = rotate(s.q, s.g);
    return T(0.1) * s.g.x * s.g.y + T(0.2) * G.x * t + T(0.05) * G.z * s.g.z;
  }
};
System system_of(const Body& body) {
  return System(body, Frame::precessing({1, 2, -1}, 0.2),
                {AnyPerturbation("energy", HamiltonianTerm(Energy{})),
                 AnyPerturbation("push", TorqueTerm(Push{}))});
}

// B dz/dt + dB/dt is the motion of the hub; against the system's own, relative to their sizes.
template <class F>
double hub_defect(const F& f, const System& system, double t, const rates::Variables<double>& z) {
  const Six rates = rates::equations_of_motion(system, t, z, f);
  const rates::detail::VariablesAt at = rates::detail::variables_at(f, t, z);
  const rates::HubRates hub = rates::hub_rates(system, t, {normalized(at.s.q), at.s.g});
  const Six expected{hub.theta.x, hub.theta.y, hub.theta.z, hub.g.x, hub.g.y, hub.g.z};
  test::Worst worst;
  for (int i = 0; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(i);
    double moved = at.by_t[k], size = std::abs(expected[k]) + std::abs(moved);
    for (int j = 0; j < 6; ++j) {
      moved += at.B(i, j) * rates[static_cast<std::size_t>(j)];
      size += std::abs(at.B(i, j) * rates[static_cast<std::size_t>(j)]);
    }
    const double defect = std::abs(moved - expected[k]) / size;
    worst.add(defect);
  }
  return worst.value();
}

TEST(AndoyersMethod, CanonicalSetsAreCanonical) {
  EXPECT_LT(rates::canonical_defect(Euler{}, generic_euler), budget::andoyer_method);
  EXPECT_LT(rates::canonical_defect(Andoyer{}, variables), budget::andoyer_method);
  EXPECT_LT(rates::canonical_defect(Poincare{}, generic_poincare), budget::andoyer_method);
  EXPECT_LT(rates::canonical_defect(InitialValues{}, variables, 3.0), budget::andoyer_method);
}

TEST(AndoyersMethod, OthersAreNot) {
  EXPECT_GT(rates::canonical_defect(Inclinations{}, generic_inclinations), budget::not_canonical);
  EXPECT_GT(rates::canonical_defect(RatesAndVector{}, variables), budget::not_canonical);
  EXPECT_GT(rates::canonical_defect(TurningScaled{}, variables, 1.0), budget::not_canonical);
  // a scaled angle with its momentum divided is canonical again
  const auto paired = []<Real T>(const rates::Variables<T>& z) {
    return to_rotor(
        BasicAndoyerState<T>{T(T(2.0) * z[0]), z[1], z[2], T(T(0.5) * z[3]), z[4], z[5]});
  };
  EXPECT_LT(rates::canonical_defect(paired, variables), budget::andoyer_method);
}

// [SA "Lagrange brackets"] [l, J] = -G sin J, [l, G] = cos J, [g, G] = 1, [h, G] = cos I, [h, I] =
// -G sin I: those of L = G cos J, H = G cos I
TEST(AndoyersMethod, BracketsOfInclinations) {
  const Matrix6 b = rates::lagrange_brackets(Inclinations{}, generic_inclinations);
  const double J = generic_inclinations[3], G = generic_inclinations[4];
  const double I = generic_inclinations[5];
  Matrix6 expected;
  const auto set = [&](int k, int l, double x) {
    expected(k, l) = x;
    expected(l, k) = -x;
  };
  set(0, 3, -G * std::sin(J));
  set(0, 4, std::cos(J));
  set(1, 4, 1.0);
  set(2, 4, std::cos(I));
  set(2, 5, -G * std::sin(I));
  for (int k = 0; k < 6; ++k)
    for (int l = 0; l < 6; ++l)
      EXPECT_NEAR(b(k, l), expected(k, l), budget::andoyer_method) << k << ", " << l;
}

// [SA "linear", "eqHam"]
TEST(AndoyersMethod, CanonicalSetsMoveAtTheirCanonicalRates) {
  const System system = system_of(Body(3, 4, 6));
  const auto compare = [&](const auto& f, const CanonicalChart& chart,
                           const rates::Variables<double>& z) {
    const Six rates = rates::equations_of_motion(system, 0.4, z, f);
    const Six expected = rates::canonical_rates(system, 0.4, f(z), chart);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(rates[i], expected[i], budget::andoyer_method) << i;
  };
  compare(Euler{}, {CanonicalSet::euler}, generic_euler);
  compare(Andoyer{}, {CanonicalSet::andoyer}, variables);
  compare(Poincare{}, {CanonicalSet::poincare}, generic_poincare);
}

TEST(AndoyersMethod, WhateverTheVariablesTheHubMovesTheSame) {
  const System system = system_of(Body(3, 4, 6)), symmetric = system_of(Body(4, 4, 6));
  EXPECT_LT(hub_defect(Euler{}, system, 0.4, generic_euler), budget::andoyer_method);
  EXPECT_LT(hub_defect(Poincare{}, system, 0.4, generic_poincare), budget::andoyer_method);
  EXPECT_LT(hub_defect(Inclinations{}, system, 0.4, generic_inclinations), budget::andoyer_method);
  EXPECT_LT(hub_defect(RatesAndVector{}, system, 0.4, variables), budget::andoyer_method);
  EXPECT_LT(hub_defect(TurningScaled{}, system, 0.4, variables), budget::andoyer_method);
  EXPECT_LT(hub_defect(InitialValues{}, symmetric, 0.4, variables), budget::andoyer_method);
}

// The initial values of the unperturbed axisymmetric body stand still.
TEST(AndoyersMethod, ConstantsOfFreeMotionAreConstant) {
  for (const double rate :
       rates::equations_of_motion(System(Body(4, 4, 6)), 5.0, variables, InitialValues{}))
    EXPECT_NEAR(rate, 0.0, budget::andoyer_method);
}

// Six variables of which two say the same.
TEST(AndoyersMethod, SingularSetsAnswerNaN) {
  const auto twice = []<Real T>(const rates::Variables<T>& z) {
    return to_rotor(BasicAndoyerState<T>{T(z[0] + z[1]), z[2], T(0.3), z[3], z[4], z[5]});
  };
  for (const double rate : rates::equations_of_motion(System(Body(3, 4, 6)), 0.0, variables, twice))
    EXPECT_TRUE(std::isnan(rate));
}

}  // namespace
}  // namespace polhode::test
