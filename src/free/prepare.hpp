// SPDX-License-Identifier: MIT
// prepare(): every decision about a free arc - regime, form, number of terms, order and signs of
// the axes, rates and periods - made once, as data for evaluate().
//
// Equations   docs/design/0002-free-rotation.md, docs/design/0016-prepare-and-evaluate.md.
// Units       any consistent set, as in free_rotation.hpp.
// Domain      that of FreeRotation. T is double, DoubleDouble, a Dual of double, or a pack of
//             doubles, each lane with its own body, state and epoch.
//             Derivatives of a Dual, by moments, state and epoch, are those of the motion. At spin
//             about an axis, at rest, on the separatrix and within k'^2 = 2^-200 of it, and of a
//             body with equal moments the form of the arc differs for neighbouring bodies or
//             states: there those by moments and momentum are NaN (FreeRotation::state_transition
//             has those by momentum).
// Accuracy    docs/accuracy/free-rotation.md; derivatives: budget free_dual in tests/budgets.hpp.
// Errors      DomainError, as FreeRotation.
// Cost        tens of microseconds for a double and per lane, some hundred for a Dual.
#pragma once

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/free/detail/phase_arithmetic.hpp"
#include "polhode/free/detail/prepared_kernel.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// The arc with this state at time t0, of a body with these principal moments.
template <Number T>
  requires detail::has_double_digits<T>
BasicFreeKernel<T> prepare(const BasicVec3<T>& moments, const BasicRotorState<T>& s0, const T& t0) {
  return detail::prepared_kernel<T>(moments, s0, t0);
}

// The same of constants, for evaluation in T.
template <Number T = double>
BasicFreeKernel<T> prepare(const Body& body, const RotorState& s0, double t0 = 0.0) {
  return detail::prepared_kernel<T>(
      detail::converted<T>(body.moments()),
      BasicRotorState<T>{detail::converted<T>(s0.q), detail::converted<T>(s0.g)}, T(t0));
}

}  // namespace v0
}  // namespace polhode
