// SPDX-License-Identifier: MIT
// Andoyer's method: brackets of canonical and other sets, sets that depend on time, torques without
// energy. Whatever the variables, the hub must move as the system says.
#include "polhode/system/andoyer_method.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using Six = std::array<double, 6>;

struct Euler {
  template <Real T>
  BasicRotorState<T> operator()(const Variables<T>& z) const {
    return to_rotor(BasicEulerState<T>{z[0], z[1], z[2], z[3], z[4], z[5]});
  }
};
struct Andoyer {
  template <Real T>
  BasicRotorState<T> operator()(const Variables<T>& z) const {
    return to_rotor(BasicAndoyerState<T>{z[0], z[1], z[2], z[3], z[4], z[5]});
  }
};
struct Poincare {
  template <Real T>
  BasicRotorState<T> operator()(const Variables<T>& z) const {
    return to_rotor(BasicPoincareState<T>{z[0], z[1], z[2], z[3], z[4], z[5], {}, {}});
  }
};
// (l, g, h, J, G, I): angles in place of two momenta, not canonical.
struct Inclinations {
  template <Real T>
  BasicRotorState<T> operator()(const Variables<T>& z) const {
    using std::cos;
    return to_rotor(BasicAndoyerState<T>{z[0], z[1], z[2], T(z[4] * T(cos(z[3]))), z[4],
                                         T(z[4] * T(cos(z[5])))});
  }
};
// Quaternion by a rotation vector (through tan of a quarter), and the angular velocity, in odd
// units.
struct RatesAndVector {
  template <Real T>
  BasicRotorState<T> operator()(const Variables<T>& z) const {
    return {{T(1.0), z[0], z[1], z[2]}, {T(3e6) * z[3], T(4e6) * z[4], T(6e6) * z[5]}};
  }
};
// Initial values of an axisymmetric free body, a set that depends on time and is canonical: l = l0
// + L (1/I3 - 1/I1) t, g = g0 + G t/I1.
struct InitialValues {
  template <Real T>
  BasicRotorState<T> operator()(const Variables<T>& z, const T& t) const {
    const T slow(1.0 / 6.0 - 1.0 / 4.0), fast(0.25);
    return to_rotor(BasicAndoyerState<T>{T(z[0] + slow * z[3] * t), T(z[1] + fast * z[4] * t), z[2],
                                         z[3], z[4], z[5]});
  }
};
// Elements as seen from axes that turn about the third: depends on time, and the angle is scaled.
struct TurningScaled {
  template <Real T>
  BasicRotorState<T> operator()(const Variables<T>& z, const T& t) const {
    return to_rotor(BasicAndoyerState<T>{T(T(2.0) * z[0]), z[1], T(z[2] + T(0.7) * t * t), z[3],
                                         z[4], T(z[5] * (T(1.0) + T(0.1) * t))});
  }
};

const Variables<double> generic{0.7, -1.1, 2.0, 0.4, 1.3, -0.5};
const Variables<double> generic_euler{0.7, 1.1, 2.0, 0.4, 0.6, -0.5};
const Variables<double> generic_poincare{0.7, 0.3, -0.4, 1.3, 0.6, 0.5};
const Variables<double> generic_inclinations{0.7, -1.1, 2.0, 1.2, 1.3, 0.8};

struct Energy {
  template <class T>
  T operator()(const T& t, const BasicRotorState<T>& s) const {
    const BasicVec3<T> G = rotate(s.q, s.g);
    return T(0.1) * s.g.x * s.g.y + T(0.2) * G.x * t + T(0.05) * G.z * s.g.z;
  }
};
struct Push {
  template <Real T>
  BasicVec3<T> operator()(const T& t, const BasicRotorState<T>& s) const {
    using std::sin;
    return BasicVec3<T>{T(0.3) * T(sin(t)), T(-0.1), T(0.2)} - T(0.05) * s.g;
  }
};
System system_of(const Body& body) {
  return System(body, Frame::precessing({1, 2, -1}, 0.2),
                {AnyPerturbation("energy", HamiltonianTerm(Energy{})),
                 AnyPerturbation("push", TorqueTerm(Push{}))});
}

// B dz/dt + dB/dt is the motion of the hub; against the system's own, relative to their sizes.
template <class F>
double hub_defect(const F& f, const System& system, double t, const Variables<double>& z) {
  const Six rates = equations_of_motion(f, system, t, z);
  const detail::VariablesAt at = detail::variables_at(f, t, z);
  const HubRates hub = hub_rates(system, t, {normalized(at.s.q), at.s.g});
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
  EXPECT_LT(canonical_defect(Euler{}, generic_euler), budget::andoyer_method);
  EXPECT_LT(canonical_defect(Andoyer{}, generic), budget::andoyer_method);
  EXPECT_LT(canonical_defect(Poincare{}, generic_poincare), budget::andoyer_method);
  EXPECT_LT(canonical_defect(InitialValues{}, generic, 3.0), budget::andoyer_method);
}

TEST(AndoyersMethod, OthersAreNot) {
  EXPECT_GT(canonical_defect(Inclinations{}, generic_inclinations), budget::not_canonical);
  EXPECT_GT(canonical_defect(RatesAndVector{}, generic), budget::not_canonical);
  EXPECT_GT(canonical_defect(TurningScaled{}, generic, 1.0), budget::not_canonical);
  // a scaled angle with its momentum divided is canonical again
  const auto paired = []<Real T>(const Variables<T>& z) {
    return to_rotor(
        BasicAndoyerState<T>{T(T(2.0) * z[0]), z[1], z[2], T(T(0.5) * z[3]), z[4], z[5]});
  };
  EXPECT_LT(canonical_defect(paired, generic), budget::andoyer_method);
}

// [SA "Lagrange brackets"] [l, J] = -G sin J, [l, G] = cos J, [g, G] = 1, [h, G] = cos I, [h, I] =
// -G sin I: those of L = G cos J, H = G cos I
TEST(AndoyersMethod, BracketsOfInclinations) {
  const Matrix6 b = lagrange_brackets(Inclinations{}, generic_inclinations);
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
  const auto compare = [&](const auto& f, const CanonicalChart& chart, const Variables<double>& z) {
    const Six rates = equations_of_motion(f, system, 0.4, z);
    const Six expected = canonical_rates(chart, system, 0.4, f(z));
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(rates[i], expected[i], budget::andoyer_method) << i;
  };
  compare(Euler{}, {CanonicalSet::euler}, generic_euler);
  compare(Andoyer{}, {CanonicalSet::andoyer}, generic);
  compare(Poincare{}, {CanonicalSet::poincare}, generic_poincare);
}

TEST(AndoyersMethod, WhateverTheVariablesTheHubMovesTheSame) {
  const System system = system_of(Body(3, 4, 6)), symmetric = system_of(Body(4, 4, 6));
  EXPECT_LT(hub_defect(Euler{}, system, 0.4, generic_euler), budget::andoyer_method);
  EXPECT_LT(hub_defect(Poincare{}, system, 0.4, generic_poincare), budget::andoyer_method);
  EXPECT_LT(hub_defect(Inclinations{}, system, 0.4, generic_inclinations), budget::andoyer_method);
  EXPECT_LT(hub_defect(RatesAndVector{}, system, 0.4, generic), budget::andoyer_method);
  EXPECT_LT(hub_defect(TurningScaled{}, system, 0.4, generic), budget::andoyer_method);
  EXPECT_LT(hub_defect(InitialValues{}, symmetric, 0.4, generic), budget::andoyer_method);
}

// The initial values of the unperturbed axisymmetric body stand still.
TEST(AndoyersMethod, ConstantsOfFreeMotionAreConstant) {
  for (const double rate :
       equations_of_motion(InitialValues{}, System(Body(4, 4, 6)), 5.0, generic))
    EXPECT_NEAR(rate, 0.0, budget::andoyer_method);
}

// Six variables of which two say the same.
TEST(AndoyersMethod, SingularSetsAnswerNaN) {
  const auto twice = []<Real T>(const Variables<T>& z) {
    return to_rotor(BasicAndoyerState<T>{T(z[0] + z[1]), z[2], T(0.3), z[3], z[4], z[5]});
  };
  for (const double rate : equations_of_motion(twice, System(Body(3, 4, 6)), 0.0, generic))
    EXPECT_TRUE(std::isnan(rate));
}

}  // namespace
