// SPDX-License-Identifier: MIT
// Error-free transformations: the rounded result of one operation together with its exact rounding
// error.
//
// Equations   hi + lo = a + b (two_sum, quick_two_sum) and hi + lo = a b (two_prod, two_prod_fma),
//             exactly, with hi the rounded result. Knuth; Dekker and Veltkamp.
// Domain      two_sum: any finite numbers without overflow. quick_two_sum: |a| >= |b| or a = 0.
//             Products: |a|, |b| < 2^995 and |a b| in [2^-968, 2^1022]; the two of them then return
//             the same bits. Non-finite input gives a NaN error term.
// Accuracy    exact. Compile without -ffast-math: reassociation destroys these functions.
// Cost        6, 3, 17 and 2 flops. F is double or a pack of doubles. two_prod_fma is for callers
//             compiled for a processor with FMA (flags or a target attribute); elsewhere std::fma
//             is a slow library call, and two_prod is the fast one.
#pragma once

#include <cmath>

#include "polhode/version.hpp"  // asks for C++20

#ifdef __FAST_MATH__
#error "polhode needs IEEE arithmetic: compile without -ffast-math"
#endif

namespace polhode {
inline namespace v0 {

// An unevaluated sum: hi is the rounded result, lo what rounding left over.
template <class F>
struct TwoTerms {
  F hi;
  F lo;
};

template <class F>
[[gnu::always_inline]] constexpr TwoTerms<F> two_sum(const F& a, const F& b) {
  const F hi = a + b;
  const F b_part = hi - a;
  return {hi, (a - (hi - b_part)) + (b - b_part)};
}

template <class F>
[[gnu::always_inline]] constexpr TwoTerms<F> quick_two_sum(const F& a, const F& b) {
  const F hi = a + b;
  return {hi, b - (hi - a)};
}

// a = hi + lo with both parts of at most 26 bits (Veltkamp): products of parts are exact.
template <class F>
[[gnu::always_inline]] constexpr TwoTerms<F> split(const F& a) {
  const F c = F(134217729.0) * a;  // 2^27 + 1
  const F hi = c - (c - a);
  return {hi, a - hi};
}

template <class F>
[[gnu::always_inline]] constexpr TwoTerms<F> two_prod(const F& a, const F& b) {
  const F hi = a * b;
  const TwoTerms<F> x = split(a);
  const TwoTerms<F> y = split(b);
  return {hi, ((x.hi * y.hi - hi) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

template <class F>
[[gnu::always_inline]] inline TwoTerms<F> two_prod_fma(const F& a, const F& b) {
  using std::fma;
  const F hi = a * b;
  return {hi, fma(a, b, -hi)};
}

}  // namespace v0
}  // namespace polhode
