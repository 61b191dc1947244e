// SPDX-License-Identifier: MIT
// The state of a direct flow from its rates: away from the separatrix by theta series, and next to
// it by their hyperbolic form.
#pragma once

#include <cmath>

#include "free/detail/direct_flow.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// From the rates of a normalized arc to its state: theta series with coefficients from the
// amplitudes of the momentum, the phase at the epoch as a point of the circle, never as an angle.
//
// w = w0 + y (w1 + ...), z = sin 2x (...), x = sin x (...), y = cos x (...), of y = cos 2x: the
// trigonometric form of CayleyKleinSeries for q < 0.17.
template <Number T>
struct DirectSeries {
  T w0, w1, w2, w3;
  T z0, z1, z2;
  T x0, x1, x2;
  T y0, y1, y2;

  [[gnu::always_inline]] T w(const T& y) const { return w0 + y * (w1 + y * (w2 + y * w3)); }
  [[gnu::always_inline]] T z(const T& y) const { return z0 + y * (z1 + y * z2); }
  [[gnu::always_inline]] T x(const T& y) const { return x0 + y * (x1 + y * x2); }
  [[gnu::always_inline]] T y(const T& y) const { return y0 + y * (y1 + y * y2); }
};

// H = 2 p cosh 2a by the quotient of theta4 and theta3 of ia, nome p, which are known from the
// momentum at x = 0 and pi/2.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline DirectSeries<T> direct_series(
    const PrimedLane<Arithmetic, T>& lane, const DirectRates<Arithmetic, T>& rates) {
  using std::sqrt;
  const T one(1.0), two(2.0);
  const T p = rates.nome * rates.nome, p2 = p * p, p4 = p2 * p2, p6 = p4 * p2;
  const T at_0 = lane.G.hi + lane.a3, at_quarter = lane.G.hi + lane.a3 * rates.kp;
  const T over = one / (at_0 * at_quarter);
  const T R = sqrt(rates.root_kp * (at_0 * at_0) * over);
  const T first = (one - R) / (one + R);
  T H = first;
  for (int i = 0; i < 3; ++i) {  // gains q^6 each time
    const T HH = H * H;
    H = first * (one + (p2 * HH - two * p4)) * (one - (p6 * HH - T(3.0) * (p6 * p2)));
  }
  const T HH = H * H, pH = p * H, p2HH = p2 * HH;
  const T A2 = p2HH - two * p4, A3 = H * (p4 * p2HH - T(3.0) * (p4 * p4));
  DirectSeries<T> s;
  s.w0 = one - A2;
  s.w1 = T(3.0) * A3 - H;
  s.w2 = two * A2;
  s.w3 = T(-4.0) * A3;
  const T s3 = pH + p2, c3 = pH - p2, s5 = p2 * p2HH, both = p4 * pH;
  const T s5s = s5 + both - p6, c5c = s5 - both - p6;
  // tan(theta/2) at x = 0 and pi/2
  const T w_0 = s.w(one), w_quarter = s.w(T(-one));
  const T fs = one - s3 + s5s, fc = one + c3 + c5c;
  const T over_f = over / (fs * fc);
  const T S = lane.a1 * w_0 * (at_quarter * fc * over_f);
  const T C = lane.a2 * w_quarter * (at_0 * fs * over_f);
  s.x0 = C * (one - c3 - c5c);
  s.x1 = C * two * (c5c - c3);
  s.x2 = T(4.0) * (C * c5c);
  s.y0 = -(S * (one + s3 - s5s));
  s.y1 = S * two * (s3 + s5s);
  s.y2 = T(-4.0) * (S * s5s);
  const T Hs = H * (two * S * C) / (S * S + C * C);
  const T B3 = Hs * (p4 * p2HH - p4 * p4);
  s.z0 = B3 - Hs;
  s.z1 = two * (p2 * H * Hs);
  s.z2 = T(-4.0) * B3;
  return s;
}

// sn u, cn u and dn u times `unit`, sn and cn up to a common factor.
template <Number T>
struct AmplitudePoint {
  T sn, cn, dn, unit;
};
// k' and its root, the nome q of k, and q / eps.
template <Number T>
struct NomeOf {
  T kp, root_kp, q, stretch;
};

// Sine and cosine of x = pi u / (2K): tan x = sqrt k' sn/cn theta2-theta1 corrections of y = cos
// 2x, and (dn - sqrt k')/(dn + sqrt k') = 2 q y (1 + q^8 ...)/(1 + 2 q^4 ...).
template <Number T>
[[gnu::always_inline]] inline SinCos<T> phase_point(const AmplitudePoint<T>& u,
                                                    const NomeOf<T>& nome) {
  using std::sqrt;
  const T one(1.0), two(2.0), four(4.0);
  const T q = nome.q, q2 = q * q, q4 = q2 * q2, q6 = q4 * q2, q8 = q4 * q4, q12 = q6 * q6;
  const T c2 = u.cn * u.cn, s2 = u.sn * u.sn;
  const T d = u.dn + nome.root_kp * u.unit, scale = (one + nome.root_kp) * u.unit;
  const T first = (c2 - nome.kp * s2) * (scale * scale) / ((c2 + s2) * (d * d) * nome.stretch);
  const T q16 = q8 * q8;
  const T f0 = first * (((one - two * q4) + T(3.0) * q8) - (T(6.0) * q12 - T(11.0) * q16));
  const T f1 = first * ((four * (q4 - q8) + T(20.0) * q12) - T(40.0) * q16);
  const T f2 = first * (T(32.0) * q16 - T(16.0) * q12);
  T y = first;
  for (int i = 0; i < 5; ++i) {  // gains 4 q^4 each time, and is wanted to 1e-16 / q^2
    const T yy = y * y;
    y = f0 + yy * (f1 + yy * f2);
  }
  const T yy = y * y, even = four * yy - one, odd = two * y, last = T(8.0) * (yy * y) - four * y,
          last_even = four * yy - one;
  const T in_c = one - q2 * (one + odd) + q6 * (even + odd) - q12 * (last + last_even);
  const T in_s = one + q2 * (odd - one) + q6 * (even - odd) + q12 * (last - last_even);
  const T x = u.cn * in_c, z = nome.root_kp * u.sn * in_s;
  const T f = one / sqrt(x * x + z * z);
  return {f * z, f * x};
}

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline SinCos<T> direct_epoch(const PrimedLane<Arithmetic, T>& lane,
                                                     const DirectRates<Arithmetic, T>& rates) {
  const AmplitudePoint<T> u{lane.m.y * lane.a1, lane.m.x * lane.a2, lane.m.z, lane.a3};
  return phase_point(u, NomeOf<T>{rates.kp, rates.root_kp, rates.nome, rates.stretch});
}

// Sine and cosine of an angle below 2^16, the sum of two numbers, as reduced_sincos without its two
// divisions: a multiple of pi/2 is taken off in three parts.
template <Number T>
[[gnu::always_inline]] inline SinCos<T> sincos_of_few_turns(const TwoTerms<T>& a) {
  const T one(1.0), half(0.5);
  // pi/2 in three parts, of which two have 33 bits: their products with |k| < 2^20 are exact
  const T part1(0x1.921fb544p+0), part2(0x1.0b4611a6p-34), part3(0x1.3198a2e037073p-69);
  const T integer_bits(0x1.8p52);  // leaves the integer in the low bits of a sum
  const T shifted = a.hi * T(0.6366197723675814) + integer_bits;
  const T k = shifted - integer_bits;
  const TwoTerms<T> rest = two_sum(T((a.hi - k * part1) - k * part2), T(a.lo - k * part3));
  const T r = rest.hi, tail = rest.lo;
  const T z = r * r;
  T s(1.0 / 355687428096000.0), c(1.0 / 20922789888000.0);
  for (const double x : {-1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800, 1.0 / 362880,
                         -1.0 / 5040, 1.0 / 120, -1.0 / 6})
    s = s * z + T(x);
  for (const double x :
       {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24})
    c = c * z + T(x);
  const T sine = r + (r * (z * s) + tail);
  const T half_z = half * z, w = one - half_z;
  const T cosine = w + (((one - w) - half_z) + ((z * z) * c - r * tail));
  return quarters_turned(sine, cosine, shifted, k);
}

// The state whose series has the value p, where at the epoch its first and last numbers were w0 and
// z0, when the invariable frame has turned.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> direct_attitude(
    const BodyInLane<T>& body, const PrimedLane<Arithmetic, T>& lane, const T& w0, const T& z0,
    const BasicQuaternion<T>& p, const SinCos<T>& turn) {
  using std::sqrt;
  const T one(1.0), two(2.0);
  const T c = turn.cos * w0 + turn.sin * z0, d = turn.sin * w0 - turn.cos * z0;
  const BasicQuaternion<T> spun{c * p.w - d * p.z, c * p.x - d * p.y, c * p.y + d * p.x,
                                c * p.z + d * p.w};
  // from the axes at the epoch, whose axis 3 meets the momentum by the shortest turn
  const BasicVec3<T>& m = lane.m;
  const T u = lane.G.hi + m.z;
  const BasicVec3<T> v{u * spun.x - m.y * spun.w + m.x * spun.z,
                       u * spun.y + m.x * spun.w + m.y * spun.z,
                       u * spun.z - m.y * spun.y - m.x * spun.x};
  const T w = u * spun.w + m.y * spun.x - m.x * spun.y;
  const BasicVec3<T> back = lane.axes.restored(v);
  BasicRotorState<T> r;
  const BasicQuaternion<T> q = body.state.q * BasicQuaternion<T>{w, back.x, back.y, back.z};
  const T n2 = (p.w * p.w + p.x * p.x) + (p.y * p.y + p.z * p.z);
  const T norm = sqrt((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
  const T over = one / (norm * n2), f = over * n2;
  r.q = {f * q.w, f * q.x, f * q.y, f * q.z};
  const T h = lane.momentum_unit * (lane.G.hi * (over * norm)), h2 = two * h;
  r.g = lane.axes.restored(BasicVec3<T>{h2 * (p.x * p.z - p.w * p.y), h2 * (p.y * p.z + p.w * p.x),
                                        h * (p.w * p.w + p.z * p.z - p.x * p.x - p.y * p.y)});
  return r;
}

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline BasicRotorState<T> direct_state(
    const BodyInLane<T>& body, const PrimedLane<Arithmetic, T>& lane, const DirectSeries<T>& s,
    const SinCos<T>& epoch, const SinCos<T>& advance, const SinCos<T>& turn) {
  const T one(1.0), two(2.0);
  const T y0 = one - two * (epoch.sin * epoch.sin);
  const T w0 = s.w(y0), z0 = two * (epoch.sin * epoch.cos) * s.z(y0);
  const T sin_x = epoch.sin * advance.cos + epoch.cos * advance.sin;
  const T cos_x = epoch.cos * advance.cos - epoch.sin * advance.sin;
  const T y = one - two * (sin_x * sin_x);
  const BasicQuaternion<T> p{s.w(y), sin_x * s.x(y), cos_x * s.y(y),
                             two * (sin_x * cos_x) * s.z(y)};
  return direct_attitude(body, lane, w0, z0, p, turn);
}

// The state of a normalized arc next to the separatrix: the hyperbolic form of the series, with
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
                                                        const DirectRates<Arithmetic, T>& rates) {
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
                                                            const DirectRates<Arithmetic, T>& rates,
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
  return direct_attitude(body, lane, p0.w, p0.z, p, sincos_of_few_turns(turn));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
