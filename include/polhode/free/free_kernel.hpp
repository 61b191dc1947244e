// SPDX-License-Identifier: MIT
// FreeKernel: one free arc, prepared. Plain numbers from which the state at any time follows
// without an elliptic function, without a branch on the regime beyond its form, and without
// allocation.
//
// Equations   Cayley-Klein parameters by theta series, docs/design/0002-free-rotation.md.
// Units       those of the Body and the RotorState it was prepared from; phases in radians.
// Domain      made only by FreeRotation; any finite time (see free_rotation.hpp). NaN in, NaN out.
// Accuracy    docs/accuracy/free-rotation.md. Phases are reduced in double-double.
// Errors      none.
// Cost        one state: two sincos (or one sincos and one exp next to the separatrix), four short
//             polynomials; see docs/accuracy/free-rotation.md.
#pragma once

#include <array>

#include "polhode/free/cayley_klein.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

struct FreeKernel {
  enum class Form {
    steady,         // omega is constant: q(t) = left exp(axis phase)
    trigonometric,  // theta series in x = pi u / (2K)
    hyperbolic      // the transformed series, next to and on the separatrix
  };

  Form form = Form::steady;
  CayleyKleinSeries<double> series;  // attitude of the primed axes in the invariable frame

  double epoch = 0.0;
  double time_scale = 1.0;            // a power of two: rates below are per scaled time
  DoubleDouble phase0;                // x (trigonometric) or u (hyperbolic) at the epoch
  DoubleDouble phase_rate;            // its rate
  DoubleDouble phase_period;          // 2 pi, or 2K; 0 where the phase is not periodic
  double inverse_phase_period = 0.0;  // 0 where the phase is not periodic
  DoubleDouble half_precession;       // Lambda; half of the spin rate in the steady form

  Quaternion left;                          // inertial frame <- invariable frame at the epoch
  Quaternion right;                         // primed axes <- body axes
  Vec3 axis;                                // steady form: omega / |omega| in body axes
  Vec3 g0;                                  // steady form: the constant momentum
  double G = 0.0;                           // |g|
  std::array<int, 3> primed_axis{0, 1, 2};  // body component primed_axis[i] is ...
  std::array<double, 3> primed_sign{1.0, 1.0, 1.0};  // ... primed_sign[i] times primed component i
};

// The state at time t.
RotorState evaluated(const FreeKernel& kernel, double t) noexcept;

}  // namespace v0
}  // namespace polhode
