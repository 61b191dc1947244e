// SPDX-License-Identifier: MIT
// In this header: error_free, double_double.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/math/real.hpp"
#include "polhode/version.hpp"  // asks for C++20

#ifdef __FAST_MATH__
#error "polhode needs IEEE arithmetic: compile without -ffast-math"
#endif

namespace polhode {
inline namespace v0 {

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

// DoubleDouble: a real number as an unevaluated sum of two doubles, about 32 decimal digits.
//
// Equations   value = hi + lo with |lo| <= ulp(hi)/2. Sums, products, quotients and roots follow
//             Joldes, Muller and Popescu (2017) and Lefevre et al. (2023), the accurate variants.
// Units       none: a DoubleDouble is a Real.
// Domain      full accuracy for magnitudes in [1e-270, 1e290]: below, the low part is subnormal;
//             above, the splitting of a product overflows. sin, cos, sincos and tan: |x| <= 1e10,
//             beyond which they have the digits of double. Infinities and NaN pass through with
//             lo = 0; signed zeros keep their sign in hi.
// Accuracy    budget double_double_* in tests/budgets.hpp: a few times epsilon = 2^-104, relative,
//             also where a difference cancels and near the zeros of log, expm1, sin and atan2.
// Errors      none; NaN outside the domain of a function, as in <cmath>.
// Cost        + 20, * 24, / about 80 flops, inline; elementary functions well below 1 us. Products
//             use Dekker's splitting (two_prod), never fma: a file compiled for FMA and one that is
//             not then share the same inline code, and the bits do not depend on the processor.

struct DoubleDouble {
  double hi = 0.0;
  double lo = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double x) : hi(x) {}  // NOLINT(google-explicit-constructor): exact
  // Precondition: high + low rounds to high (use sum() or product() for two unrelated doubles).
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  constexpr explicit operator double() const { return hi; }

  // a + b and a b of two doubles, without any rounding.
  static constexpr DoubleDouble sum(double a, double b) { return settled(two_sum(a, b)); }
  static constexpr DoubleDouble product(double a, double b) {
    const TwoTerms<double> p = two_prod(a, b);
    return settled_product(p, p.hi);
  }
  static constexpr DoubleDouble pi() { return {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53}; }
  static constexpr DoubleDouble two_pi() { return {0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52}; }
  static constexpr DoubleDouble half_pi() { return {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54}; }

  friend constexpr DoubleDouble operator+(DoubleDouble a) { return a; }
  friend constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }

  friend constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
    const TwoTerms<double> high = two_sum(a.hi, b.hi);
    const TwoTerms<double> low = two_sum(a.lo, b.lo);
    const TwoTerms<double> first = quick_two_sum(high.hi, high.lo + low.hi);
    return settled(quick_two_sum(first.hi, first.lo + low.lo), high.hi);
  }
  friend constexpr DoubleDouble operator+(DoubleDouble a, double b) {
    const TwoTerms<double> s = two_sum(a.hi, b);
    return settled(quick_two_sum(s.hi, s.lo + a.lo), s.hi);
  }
  friend constexpr DoubleDouble operator+(double a, DoubleDouble b) { return b + a; }
  friend constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + (-b); }
  friend constexpr DoubleDouble operator-(DoubleDouble a, double b) { return a + (-b); }
  friend constexpr DoubleDouble operator-(double a, DoubleDouble b) { return (-b) + a; }

  friend constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
    const TwoTerms<double> p = two_prod(a.hi, b.hi);
    const double cross = a.hi * b.lo + (a.lo * b.hi + a.lo * b.lo);
    return settled_product(quick_two_sum(p.hi, p.lo + cross), p.hi);
  }
  friend constexpr DoubleDouble operator*(DoubleDouble a, double b) {
    const TwoTerms<double> p = two_prod(a.hi, b);
    return settled_product(quick_two_sum(p.hi, p.lo + a.lo * b), p.hi);
  }
  friend constexpr DoubleDouble operator*(double a, DoubleDouble b) { return b * a; }

  friend constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
    const double q0 = a.hi / b.hi;
    if (q0 == 0.0 || q0 - q0 != 0.0) return q0;  // 0/x, x/inf, overflow, x/0, 0/0
    const DoubleDouble r0 = a - b * q0;
    const double q1 = r0.hi / b.hi;
    const DoubleDouble r1 = r0 - b * q1;
    const TwoTerms<double> q = quick_two_sum(q0, q1);
    return DoubleDouble{q.hi, q.lo} + r1.hi / b.hi;
  }

  constexpr DoubleDouble& operator+=(DoubleDouble b) { return *this = *this + b; }
  constexpr DoubleDouble& operator-=(DoubleDouble b) { return *this = *this - b; }
  constexpr DoubleDouble& operator*=(DoubleDouble b) { return *this = *this * b; }
  constexpr DoubleDouble& operator/=(DoubleDouble b) { return *this = *this / b; }

  friend constexpr bool operator==(DoubleDouble a, DoubleDouble b) {
    return a.hi == b.hi && a.lo == b.lo;
  }
  friend constexpr bool operator<(DoubleDouble a, DoubleDouble b) {
    return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
  }
  friend constexpr bool operator>(DoubleDouble a, DoubleDouble b) { return b < a; }
  friend constexpr bool operator<=(DoubleDouble a, DoubleDouble b) {
    return a.hi < b.hi || (a.hi == b.hi && a.lo <= b.lo);
  }
  friend constexpr bool operator>=(DoubleDouble a, DoubleDouble b) { return b <= a; }

  // All functions are found by argument-dependent lookup only, so that no double is promoted by
  // accident.
  friend bool isnan(DoubleDouble x) { return std::isnan(x.hi); }
  friend bool isinf(DoubleDouble x) { return std::isinf(x.hi); }
  friend bool isfinite(DoubleDouble x) { return std::isfinite(x.hi); }
  friend bool signbit(DoubleDouble x) { return std::signbit(x.hi); }
  friend DoubleDouble abs(DoubleDouble x) { return std::signbit(x.hi) ? -x : x; }
  friend DoubleDouble fabs(DoubleDouble x) { return abs(x); }
  friend DoubleDouble copysign(DoubleDouble x, DoubleDouble s) {
    return std::signbit(x.hi) == std::signbit(s.hi) ? x : -x;
  }
  friend DoubleDouble ldexp(DoubleDouble x, int n) {
    return {std::ldexp(x.hi, n), std::ldexp(x.lo, n)};
  }
  friend DoubleDouble floor(DoubleDouble x) {
    const double f = std::floor(x.hi);
    if (f != x.hi || !std::isfinite(f)) return f;  // |lo| cannot carry hi over an integer below
    return settled(quick_two_sum(f, std::floor(x.lo)));
  }
  // Nearest integer, halves to even, as std::rint.
  friend DoubleDouble rint(DoubleDouble x) {
    const double r = std::rint(x.hi);
    if (r == x.hi) return settled(quick_two_sum(r, std::rint(x.lo)));  // inf and NaN too
    const bool halfway = std::abs(x.hi - r) == 0.5 && x.lo != 0.0;     // lo knows the side
    return halfway ? (x.lo < 0.0 ? std::floor(x.hi) : std::ceil(x.hi)) : r;
  }
  friend DoubleDouble ceil(DoubleDouble x) { return -floor(-x); }
  // Nearest integer, halves away from zero, as std::round.
  friend DoubleDouble round(DoubleDouble x) {
    return std::signbit(x.hi) ? -floor(0.5 - x) : floor(x + 0.5);
  }
  friend DoubleDouble sqrt(DoubleDouble x) {
    const double s = std::sqrt(x.hi);
    if (!(s > 0.0) || std::isinf(s)) return s;  // 0, -0, inf, NaN
    const TwoTerms<double> square = two_prod(s, s);
    const double rest = (x.hi - square.hi) - square.lo + x.lo;
    return settled(quick_two_sum(s, rest / (2.0 * s)));
  }

  friend DoubleDouble hypot(DoubleDouble x, DoubleDouble y);
  friend DoubleDouble exp(DoubleDouble x);
  friend DoubleDouble expm1(DoubleDouble x);
  friend DoubleDouble log(DoubleDouble x);
  friend DoubleDouble log1p(DoubleDouble x);
  friend DoubleDouble sin(DoubleDouble x);
  friend DoubleDouble cos(DoubleDouble x);
  friend SinCos<DoubleDouble> sincos(DoubleDouble x);
  friend DoubleDouble tan(DoubleDouble x);
  friend DoubleDouble atan(DoubleDouble x);
  friend DoubleDouble atan2(DoubleDouble y, DoubleDouble x);
  friend DoubleDouble asin(DoubleDouble x);
  friend DoubleDouble acos(DoubleDouble x);
  friend DoubleDouble sinh(DoubleDouble x);
  friend DoubleDouble cosh(DoubleDouble x);
  friend DoubleDouble tanh(DoubleDouble x);

 private:
  // The low part of an infinity or a NaN is 0, not the NaN that the exact formulas give.
  static constexpr DoubleDouble settled(TwoTerms<double> r, double leading) {
    return leading - leading == 0.0 ? DoubleDouble{r.hi, r.lo} : DoubleDouble{leading, 0.0};
  }
  // A product of zero keeps its sign.
  static constexpr DoubleDouble settled_product(TwoTerms<double> r, double leading) {
    return leading != 0.0 ? settled(r, leading) : DoubleDouble{leading, 0.0};
  }
  static constexpr DoubleDouble settled(TwoTerms<double> r) { return settled(r, r.hi); }
};

template <>
struct RealTraits<DoubleDouble> {
  static constexpr DoubleDouble pi() { return DoubleDouble::pi(); }
  static constexpr double epsilon() { return 0x1p-104; }
  static constexpr double to_double(DoubleDouble x) { return x.hi; }
};

}  // namespace v0
}  // namespace polhode

template <>
class std::numeric_limits<polhode::DoubleDouble> : public std::numeric_limits<double> {
 public:
  static constexpr int digits = 104;
  static constexpr int digits10 = 31;
  static constexpr int max_digits10 = 33;
  static constexpr bool is_iec559 = false;
  static constexpr polhode::DoubleDouble epsilon() noexcept { return 0x1p-104; }
  static constexpr polhode::DoubleDouble min() noexcept {
    return std::numeric_limits<double>::min();
  }
  static constexpr polhode::DoubleDouble max() noexcept {
    return std::numeric_limits<double>::max();
  }
  static constexpr polhode::DoubleDouble lowest() noexcept { return -max(); }
  static constexpr polhode::DoubleDouble infinity() noexcept {
    return std::numeric_limits<double>::infinity();
  }
  static constexpr polhode::DoubleDouble quiet_NaN() noexcept {
    return std::numeric_limits<double>::quiet_NaN();
  }
};
