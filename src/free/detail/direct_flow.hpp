// SPDX-License-Identifier: MIT
// The state of a body that is met once: moments, a state and a time in, the state at that time out,
// without an elliptic function, an angle at the epoch, or a branch; a number or a pack, a body a
// lane. Here its arc and the two mean rates, in direct_flow_state.hpp the state.
//
// Formulas and names: docs/design/0032-many-bodies.md. "Primed" axes are those of
// polhode_curve.hpp: A, B, C are the moments about them, CB = |C - B| and so on.
#pragma once

#include <cmath>
#include <cstddef>

#include "free/detail/two_parts.hpp"
#include "polhode/free/detail/phase_arithmetic.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Primed axes <- body axes: exchanges of axes and three signs with determinant +1.
template <Number T>
struct LaneAxes {
  Mask<T> low, high, low_again, outer;  // 1 and 2, 2 and 3, 1 and 2, 1 and 3 change places
  T s1, s2, s3;

  [[gnu::always_inline]] static void swap_if(const Mask<T>& mask, T& a, T& b) {
    const T x = select(mask, b, a);
    b = select(mask, a, b);
    a = x;
  }
  // Sorts the moments, and a vector with them.
  [[gnu::always_inline]] void sort(BasicVec3<T>& I, BasicVec3<T>& g) {
    low = I.y < I.x;
    swap_if(low, I.x, I.y);
    swap_if(low, g.x, g.y);
    high = I.z < I.y;
    swap_if(high, I.y, I.z);
    swap_if(high, g.y, g.z);
    low_again = I.y < I.x;
    swap_if(low_again, I.x, I.y);
    swap_if(low_again, g.x, g.y);
  }
  // Then axis 3 is that which the momentum circles about, and axes 1 and 3 point along it.
  [[gnu::always_inline]] void prime(const Mask<T>& long_axis, BasicVec3<T>& g) {
    const T one(1.0), zero(0.0);
    outer = long_axis;
    swap_if(outer, g.x, g.z);
    s1 = select(g.x < zero, T(-one), one);
    s3 = select(g.z < zero, T(-one), one);
    const auto odd = (low != high) != (low_again != outer);
    s2 = select(odd, T(-(s1 * s3)), T(s1 * s3));
    g = {s1 * g.x, s2 * g.y, s3 * g.z};
  }
  [[gnu::always_inline]] BasicVec3<T> restored(const BasicVec3<T>& v) const {
    BasicVec3<T> u{s1 * v.x, s2 * v.y, s3 * v.z};
    swap_if(outer, u.x, u.z);
    swap_if(low_again, u.x, u.y);
    swap_if(high, u.y, u.z);
    swap_if(low, u.x, u.y);
    return u;
  }
};

// Whose turns are few enough for rates of 62 bits: those of 1024 radians at the fastest rate that
// the body could have.
inline constexpr double short_arc_radians = 1024.0;
// Beyond so many the rates of lanes have too few digits.
inline constexpr double long_arc_radians = 0x1p36;

template <Number T>
struct BodyInLane {
  BasicVec3<T> moments;
  BasicRotorState<T> state;
  T t, t0;
};

// What the moments and the momentum are in primed axes, and the first products.
template <class Arithmetic, Number T>
struct PrimedLane {
  using Two = TwoParts<Arithmetic, T>;
  LaneAxes<T> axes;
  Mask<T> ordinary;
  Mask<T> long_axis;
  TwoTerms<T> elapsed;
  T momentum_unit;  // the power of two that g is divided by
  T sense;          // of the phase: -1 in long-axis mode
  BasicVec3<T> m;   // momentum
  T a1, a2, a3;     // amplitudes of m
  T X, Y, Z;        // A CB, C BA and B CA
  Mask<T> is_short;
  Two U, V;          // k'^2 = V / U
  Two S;             // p0^2 U of the mean of the third kind
  Two base, share;   // Omega = (base + share mean / 2) / (ABC G), less the phase rate where
  Mask<T> by_axis3;  // the precession of axis 3 is the better one
  Two G, ABC;
  T ABC_inverse;
};

// The least and greatest of what goes in lanes, after scaling.
inline constexpr double least_ratio = 0x1p-20;
inline constexpr double least_product = 0x1p-60;

// Whether the numbers of a body can be scaled, and its attitude normalised.
template <Number T>
[[gnu::always_inline]] inline Mask<T> is_ordinary(const BodyInLane<T>& body, const T& g_most) {
  const auto sizes = [](const T& x) { return x > T(0x1p-500) && x < T(0x1p500); };
  const BasicQuaternion<T>& q = body.state.q;
  const T q2 = (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z);
  return sizes(body.moments.x) && sizes(body.moments.y) && sizes(body.moments.z) && sizes(g_most) &&
         sizes(q2);
}

// Whether scaled and sorted moments are those of a body, and products of them are far from the ends
// of double range.
template <Number T>
[[gnu::always_inline]] inline Mask<T> has_room(const BasicVec3<T>& I, const T& X, const T& PA,
                                               const T& PC) {
  const T least(least_product);
  return I.x > T(least_ratio) && I.z - (I.x + I.y) <= T(0x1p-51) && X > least && PA > least &&
         PC > least * least;
}

// What grows with time: squares of the first two numbers of the mean, and the terms of the
// precession. m1, m3 and G2 are squares in primed axes.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline void set_terms(
    PrimedLane<Arithmetic, T>& p, const BasicVec3<T>& I, const TwoParts<Arithmetic, T>& X,
    const TwoParts<Arithmetic, T>& Y, const TwoParts<Arithmetic, T>& Z,
    const TwoParts<Arithmetic, T>& P2, const TwoParts<Arithmetic, T>& PA,
    const TwoParts<Arithmetic, T>& PC, const TwoParts<Arithmetic, T>& G2) {
  using Two = TwoParts<Arithmetic, T>;
  p.U = X * PA;
  p.V = Z * P2;
  const Two XG = X * G2;
  p.by_axis3 = PA.hi < XG.hi;
  p.S = Z * select(p.by_axis3, PA, XG);
  const T A = select(p.long_axis, I.z, I.x), C = select(p.long_axis, I.x, I.z);
  const Two IG = G2 * I.y;
  p.base = IG * select(p.by_axis3, C, A);
  const Two mean3 = Y * G2;
  p.share = select(p.by_axis3, mean3, PC);
  // + in short-axis mode for axis 1 and - for axis 3, the other way in long-axis mode
  const T sign = select(p.by_axis3, T(-p.sense), p.sense);
  p.share = {sign * p.share.hi, sign * p.share.lo};
  p.ABC = Two::product(I.x, I.y) * I.z;
}

// `near`: next to the separatrix, where P2 cancels.
template <bool near, class Arithmetic, Number T>
[[gnu::always_inline]] inline PrimedLane<Arithmetic, T> primed_lane(const BodyInLane<T>& body) {
  using std::abs;
  using std::sqrt;
  using Two = TwoParts<Arithmetic, T>;
  PrimedLane<Arithmetic, T> p;
  BasicVec3<T> I = body.moments, g = body.state.g;
  p.axes.sort(I, g);
  const auto larger = [](const T& a, const T& b) { return select(a > b, a, b); };
  const T g_most = larger(larger(T(abs(g.x)), T(abs(g.y))), T(abs(g.z)));
  p.momentum_unit = power_below(g_most);
  const T i = inverse_power_below(I.z), j = inverse_power_below(g_most);
  I = i * I;
  g = j * g;
  const TwoTerms<T> since = two_sum(body.t, T(-body.t0));
  const T rate = p.momentum_unit * i;
  p.elapsed = {rate * since.hi, rate * since.lo};

  const Two d21 = Two::difference(I.y, I.x), d31 = Two::difference(I.z, I.x),
            d32 = Two::difference(I.z, I.y);
  const Two e1 = d32 * I.x, e3 = d21 * I.z, Z = d31 * I.y;
  const Two g1 = Two::square(g.x), g2 = Two::square(g.y), g3 = Two::square(g.z);
  const Two plus = g3 * e1, minus = g1 * e3;
  Two P2 = (plus - minus).settled();
  if constexpr (near) {
    using Three = ThreeParts<Arithmetic, T>;
    P2 = difference(Three::product(g3, d32, I.x), Three::product(g1, d21, I.z));
  }
  p.long_axis = P2.hi < T(0.0);
  const auto& along = p.long_axis;
  P2 = select(along, Two{-P2.hi, -P2.lo}, P2);
  const Two X = select(along, e3, e1), Y = select(along, e1, e3);  // A CB and C BA
  const Two m1 = select(along, g3, g1), m3 = select(along, g1, g3);
  const Two PA = g2 * Y + m3 * Z, PC = m1 * Z + g2 * X;
  const Two G2 = (g1 + g2) + g3;
  p.m = g;
  p.axes.prime(along, p.m);
  p.sense = select(along, T(-1.0), T(1.0));
  set_terms(p, I, X, Y, Z, P2, PA, PC, G2);
  p.X = X.hi;
  p.Y = Y.hi;
  p.Z = Z.hi;
  const T G = sqrt(G2.hi);
  const T ZX = Z.hi * X.hi, over = T(1.0) / (ZX * G2.hi);
  const T over_ZX = over * G2.hi;
  p.G = root(G2, G, T(0.5) * G * (over * ZX));
  const T over_Z = X.hi * over_ZX, over_X = Z.hi * over_ZX;
  p.a1 = sqrt(PC.hi * over_Z);
  p.a2 = sqrt(PC.hi * over_X);
  p.a3 = sqrt(PA.hi * over_Z);

  // |omega| <= |g| / I1
  p.is_short = abs(p.elapsed.hi) < T(short_arc_radians) * I.x;
  // what cancels in P2, over what is left of it
  const T lost = (plus.hi + minus.hi) * T(near ? 0x1p-60 : 0x1p-6);
  p.ordinary = is_ordinary(body, g_most) && abs(p.elapsed.hi) < T(long_arc_radians) * I.x &&
               has_room(I, X.hi, PA.hi, PC.hi) && P2.hi > lost;
  return p;
}

// The two mean rates of a normalized arc, by one arithmetic-geometric mean in two parts and the sum
// of the third kind that goes with it.
//
// U and V are the squares of a0 and b0: agm(a0, b0) / (A B C) is the rate of the phase x. With
// t_n = a_n b_n and s_0 = S, the mean of the third kind is 1 + e0/2 (1 + e1/2 (1 + ...)),
// e_n = (s_n - t_n)/(s_n + t_n), s_(n+1) = (s_n + t_n)^2 / (4 s_n)  [DLMF 19.8.6].
template <class Arithmetic, Number T>
struct DirectRates {
  TwoTerms<T> phase;            // of x; negative in long-axis mode
  TwoTerms<T> half_precession;  // Lambda
  T root_kp, kp;                // sqrt(k') and k'
  T nome;                       // q
  T stretch;                    // q / eps, eps = (1 - sqrt k')/(2 (1 + sqrt k'))
  T mean;                       // agm(a0, b0)
};

// q/eps as a series in eps^4: the nome for k' >= 0.28.
template <Number T>
[[gnu::always_inline]] inline T nome_over_epsilon(const T& eps4) {
  T s(3567400.0);
  for (const double c : {268616.0, 20910.0, 1707.0, 150.0, 15.0, 2.0, 1.0}) s = s * eps4 + T(c);
  return s;
}

// The arithmetic-geometric mean of two numbers in two parts, and e0, e1, ... with it.
template <class Arithmetic, Number T>
struct MeanSteps {
  using Two = TwoParts<Arithmetic, T>;
  Two a, b, t, s;

  // e of this step; then a, b and s are those of the next, but not t.
  [[gnu::always_inline]] Two advanced() {
    const Two sum = s + t, difference = (s - t).settled();
    const T over_both = T(1.0) / (sum.hi * s.hi);
    const Two e = quotient(difference, sum, T(s.hi * over_both));
    s = scaled(quotient(sum * sum, s, T(sum.hi * over_both)), 0.25);
    return e;
  }
};

// 1 + x y / 2.
template <class Two>
[[gnu::always_inline]] inline Two one_and_half(const Two& x, const Two& y) {
  const Two half = scaled(x * y, 0.5);
  const auto sum = quick_two_sum(decltype(half.hi)(1.0), half.hi);
  return {sum.hi, sum.lo + half.lo};
}

// What is left of the sum of the third kind when a and b have met: s - t, s and t as they are there
// and in the two steps after, m the square of the mean.
template <Number T>
[[gnu::always_inline]] inline T mean_tail(const T& difference, const T& s, const T& t,
                                          const T& next_t, const T& m) {
  const T one(1.0), half(0.5), four(4.0);
  const T sum = s + t, square = sum * sum, b = four * (s * next_t);
  const T c = square + b, third = c * c, d = T(16.0) * (s * square) * m;
  const T e2 = (third - d) / (third + d), over = one / (sum * c);
  const T e1 = (square - b) * sum * over, e0 = difference * c * over;
  return one + half * e0 * (one + half * e1 * (one + half * e2));
}

// M is the mean of a0 and b0, third that of the third kind.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline void set_rates(DirectRates<Arithmetic, T>& r,
                                             const PrimedLane<Arithmetic, T>& p,
                                             const TwoParts<Arithmetic, T>& M,
                                             const TwoParts<Arithmetic, T>& third) {
  using Two = TwoParts<Arithmetic, T>;
  const Two D = p.ABC * p.G;
  const T over_D = T(1.0) / D.hi;
  Two phase = quotient(M * p.G, D, over_D);
  phase = {p.sense * phase.hi, p.sense * phase.lo};
  Two turn = quotient(p.base + scaled(p.share * third, 0.5), D, over_D);
  const Two of_axis1 = turn - phase;
  turn = select(p.by_axis3, of_axis1, turn);
  r.mean = M.hi;
  r.phase = phase.settled().terms();
  r.half_precession = scaled(turn, 0.5).settled().terms();
}

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline void set_nome(DirectRates<Arithmetic, T>& r, const T& a0, const T& b0,
                                            const T& b1, const T& over_t0) {
  const T half(0.5);
  r.root_kp = b1 * b0 * over_t0;
  r.kp = b0 * b0 * over_t0;
  const T eps = half * (a0 - b1) / (a0 + b1), eps2 = eps * eps;
  const T stretch = nome_over_epsilon(T(eps2 * eps2));
  r.nome = eps * stretch;
  r.stretch = stretch;
}

// Rates of 62 bits and more, for k' >= 0.28.
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline DirectRates<Arithmetic, T> short_rates(
    const PrimedLane<Arithmetic, T>& p) {
  using std::sqrt;
  using Two = TwoParts<Arithmetic, T>;
  const T one(1.0), half(0.5), two(2.0);
  DirectRates<Arithmetic, T> r;
  const T a0 = sqrt(p.U.hi), b0 = sqrt(p.V.hi);
  const T over_t0 = one / (a0 * b0);
  MeanSteps<Arithmetic, T> mean;
  mean.a = root(p.U, a0, T(half * b0 * over_t0));
  mean.b = root(p.V, b0, T(half * a0 * over_t0));
  mean.t = mean.a * mean.b;
  mean.s = p.S;
  const Two e0 = mean.advanced();
  const T b1 = sqrt(mean.t.hi);
  set_nome(r, a0, b0, b1, over_t0);
  mean.a = scaled(mean.a + mean.b, 0.5);
  mean.b = root(mean.t, b1, T(half * b1 * over_t0));
  mean.t = mean.a * mean.b;
  const Two e1 = mean.advanced();
  mean.a = scaled(mean.a + mean.b, 0.5);
  // agm(a2, b2) = a2 / theta3(q^4)^2, b2 = a2 (theta4 / theta3)^2
  const T q2 = r.nome * r.nome, q4 = q2 * q2, q8 = q4 * q4;
  const T u = two * (q4 + q8 * q8), over = one / (one + u);
  const T shrink = -(u * (two + u)) * (over * over);
  const T ratio = (one - two * q4 + two * q8 * q8) * over, ratio2 = ratio * ratio;
  const T a22 = mean.a.hi * mean.a.hi, m = a22 * ((one + shrink) * (one + shrink));
  const T t2 = a22 * ratio2;
  const T tail = mean_tail(T((mean.s.hi - t2) + mean.s.lo), mean.s.hi, t2,
                           T(half * a22 * ratio * (one + ratio2)), m);
  const Two M = Two{mean.a.hi, mean.a.lo + mean.a.hi * shrink}.settled();
  set_rates(r, p, M, one_and_half(e0, one_and_half(e1, Two{tail, T(0.0)})));
  return r;
}
// Rates of 95 bits, by so many steps in two parts: 4 do for k' >= 0.28, 8 for k' >= 2^-30.
template <std::size_t steps, class Arithmetic, Number T>
[[gnu::always_inline]] inline DirectRates<Arithmetic, T> long_rates(
    const PrimedLane<Arithmetic, T>& p) {
  using std::sqrt;
  using Two = TwoParts<Arithmetic, T>;
  const T one(1.0), half(0.5);
  DirectRates<Arithmetic, T> r;
  const T a0 = sqrt(p.U.hi), b0 = sqrt(p.V.hi);
  const T over_t0 = one / (a0 * b0);
  MeanSteps<Arithmetic, T> mean;
  mean.a = root(p.U, a0, T(half * b0 * over_t0));
  mean.b = root(p.V, b0, T(half * a0 * over_t0));
  mean.t = mean.a * mean.b;
  mean.s = p.S;
  Two e[steps];
  for (std::size_t i = 0; i < steps; ++i) {
    e[i] = mean.advanced();
    const T b = sqrt(mean.t.hi);
    if (i == 0) set_nome(r, a0, b0, b, over_t0);
    mean.a = scaled(mean.a + mean.b, 0.5);
    mean.b = root(mean.t, b, T(half / b));
    mean.t = mean.a * mean.b;
  }
  // agm(a, b) = (a + b)/2 (1 - x^2/4 - ...), x = (a - b)/(a + b)
  Two M = scaled(mean.a + mean.b, 0.5);
  const T x = half * ((mean.a - mean.b).settled().hi / M.hi);
  M.lo = M.lo - T(0.25) * M.hi * (x * x);
  M = M.settled();
  const T m = M.hi * M.hi;
  Two third{mean_tail((mean.s - mean.t).settled().hi, mean.s.hi, mean.t.hi, m, m), T(0.0)};
  for (std::size_t i = steps; i-- > 0;) third = one_and_half(e[i], third);
  set_rates(r, p, M, third);
  return r;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
