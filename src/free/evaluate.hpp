// SPDX-License-Identifier: MIT
// evaluate(): the state of a prepared free arc at a time, one formula for every Number.
//
// Equations   docs/design/0002-free-rotation.md.
// Units       those of the kernel.
// Domain      any kernel of prepare(), any time; NaN or infinite time in, NaN out. What a type has
//             to offer: docs/design/0016-prepare-and-evaluate.md. On packs every lane has the bits
//             that its kernel has alone, where functions of the pack have those of the scalar.
// Accuracy    docs/accuracy/free-rotation.md for double and packs of it; for DoubleDouble that of
//             its functions, until its phase has no digit left. Phases of double and of packs of it
//             are reduced in two parts.
// Errors      none; NaN in, NaN out.
// Cost        that of FreeRotation::at per lane, and in a pack of several forms that of each form.
#pragma once

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/free/detail/phase_arithmetic.hpp"
#include "polhode/free/detail/state_at.hpp"

namespace polhode {
inline namespace v0 {
// The state at time t; q is normalised.
template <Number T>
BasicRotorState<T> evaluate(const BasicFreeKernel<T>& kernel, const T& t) {
  return detail::state_at<detail::PhaseArithmetic<T>>(kernel, t);
}

}  // namespace v0
}  // namespace polhode
