// SPDX-License-Identifier: MIT
// The generating function S of section 3.1, that turns Euler's variables into Serret's constants,
// along a free motion, with its derivatives.
//
// Equations   S(q; P, t) = -t T + G h cos I + G g + G int cos J dl, q = (phi, theta, psi), P = (G,
//             H, T) [SA (51)], evaluated as (t - 2 t0) T + H h + G g0 [SA (55)]. dS/dq = momenta,
//             dS/dG = g0, dS/dH = h, dS/dT = u/n - t = -t0 [SA (56)-(62)], dS/dt = -T, the Jacobi
//             equation [SA (43)].
// Corrections the integral starts at l = pi/2 (long-axis mode: the sign of g1 times pi/2), where u
//             = 0; from elsewhere the set is not canonical: docs/theory/errata.md.
// Units       S an action, momentum; angles radians.
// Domain      that of to_serret. S is multivalued as the elements are: another turn of g0 or h adds
//             2 pi G or 2 pi H, another period of t0 with its turn of g0 adds a multiple of the
//             action of the polhode. This is the branch that to_serret returns, its jumps included.
// Accuracy    budget paper_generating in tests/budgets.hpp, for times of order of a period.
// Errors      none; NaN time in, NaN out.
// Cost        tens of microseconds.
#pragma once

#include "polhode/free/free_rotation.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/euler.hpp"

namespace polhode {
inline namespace v0 {

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

// [SA (37)-(48), (51), (55)-(62), "identically nil", (A47), (A48), (A66)]
GeneratingFunction generating_function(const FreeRotation& motion, double t);

}  // namespace v0
}  // namespace polhode
