// SPDX-License-Identifier: MIT
// Phases as unevaluated sums of two numbers: sums and products of them, and what is left of one
// when its whole periods are taken off.
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/free/detail/reduced_sincos.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

// Of packs, lane by lane.
template <Number T>
  requires(!Real<T>)
TwoTerms<T> select(const Mask<T>& mask, const TwoTerms<T>& a, const TwoTerms<T>& b) {
  return {select(mask, a.hi, b.hi), select(mask, a.lo, b.lo)};
}

namespace detail {

// Sine and cosine of a reduced phase of double, of a pack of doubles, or of a Dual of one.
template <Number T>
[[gnu::always_inline]] inline SinCos<T> phase_sincos(const TwoTerms<T>& phase) {
  return reduced_sincos(phase);
}
template <Real T, int N>
SinCos<Dual<T, N>> phase_sincos(const TwoTerms<Dual<T, N>>& phase) {
  const SinCos<T> v = phase_sincos(TwoTerms<T>{phase.hi.value, phase.lo.value});
  const Dual<T, N> angle = phase.hi + phase.lo;
  return {angle.chained(v.sin, v.cos), angle.chained(v.cos, T(-v.sin))};
}

// The two ways to an exact product; both give the same bits.
struct DekkerArithmetic {
  using Exp = NaturalExp;
  template <Number T>
  [[gnu::always_inline]] static TwoTerms<T> sum(const T& a, const T& b) {
    return two_sum(a, b);
  }
  template <Number T>
  static TwoTerms<T> product(const T& a, const T& b) {
    using std::abs;
    const auto large = abs(b) > T(0x1p990);  // the halves of b overflow at 2^996
    if (!any(large)) return two_prod(a, b);
    const TwoTerms<T> p = two_prod(a, T(select(large, T(0x1p-60), T(1.0)) * b));
    const T unit = select(large, T(0x1p60), T(1.0));
    return {unit * p.hi, unit * p.lo};
  }
  template <Number T>
  [[gnu::always_inline]] static SinCos<T> sincos(const TwoTerms<T>& phase) {
    return phase_sincos(phase);
  }
};
struct FmaArithmetic : DekkerArithmetic {
  template <Number T>
  [[gnu::always_inline]] static TwoTerms<T> product(const T& a, const T& b) {
    return two_prod_fma(a, b);
  }
};
// Of numbers that have the digits that a phase needs: the low part stays 0.
struct WideArithmetic {
  using Exp = NaturalExp;
  template <Number T>
  static TwoTerms<T> sum(const T& a, const T& b) {
    return {a + b, T(0.0)};
  }
  template <Number T>
  static TwoTerms<T> product(const T& a, const T& b) {
    return {a * b, T(0.0)};
  }
  template <Number T>
  static SinCos<T> sincos(const TwoTerms<T>& phase) {
    using polhode::sincos;
    const T angle = phase.hi + phase.lo;
    if constexpr (requires { sincos(angle); }) {
      return sincos(angle);
    } else {
      using std::cos;
      using std::sin;
      return {sin(angle), cos(angle)};
    }
  }
};

// Whether T has the 53 bits of double.
template <Number T>
inline constexpr bool has_double_digits = RealTraits<T>::epsilon() > 0x1p-60;

template <Number T>
using PhaseArithmetic = std::conditional_t<has_double_digits<T>, DekkerArithmetic, WideArithmetic>;

// rate * elapsed + start, and the same less a whole number of periods. Unlike DoubleDouble's
// operators this carries one low part through the whole chain; what that loses is 2^-104 of the
// phase.
template <class Arithmetic, Number T, class Rate, class Start>
[[gnu::always_inline]] inline TwoTerms<T> phase_at(const Rate& rate, const TwoTerms<T>& elapsed,
                                                   const Start& start) {
  const TwoTerms<T> p = Arithmetic::product(rate.hi, elapsed.hi);
  const TwoTerms<T> s = Arithmetic::sum(p.hi, start.hi);
  const T lo = p.lo + (rate.hi * elapsed.lo + rate.lo * elapsed.hi);
  return {s.hi, s.lo + (lo + start.lo)};
}

template <class Arithmetic, Number T, class Period>
[[gnu::always_inline]] inline TwoTerms<T> less_periods(const TwoTerms<T>& phase,
                                                       const Period& period, const T& count) {
  const TwoTerms<T> c = Arithmetic::product(count, period.hi);
  const T hi = phase.hi - c.hi;  // exact: within a factor of two, or count = 0
  return quick_two_sum(hi, T(phase.lo - (c.lo + count * period.lo)));
}

// The phase less its whole periods, and how many of them: first + more, not added up, since the sum
// may need more than 53 bits. Beyond 2^52 periods the rounded count itself is off, so what it
// leaves is reduced once more.
template <Number T>
struct PhaseRemainder {
  TwoTerms<T> rest;
  T first, more;
};

template <class Arithmetic, Number T, class Period>
[[gnu::always_inline]] inline PhaseRemainder<T> reduced(const TwoTerms<T>& phase,
                                                        const Period& period, const T& inverse) {
  using std::abs;
  using std::rint;
  const T periods = rint(phase.hi * inverse);
  const TwoTerms<T> r = less_periods<Arithmetic>(phase, period, periods);
  const auto far = abs(r.hi * inverse) > T(0.75);
  if (!any(far)) return {r, periods, T(0.0)};
  const T more = select(far, T(rint(r.hi * inverse)), T(0.0));
  return {select(far, less_periods<Arithmetic>(r, period, more), r), periods, more};
}

// Whether the number of periods taken off is odd.
template <Number T>
[[gnu::always_inline]] inline Mask<T> is_odd(const PhaseRemainder<T>& r) {
  using std::floor;
  const auto odd = [](const T& n) { return !(T(2.0) * floor(T(T(0.5) * n)) == n); };
  return odd(r.first) != odd(r.more);
}

// A phase beyond 2^90 has no digit left: any point of the orbit is as good, so 0 is taken; t - t is
// NaN when t is infinite or NaN.
template <Number T>
[[gnu::always_inline]] inline TwoTerms<T> bounded(const TwoTerms<T>& phase, const T& t) {
  using std::abs;
  return select(abs(phase.hi) < T(0x1p90), phase, TwoTerms<T>{t - t, T(0.0)});
}

// 2 pi.
template <Number T>
[[gnu::always_inline]] inline TwoPartPhase<T> whole_turn() {
  if constexpr (has_double_digits<T>) {
    return {T(DoubleDouble::two_pi().hi), T(DoubleDouble::two_pi().lo)};
  } else {
    return {T(2.0) * pi<T>(), T(0.0)};
  }
}

template <class Arithmetic, Number T>
[[gnu::always_inline]] inline TwoTerms<T> whole_turns_off(const TwoTerms<T>& turn) {
  const T inverse_two_pi(0.15915494309189535);
  return reduced<Arithmetic>(turn, whole_turn<T>(), inverse_two_pi).rest;
}
template <class Arithmetic, Number T>
[[gnu::always_inline]] inline SinCos<T> sincos_of_turn(const TwoTerms<T>& turn) {
  return Arithmetic::sincos(whole_turns_off<Arithmetic>(turn));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
