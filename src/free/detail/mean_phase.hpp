// SPDX-License-Identifier: MIT
// The two slow constants of a kernel at a time t: the phase x on the polhode and the mean frame.
#pragma once

#include <cmath>

#include "polhode/free/free_rotation.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
