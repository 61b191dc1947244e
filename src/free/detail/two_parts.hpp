// SPDX-License-Identifier: MIT
// Arithmetic of numbers in two parts, hi + lo, of which lo is not kept below the rounding of hi:
// half the operations of DoubleDouble, and 100 bits as long as nothing cancels (settled() after a
// difference). Exact products are those of Arithmetic, so that the bits are the same with FMA and
// without (phase_arithmetic.hpp).
#pragma once

#include <cmath>

#include "polhode/free/detail/phase_arithmetic.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class Arithmetic, Number T>
struct TwoParts {
  T hi, lo;

  [[gnu::always_inline]] static TwoParts of(const TwoTerms<T>& x) { return {x.hi, x.lo}; }
  [[gnu::always_inline]] static TwoParts square(const T& x) {
    return of(Arithmetic::product(x, x));
  }
  [[gnu::always_inline]] static TwoParts product(const T& x, const T& y) {
    return of(Arithmetic::product(x, y));
  }
  [[gnu::always_inline]] static TwoParts difference(const T& x, const T& y) {
    return of(two_sum(x, T(-y)));
  }

  [[gnu::always_inline]] friend TwoParts operator+(const TwoParts& a, const TwoParts& b) {
    const TwoTerms<T> s = two_sum(a.hi, b.hi);
    return {s.hi, s.lo + (a.lo + b.lo)};
  }
  [[gnu::always_inline]] friend TwoParts operator-(const TwoParts& a, const TwoParts& b) {
    return a + TwoParts{-b.hi, -b.lo};
  }
  [[gnu::always_inline]] friend TwoParts operator*(const TwoParts& a, const TwoParts& b) {
    const TwoTerms<T> p = Arithmetic::product(a.hi, b.hi);
    return {p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi)};
  }
  [[gnu::always_inline]] friend TwoParts operator*(const TwoParts& a, const T& b) {
    const TwoTerms<T> p = Arithmetic::product(a.hi, b);
    return {p.hi, p.lo + a.lo * b};
  }
  // a / b, with 1 / b.hi to a rounding or two.
  [[gnu::always_inline]] friend TwoParts quotient(const TwoParts& a, const TwoParts& b,
                                                  const T& inverse) {
    const T q = a.hi * inverse;
    const TwoTerms<T> p = Arithmetic::product(q, b.hi);
    return {q, (((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo)) * inverse};
  }
  // The root with its first part given, and half of 1 / first.
  [[gnu::always_inline]] friend TwoParts root(const TwoParts& a, const T& first,
                                              const T& half_inverse) {
    const TwoTerms<T> p = Arithmetic::product(first, first);
    return {first, (((a.hi - p.hi) - p.lo) + a.lo) * half_inverse};
  }
  // By a power of two.
  [[gnu::always_inline]] friend TwoParts scaled(const TwoParts& a, double power) {
    return {T(power) * a.hi, T(power) * a.lo};
  }
  [[gnu::always_inline]] TwoParts settled() const { return of(quick_two_sum(hi, lo)); }
  [[gnu::always_inline]] friend TwoParts select(const Mask<T>& mask, const TwoParts& a,
                                                const TwoParts& b) {
    return {select(mask, a.hi, b.hi), select(mask, a.lo, b.lo)};
  }
  [[gnu::always_inline]] TwoTerms<T> terms() const { return {hi, lo}; }
};

// Products and differences with a third part, for the one difference that cancels.
template <class Arithmetic, Number T>
struct ThreeParts {
  T hi, middle, lo;

  [[gnu::always_inline]] static ThreeParts product(const TwoParts<Arithmetic, T>& a,
                                                   const TwoParts<Arithmetic, T>& b, const T& c) {
    const TwoTerms<T> p = Arithmetic::product(a.hi, b.hi), q = Arithmetic::product(a.hi, b.lo),
                      r = Arithmetic::product(a.lo, b.hi);
    const TwoTerms<T> s = two_sum(q.hi, r.hi), u = two_sum(p.lo, s.hi);
    const T third = ((u.lo + s.lo) + (q.lo + r.lo)) + a.lo * b.lo;
    const TwoTerms<T> first = Arithmetic::product(p.hi, c), second = Arithmetic::product(u.hi, c);
    const TwoTerms<T> w = two_sum(first.lo, second.hi);
    return {first.hi, w.hi, (w.lo + second.lo) + third * c};
  }
  [[gnu::always_inline]] friend TwoParts<Arithmetic, T> difference(const ThreeParts& a,
                                                                   const ThreeParts& b) {
    const TwoTerms<T> s = two_sum(a.hi, T(-b.hi)), t = two_sum(a.middle, T(-b.middle));
    const TwoTerms<T> u = two_sum(s.lo, t.hi), v = two_sum(s.hi, u.hi);
    const TwoTerms<T> r = two_sum(v.hi, T(v.lo + ((u.lo + t.lo) + (a.lo - b.lo))));
    return {r.hi, r.lo};
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
