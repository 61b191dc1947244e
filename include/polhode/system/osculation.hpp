// SPDX-License-Identifier: MIT
// Osculating and canonical elements of one state, and the map between them.
//
// Equations   canonical: the body momentum g of the hub state (q_SB, g_B), the one that obeys
//             Hamilton's equations. Osculating: that of the free rotor that has the attitude q_SB
//             and the angular velocity w_SB of this instant, g_osc = I w_SB = g + I v, v the
//             convective term as a vector [SA (104)-(107)]. In a precessing frame v = -mu: g_osc =
//             g - I mu [SA (118), (124)]. Elements are those of the momentum meant: Andoyer's of g
//             or of g_osc. The two agree if and only if v = 0.
// Corrections none: the paper says when the two differ, not how to get one from the other.
// Units       those of the state.
// Domain      osculating from canonical: any state. Canonical from osculating solves
//             g + I v(t, q, g) = g_osc by Newton's method from g = g_osc: one step where v is
//             affine in g (frames, linear terms); where several g answer, one of them. A term that
//             works on double alone counts as one whose v does not depend on g.
// Accuracy    budget osculation_round_trip in tests/budgets.hpp, where 1 + I dv/dg is well
//             conditioned.
// Errors      DomainError when Newton's method does not converge, as where v grows too fast with g.
//             What a term throws passes through.
// Cost        the terms once; the inverse the terms with derivatives per step, at most 50 steps.
#pragma once

#include "polhode/rotor/andoyer.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace charts {

// {q, g_osc} of a canonical state [SA (104), (107), (124)]: FreeRotation from here is the free
// motion that touches the true one in S. And back. T = DoubleDouble or Tangent.
RotorState osculating_state(const System& system, double t, const RotorState& canonical);
RotorState canonical_state(const System& system, double t, const RotorState& osculating);
template <Real T>
BasicRotorState<T> osculating_state(const System& system, double t,
                                    const BasicRotorState<T>& canonical);
template <Real T>
BasicRotorState<T> canonical_state(const System& system, double t,
                                   const BasicRotorState<T>& osculating);

// Andoyer elements. The canonical ones of a hub state are to_andoyer(s).
AndoyerState osculating_andoyer(const System& system, double t, const RotorState& canonical);
AndoyerState osculating_andoyer(const System& system, double t, const AndoyerState& canonical);
AndoyerState canonical_andoyer(const System& system, double t, const AndoyerState& osculating);

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

// The set with epoch t0 of a state at time t, and back [SA (98), (100), (108), (125), (126)].
AndoyerState modified_andoyer(const Body& body, double t, const RotorState& s, double t0);
RotorState from_modified_andoyer(const Body& body, double t, const AndoyerState& C, double t0);

// Its rates at time t: all zero without a perturbation [SA (99)]. The equations of motion of
// variation of constants [SA (102), (103)]; their convective term [SA (106), (107), (111)].
rates::AndoyerRates modified_andoyer_rates(const System& system, double t, const RotorState& s,
                                           double t0);

}  // namespace charts
}  // namespace v0
}  // namespace polhode
