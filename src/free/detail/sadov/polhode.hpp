// SPDX-License-Identifier: MIT
// The polhode in each lane of a pack, for Sadov's variables and Serret's elements: by its momentum
// or by its action, with its arithmetic-geometric mean and the angles of its mean frame.
#pragma once

#include "free/detail/sadov/constants.hpp"
#include "math/pack_functions.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The polhode of a momentum in each lane of a pack, as Sadov's variables in lanes need it.
template <class T>
struct SadovCurve {
  using Mask = typename T::Mask;
  // negative1, negative3: momentum along primed axes 1 and 3; small: k^2 < 0.01; usual: not next to
  // what degenerates
  Mask long_axis, negative1, negative3, by_deficit, small, usual;
  BasicVec3<T> m;  // momentum along primed axes; m.x, m.z >= 0
  T G, k2, kp2, kap2, r2;
};

template <class T>
[[gnu::always_inline]] inline T of_mode(const typename T::Mask& long_axis, const double (&x)[2]) {
  return select(long_axis, T(x[1]), T(x[0]));
}

// G^2 - 2 T I2 times I1 I3, with its digits however much cancels.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> lane_separatrix_distance(const SadovConstants& c,
                                                                 const Pack<isa>& g1,
                                                                 const Pack<isa>& g3) {
  using T = Pack<isa>;
  const auto term = [](const T& g, const DoubleDouble& factor) {
    const TwoTerms<T> square = exact_product(g, g);
    const TwoTerms<T> p = exact_product(square.hi, T(factor.hi));
    return TwoTerms<T>{p.hi, p.lo + (square.hi * T(factor.lo) + square.lo * T(factor.hi))};
  };
  const TwoTerms<T> plus = term(g3, c.plus), minus = term(g1, c.minus);
  const TwoTerms<T> d = two_sum(plus.hi, T(-minus.hi));
  return d.hi + (d.lo + (plus.lo - minus.lo));
}

// Far enough from the separatrix for six terms of the theta function.
inline constexpr double least_complement = 1e-6;

// Of a momentum along the body axes.
template <InstructionSet isa>
[[gnu::always_inline]] inline SadovCurve<Pack<isa>> sadov_curve(const SadovConstants& c,
                                                                const BasicVec3<Pack<isa>>& g) {
  using T = Pack<isa>;
  const T one(1.0), zero(0.0);
  const T* const v[] = {&g.x, &g.y, &g.z};
  const T x = T(c.sign[0]) * *v[c.axis[0]], y = T(c.sign[1]) * *v[c.axis[1]],
          z = T(c.sign[2]) * *v[c.axis[2]];
  SadovCurve<T> k;
  const T g1 = x * x, g2 = y * y, g3 = z * z;
  k.G = sqrt(T(g1 + g2 + g3));
  const T D1 = g2 * T(c.d1[0]) + g3 * T(c.d1[1]);
  const T D3 = g1 * T(c.d3[0]) + g2 * T(c.d3[1]);
  const T D2 = lane_separatrix_distance(c, x, z);
  k.long_axis = D2 < zero;
  const T DA = select(k.long_axis, D3, D1), DC = select(k.long_axis, D1, D3);
  const T inverse = one / DA;
  k.k2 = of_mode<T>(k.long_axis, c.k2_per_DC) * DC * inverse;
  k.kp2 = of_mode<T>(k.long_axis, c.kp2_per_D2) * abs(D2) * inverse;
  k.r2 = of_mode<T>(k.long_axis, c.A_over_C) * DC * inverse;
  k.kap2 = of_mode<T>(k.long_axis, c.kap2);
  k.by_deficit = k.long_axis || k.r2 < one;
  const T x1 = select(k.long_axis, z, x), z1 = select(k.long_axis, x, z);
  k.negative1 = x1 < zero;
  k.negative3 = z1 < zero;
  k.m = {abs(x1), negated(k.long_axis != (k.negative1 != k.negative3), y), abs(z1)};
  k.small = k.k2 < T(0.01);
  k.usual = k.kp2 > T(least_complement) && k.r2 > T(1e-24) && k.r2 < T(1e12) && DC > zero &&
            of_mode<T>(k.long_axis, c.usual) > zero && k.G > T(0x1p-100) && k.G < T(0x1p100);
  return k;
}

// The momentum's length and the energy, to their last digits: elements hold the polhode by them.
template <class T>
struct LaneInvariants {
  T G, energy;
};
template <InstructionSet isa>
[[gnu::always_inline]] inline LaneInvariants<Pack<isa>> lane_invariants(
    const SadovConstants& c, const BasicVec3<Pack<isa>>& g) {
  using T = Pack<isa>;
  TwoTerms<T> G2{T(0.0), T(0.0)}, energy = G2;
  const T* const v[] = {&g.x, &g.y, &g.z};
  for (std::size_t j = 0; j < 3; ++j) {
    const DoubleDouble w = c.half_inverse[j];
    const TwoTerms<T> square = exact_product(*v[j], *v[j]);
    const TwoTerms<T> p = exact_product(square.hi, T(w.hi));
    const T rest = p.lo + (square.hi * T(w.lo) + square.lo * T(w.hi));
    const TwoTerms<T> sum = two_sum(G2.hi, square.hi), more = two_sum(energy.hi, p.hi);
    G2 = {sum.hi, G2.lo + (sum.lo + square.lo)};
    energy = {more.hi, energy.lo + (more.lo + rest)};
  }
  const T G = sqrt(G2.hi);
  const TwoTerms<T> again = exact_product(G, G);
  const T missing = ((G2.hi - again.hi) - again.lo) + G2.lo;
  return {G + missing * (T(0.5) / G), energy.hi + energy.lo};
}

// The polhode of an action in each lane: with y = 1 - a3/G, a3 the largest momentum along the axis
// that is circulated about, the deficit d of the action is a convex function of y, and
// d' = sqrt(1 + kappa^2) 2K / pi. It lies between its chord and its tangent at y = 0, so Newton's
// steps from between these settle soon. docs/design/0036-threads-and-the-way-back.md.
//
// The deficit of an action at y, and its derivative.
template <class T>
struct DeficitSlope {
  T deficit, slope;
};

// A polhode by y, for momentum 1.
template <class T>
struct PolhodeOfDeficit {
  T a3, r2, k2, kp2;
};
template <class T>
[[gnu::always_inline]] inline PolhodeOfDeficit<T> polhode_at(const T& y, const T& kap2,
                                                             const T& most, const T& least) {
  const T one(1.0), s = one - y, over = one / (s * s);
  const T r2 = y * (one + s) * over;
  return {s, r2, kap2 * r2, (one + kap2) * (most - y) * (s + least) * over};
}

template <class T>
[[gnu::always_inline]] inline DeficitSlope<T> deficit_at(const PolhodeOfDeficit<T>& c, const T& y,
                                                         const T& root_of_kap2) {
  const T one(1.0), two(2.0);
  T kc = sqrt(c.kp2), product = kc, mean = one, p = one / c.a3, inverse_p = c.a3, a = one, b(0.0);
#pragma GCC unroll 7
  for (int n = 0; n < 7; ++n) {  // Bulirsch's loop for cel(k', 1 + r2, 1, 0)
    const T part = product * inverse_p;
    const T next_a = a + b * inverse_p;
    b = two * (a * part + b);
    a = next_a;
    p = part + p;
    mean = kc + mean;
    if (n < 6) kc = two * sqrt(product);
    product = kc * mean;
    if (n < 6) inverse_p = one / p;
  }
  const T cel = (b + a * mean) / (mean * (mean + p));
  return {root_of_kap2 * (y * (one + c.a3) / c.a3) * cel, root_of_kap2 * (T(128.0) / mean)};
}

// The arithmetic-geometric mean of a polhode in each lane of a pack: by Bulirsch's loop the action,
// by what goes along the nome and the shift of the theta function.
// docs/design/0033-grids-and-charts-in-lanes.md.
template <class T>
struct SadovMean {
  T kc, mean, product, p, inverse_p, a, b;
  T c_n;  // 2^n c_n, c_n^2 = a_n^2 - b_n^2
  T e;    // e^(-2 psi_n), psi the imaginary amplitude
  T inverse_mean;
  T nome, shift;  // logarithms, from n = 4 and 6 on
};

// Of cel(k', p^2, 1, b).
template <InstructionSet isa>
[[gnu::always_inline]] inline void begin_mean(SadovMean<Pack<isa>>& s, const Pack<isa>& kp2,
                                              const Pack<isa>& p, const Pack<isa>& b,
                                              const Pack<isa>& kap2, const Pack<isa>& r2) {
  using T = Pack<isa>;
  const T one(1.0);
  s.kc = s.product = sqrt(kp2);
  s.mean = one;
  s.p = p;
  s.inverse_p = one / s.p;
  s.a = one;
  s.b = b * s.inverse_p;
  // psi of the larger of kappa and a1/a3: its partner, of the other, makes ln(1/q) up
  const T v = select(kap2 < r2, r2, kap2), root = one + sqrt(T(one + v));
  s.e = v / (root * root);
}

// sqrt(q_n) of a small modulus.
template <class T>
[[gnu::always_inline]] inline T nome_root(const T& modulus) {
  const T m = modulus * modulus;
  return T(0.25) * modulus * (T(1.0) + m * (T(0.25) + m * T(17.0 / 128)));
}

// One of seven steps: that of c_n / a_n and of the imaginary amplitude, whose own step is
// e -> e (r + e) / (1 + r e), too. `small`: k^2 < 0.01.
template <int n, InstructionSet isa>
[[gnu::always_inline]] inline void step_of_mean(SadovMean<Pack<isa>>& s, const Pack<isa>& k2,
                                                const PackMask<isa>& small) {
  using T = Pack<isa>;
  const T two(2.0);
  const T part = s.product * s.inverse_p;
  const T next_a = s.a + s.b * s.inverse_p;
  s.b = two * (s.a * part + s.b);
  s.a = next_a;
  s.p = part + s.p;
  s.mean = s.kc + s.mean;
  if (n < 6) s.kc = two * sqrt(s.product);
  s.product = s.kc * s.mean;
  // one quotient for the three that are needed
  const T square = n == 0 ? k2 : T(s.c_n * s.c_n), mean2 = s.mean * s.mean;
  const T under = mean2 + square * s.e, all = T(1.0) / (s.p * s.mean * under);
  s.inverse_p = all * (s.mean * under);
  s.inverse_mean = all * (s.p * under);
  s.e = s.e * (square + s.e * mean2) * (all * (s.p * s.mean));
  s.c_n = square * s.inverse_mean;
  if (n == 2) s.nome = log_of(T(T(0.25) * s.c_n * s.inverse_mean)) * T(0.25);
  if (n == 4)
    s.nome = select(small, s.nome, T(log_of(nome_root(T(s.c_n * s.inverse_mean))) * T(0.0625)));
  if (n == 3) s.shift = s.e;
  if (n == 6)
    s.shift = log_of(select(small, s.shift, s.e)) * select(small, T(0.0625), T(0.0078125));
}

// ln w = -2a of the theta function: that of the shift, or of its partner, which make up ln q.
template <class T>
[[gnu::always_inline]] inline T log_of_shift(const SadovMean<T>& s, const T& kap2, const T& r2) {
  return select(kap2 < r2, T(s.nome - s.shift), s.shift);
}

// A complex number: a direction in a plane, times a positive scale that is of no interest.
template <class T>
struct LanePhasor {
  T re, im;

  [[gnu::always_inline]] friend LanePhasor operator*(const LanePhasor& a, const LanePhasor& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  [[gnu::always_inline]] friend LanePhasor operator+(const LanePhasor& a, const LanePhasor& b) {
    return {a.re + b.re, a.im + b.im};
  }
  [[gnu::always_inline]] friend LanePhasor operator-(const LanePhasor& a, const LanePhasor& b) {
    return {a.re - b.re, a.im - b.im};
  }
  [[gnu::always_inline]] friend LanePhasor operator*(const T& s, const LanePhasor& a) {
    return {s * a.re, s * a.im};
  }
  [[gnu::always_inline]] friend LanePhasor conj(const LanePhasor& a) { return {a.re, -a.im}; }
  [[gnu::always_inline]] friend LanePhasor select(const typename T::Mask& mask, const LanePhasor& a,
                                                  const LanePhasor& b) {
    return {select(mask, a.re, b.re), select(mask, a.im, b.im)};
  }
};

// A quaternion as a + b i with a = w + z k, b = x + y k: turns about axis 3 are factors of a and b.
template <class T>
struct LanePhasorPair {
  LanePhasor<T> a, b;
};

// Times the inverse of the half turn that makes the momentum along axes 1 and 3 positive.
template <class T>
[[gnu::always_inline]] inline LanePhasorPair<T> with_positive_axes(const SadovCurve<T>& k,
                                                                   const BasicQuaternion<T>& q) {
  using P = LanePhasor<T>;
  const P a{q.w, q.z}, b{q.x, q.y}, ia{a.im, -a.re}, ib{b.im, -b.re};  // times -i
  const auto both = k.negative1 && k.negative3;
  const auto chosen = [&](const P& none, const P& x, const P& y, const P& z) {
    return select(both, y, select(k.negative1, z, select(k.negative3, x, none)));
  };
  return {chosen(a, b, ib, ia), chosen(b, {-a.re, -a.im}, ia, {-ib.re, -ib.im})};
}

// e^(i mean angle) but for that of theta, of an attitude of the body axes; not of length one.
template <class T>
[[gnu::always_inline]] inline LanePhasor<T> frame_phasor(const SadovConstants& c,
                                                         const SadovCurve<T>& k,
                                                         const BasicQuaternion<T>& attitude) {
  using P = LanePhasor<T>;
  const auto constant = [&](std::size_t j) {
    return select(k.long_axis, T(c.to_axes[1][j]), T(c.to_axes[0][j]));
  };
  const LanePhasorPair<T> s = with_positive_axes(
      k, attitude * BasicQuaternion<T>{constant(0), constant(1), constant(2), constant(3)});
  const T above = k.G + k.m.z;
  const P along = above * s.a + s.b * P{k.m.y, k.m.x};
  const P across = above * s.b - s.a * P{k.m.y, -k.m.x};
  return along * conj(across);
}

// H, with the rounding of the result alone near +-G: there G - |H| comes from the node.
template <class T>
[[gnu::always_inline]] inline T third_momentum(const T& G, const T& along, const T& node2) {
  const T size = G - node2 / (G + abs(along));
  return select(abs(along) < T(0.5) * G, along, negated(signbit(along), size));
}

// Within (-pi, pi] of an angle within three of it.
template <class T>
[[gnu::always_inline]] inline T wrapped_angle(const T& angle) {
  const T turn(6.283185307179586), pi(3.141592653589793);
  const T r = angle - select(angle > pi, turn, T(0.0));
  return r + select(r <= -pi, turn, T(0.0));
}

// An angle of less than 2^20 turns, in two parts, less whole turns: pairs of them where the half of
// it is to keep its sign.
template <int together, InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> whole_turns_off(const TwoTerms<Pack<isa>>& angle) {
  using T = Pack<isa>;
  // a turn in three parts; the first two have 33 bits
  const T part1(0x1.921fb544p+2), part2(0x1.0b4611a6p-32), part3(0x1.3198a2e037073p-67);
  const T k = T(together) * rint(T(angle.hi * T(0.15915494309189535 / together)));
  return ((angle.hi - k * part1) - k * part2) + (angle.lo - k * part3);
}
inline constexpr double most_radians = 1e6;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
