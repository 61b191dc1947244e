// SPDX-License-Identifier: MIT
// Legendre's incomplete elliptic integrals, with the amplitude given by its sine and cosine.
//
// Equations   F = int 1/D, E = int D, D = int sin^2/D, Pi(n) = int 1/((1 - n sin^2) D), each from 0
//             to phi, with D(phi) = sqrt(1 - m sin^2) = sqrt(cos^2 + m1 sin^2)
//             [DLMF 19.25.5, .10, .13, .14]. Standard sign 1 - n sin^2; the n_S of the paper is -n.
//             For n < 0, Pi is led to a positive characteristic-free form [DLMF 19.21.12]:
//             nu = -n, p = 1 + nu s^2, q = 1 + m s^2/nu:
//             Pi = s (RC(c^2 D^2, p q) + (m s^2/(3 nu)) RJ(c^2, D^2, 1, q)), without cancellation.
// Units       none; phi in radians.
// Domain      any (sin phi, cos phi) with phi in [-pi, pi]; beyond +-pi/2 by symmetry about it. Pi:
//             n sin^2 phi < 1 (and n < 1 beyond pi/2), otherwise NaN or inf. At m1 = 0: F, D and Pi
//             are inf at pi/2 and beyond. Derivatives of Dual arguments are those along the circle:
//             dphi = c ds - s dc.
// Accuracy    budget elliptic_legendre: relative.
// Errors      none.
// Cost        one RF; one RF or RC and one RJ for Pi. Beyond pi/2 the complete integral as well.
#pragma once

#include <cmath>

#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {

// D^2 = cos^2 + m1 sin^2; not 1 - m sin^2: cancels
template <class T>
T squared_delta(const T& s, const T& c, const BasicModulus<T>& mod) {
  return c * c + mod.m1() * (s * s);
}

// The integral from 0 to atan2(s, c), given that from 0 to atan2(s, |c|) and the complete one.
template <class T, class Complete>
T continued(const T& s, const T& c, const T& inside, const Complete& complete) {
  if (!(c < T(0.0))) return inside;
  const T whole = T(2.0) * complete();
  return (s < T(0.0) ? -whole : whole) - inside;
}

template <class T>
T legendre_f_at(const T& s, const T& c, const BasicModulus<T>& mod) {
  const T f = s * carlson_rf(T(c * c), squared_delta(s, c, mod), T(1.0));
  return continued(s, c, f, [&] { return complete_k(mod); });
}

template <class T>
T legendre_e_at(const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::abs;
  using std::sqrt;
  const T c2 = c * c;
  const T d2 = squared_delta(s, c, mod);
  T e = s;  // at m1 = 0
  if (mod.m1() > T(0.0)) {
    // Positive terms [DLMF 19.25.10]; not RF - (m/3) s^2 RD(c^2, D^2, 1): cancels as m -> 1.
    const T rd = carlson_rd(c2, T(1.0), d2);
    const T integrals = carlson_rf(c2, d2, T(1.0)) + mod.m() * (s * s) * rd / 3.0;
    e = s * (mod.m1() * integrals + mod.m() * abs(c) / sqrt(d2));
  }
  return continued(s, c, e, [&] { return complete_e(mod); });
}

template <class T>
T legendre_d_at(const T& s, const T& c, const BasicModulus<T>& mod) {
  const T d = s * s * s * carlson_rd(T(c * c), squared_delta(s, c, mod), T(1.0)) / 3.0;
  return continued(s, c, d, [&] { return complete_d(mod); });
}

template <class T>
T legendre_pi_at(const T& s, const T& c, const T& n, const BasicModulus<T>& mod) {
  const T one(1.0);
  const T c2 = c * c;
  const T s2 = s * s;
  const T d2 = squared_delta(s, c, mod);
  const T p = c2 + (one - n) * s2;
  T inside(0.0);
  if (n < T(-0.25)) {
    const T r = mod.m() * s2 / -n;
    const T q = one + r;
    inside = s * (carlson_rc(T(c2 * d2), T(p * q)) + r * carlson_rj(c2, d2, one, q) / 3.0);
  } else {
    inside = s * (carlson_rf(c2, d2, one) + n * s2 * carlson_rj(c2, d2, one, p) / 3.0);
  }
  return continued(s, c, inside, [&] { return complete_pi(n, mod); });
}

// The amplitude of a Dual: (s, c) as constants, and its derivative apart. Carlson's integrals are
// differentiated at fixed (s, c): through c^2 it would be inf * 0 at c = 0.
template <class T>
struct FixedAmplitude {
  T s;
  T c;
  T shift;  // value 0, derivative dphi = c ds - s dc
};
template <class T, int N>
FixedAmplitude<Dual<T, N>> fixed_amplitude(const Dual<T, N>& s, const Dual<T, N>& c) {
  return {s.value, c.value, Dual<T, N>::chained(T(0.0), c.value, s, -s.value, c)};
}

}  // namespace detail

template <Real T>
T legendre_f(const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::sqrt;
  if constexpr (derivative_order<T> > 0) {
    const auto a = detail::fixed_amplitude(s, c);
    return detail::legendre_f_at(a.s, a.c, mod) +
           a.shift / sqrt(detail::squared_delta(a.s, a.c, mod));
  } else {
    return detail::legendre_f_at(s, c, mod);
  }
}

// D = (F - E)/m, without its cancellation as m -> 0.
template <Real T>
T legendre_d(const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::sqrt;
  if constexpr (derivative_order<T> > 0) {
    const auto a = detail::fixed_amplitude(s, c);
    return detail::legendre_d_at(a.s, a.c, mod) +
           a.shift * (a.s * a.s) / sqrt(detail::squared_delta(a.s, a.c, mod));
  } else {
    return detail::legendre_d_at(s, c, mod);
  }
}

template <Real T>
T legendre_e(const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::sqrt;
  if constexpr (derivative_order<T> > 0) {
    // dE/dm = -D/2: through the sum above the slope of a short arc would cancel.
    const auto base = values(mod);
    const auto delta = sqrt(detail::squared_delta(s.value, c.value, base));
    const auto by_m = -0.5 * legendre_d(s.value, c.value, base);
    const auto shift = detail::fixed_amplitude(s, c).shift;
    return T::chained(legendre_e(s.value, c.value, base), delta, shift, by_m, mod.m());
  } else {
    return detail::legendre_e_at(s, c, mod);
  }
}

template <Real T>
T legendre_pi(const T& s, const T& c, const T& n, const BasicModulus<T>& mod) {
  using std::sqrt;
  if constexpr (derivative_order<T> > 0) {
    const auto a = detail::fixed_amplitude(s, c);
    const T p = a.c * a.c + (T(1.0) - n) * (a.s * a.s);
    return detail::legendre_pi_at(a.s, a.c, n, mod) +
           a.shift / (p * sqrt(detail::squared_delta(a.s, a.c, mod)));
  } else {
    return detail::legendre_pi_at(s, c, n, mod);
  }
}

// Compiled once, in the library.
extern template double legendre_f<double>(const double&, const double&,
                                          const BasicModulus<double>&);
extern template double legendre_e<double>(const double&, const double&,
                                          const BasicModulus<double>&);
extern template double legendre_d<double>(const double&, const double&,
                                          const BasicModulus<double>&);
extern template double legendre_pi<double>(const double&, const double&, const double&,
                                           const BasicModulus<double>&);
extern template DoubleDouble legendre_f<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_e<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_d<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_pi<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                       const DoubleDouble&,
                                                       const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
