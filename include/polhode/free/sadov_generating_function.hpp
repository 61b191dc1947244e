// SPDX-License-Identifier: MIT
// The generating functions W and V of section 5 that turn Andoyer's variables into Sadov's, and
// the quadratures that they are made of.
//
// Equations   W(l, g, h; I_l, I_g, I_h) = I_g g + I_h h + V(l; I_l, I_g), V = int L dl from pi/2
//             (long-axis mode: from lobe times pi/2). dW/d(l, g, h) = (L, G, H), dW/d(I_l, I_g,
//             I_h) = (phi_l, phi_g, phi_h) [SA "ActioTransf", "transf. eqs"]. V is homogeneous of
//             degree 1 in the actions, so V = I_l phi_l + I_g (phi_g - g) and W = I_l phi_l + I_g
//             phi_g + I_h phi_h. sadov_quadratures: [SA "SadovPar", "changeAction", "IellSadov",
//             "dI_l/dlambda", "partialPhiU", "phiSadovProv", "quad dL/dlambda", "quad L dl",
//             "phiSadov"]; for lambda > 1 K(1/lambda)/lambda stands for K, and so F and Pi.
// Corrections [SA "transf. eqs"], [SA "quad L dl"]: docs/theory/errata.md.
// Branches    W is multivalued: the branch is that of s, whose I_l, I_g, I_h, region and lobe are
//             arguments and whose angles are any real numbers. The result has the phi_l, phi_g,
//             phi_h nearest to those of s, and W with g and h in the same revolution. In long-axis
//             mode two momenta, L and -L, have the same l; the result is the one with the nearer
//             phi_l. Along a motion whose unwrapped angles s has, W is continuous.
// Units       W and V are actions, in the units of momentum; angles in radians.
// Domain      l, g, h: any; in the long-axis region l within the libration about lobe times pi/2.
//             Refers to the body axes sorted by moment. Actions inside their region, |I_l| < I_g
//             (long-axis: I_l > 0), off the separatrix; a sphere: V = I_l (l - pi/2). At the end of
//             a libration, L = 0, the two branches meet and dL/dl is not finite.
//             sadov_quadratures: kappa > 0, lambda > 0 and not 1, L > 0. For L < 0 I_l, its
//             derivatives by lambda and I_l, both integrals and phi_g - g change sign.
// Accuracy    budgets generating_* in tests/budgets.hpp. sadov_quadratures evaluates the
//             paper's formulas in double: where their terms cancel (kappa or lambda far from 1)
//             they lose digits that sadov_generating_function keeps.
// Errors      DomainError outside the domain.
// Cost        about a hundred microseconds; a few for the quadratures.
#pragma once

#include "polhode/free/sadov.hpp"

namespace polhode {
inline namespace v0 {

struct SadovGeneratingFunction {
  double W;
  double V;
  // dW/d(l, g, h)
  double L;
  double G;
  double H;
  // dW/d(I_l, I_g, I_h)
  double phi_l;
  double phi_g;
  double phi_h;

  constexpr bool operator==(const SadovGeneratingFunction&) const = default;
};

// W(l, g, h; s.I_l, s.I_g, s.I_h) on the branch of s.
SadovGeneratingFunction sadov_generating_function(const Body& body, double l, double g, double h,
                                                  const SadovState& s);

// Sadov's constant of the body and state function of the motion [SA "SadovPar"].
struct SadovParameters {
  double kappa;
  double lambda;

  constexpr bool operator==(const SadovParameters&) const = default;
};
SadovParameters sadov_parameters(const Body& body, double G, double T);

struct SadovQuadratures {
  double z;              // auxiliary angle of l [SA "changeAction"]
  double I_l;            // (1/2pi) of the loop integral of L dl
  double dI_l_dlambda;   // at constant I_g
  double dlambda_dI_l;   // at constant I_g
  double dlambda_dI_g;   // at constant I_l
  double L_dl;           // int L dl from z = 0
  double dL_dlambda_dl;  // int dL/dlambda dl from z = 0
  double phi_l;
  double phi_g_minus_g;

  constexpr bool operator==(const SadovQuadratures&) const = default;
};
SadovQuadratures sadov_quadratures(const SadovParameters& p, double I_g, double l);

}  // namespace v0
}  // namespace polhode
