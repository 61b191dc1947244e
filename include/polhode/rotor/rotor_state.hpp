// SPDX-License-Identifier: MIT
// RotorState{q, g}: the hub. Attitude quaternion and body angular momentum; every other chart
// converts to and from it.
//
// Equations   q: v_I = q v_B q* (Hamilton, scalar first), the 3-1-3 attitude of [SA (1), (2)];
//             g = I omega [SA (24)].
// Units       q none; g in moment x rate, components along the principal axes B.
// Domain      q any non-zero quaternion (|q| is not a coordinate: consumers use q/|q|); g any
//             vector, 0 included.
// Accuracy    no singularity anywhere: this is the one chart without them.
// Errors      none: it is a plain value. Builders check their input and throw DomainError.
// Cost        seven numbers.
#pragma once

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicRotorState {
  BasicQuaternion<T> q;  // attitude, body to inertial
  BasicVec3<T> g;        // angular momentum, body components g_B

  bool operator==(const BasicRotorState&) const
    requires Real<T>
  = default;
};
using RotorState = BasicRotorState<double>;

// Of packs, lane by lane.
template <Number T>
  requires(!Real<T>)
BasicRotorState<T> select(const Mask<T>& mask, const BasicRotorState<T>& a,
                          const BasicRotorState<T>& b) {
  return {select(mask, a.q, b.q), select(mask, a.g, b.g)};
}

// Every number of it, always in this order: what a checkpoint keeps and puts back.
template <Real T, class Visit>
constexpr void each_number(BasicRotorState<T>& s, Visit&& visit) {
  for (T* x : {&s.q.w, &s.q.x, &s.q.y, &s.q.z, &s.g.x, &s.g.y, &s.g.z}) visit(*x);
}

// Angular momentum in inertial components, G_I = q g q*: constant in free rotation
// [SA (28)-(31), "sphere"]. (28) is misprinted.
template <Number T>
BasicVec3<T> inertial_momentum(const BasicRotorState<T>& s) {
  return rotate(normalized(s.q), s.g);
}

// Pole: the end of a polar angle that a chart is regular at.
//
// Domain      J or I near 0, or near pi.
// Accuracy    exact.

enum class Pole { zero, pi };

}  // namespace v0
}  // namespace polhode
