// SPDX-License-Identifier: MIT
// The modified Andoyer set: Andoyer's variables as initial values, constants of free rotation that
// a perturbation moves slowly.
//
// Equations   C = (l_o, g_o, h, L_o, G, H) is the AndoyerState that the free motion through the
//             state at time t has at the epoch t0. Canonical, with H* = 0: dQ/dt = dDeltaH*/dP,
//             dP/dt = -dDeltaH*/dQ [SA (102), (103)]; dC/dt = B^-1 M (v, g x v + u), M the free
//             state transition from t to t0. The convective term of the Euler angles is the same
//             in this set and in the regular one [SA (107), (111)].
// Units       those of AndoyerState; rates per time.
// Domain      any state and times; the free motion is that of the body in the reference frame S, as
//             if S were inertial. Angles in (-pi, pi]. At J or I = 0, pi of the epoch state: as
//             canonical_rates.hpp.
// Accuracy    budget paper_modified in tests/budgets.hpp; M grows like t - t0, and like
//             exp(n (t - t0)) on the separatrix.
// Errors      DomainError for a state that FreeRotation refuses. What a term throws passes through.
// Cost        one FreeRotation each, tens of microseconds.
#pragma once

#include "polhode/rotor/andoyer.hpp"
#include "polhode/system/canonical_rates.hpp"

namespace polhode {
inline namespace v0 {

// The set with epoch t0 of a state at time t, and back [SA (98), (100), (108), (125), (126)].
AndoyerState modified_andoyer(const Body& body, double t, const RotorState& s, double t0);
RotorState from_modified_andoyer(const Body& body, double t, const AndoyerState& C, double t0);

// Its rates at time t: all zero without a perturbation [SA (99)]. The equations of motion of
// variation of constants [SA (102), (103)]; their convective term [SA (106), (107), (111)].
AndoyerRates modified_andoyer_rates(const System& system, double t, const RotorState& s, double t0);

}  // namespace v0
}  // namespace polhode
