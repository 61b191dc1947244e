// SPDX-License-Identifier: MIT
// The generating function S of section 3.1 that turns Euler's variables into Serret's constants, as
// a function of the Euler angles, of G, H, T and of time, with all its derivatives.
//
// Equations   S(q; P, t) = -t T + G h cos I + G g + G int cos J dl, q = (phi, theta, psi), P = (G,
//             H, T) [SA (36)-(51)], evaluated as (t - 2 t0) T + H h + G g0 [SA (52)-(55)]. dS/dq =
//             momenta, dS/dG = g0, dS/dH = h, dS/dT = u/n - t = -t0 [SA (56)-(62), (A47), (A48),
//             (A66)], dS/dt = -T, the Jacobi equation [SA (43)]. The angle phi - h solves 2T = sum
//             of g_i^2/I_i on the circle of momenta of size G with the part H along the frame's
//             third axis.
// Corrections the integral starts at l = pi/2 (long-axis mode: the sign of g1 times pi/2), where u
//             = 0; from elsewhere the set is not canonical: docs/theory/errata.md.
// Branches    S is multivalued. Up to four motions with the same G, H, T and lobe pass through an
//             attitude, and every revolution of h, g0 and every period of t0 adds a constant to S.
//             The branch is that of a near motion c: its G, H, T are arguments of S, its signs give
//             the lobe and the base point, and its g0, h, t0 are any real numbers. The result
//             belongs to the motion whose momentum at time t is nearest, in body axes, to that of
//             c, and its t0, g0 and h are the values nearest to those of c. Along the motion c,
//             q(t) for any t, S is continuous: S = (t - 2 t0) T + H h + G g0 with constant
//             elements; each branch is smooth in (q, G, H, T, t) between caustics.
// Units       S is an action, in the units of momentum; angles in radians; t and t0 times.
// Domain      0 < theta < pi, |H| < G, T inside (G^2/2I3, G^2/2I1), any body but a sphere; the
//             separatrix included. On a caustic, where g, omega and the third axis of the frame lie
//             in a plane, two branches meet: S is continuous there, its second derivatives are not
//             finite, and beyond it no motion passes through q.
// Accuracy    budgets generating_* in tests/budgets.hpp. Near a caustic the rounding of the
//             arguments costs the derivatives up to sqrt(eps); S itself keeps its accuracy.
// Errors      DomainError outside the domain, and for elements that to_rotor rejects. If no motion
//             passes through the attitude, the message has the range of T that it allows. NaN or
//             infinite time in, NaN out; serret_branches needs a finite time.
// Cost        about a hundred microseconds.
#pragma once

#include <vector>

#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace free {

struct GeneratingFunction {
  double S;
  // dS/d(phi, theta, psi)
  double Phi;
  double Theta;
  double Psi;
  // dS/d(G, H, T)
  double g0;
  double h;
  double minus_t0;
  // dS/dt
  double minus_T;

  constexpr bool operator==(const GeneratingFunction&) const = default;
};

// S(q; c.G, c.H, c.T; t) on the branch of the motion c.
// [SA (37)-(48), (51), (55)-(62), "identically nil", (A47), (A48), (A66)]
GeneratingFunction generating_function(const Body& body, const EulerAngles& q, const SerretState& c,
                                       double t);

// The motions with these constants that have the attitude q at time t, one for each branch: all
// lobes, g0 and h in (-pi, pi], t0 nearest to t. At least one, otherwise DomainError.
std::vector<SerretState> serret_branches(const Body& body, const EulerAngles& q, double G, double H,
                                         double T, double t);

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

}  // namespace free
}  // namespace v0
}  // namespace polhode
