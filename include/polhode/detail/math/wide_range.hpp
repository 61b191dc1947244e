// SPDX-License-Identifier: MIT
// WideRange<T>: a real number with an exponent of its own, so that no step of a formula overflows
// or underflows between arguments and a result that T can hold.
//
// Equations   value = part 2^exponent, 2^-128 <= |part| < 2^128 and exponent a multiple of 256, or
//             part is 0, infinite or NaN. Shifts by powers of two are exact: a formula of + - * /
//             and sqrt has in WideRange<T> the bits that it has in T wherever T holds every step.
// Units       none: a WideRange is a Real.
// Domain      T = double or DoubleDouble. Exponents to +-2^30.
// Accuracy    that of T. A term more than 2^256 times smaller than another is dropped from a sum.
// Errors      none; NaN in, NaN out.
// Cost        about ten times T: for the few arguments that need it.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

template <Real T>
class WideRange {
 public:
  using Scalar = T;

  constexpr WideRange() = default;
  WideRange(double x) : WideRange(settled(T(x), 0)) {}  // NOLINT(google-explicit-constructor)
  WideRange(const T& x)                                 // NOLINT(google-explicit-constructor)
    requires(!std::same_as<T, double>)
      : WideRange(settled(x, 0)) {}

  // Rounded to T: 0 or inf where T has no room.
  T narrow() const {
    using std::ldexp;
    return ldexp(part_, exponent_);
  }
  // value = f 2^n with |f| in [1/2, 1): n, and 0 for 0, infinities and NaN.
  int binary_exponent() const {
    int n = 0;
    const double leading = polhode::to_double(part_);
    if (!is_ordinary()) return 0;
    std::frexp(leading, &n);
    return n + exponent_;
  }

  friend WideRange operator+(const WideRange& a) { return a; }
  friend WideRange operator-(const WideRange& a) { return {-a.part_, a.exponent_}; }
  friend WideRange operator+(const WideRange& a, const WideRange& b) {
    using std::ldexp;
    if (a.exponent_ == b.exponent_) return settled(a.part_ + b.part_, a.exponent_);
    if (!a.is_ordinary()) return a.part_ == T(0.0) ? b : WideRange(a.part_, 0);
    if (!b.is_ordinary()) return b.part_ == T(0.0) ? a : WideRange(b.part_, 0);
    const WideRange &more = a.exponent_ < b.exponent_ ? b : a, &less = &more == &a ? b : a;
    if (more.exponent_ - less.exponent_ > step) return more;
    return settled(more.part_ + ldexp(less.part_, -step), more.exponent_);
  }
  friend WideRange operator-(const WideRange& a, const WideRange& b) { return a + (-b); }
  friend WideRange operator*(const WideRange& a, const WideRange& b) {
    return settled(a.part_ * b.part_, a.exponent_ + b.exponent_);
  }
  friend WideRange operator/(const WideRange& a, const WideRange& b) {
    return settled(a.part_ / b.part_, a.exponent_ - b.exponent_);
  }
  WideRange& operator+=(const WideRange& b) { return *this = *this + b; }
  WideRange& operator-=(const WideRange& b) { return *this = *this - b; }
  WideRange& operator*=(const WideRange& b) { return *this = *this * b; }
  WideRange& operator/=(const WideRange& b) { return *this = *this / b; }

  friend bool operator==(const WideRange& a, const WideRange& b) {
    return a.part_ == b.part_ && a.exponent_ == b.exponent_;
  }
  friend bool operator<(const WideRange& a, const WideRange& b) {
    if (a.exponent_ == b.exponent_) return a.part_ < b.part_;
    return (b - a).part_ > T(0.0);
  }
  friend bool operator>(const WideRange& a, const WideRange& b) { return b < a; }
  friend bool operator<=(const WideRange& a, const WideRange& b) { return a < b || a == b; }
  friend bool operator>=(const WideRange& a, const WideRange& b) { return b <= a; }

  // Functions, found by argument-dependent lookup only.
  friend bool isnan(const WideRange& x) { return std::isnan(polhode::to_double(x.part_)); }
  friend bool isfinite(const WideRange& x) { return std::isfinite(polhode::to_double(x.part_)); }
  friend bool signbit(const WideRange& x) { return std::signbit(polhode::to_double(x.part_)); }
  friend WideRange abs(const WideRange& x) { return x.part_ < T(0.0) ? -x : x; }
  friend WideRange fabs(const WideRange& x) { return abs(x); }
  friend WideRange ldexp(const WideRange& x, int n) {
    using std::ldexp;
    const int steps = n / step;
    return x.is_ordinary() ? settled(ldexp(x.part_, n - steps * step), x.exponent_ + steps * step)
                           : x;
  }
  friend WideRange sqrt(const WideRange& x) {
    using std::ldexp;
    using std::sqrt;
    const bool odd = x.exponent_ % (2 * step) != 0;  // half of it is no whole step
    if (!odd) return settled(sqrt(x.part_), x.exponent_ / 2);
    return settled(ldexp(sqrt(x.part_), step / 2), (x.exponent_ - step) / 2);
  }
  friend WideRange log(const WideRange& x) {
    using std::log;
    if (x.exponent_ == 0) return log(x.part_);
    return T(log(x.part_) + static_cast<double>(x.exponent_) * log(T(2.0)));
  }
  friend WideRange log1p(const WideRange& x) {
    using std::log1p;
    if (x.exponent_ == 0) return T(log1p(x.part_));
    return x.exponent_ < 0 ? x : log(x);
  }
  friend WideRange atan(const WideRange& x) {
    using std::atan;
    if (x.exponent_ < 0) return x;
    return T(atan(x.exponent_ == 0 ? x.part_ : T(x.part_ / T(0.0))));
  }
  friend WideRange atan2(const WideRange& y, const WideRange& x) {
    using std::atan2;
    if (x.exponent_ == y.exponent_) return T(atan2(y.part_, x.part_));
    const WideRange slope = y / x;
    if (!(x.part_ == T(0.0)) && slope.exponent_ == 0) {
      return x.part_ > T(0.0) ? T(atan2(slope.part_, T(1.0))) : T(atan2(-slope.part_, T(-1.0)));
    }
    const T up = y.part_ < T(0.0) ? T(-1.0) : T(1.0);
    if (x.part_ == T(0.0) || slope.exponent_ > 0) return T(0.5) * up * pi<T>();
    return x.part_ > T(0.0) ? slope : WideRange(T(up * pi<T>()));
  }

 private:
  static constexpr int step = 256;

  WideRange(const T& part, int exponent) : part_(part), exponent_(exponent) {}
  bool is_ordinary() const {
    const double size = std::abs(polhode::to_double(part_));
    return size > 0.0 && size <= std::numeric_limits<double>::max();
  }
  static WideRange settled(T part, int exponent) {
    using std::ldexp;
    double size = std::abs(polhode::to_double(part));
    if (!(size > 0.0 && size <= std::numeric_limits<double>::max())) return {part, 0};
    while (size >= 0x1p128) {  // at most 4
      part = ldexp(part, -step);
      size = std::abs(polhode::to_double(part));
      exponent += step;
    }
    while (size < 0x1p-128) {  // at most 4
      part = ldexp(part, step);
      size = std::abs(polhode::to_double(part));
      exponent -= step;
    }
    return {part, exponent};
  }

  T part_ = T(0.0);
  int exponent_ = 0;
};

template <Real T>
struct RealTraits<WideRange<T>> {
  static WideRange<T> pi() { return RealTraits<T>::pi(); }
  static constexpr double epsilon() { return RealTraits<T>::epsilon(); }
  static double to_double(const WideRange<T>& x) { return RealTraits<T>::to_double(x.narrow()); }
};

// Widening: which numbers have the exponents of double, and the same numbers with a WideRange in
// their heart: for the few arguments between which a formula would overflow or underflow.
//
// Units       those of the number.
// Domain      double, DoubleDouble and Duals of them have a wide form; others have none.
// Accuracy    exact there; back, 0 or inf where T has no room.
// Cost        a few flops.

// double, DoubleDouble and Duals of them: the types whose exponents are those of double. The same
// number with WideRange in its heart, and back.
template <class T>
struct Widening {
  static constexpr bool exists = false;
};
template <class T>
  requires(std::same_as<T, double> || std::same_as<T, DoubleDouble>)
struct Widening<T> {
  static constexpr bool exists = true;
  using Wide = WideRange<T>;
  static Wide widened(const T& x) { return x; }
  static T narrowed(const Wide& x) { return x.narrow(); }
};
template <Real T, int N>
  requires Widening<T>::exists
struct Widening<Dual<T, N>> {
  static constexpr bool exists = true;
  using Wide = Dual<typename Widening<T>::Wide, N>;
  static Wide widened(const Dual<T, N>& x) {
    Wide r(Widening<T>::widened(x.value));
    for (std::size_t i = 0; i < Wide::size; ++i)
      r.derivative[i] = Widening<T>::widened(x.derivative[i]);
    return r;
  }
  static Dual<T, N> narrowed(const Wide& x) {
    Dual<T, N> r(Widening<T>::narrowed(x.value));
    for (std::size_t i = 0; i < Wide::size; ++i)
      r.derivative[i] = Widening<T>::narrowed(x.derivative[i]);
    return r;
  }
};
template <class T>
concept NarrowRange = Widening<T>::exists;

template <NarrowRange T>
auto widened(const T& x) {
  return Widening<T>::widened(x);
}

template <class T>
inline constexpr bool is_wide = false;
template <class T>
inline constexpr bool is_wide<WideRange<T>> = true;
template <class T, int N>
inline constexpr bool is_wide<Dual<T, N>> = is_wide<T>;

template <class T>
int binary_exponent(const WideRange<T>& x) {
  return x.binary_exponent();
}
template <class T, int N>
int binary_exponent(const Dual<T, N>& x) {
  return binary_exponent(x.value);
}

// True if every number is 0 or has a size in [least, most].
template <class... T>
bool within(double least, double most, const T&... x) {
  const auto fits = [&](double a) { return a == 0.0 || (a >= least && a <= most); };
  return (fits(std::abs(to_double(x))) && ...);
}

// The same of every lane of packs.
template <class Pack, class... Rest>
  requires(!Real<Pack>)
bool lanes_within(double least, double most, const Pack& x, const Rest&... rest) {
  const auto fits = [&](const Pack& y) {
    using std::abs;
    const Pack size = abs(y), zero(0.0);
    return size == zero || (size >= Pack(least) && size <= Pack(most));
  };
  return all(fits(x)) && (all(fits(rest)) && ...);
}

}  // namespace v0
}  // namespace polhode
