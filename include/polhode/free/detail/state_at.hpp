// SPDX-License-Identifier: MIT
// The one evaluation of a prepared arc, for every Number; Arithmetic is that of its phases.
#pragma once

#include <cmath>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/free/detail/phase_arithmetic.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The four numbers of the series, not normalised, and by how much the invariable frame has turned
// in addition. The phase is x (trigonometric) or u (hyperbolic) less its whole periods.
template <Number T>
struct SeriesValue {
  BasicQuaternion<T> p;
  T turn;
};

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicQuaternion<T> trigonometric_value(
    const CayleyKleinSeries<T>& series, const TwoTerms<T>& phase) {
  const SinCos<T> x = Arithmetic::sincos(phase);
  return trigonometric_sum(series, x.sin, x.cos);
}

// Each lane in its own form.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline SeriesValue<T> series_value(const CayleyKleinSeries<T>& series,
                                                          const TwoTerms<T>& phase,
                                                          const Mask<T>& odd_half_periods) {
  const T chi = series.chi_per_u * phase.hi;
  const SeriesValue<T> v{hyperbolic_sum<typename Arithmetic::Exp>(series, chi, odd_half_periods),
                         series.phase_per_u * phase.hi};
  if (all(series.hyperbolic)) return v;
  return {select(series.hyperbolic, v.p, trigonometric_value<Arithmetic>(series, phase)),
          select(series.hyperbolic, v.turn, T(0.0))};
}

// The state whose series has the value p when the invariable frame has turned by twice the angle of
// c.
template <Number T>
[[gnu::always_inline]] inline BasicRotorState<T> turned_by(const BasicFreeKernel<T>& k,
                                                           const BasicQuaternion<T>& p,
                                                           const SinCos<T>& c,
                                                           const T& inverse_n2) {
  using std::sqrt;
  const T f = sqrt(inverse_n2);
  const BasicQuaternion<T> spun{f * (c.cos * p.w - c.sin * p.z), f * (c.cos * p.x - c.sin * p.y),
                                f * (c.cos * p.y + c.sin * p.x), f * (c.cos * p.z + c.sin * p.w)};
  const BasicVec3<T> m = momentum_direction(p, inverse_n2);
  return {k.left * (spun * k.right), k.to_body.applied(k.G * m)};
}

template <Number T>
[[gnu::always_inline]] inline T inverse_norm2(const BasicQuaternion<T>& p) {
  return T(1.0) / (p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z);
}

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> turned_state(const BasicFreeKernel<T>& k,
                                                              const BasicQuaternion<T>& p,
                                                              const TwoTerms<T>& turn) {
  const T inverse_n2 = inverse_norm2(p);
  return turned_by(k, p, sincos_of_turn<Arithmetic>(turn), inverse_n2);
}

// Attitude and momentum of an arc that is not steady.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> series_state(const BasicFreeKernel<T>& k,
                                                              const TwoTerms<T>& elapsed,
                                                              const TwoTerms<T>& turn, const T& t) {
  const PhaseRemainder<T> phase =
      reduced<Arithmetic>(bounded(phase_at<Arithmetic>(k.phase_rate, elapsed, k.phase0), t),
                          k.phase_period, k.inverse_phase_period);
  if (!any(k.series.hyperbolic))
    return turned_state<Arithmetic>(k, trigonometric_value<Arithmetic>(k.series, phase.rest), turn);
  const auto [p, more] = series_value<Arithmetic>(k.series, phase.rest, is_odd(phase));
  const TwoTerms<T> shifted = Arithmetic::sum(turn.hi, T(turn.lo + more));
  return turned_state<Arithmetic>(k, p, select(k.series.hyperbolic, shifted, turn));
}

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> steady_state(const BasicFreeKernel<T>& k,
                                                              const TwoTerms<T>& turn) {
  const SinCos<T> c = sincos_of_turn<Arithmetic>(turn);
  return {k.left * BasicQuaternion<T>{c.cos, c.sin * k.axis.x, c.sin * k.axis.y, c.sin * k.axis.z},
          k.g0};
}

// The state so long after the epoch, in the kernel's units; NaN where t is not finite.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> state_after(const BasicFreeKernel<T>& k,
                                                             const TwoTerms<T>& elapsed,
                                                             const T& t) {
  const T zero(0.0);
  const TwoTerms<T> turn =
      bounded(phase_at<Arithmetic>(k.half_precession, elapsed, TwoTerms<T>{zero, zero}), t);
  if (all(k.steady)) return steady_state<Arithmetic>(k, turn);
  // Returned at once: GCC copies a state with a name once more.
  if (!any(k.steady)) return series_state<Arithmetic>(k, elapsed, turn, t);
  return select(k.steady, steady_state<Arithmetic>(k, turn),
                series_state<Arithmetic>(k, elapsed, turn, t));
}

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> state_at(const BasicFreeKernel<T>& k, const T& t) {
  const TwoTerms<T> since = Arithmetic::sum(t, T(-k.epoch));
  return state_after<Arithmetic>(k, TwoTerms<T>{k.time_scale * since.hi, k.time_scale * since.lo},
                                 t);
}

}  // namespace detail

}  // namespace v0
}  // namespace polhode
