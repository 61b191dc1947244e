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
// Domain      |chi| <= K chi_per_u, or any chi on the separatrix (nome 0); any x. In a pack each
//             lane has its own form and its own number of terms: coefficients beyond it are 0.
// Accuracy    a few units of rounding of T; series are cut at the rounding of T.
// Cost        at most 8 terms; 2 to 4 in double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "polhode/free/detail/series_polynomials.hpp"
#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {

// Enough terms for DoubleDouble on both sides of the border k'^2 = 0.01: the last ones are
// q^(2 j^2 - j) at q = 0.27 (j = 7) and qt^(m^2) at qt = 0.025 (m = 5).
inline constexpr std::size_t max_series_terms = 8;

template <Number T>
using SeriesPolynomial = std::array<T, max_series_terms>;

// Coefficients of a Cayley-Klein series. Made by prepare().
//   trigonometric: w = A(y), z = sin 2x B(y), x = sin x C(y), y = cos x D(y) with y = cos 2x.
//   hyperbolic:    with v = qt e^(2|chi|), e = e^(-2|chi|) and upper signs for chi >= 0:
//                  w = A(v) + e A(qt e),      z = -+(B(v) - e B(qt e)),
//                  x = +-(C(v) - e C(qt e)),  y = D(v) + e D(qt e).
template <Number T>
struct CayleyKleinSeries {
  Mask<T> hyperbolic = false;
  int terms = 1;  // the most of any lane
  SeriesPolynomial<T> A{}, B{}, C{}, D{};
  T nome = T(0.0);         // qt = exp(-pi K / (2 K')), hyperbolic only; 0 where one term is enough
  T chi_per_u = T(0.0);    // chi = pi u / (4 K')
  T phase_per_u = T(0.0);  // the linear phase that the transformation leaves: b u / K, u reduced
};

// The four numbers, not normalised; x = pi u / (2K).
template <Number T>
[[gnu::always_inline]] inline BasicQuaternion<T> trigonometric_sum(const CayleyKleinSeries<T>& s,
                                                                   const T& sin_x, const T& cos_x) {
  const T y = T(1.0) - T(2.0) * sin_x * sin_x;
  const T sin_2x = T(2.0) * sin_x * cos_x;
  const auto at_y = detail::polynomials_at(s, y);
  return {at_y.A, sin_x * at_y.C, cos_x * at_y.D, sin_2x * at_y.B};
}

// Direction of the momentum in the axes whose attitude in the invariable frame is p / |p|: the
// third row of that rotation. inverse_norm2 = 1 / |p|^2.
template <Number T>
BasicVec3<T> momentum_direction(const BasicQuaternion<T>& p, const T& inverse_norm2) {
  const T f = T(2.0) * inverse_norm2;
  return {f * (p.x * p.z - p.w * p.y), f * (p.y * p.z + p.w * p.x),
          inverse_norm2 * (p.w * p.w + p.z * p.z - p.x * p.x - p.y * p.y)};
}

// The exponential of <cmath>, or that of the number's own namespace.
struct NaturalExp {
  template <Number T>
  [[gnu::always_inline]] T operator()(const T& x) const {
    using std::exp;
    return exp(x);
  }
};

// chi = chi_per_u u with |u| <= K, or any u on the separatrix; odd_half_periods flips theta1.
template <class Exp = NaturalExp, Number T>
[[gnu::always_inline]] inline BasicQuaternion<T> hyperbolic_sum(const CayleyKleinSeries<T>& s,
                                                                const T& chi,
                                                                const Mask<T>& odd_half_periods) {
  using std::abs;
  const T zero(0.0), one(1.0);
  const T e = Exp{}(T(T(-2.0) * abs(chi)));
  // <= 1 because e >= qt; on the separatrix e may be 0
  const T v = select(s.nome == zero, zero, T(s.nome / e));
  const T f = s.nome * e;
  const T side = select(chi < zero, T(-one), one);
  const T flip = select(odd_half_periods, T(-one), one);
  const auto at_v = detail::polynomials_at(s, v), at_f = detail::polynomials_at(s, f);
  return {at_v.A + e * at_f.A, flip * side * (at_v.C - e * at_f.C), flip * (at_v.D + e * at_f.D),
          -side * (at_v.B - e * at_f.B)};
}

}  // namespace v0
}  // namespace polhode
