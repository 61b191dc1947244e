// SPDX-License-Identifier: MIT
// The attitude of a free rotor as a short series: Cayley-Klein parameters by theta functions of
// nome p = q^2, and the same functions after Jacobi's imaginary transformation next to the
// separatrix.
//
// Equations   with x = pi u / (2K), a = pi y1 / (2K), y1 = F(arctan(1/kappa), k'):
//               w + iz ~ theta4(x - ia; p) exp(i Lambda t),  x + iy ~ r theta1(x - ia; p) exp(i
//               Lambda t)
//             is the quaternion of the primed axes in the invariable frame, up to a positive
//             factor. The momentum follows from the same four numbers.
//             docs/design/0002-free-rotation.md.
// Units       x and chi are pure numbers.
// Domain      |chi| <= K chi_per_u, or any chi on the separatrix (nome 0); any x.
// Accuracy    a few units of rounding of T; series are cut at the rounding of T.
// Errors      none.
// Cost        at most 8 terms; 2 to 4 in double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {

// Enough terms for DoubleDouble on both sides of the border k'^2 = 0.01: the last ones are
// q^(2 j^2 - j) at q = 0.27 (j = 7) and qt^(m^2) at qt = 0.025 (m = 5).
inline constexpr std::size_t max_series_terms = 8;

template <Real T>
using SeriesPolynomial = std::array<T, max_series_terms>;

// Coefficients of a Cayley-Klein series. Made by FreeRotation.
//   trigonometric: w = A(y), z = sin 2x B(y), x = sin x C(y), y = cos x D(y) with y = cos 2x.
//   hyperbolic:    with v = qt e^(2|chi|), e = e^(-2|chi|): w = A(v) + e A(qt e), z = -+(B(v) - e
//   B(qt e)),
//                  x = +-(C(v) - e C(qt e)), y = D(v) + e D(qt e), upper signs for chi >= 0.
template <Real T>
struct CayleyKleinSeries {
  bool hyperbolic = false;
  int terms = 1;
  SeriesPolynomial<T> A{}, B{}, C{}, D{};
  T nome = T(0.0);         // qt = exp(-pi K / (2 K')), hyperbolic only
  T chi_per_u = T(0.0);    // chi = pi u / (4 K')
  T phase_per_u = T(0.0);  // the linear phase that the transformation leaves: b u / K, u reduced
};

namespace detail {

template <Real T>
T horner(const SeriesPolynomial<T>& c, int terms, const T& y) {
  T s = c[static_cast<std::size_t>(terms - 1)];
  for (int j = terms - 2; j >= 0; --j) s = s * y + c[static_cast<std::size_t>(j)];  // <= 7 trips
  return s;
}

}  // namespace detail

// The four numbers, not normalised; x = pi u / (2K).
template <Real T>
BasicQuaternion<T> trigonometric_sum(const CayleyKleinSeries<T>& s, const T& sin_x,
                                     const T& cos_x) {
  const T y = T(1.0) - T(2.0) * sin_x * sin_x;
  const T sin_2x = T(2.0) * sin_x * cos_x;
  return {detail::horner(s.A, s.terms, y), sin_x * detail::horner(s.C, s.terms, y),
          cos_x * detail::horner(s.D, s.terms, y), sin_2x * detail::horner(s.B, s.terms, y)};
}

// Direction of the momentum in the axes whose attitude in the invariable frame is p / |p|: the
// third row of that rotation. inverse_norm2 = 1 / |p|^2.
template <Real T>
BasicVec3<T> momentum_direction(const BasicQuaternion<T>& p, const T& inverse_norm2) {
  const T f = T(2.0) * inverse_norm2;
  return {f * (p.x * p.z - p.w * p.y), f * (p.y * p.z + p.w * p.x),
          inverse_norm2 * (p.w * p.w + p.z * p.z - p.x * p.x - p.y * p.y)};
}

// chi = chi_per_u u with |u| <= K, or any u on the separatrix; odd_half_periods flips theta1.
template <Real T>
BasicQuaternion<T> hyperbolic_sum(const CayleyKleinSeries<T>& s, const T& chi,
                                  bool odd_half_periods) {
  using std::abs;
  using std::exp;
  const T e = exp(T(-2.0) * abs(chi));
  const T v = s.terms == 1 ? T(0.0) : s.nome / e;  // <= 1 because e >= qt
  const T f = s.nome * e;
  const T side = chi < T(0.0) ? T(-1.0) : T(1.0);
  const T flip = odd_half_periods ? T(-1.0) : T(1.0);
  return {detail::horner(s.A, s.terms, v) + e * detail::horner(s.A, s.terms, f),
          flip * side * (detail::horner(s.C, s.terms, v) - e * detail::horner(s.C, s.terms, f)),
          flip * (detail::horner(s.D, s.terms, v) + e * detail::horner(s.D, s.terms, f)),
          -side * (detail::horner(s.B, s.terms, v) - e * detail::horner(s.B, s.terms, f))};
}

}  // namespace v0
}  // namespace polhode
