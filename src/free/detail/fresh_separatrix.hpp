// SPDX-License-Identifier: MIT
// The state of a fresh arc next to the separatrix: the hyperbolic form of the series.
#pragma once

#include <cmath>

#include "free/detail/fresh_arc.hpp"
#include "free/detail/fresh_rates.hpp"
#include "free/detail/fresh_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// nu = qt = exp(-pi K / (2 K')), and theta functions of that nome: A_m = nu^(m^2) cos (2m + 1) b,
// B_m with the sine.
template <Number T>
struct NearSeries {
  static constexpr int terms = 4;  // the next is nu^16, nu < 0.08
  T A[terms], B[terms];
  T nu, r;
  T b;        // an angle
  T k_ratio;  // K / K'
  T root_k, k;
  T nome, stretch;  // of k': q', and q'/eps'
};

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline NearSeries<T> near_series(const PrimedLane<Arithmetic, T>& lane,
                                                        const FreshRates<Arithmetic, T>& rates) {
  using std::sqrt;
  const T one(1.0), two(2.0), half(0.5);
  NearSeries<T> s;
  const T kp2 = lane.V.hi / lane.U.hi, a0 = sqrt(lane.U.hi);
  s.k = sqrt((lane.U.hi - lane.V.hi) / lane.U.hi);
  s.root_k = sqrt(s.k);
  const T g = one + s.root_k;
  const T eps = half * kp2 / ((one + s.k) * (g * g)), eps2 = eps * eps, eps4 = eps2 * eps2;
  const T stretch = one + eps4 * (two + eps4 * (T(15.0) + T(150.0) * eps4));
  s.nome = eps * stretch;
  s.stretch = stretch;
  s.nu = sqrt(s.nome);
  const T q = s.nome, q4 = (q * q) * (q * q), theta3 = one + two * (q + q4);
  s.k_ratio = a0 / (rates.mean * (theta3 * theta3));
  // 2 b is the x of F(arctan(1/kappa), k') in the nome of k'
  const T sin2 = lane.X / lane.Z, cos2 = lane.Y / lane.Z;
  const AmplitudePoint<T> shift{sqrt(sin2), sqrt(cos2), sqrt(one - kp2 * sin2), one};
  const SinCos<T> twice = phase_point(shift, NomeOf<T>{s.k, s.root_k, s.nome, s.stretch});
  const T cos_b = sqrt(half * (one + twice.cos)), sin_b = half * twice.sin / cos_b;
  s.b = each_lane([](double y, double x) { return std::atan2(y, x); }, sin_b, cos_b);
  T power = one, step = s.nu, c = cos_b, d = sin_b, c_before = cos_b, d_before = -sin_b;
  const T nu2 = s.nu * s.nu;
  T even(0.0), odd(0.0), at_0 = one;  // sums at chi = 0
  for (int m = 0; m < s.terms; ++m) {
    s.A[m] = power * c;
    s.B[m] = power * d;
    even = even + at_0 * s.A[m];
    odd = m % 2 == 0 ? T(odd + at_0 * s.B[m]) : T(odd - at_0 * s.B[m]);
    at_0 = at_0 * s.nu;
    power = power * step;
    step = step * nu2;
    const T c_next = two * twice.cos * c - c_before, d_next = two * twice.cos * d - d_before;
    c_before = c;
    d_before = d;
    c = c_next;
    d = d_next;
  }
  s.r = lane.a1 / (lane.G.hi + lane.a3) * even / odd;
  return s;
}

// The four numbers at e = exp(-2 |chi|); side and flip are 1 or -1.
template <Number T>
[[gnu::always_inline]] inline BasicQuaternion<T> near_sum(const NearSeries<T>& s, const T& e,
                                                          const T& side, const T& flip) {
  const T v = s.nu / e, f = s.nu * e;
  const auto sum = [](const T* c, const T& y, double sign) {
    return c[0] + y * (T(sign) * c[1] + y * (c[2] + y * (T(sign) * c[3])));
  };
  const T Av = sum(s.A, v, 1.0), Af = e * sum(s.A, f, 1.0);
  const T Bv = sum(s.B, v, 1.0), Bf = e * sum(s.B, f, 1.0);
  const T Cv = sum(s.A, v, -1.0), Cf = e * sum(s.A, f, -1.0);
  const T Dv = sum(s.B, v, -1.0), Df = e * sum(s.B, f, -1.0);
  return {Av + Af, flip * side * s.r * (Cv - Cf), -(flip * s.r * (Dv + Df)), -(side * (Bv - Bf))};
}

// exp(-2 |chi|) at the epoch, through cosh 4 chi, which is cos 2x of the imaginary argument.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline T near_epoch(const PrimedLane<Arithmetic, T>& lane,
                                           const NearSeries<T>& s) {
  using std::abs;
  using std::sqrt;
  const T one(1.0), two(2.0), four(4.0), half(0.5);
  const T cn = lane.m.x / lane.a1, sn = abs(lane.m.y) / lane.a2, dn = lane.m.z / lane.a3;
  const T norm2 = cn * cn + sn * sn;  // 1 but for rounding
  const T q = s.nome, q2 = q * q, q4 = q2 * q2, q6 = q4 * q2;
  const T g = one + s.root_k, d = dn + s.root_k * cn;
  const T first = (norm2 + s.k * (sn * sn)) * (g * g) / (d * d * s.stretch);
  T y = first;
  for (int i = 0; i < 3; ++i) {  // gains q^2 each time
    const T yy = y * y;
    y = first * (one + two * q4 * (two * yy - one)) * (one - (q4 * q4) * (four * yy - T(3.0)));
  }
  const T yy = y * y;
  const T n1 = one - q2 * (one + two * y) + q6 * (four * yy + two * y - one);
  const T n2 = one + q2 * (two * y - one) + q6 * (four * yy - two * y - one);
  const T tanh_2chi = s.root_k * sn * n2 / n1, cosh_2chi = sqrt(half * (y + one));
  return one / (cosh_2chi * (one + tanh_2chi));
}

// Everything at the time: what turns the state at the epoch into it.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> near_state(const BodyInLane<T>& body,
                                                            const PrimedLane<Arithmetic, T>& lane,
                                                            const FreshRates<Arithmetic, T>& rates,
                                                            const NearSeries<T>& s) {
  using std::exp;
  const T zero(0.0), one(1.0);
  const TwoTerms<T> start{zero, zero};
  const T e0 = near_epoch(lane, s);
  const T side0 = select(lane.m.y < zero, T(-one), one);
  const BasicQuaternion<T> p0 = near_sum(s, e0, side0, one);
  // x less whole half periods
  const TwoPartPhase<T> period{T(DoubleDouble::pi().hi), T(DoubleDouble::pi().lo)};
  const PhaseRemainder<T> x = reduced<Arithmetic>(
      phase_at<Arithmetic>(rates.phase, lane.elapsed, start), period, T(0.3183098861837907));
  const T rest = x.rest.hi + x.rest.lo;
  const T grown = exp(T(-(rest * s.k_ratio)));
  const T E0 = select(side0 < zero, T(one / e0), e0);  // exp(-2 chi0)
  T E = E0 * grown;
  const auto above = E<s.nu, below = E * s.nu> one;  // beyond K, beyond -K
  const T nu2 = s.nu * s.nu;
  E = select(above, T(E / nu2), select(below, T(E * nu2), E));
  const T wraps = select(above, one, select(below, T(-one), zero));
  const auto odd = is_odd(x) != (above || below);
  const auto negative = E > one;
  const T e = select(negative, T(one / E), E);
  const BasicQuaternion<T> p =
      near_sum(s, e, select(negative, T(-one), one), select(odd, T(-one), one));
  const T inverse_half_turn(0.3183098861837907);
  const T more = T(2.0) * s.b * (rest * inverse_half_turn - wraps);
  TwoTerms<T> turn =
      whole_turns_off<Arithmetic>(phase_at<Arithmetic>(rates.half_precession, lane.elapsed, start));
  turn = whole_turns_off<Arithmetic>(Arithmetic::sum(turn.hi, T(turn.lo + more)));
  return turned_fresh(body, lane, p0.w, p0.z, p, sincos_of_few_turns(turn));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
