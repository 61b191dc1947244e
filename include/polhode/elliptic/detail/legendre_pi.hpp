// SPDX-License-Identifier: MIT
// Legendre's third kind by Carlson's integrals, before and behind its poles.
#pragma once

#include <cmath>
#include <concepts>

#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

namespace detail {

// Behind the pole; p = 1 - n s^2 < 0.
template <class T>
T legendre_pi_behind(const T& s, const T& c, const T& p, const T& n, const BasicModulus<T>& mod) {
  using std::sqrt;
  const T one(1.0);
  const T s2 = s * s;
  const T d2 = squared_delta(s, c, mod);
  const T over = n - one;
  const T rest = (over + mod.m1()) / n;  // 1 - m/n
  const T q = c * c + rest * s2;
  const T w2 = over * rest;
  const T pole = c * sqrt(d2 / w2) * carlson_rc(T(w2 * s2), T(-p * q));
  const T regular = mod.m() / n * (s * s2) * carlson_rj(T(c * c), d2, one, q) / 3.0;
  return (s < T(0.0) ? T(-pole) : pole) - regular;
}

// phi in [-pi/2, pi/2]; of a pack before the pole, with 0 <= m < 1.
template <class T>
T legendre_pi_inside(const T& s, const T& c, const T& n, const BasicModulus<T>& mod) {
  const T zero(0.0), one(1.0);
  const T c2 = c * c;
  const T s2 = s * s;
  const T d2 = squared_delta(s, c, mod);
  const T p = c2 + (one - n) * s2;
  const auto led = n < T(-0.25);  // to positive terms
  if constexpr (Real<T>) {
    if (p < zero) return d2 < zero ? T(d2 / zero * zero) : legendre_pi_behind(s, c, p, n, mod);
    if (led && mod.m() < zero) {
      const T nu = -n;
      const T ratio = mod.m1() * s2 / (one + nu);
      const T q = c2 + ratio;
      const T third = c * carlson_rc(d2, T(p * q)) + ratio * carlson_rj(c2, d2, one, q) / 3.0;
      return s * ((carlson_rf(c2, d2, one) + nu * third) / (one + nu));
    }
  }
  const auto direct = [&]() -> T {
    return s * (carlson_rf(c2, d2, one) + n * s2 * carlson_rj(c2, d2, one, p) / 3.0);
  };
  const auto by_positive_terms = [&]() -> T {
    const T r = mod.m() * s2 / select(led, T(-n), one);
    const T q = one + r;
    return s * (carlson_rc(T(c2 * d2), T(p * q)) + r * carlson_rj(c2, d2, one, q) / 3.0);
  };
  return where(led, by_positive_terms, direct);
}

template <class T>
T legendre_pi_at(const T& s, const T& c, const T& n, const BasicModulus<T>& mod) {
  using std::abs;
  if constexpr (!Real<T>) {
    const T p = c * c + (T(1.0) - n) * (s * s);
    if (!is_ordinary(s, c, mod) || !lanes_within(0.0, 0x1p300, n) || !all(p >= T(0.0)))
      return each_lane_of([](const auto&... x) { return legendre_pi_at(x...); }, mod, s, c, n);
  }
  T inside(0.0);
  if constexpr (NarrowRange<T>) {
    if (!within(0x1p-250, 2.0, s, c) || !within(0x1p-900, 0x1p300, mod.m1()) ||
        !(std::abs(to_double(n)) <= 0x1p300)) {
      inside = Widening<T>::narrowed(
          legendre_pi_inside(widened(s), widened(T(abs(c))), widened(n), widened_modulus(mod)));
      return continued(s, c, inside, [&] { return complete_pi(n, mod); });
    }
  }
  inside = legendre_pi_inside(s, T(abs(c)), n, mod);
  return continued(s, c, inside, [&] { return complete_pi(n, mod); });
}

}  // namespace detail

template <Number T>
T legendre_pi(const T& s, const T& c, const T& n, const BasicModulus<T>& mod) {
  using std::sqrt;
  if constexpr (derivative_order<T> > 0) {
    const auto a = detail::fixed_amplitude(s, c);
    const T p = a.c * a.c + (T(1.0) - n) * (a.s * a.s);
    return detail::legendre_pi_at(T(a.s), T(a.c), n, mod) +
           a.shift / (p * sqrt(detail::squared_delta(a.s, a.c, mod)));
  } else {
    return detail::legendre_pi_at(s, c, n, mod);
  }
}

// The same of any angle phi.
template <Number T>
T legendre_pi(const T& phi, const T& n, const BasicModulus<T>& mod) {
  if constexpr (std::same_as<T, double>) {
    if (n > 1.0 || mod.m1() < 0.0) {
      const auto wider = detail::promoted(mod);
      return to_double(legendre_pi(DoubleDouble(phi), DoubleDouble(n), wider));
    }
  }
  if constexpr (!Real<T>) {
    if (!detail::all_before_separatrix(mod) || !all(n <= T(1.0)))
      return detail::each_lane_of([](const auto&... x) { return legendre_pi(x...); }, mod, phi, n);
  }
  const HalfTurns<T> h = half_turns(phi);
  return detail::continued(h.turns, legendre_pi(h.s, h.c, n, mod),
                           [&] { return complete_pi(n, mod); });
}

// Compiled once, in the library.
extern template double legendre_pi<double>(const double&, const double&, const double&,
                                           const BasicModulus<double>&);
extern template double legendre_pi<double>(const double&, const double&,
                                           const BasicModulus<double>&);
extern template DoubleDouble legendre_pi<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                       const DoubleDouble&,
                                                       const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_pi<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                       const BasicModulus<DoubleDouble>&);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
