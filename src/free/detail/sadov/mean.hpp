// SPDX-License-Identifier: MIT
// The arithmetic-geometric mean of a polhode in each lane of a pack: by Bulirsch's loop the action,
// by what goes along the nome and the shift of the theta function.
// docs/design/0033-grids-and-charts-in-lanes.md.
#pragma once

#include "polhode/math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
