// SPDX-License-Identifier: MIT
// Elliptic integrals and functions from Boost.Math at 60 digits (350 where the modulus needs them).
// Light: multiprecision stays in exact.cpp.
#pragma once

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode::test {

// A reference value to 159 bits.
struct Exact {
  double a;
  double b;
  double c;
};

// (computed - exact) / exact; 0 for 0 = 0 and inf = inf.
double relative_error(DoubleDouble computed, const Exact& exact);
double absolute_error(DoubleDouble computed, const Exact& exact);

using ExactModulus =
    elliptic::BasicModulus<DoubleDouble>;  // the smaller member counts, the other is 1 minus

// Partial derivatives: `by` names the argument, none the value itself.
enum class By { none, first, second, third, fourth };
// Arguments of Legendre's integrals and of the Jacobi functions.
enum class Along { none, amplitude, argument, modulus, characteristic };

Exact exact_rf(DoubleDouble x, DoubleDouble y, DoubleDouble z, By by = By::none);
Exact exact_rc(DoubleDouble x, DoubleDouble y, By by = By::none);
Exact exact_rd(DoubleDouble x, DoubleDouble y, DoubleDouble z, By by = By::none);
Exact exact_rj(DoubleDouble x, DoubleDouble y, DoubleDouble z, DoubleDouble p, By by = By::none);

enum class Complete { k, e, b, d };
Exact exact_complete(Complete kind, const ExactModulus& mod, Along along = Along::none);
Exact exact_complete_pi(DoubleDouble n, const ExactModulus& mod, Along along = Along::none);
// Bulirsch's cel by quadrature.
Exact exact_cel(DoubleDouble kc, DoubleDouble p, DoubleDouble a, DoubleDouble b);

enum class Legendre { f, e, d, pi };
// phi = atan2(s, c); n is used by pi alone.
Exact exact_legendre(Legendre kind, DoubleDouble s, DoubleDouble c, DoubleDouble n,
                     const ExactModulus& mod, Along along = Along::none);

struct ExactJacobi {
  Exact sn;
  Exact cn;
  Exact dn;
};
ExactJacobi exact_jacobi(DoubleDouble u, const ExactModulus& mod, Along along = Along::none);

Exact exact_nome(const ExactModulus& mod, Along along = Along::none);
Exact exact_heuman_lambda0(DoubleDouble psi, const ExactModulus& mod);

}  // namespace polhode::test
