// SPDX-License-Identifier: MIT
// The plainest pack of numbers: N of them in an array, every operation lane by lane. What it
// computes has in each lane the bits of the scalar, if the kernel takes no branch on a value.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/math/real.hpp"

namespace polhode::test {

template <std::size_t N>
struct LaneMask {
  std::array<bool, N> lane{};

  constexpr LaneMask() = default;
  constexpr LaneMask(bool b) { lane.fill(b); }  // NOLINT(google-explicit-constructor): to all lanes

  template <class F>
  static LaneMask made(const F& f) {
    LaneMask m;
    for (std::size_t i = 0; i < N; ++i) m.lane[i] = f(i);
    return m;
  }
  friend LaneMask operator!(const LaneMask& a) {
    return made([&](std::size_t i) { return !a.lane[i]; });
  }
  friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) {
    return made([&](std::size_t i) { return a.lane[i] && b.lane[i]; });
  }
  friend LaneMask operator||(const LaneMask& a, const LaneMask& b) {
    return made([&](std::size_t i) { return a.lane[i] || b.lane[i]; });
  }
  friend LaneMask operator==(const LaneMask& a, const LaneMask& b) {
    return made([&](std::size_t i) { return a.lane[i] == b.lane[i]; });
  }
  friend LaneMask operator!=(const LaneMask& a, const LaneMask& b) { return !(a == b); }
  friend bool any(const LaneMask& a) {
    for (const bool b : a.lane)
      if (b) return true;
    return false;
  }
  friend bool all(const LaneMask& a) { return !any(!a); }
};

template <class T, std::size_t N>
struct Lanes {
  std::array<T, N> lane{};

  constexpr Lanes() = default;
  constexpr Lanes(double x) { lane.fill(T(x)); }  // NOLINT(google-explicit-constructor): to all

  // f(lane of a, lane of b, ...) in every lane.
  template <class F, class... Rest>
  static Lanes made(const F& f, const Rest&... a) {
    Lanes r;
    for (std::size_t i = 0; i < N; ++i) r.lane[i] = f(a.lane[i]...);
    return r;
  }
  template <class F>
  static LaneMask<N> compared(const F& f, const Lanes& a, const Lanes& b) {
    return LaneMask<N>::made([&](std::size_t i) { return f(a.lane[i], b.lane[i]); });
  }

  friend Lanes operator-(const Lanes& a) {
    return made([](const T& x) { return T(-x); }, a);
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return made([](const T& x, const T& y) { return T(x + y); }, a, b);
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return made([](const T& x, const T& y) { return T(x - y); }, a, b);
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return made([](const T& x, const T& y) { return T(x * y); }, a, b);
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return made([](const T& x, const T& y) { return T(x / y); }, a, b);
  }
  friend LaneMask<N> operator==(const Lanes& a, const Lanes& b) {
    return compared([](const T& x, const T& y) { return x == y; }, a, b);
  }
  friend LaneMask<N> operator<(const Lanes& a, const Lanes& b) {
    return compared([](const T& x, const T& y) { return x < y; }, a, b);
  }
  friend LaneMask<N> operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend LaneMask<N> operator<=(const Lanes& a, const Lanes& b) {
    return compared([](const T& x, const T& y) { return x <= y; }, a, b);
  }
  friend LaneMask<N> operator>=(const Lanes& a, const Lanes& b) { return b <= a; }

  friend Lanes select(const LaneMask<N>& mask, const Lanes& a, const Lanes& b) {
    Lanes r;
    for (std::size_t i = 0; i < N; ++i) r.lane[i] = mask.lane[i] ? a.lane[i] : b.lane[i];
    return r;
  }
  friend Lanes ldexp(const Lanes& x, int n) {
    using std::ldexp;
    return made([n](const T& y) { return T(ldexp(y, n)); }, x);
  }
  friend SinCos<Lanes> sincos(const Lanes& x) { return {sin(x), cos(x)}; }

#define POLHODE_LANES_FUNCTION(f)                       \
  friend Lanes f(const Lanes& x) {                      \
    using std::f;                                       \
    return made([](const T& y) { return T(f(y)); }, x); \
  }
  POLHODE_LANES_FUNCTION(abs)
  POLHODE_LANES_FUNCTION(sqrt)
  POLHODE_LANES_FUNCTION(rint)
  POLHODE_LANES_FUNCTION(floor)
  POLHODE_LANES_FUNCTION(round)
  POLHODE_LANES_FUNCTION(sin)
  POLHODE_LANES_FUNCTION(cos)
  POLHODE_LANES_FUNCTION(tan)
  POLHODE_LANES_FUNCTION(exp)
  POLHODE_LANES_FUNCTION(log)
  POLHODE_LANES_FUNCTION(log1p)
  POLHODE_LANES_FUNCTION(atan)
  POLHODE_LANES_FUNCTION(tanh)
  POLHODE_LANES_FUNCTION(cosh)
#undef POLHODE_LANES_FUNCTION
  friend Lanes atan2(const Lanes& a, const Lanes& b) {
    using std::atan2;
    return made([](const T& y, const T& x) { return T(atan2(y, x)); }, a, b);
  }
};

}  // namespace polhode::test

template <class T, std::size_t N>
struct polhode::LaneTraits<polhode::test::Lanes<T, N>> {
  using Pack = polhode::test::Lanes<T, N>;
  using Scalar = T;
  static constexpr std::size_t count = N;
  static const T& get(const Pack& x, std::size_t lane) { return x.lane[lane]; }
  static void set(Pack& x, std::size_t lane, const T& value) { x.lane[lane] = value; }
  static bool get_mask(const polhode::test::LaneMask<N>& mask, std::size_t lane) {
    return mask.lane[lane];
  }
  static void set_mask(polhode::test::LaneMask<N>& mask, std::size_t lane, bool value) {
    mask.lane[lane] = value;
  }
};

template <class T, std::size_t N>
struct polhode::RealTraits<polhode::test::Lanes<T, N>> {
  static polhode::test::Lanes<T, N> pi() {
    polhode::test::Lanes<T, N> r;
    r.lane.fill(polhode::pi<T>());
    return r;
  }
  static constexpr double epsilon() { return RealTraits<T>::epsilon(); }
};
