// SPDX-License-Identifier: MIT
// The two mean rates of a fresh arc, by one arithmetic-geometric mean in two parts and the sum of
// the third kind that goes with it.
//
// U and V are the squares of a0 and b0: agm(a0, b0) / (A B C) is the rate of the phase x. With
// t_n = a_n b_n and s_0 = S, the mean of the third kind is 1 + e0/2 (1 + e1/2 (1 + ...)),
// e_n = (s_n - t_n)/(s_n + t_n), s_(n+1) = (s_n + t_n)^2 / (4 s_n)  [DLMF 19.8.6].
#pragma once

#include <cmath>
#include <cstddef>

#include "free/detail/fresh_arc.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class Arithmetic, Number T>
struct FreshRates {
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
[[gnu::always_inline]] inline void set_rates(FreshRates<Arithmetic, T>& r,
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
[[gnu::always_inline]] inline void set_nome(FreshRates<Arithmetic, T>& r, const T& a0, const T& b0,
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
[[gnu::always_inline]] inline FreshRates<Arithmetic, T> short_rates(
    const PrimedLane<Arithmetic, T>& p) {
  using std::sqrt;
  using Two = TwoParts<Arithmetic, T>;
  const T one(1.0), half(0.5), two(2.0);
  FreshRates<Arithmetic, T> r;
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
[[gnu::always_inline]] inline FreshRates<Arithmetic, T> long_rates(
    const PrimedLane<Arithmetic, T>& p) {
  using std::sqrt;
  using Two = TwoParts<Arithmetic, T>;
  const T one(1.0), half(0.5);
  FreshRates<Arithmetic, T> r;
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
