// SPDX-License-Identifier: MIT
// Evaluation of a FreeKernel: reduce two phases in double-double, sum a short series, turn.
#include "polhode/free/free_kernel.hpp"

#include <cmath>

#include "polhode/math/trigonometry.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// sin and cos of hi + lo, |lo| below an ulp of hi.
SinCos<double> sincos_of(const DoubleDouble& a) {
  const SinCos<double> t = sincos(a.hi);
  return {t.sin + t.cos * a.lo, t.cos - t.sin * a.lo};
}

DoubleDouble reduced_turns(const DoubleDouble& phase) {
  constexpr double inverse_two_pi = 0.15915494309189535;
  return phase - DoubleDouble::two_pi() * std::rint(phase.hi * inverse_two_pi);
}

RotorState steady_state(const FreeKernel& k, const DoubleDouble& elapsed) {
  const SinCos<double> t = sincos_of(reduced_turns(k.half_precession * elapsed));
  const Quaternion turn{t.cos, t.sin * k.axis.x, t.sin * k.axis.y, t.sin * k.axis.z};
  return {k.left * turn, k.g0};
}

// Momentum along the primed axes over G, from the attitude of those axes: R^T e3 for any |p|.
Vec3 momentum_direction(const Quaternion& p, double n2) {
  const double f = 2.0 / n2;
  return {f * (p.x * p.z - p.w * p.y), f * (p.y * p.z + p.w * p.x),
          (p.w * p.w + p.z * p.z - p.x * p.x - p.y * p.y) / n2};
}

}  // namespace

RotorState evaluated(const FreeKernel& k, double t) noexcept {
  const TwoTerms<double> difference = two_sum(t, -k.epoch);
  const DoubleDouble elapsed{k.time_scale * difference.hi, k.time_scale * difference.lo};
  if (k.form == FreeKernel::Form::steady) return steady_state(k, elapsed);

  DoubleDouble phase = k.phase0 + k.phase_rate * elapsed;
  const double periods = std::rint(phase.hi * k.inverse_phase_period);
  phase = phase - k.phase_period * periods;
  DoubleDouble turn = k.half_precession * elapsed;
  Quaternion p;
  if (k.form == FreeKernel::Form::trigonometric) {
    const SinCos<double> x = sincos_of(phase);
    p = trigonometric_sum(k.series, x.sin, x.cos);
  } else {
    const bool odd = std::fmod(periods, 2.0) != 0.0;
    p = hyperbolic_sum(k.series, k.series.chi_per_u * phase.hi, odd);
    turn = turn + k.series.phase_per_u * phase.hi;
  }
  const double n2 = p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z;
  const SinCos<double> c = sincos_of(reduced_turns(turn));
  const double f = 1.0 / std::sqrt(n2);
  const Quaternion spun{f * (c.cos * p.w - c.sin * p.z), f * (c.cos * p.x - c.sin * p.y),
                        f * (c.cos * p.y + c.sin * p.x), f * (c.cos * p.z + c.sin * p.w)};
  const Vec3 m = momentum_direction(p, n2);
  RotorState s{k.left * (spun * k.right), {}};
  for (int i = 0; i < 3; ++i) {
    const auto j = static_cast<std::size_t>(i);
    s.g[k.primed_axis[j]] = k.G * k.primed_sign[j] * m[i];
  }
  return s;
}

}  // namespace v0
}  // namespace polhode
