// SPDX-License-Identifier: MIT
// Fukushima and Ishizaki's elements of free rotation: Andoyer's variables at an epoch, constants of
// the motion.
//
// Equations   (l0, g0, h, L0, G, H) are Andoyer's variables that the free motion has at the epoch
//             t0: the modified Andoyer set, the analogue of Delaunay's set with M_o [SA (96)].
//             Canonical, with H* = 0 [SA (97)-(99)]. The numbers are those of modified_andoyer()
//             (system/modified_andoyer.hpp); here the epoch belongs to the value.
// Corrections the definition is uncertain. Fukushima and Ishizaki, Celest. Mech. Dyn. Astron. 59,
//             149 (1994), take initial values of "a modification of the Andoyer canonical
//             variables", and the paper calls these "Andoyer-type variables". Their text was not
//             available, so that the modification is not known here: these are Andoyer's own
//             variables.
// Units       angles in radians, (-pi, pi]; momenta in those of the angular momentum; t0 a time.
// Domain      any body and state; the axes are the body's own, not sorted. Singular where Andoyer's
//             variables at the epoch are (rotor/andoyer.hpp).
// Accuracy    budgets named_sets_* in tests/budgets.hpp, away from Andoyer's poles. chart_jacobian
//             grows like t - t0, and like exp(n (t - t0)) on the separatrix.
// Errors      DomainError as FreeRotation and andoyer_state, and for an epoch that is not finite.
// Cost        tens of microseconds.
#pragma once

#include "polhode/free/free_rotation.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

struct FukushimaIshizakiState {
  double l0;
  double g0;
  double h;
  double L0;
  double G;
  double H;
  double t0 = 0.0;  // the epoch

  constexpr bool operator==(const FukushimaIshizakiState&) const = default;
};

// The elements of a motion with the epoch t0 = t.
FukushimaIshizakiState to_fukushima_ishizaki(const FreeRotation& motion, double t);
// The state at time t of the motion with these elements.
RotorState to_rotor(const Body& body, const FukushimaIshizakiState& s, double t);
// The motion itself, with epoch t0.
FreeRotation free_rotation(const Body& body, const FukushimaIshizakiState& s);

// d(dtheta_B, dg_B)(t) / d(l0, g0, h, L0, G, H)
Matrix6 chart_jacobian(const Body& body, const FukushimaIshizakiState& s, double t);

}  // namespace v0
}  // namespace polhode
