// SPDX-License-Identifier: MIT
// Dual<T, N>: a number with its N first derivatives, carried through every operation by the chain
// rule.
//
// Equations   f(x) -> (f(x.value), f'(x.value) x.derivative).
// Units       derivative[i] has the unit of the value per unit of variable i.
// Domain      T = double, DoubleDouble or another Real (a Dual too, for second derivatives).
//             Comparisons, branches and rounding look at the value alone. sqrt at 0, asin and acos
//             at +-1, hypot and atan2 at (0, 0): a zero derivative stays 0 (a constant is a
//             constant); any other gives inf or NaN, as the function has no derivative there.
//             abs has derivative sign(value), +1 at 0; floor, rint and round have derivative 0.
// Accuracy    values are those of T; derivatives are the rounded closed rules.
// Errors      none; NaN in, NaN out.
// Cost        about N + 1 times T for arithmetic; one elementary function of T plus 2N flops each.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

template <Real T, int N>
struct Dual {
  static_assert(N > 0, "Dual needs at least one derivative");
  using Scalar = T;
  static constexpr std::size_t size = static_cast<std::size_t>(N);

  T value = T(0.0);
  std::array<T, size> derivative{};

  constexpr Dual() = default;
  constexpr Dual(const T& x) : value(x) {}  // NOLINT(google-explicit-constructor): a constant
  constexpr Dual(double x)                  // NOLINT(google-explicit-constructor): a constant
    requires(!std::same_as<T, double>)
      : value(x) {}
  constexpr Dual(const T& x, const std::array<T, size>& dx) : value(x), derivative(dx) {}
  constexpr explicit operator double() const { return to_double(value); }

  // The independent variable number `index`: derivative 1 in its own place.
  static constexpr Dual variable(const T& x, int index) {
    Dual r(x);
    r.derivative[static_cast<std::size_t>(index)] = T(1.0);
    return r;
  }

  // (y, slope x.derivative): the chain rule of one argument.
  constexpr Dual chained(const T& y, const T& slope) const {
    Dual r(y);
    for (std::size_t i = 0; i < size; ++i) r.derivative[i] = slope * derivative[i];
    return r;
  }
  // The chain rule of two arguments.
  static constexpr Dual chained(const T& y, const T& slope_a, const Dual& a, const T& slope_b,
                                const Dual& b) {
    Dual r(y);
    for (std::size_t i = 0; i < size; ++i) {
      r.derivative[i] = slope_a * a.derivative[i] + slope_b * b.derivative[i];
    }
    return r;
  }
  // Whether no variable moves this number.
  constexpr bool is_constant() const {
    for (const T& d : derivative) {
      if (!(d == T(0.0))) return false;
    }
    return true;
  }

  friend constexpr Dual operator+(const Dual& a) { return a; }
  friend constexpr Dual operator-(const Dual& a) {
    Dual r(-a.value);
    for (std::size_t i = 0; i < size; ++i) r.derivative[i] = -a.derivative[i];
    return r;
  }
  friend constexpr Dual operator+(const Dual& a, const Dual& b) {
    Dual r(a.value + b.value);
    for (std::size_t i = 0; i < size; ++i) r.derivative[i] = a.derivative[i] + b.derivative[i];
    return r;
  }
  friend constexpr Dual operator-(const Dual& a, const Dual& b) {
    Dual r(a.value - b.value);
    for (std::size_t i = 0; i < size; ++i) r.derivative[i] = a.derivative[i] - b.derivative[i];
    return r;
  }
  friend constexpr Dual operator*(const Dual& a, const Dual& b) {
    return chained(a.value * b.value, b.value, a, a.value, b);
  }
  friend constexpr Dual operator/(const Dual& a, const Dual& b) {
    const T q = a.value / b.value;
    Dual r(q);
    for (std::size_t i = 0; i < size; ++i) {
      r.derivative[i] = (a.derivative[i] - q * b.derivative[i]) / b.value;
    }
    return r;
  }

  // With a constant: an int, a double or a T.
  template <std::convertible_to<T> S>
  friend constexpr Dual operator+(const Dual& a, const S& s) {
    return {a.value + T(s), a.derivative};
  }
  template <std::convertible_to<T> S>
  friend constexpr Dual operator+(const S& s, const Dual& a) {
    return {T(s) + a.value, a.derivative};
  }
  template <std::convertible_to<T> S>
  friend constexpr Dual operator-(const Dual& a, const S& s) {
    return {a.value - T(s), a.derivative};
  }
  template <std::convertible_to<T> S>
  friend constexpr Dual operator-(const S& s, const Dual& a) {
    return T(s) + (-a);
  }
  template <std::convertible_to<T> S>
  friend constexpr Dual operator*(const Dual& a, const S& s) {
    return a.chained(a.value * T(s), T(s));
  }
  template <std::convertible_to<T> S>
  friend constexpr Dual operator*(const S& s, const Dual& a) {
    return a.chained(T(s) * a.value, T(s));
  }
  template <std::convertible_to<T> S>
  friend constexpr Dual operator/(const Dual& a, const S& s) {
    Dual r(a.value / T(s));
    for (std::size_t i = 0; i < size; ++i) r.derivative[i] = a.derivative[i] / T(s);
    return r;
  }
  template <std::convertible_to<T> S>
  friend constexpr Dual operator/(const S& s, const Dual& a) {
    const T q = T(s) / a.value;
    return a.chained(q, -q / a.value);
  }

  constexpr Dual& operator+=(const Dual& b) { return *this = *this + b; }
  constexpr Dual& operator-=(const Dual& b) { return *this = *this - b; }
  constexpr Dual& operator*=(const Dual& b) { return *this = *this * b; }
  constexpr Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend constexpr bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  friend constexpr bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend constexpr bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend constexpr bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend constexpr bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }

  // Functions, found by argument-dependent lookup only.
  friend bool isnan(const Dual& x) {
    using std::isnan;
    return isnan(x.value);
  }
  friend bool isfinite(const Dual& x) {
    using std::isfinite;
    return isfinite(x.value);
  }
  friend bool signbit(const Dual& x) {
    using std::signbit;
    return signbit(x.value);
  }
  friend Dual abs(const Dual& x) { return x.value < T(0.0) ? -x : x; }
  friend Dual fabs(const Dual& x) { return abs(x); }
  friend Dual copysign(const Dual& x, const Dual& s) { return signbit(x) == signbit(s) ? x : -x; }
  friend Dual floor(const Dual& x) {
    using std::floor;
    return floor(x.value);
  }
  friend Dual rint(const Dual& x) {
    using std::rint;
    return rint(x.value);
  }
  friend Dual round(const Dual& x) {
    using std::round;
    return round(x.value);
  }
  friend Dual ldexp(const Dual& x, int n) {
    using std::ldexp;
    Dual r(ldexp(x.value, n));
    for (std::size_t i = 0; i < size; ++i) r.derivative[i] = ldexp(x.derivative[i], n);
    return r;
  }
  friend Dual sqrt(const Dual& x) {
    using std::sqrt;
    const T s = sqrt(x.value);
    Dual r(s);
    for (std::size_t i = 0; i < size; ++i) {
      const T& d = x.derivative[i];
      r.derivative[i] = s == T(0.0) && d == T(0.0) ? T(0.0) : d / (s + s);
    }
    return r;
  }
  friend Dual exp(const Dual& x) {
    using std::exp;
    const T e = exp(x.value);
    return x.chained(e, e);
  }
  friend Dual expm1(const Dual& x) {
    using std::expm1;
    const T e = expm1(x.value);
    return x.chained(e, e + T(1.0));
  }
  friend Dual log(const Dual& x) {
    using std::log;
    return x.chained(log(x.value), T(1.0) / x.value);
  }
  friend Dual log1p(const Dual& x) {
    using std::log1p;
    return x.chained(log1p(x.value), T(1.0) / (x.value + T(1.0)));
  }
  friend SinCos<Dual> sincos(const Dual& x) {
    const auto [s, c] = sincos(x.value);
    return {x.chained(s, c), x.chained(c, -s)};
  }
  friend Dual sin(const Dual& x) { return sincos(x).sin; }
  friend Dual cos(const Dual& x) { return sincos(x).cos; }
  friend Dual tan(const Dual& x) {
    using std::tan;
    const T t = tan(x.value);
    return x.chained(t, T(1.0) + t * t);
  }
  friend Dual atan(const Dual& x) {
    using std::atan;
    return x.chained(atan(x.value), T(1.0) / (T(1.0) + x.value * x.value));
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    using std::hypot;
    const T angle = atan2(y.value, x.value);
    const T r = hypot(x.value, y.value);
    if (r == T(0.0) && x.is_constant() && y.is_constant()) return angle;
    return chained(angle, x.value / r / r, y, -(y.value / r / r), x);
  }
  friend Dual hypot(const Dual& x, const Dual& y) {
    using std::hypot;
    const T r = hypot(x.value, y.value);
    if (r == T(0.0) && x.is_constant() && y.is_constant()) return r;
    return chained(r, x.value / r, x, y.value / r, y);
  }
  friend Dual asin(const Dual& x) {
    using std::asin;
    return asin(x.value) + arc_slope(x);
  }
  friend Dual acos(const Dual& x) {
    using std::acos;
    return acos(x.value) - arc_slope(x);
  }
  friend Dual sinh(const Dual& x) {
    using std::cosh;
    using std::sinh;
    return x.chained(sinh(x.value), cosh(x.value));
  }
  friend Dual cosh(const Dual& x) {
    using std::cosh;
    using std::sinh;
    return x.chained(cosh(x.value), sinh(x.value));
  }
  friend Dual tanh(const Dual& x) {
    using std::cosh;
    using std::tanh;
    const T c = cosh(x.value);  // not 1 - tanh^2: cancels
    return x.chained(tanh(x.value), T(1.0) / c / c);
  }

 private:
  // (0, derivative / sqrt(1 - x^2))
  static Dual arc_slope(const Dual& x) {
    using std::sqrt;
    const T s = sqrt((T(1.0) - x.value) * (T(1.0) + x.value));
    Dual r;
    for (std::size_t i = 0; i < size; ++i) {
      const T& d = x.derivative[i];
      r.derivative[i] = s == T(0.0) && d == T(0.0) ? T(0.0) : d / s;
    }
    return r;
  }
};

template <Real T, int N>
inline constexpr std::size_t derivative_order<Dual<T, N>> = 1 + derivative_order<T>;

template <Real T, int N>
struct RealTraits<Dual<T, N>> {
  static Dual<T, N> pi() { return RealTraits<T>::pi(); }
  static constexpr double epsilon() { return RealTraits<T>::epsilon(); }
  static constexpr double to_double(const Dual<T, N>& x) {
    return RealTraits<T>::to_double(x.value);
  }
};

}  // namespace v0
}  // namespace polhode
