// SPDX-License-Identifier: MIT
// A rotor state put together from flow-adapted elements: a polhode, a phase on it, and the attitude
// of the mean frame (axis 3 along the momentum, turning at the mean precession of primed axis 1).
//
// q = qz(h) qx(I) qz(mean angle) p(x) q_P, with p the Cayley-Klein sum and q_P: primed <- body
// axes.
#pragma once

#include <cmath>

#include "polhode/free/detail/prepared_arc.hpp"
#include "polhode/free/detail/primed_arc.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where the primed axes lie in the sorted ones: s1, s3 are the signs of the momentum along them.
struct PrimedSense {
  bool long_axis;
  double s1, s3;
};

inline PrimedSense primed_sense(bool long_axis, int sign_g1, int sign_g3) {
  return {long_axis, static_cast<double>(long_axis ? sign_g3 : sign_g1),
          static_cast<double>(long_axis ? sign_g1 : sign_g3)};
}

template <Real T>
struct InvariableElements {
  T mean_angle;  // from the node of the invariable plane to axis 1 of the mean frame
  T h, H, G;     // [SA (84)]
};

// The mean frame in inertial axes; I = 0 where H = G.
template <Real T>
BasicQuaternion<T> mean_frame(const InvariableElements<T>& e) {
  using std::sqrt;
  const T plus = e.G + e.H, minus = e.G - e.H, zero(0.0);
  const T c = sqrt((plus < zero ? zero : plus) / (T(2.0) * e.G));
  const T s = sqrt((minus < zero ? zero : minus) / (T(2.0) * e.G));
  return rotation_z(e.h) * BasicQuaternion<T>{c, s, zero, zero} * rotation_z(e.mean_angle);
}

// The state in the user's body axes; the curve is scaled to momentum 1.
template <Real T>
BasicRotorState<T> assembled(const AxisOrder& sorted, const PrimedSense& sense,
                             const PolhodeCurve<T>& curve, const T& u,
                             const InvariableElements<T>& e) {
  const AxisOrder primed = composed(sorted, primed_axes(sense.long_axis, sense.s1, sense.s3));
  const BasicQuaternion<T> p = normalized(primed_attitude(curve, cayley_klein_series(curve), u));
  const BasicQuaternion<T> q = mean_frame(e) * p * quaternion_of<T>(primed);
  return {q, e.G * restored(primed, momentum_direction(p, T(1.0)))};
}

// Mean angle minus the Andoyer angle g of sorted axis 3 at u = 0 (and, for the Sadov angle, minus
// phi_g at x = 0): the geometry of the nodes at the moment when g lies in the 1'-3' plane.
template <Real T>
T node_offset(const PrimedSense& s) {
  const T half_pi = T(0.5) * pi<T>();
  if (s.long_axis) return T(-s.s1) * half_pi;
  return s.s3 < 0.0 ? T(-half_pi) : half_pi;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
