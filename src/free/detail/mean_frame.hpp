// SPDX-License-Identifier: MIT
// The mean frame of a free rotation and the phase on the polhode: read from a kernel, and made into
// a state.
#pragma once

#include <cmath>

#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/free/detail/prepared_arc.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The two slow constants of a kernel at a time t: the phase x on the polhode and the mean frame.
struct MeanPhase {
  DoubleDouble x;        // pi u / (2K) in (-pi, pi]; 0 on the separatrix
  DoubleDouble u_per_x;  // 2K / pi; 0 on the separatrix
  DoubleDouble u;        // x u_per_x; on the separatrix the full u
  Quaternion frame;      // inertial axes <- mean frame
};

// Angles modulo 2 pi, in (-pi, pi] as doubles.
inline DoubleDouble wrapped(const DoubleDouble& angle) {
  const DoubleDouble turn = DoubleDouble::two_pi();
  const DoubleDouble r = angle - turn * std::rint(angle.hi / turn.hi);
  return r.hi <= -DoubleDouble::pi().hi ? r + turn : r;
}
inline double wrapped(double angle) { return wrapped(DoubleDouble(angle)).hi; }
// The angle modulo 2 pi next to another one.
inline DoubleDouble turned_to(const DoubleDouble& near, const DoubleDouble& angle) {
  return near + wrapped(angle - near);
}

// The angles of the mean frame, qz(h) qx(I) qz(mean_angle). A tilt of rounding has no node: then
// h = 0.
struct FrameAngles {
  double h;
  double mean_angle;
  bool has_node = true;
};
inline FrameAngles frame_angles(const Quaternion& frame) {
  const EulerState e = to_euler(RotorState{frame, {}});
  const double rounding = 4.0 * epsilon<double>();
  const double tilt = std::hypot(frame.x, frame.y), rest = std::hypot(frame.w, frame.z);
  if (tilt <= rounding * rest) return {0.0, e.psi + e.phi, false};
  if (rest <= rounding * tilt) return {0.0, e.psi - e.phi, false};
  return {e.phi, e.psi};
}

// H, from which nothing is lost near I = 0, pi; exactly +-G where it is G to rounding.
inline double third_momentum(const FreeRotation& m, const FrameAngles& frame) {
  const AndoyerState a = to_andoyer(m.initial_state());
  const bool along = !frame.has_node || std::abs(a.H) >= a.G;
  return along ? std::copysign(m.momentum(), a.H) : a.H;
}

// A phase without a digit left is 0, as FreeKernel takes it; t - t is NaN where t is no number.
inline DoubleDouble within_limit(const DoubleDouble& phase, double t) {
  return std::abs(phase.hi) < 0x1p90 ? phase : DoubleDouble(t - t);
}

// Not for the steady form, whose phase is no coordinate.
inline MeanPhase mean_phase(const FreeKernel& k, double t) {
  const DoubleDouble elapsed = ldexp(DoubleDouble::sum(t, -k.epoch), std::ilogb(k.time_scale));
  const DoubleDouble phase = within_limit(k.phase0 + k.phase_rate * elapsed, t);
  MeanPhase m;
  if (!k.series.hyperbolic) {
    m.x = wrapped(phase);
  } else if (k.inverse_phase_period > 0.0) {
    m.u_per_x = k.phase_period / DoubleDouble::pi();
    m.x = wrapped(phase / m.u_per_x);
    m.u = m.x * m.u_per_x;
  } else {
    m.u = phase;
  }
  const DoubleDouble turn = wrapped(within_limit(k.half_precession * elapsed, t));
  m.frame = k.left * Quaternion{std::cos(turn.hi) - turn.lo * std::sin(turn.hi), 0.0, 0.0,
                                std::sin(turn.hi) + turn.lo * std::cos(turn.hi)};
  return m;
}

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

// A rotor state put together from flow-adapted elements: a polhode, a phase on it, and the attitude
// of the mean frame (axis 3 along the momentum, turning at the mean precession of primed axis 1).
//
// q = qz(h) qx(I) qz(mean angle) p(x) q_P, with p the Cayley-Klein sum and q_P: primed <- body
// axes.
//
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
