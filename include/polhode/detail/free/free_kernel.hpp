// SPDX-License-Identifier: MIT
// FreeKernel: one free arc, prepared. Plain numbers from which the state at any time follows
// without an elliptic function, without a branch whose outcome changes a result, and without
// allocation.
//
// Equations   Cayley-Klein parameters by theta series, docs/design/0002-free-rotation.md; who
//             decides what, docs/design/0016-prepare-and-evaluate.md.
// Units       those of the body and the state it was prepared from; phases in radians.
// Domain      made by prepare() (prepare.hpp) or a FreeRotation, evaluated by evaluate(); any
//             finite time (see free_rotation.hpp). NaN in, NaN out. T is any Number: in a pack each
//             lane has its own body, its own form and its own epoch.
// Accuracy    docs/accuracy/free-rotation.md. Phases are reduced in double-double.
// Cost        one state: two sincos (or one sincos and one exp next to the separatrix), four short
//             polynomials; see docs/accuracy/free-rotation.md.
#pragma once

#include <concepts>
#include <type_traits>

#include "polhode/detail/free/cayley_klein.hpp"
#include "polhode/free/detail/signed_order.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// A phase or a rate as an unevaluated sum hi + lo.
template <Number T>
using TwoPartPhase = std::conditional_t<std::same_as<T, double>, DoubleDouble, TwoTerms<T>>;

// Every decision is data: the form of the arc, the number of terms, order and signs of the axes.
template <Number T>
struct BasicFreeKernel {
  // omega is constant: q(t) = left exp(axis phase). Else the series, in one of its two forms.
  Mask<T> steady = true;
  CayleyKleinSeries<T> series;  // attitude of the primed axes in the invariable frame

  T epoch = T(0.0);
  T time_scale = T(1.0);                         // a power of two: rates below are per scaled time
  TwoPartPhase<T> phase0{T(0.0), T(0.0)};        // x (trigonometric) or u (hyperbolic) at the epoch
  TwoPartPhase<T> phase_rate{T(0.0), T(0.0)};    // its rate
  TwoPartPhase<T> phase_period{T(0.0), T(0.0)};  // 2 pi, or 2K; 0 where the phase is not periodic
  T inverse_phase_period = T(0.0);               // 0 where the phase is not periodic
  TwoPartPhase<T> half_precession{T(0.0), T(0.0)};  // Lambda; half of the spin rate if steady

  BasicQuaternion<T> left;         // inertial frame <- invariable frame at the epoch
  BasicQuaternion<T> right;        // primed axes <- body axes
  BasicVec3<T> axis;               // steady: omega / |omega| in body axes
  BasicVec3<T> g0;                 // steady: the constant momentum
  T G = T(0.0);                    // |g|
  detail::SignedOrder<T> to_body;  // body axes <- primed axes, of a vector's components
};
using FreeKernel = BasicFreeKernel<double>;

// The state at time t; q is normalised. For any other Number: evaluate.hpp.
RotorState evaluate(const FreeKernel& kernel, double t) noexcept;

}  // namespace v0
}  // namespace polhode
