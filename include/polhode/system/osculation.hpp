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
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {

// {q, g_osc} of a canonical state: FreeRotation from here is the free motion that touches the true
// one in S. And back. T = DoubleDouble or Tangent.
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

}  // namespace v0
}  // namespace polhode
