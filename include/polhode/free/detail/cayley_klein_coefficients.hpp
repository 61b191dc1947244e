// SPDX-License-Identifier: MIT
// Coefficients of the Cayley-Klein series of a polhode (see polhode/detail/free/cayley_klein.hpp
// for the sums).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "polhode/detail/free/cayley_klein.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/free/detail/polhode_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Below this k'^2 the transformed (hyperbolic) series is the shorter one.
inline constexpr double hyperbolic_below = 1e-2;

// sum_j c_j p_j(y) in powers of y, for p_(j+1) = 2 y p_j - p_(j-1), p_0 = 1, p_1 = slope y + shift.
template <Real T>
SeriesPolynomial<T> monomials(const SeriesPolynomial<T>& c, int terms, double slope, double shift) {
  std::array<double, max_series_terms> before{}, now{}, next{};  // integer coefficients, exact
  now[0] = 1.0;
  next[0] = shift;
  next[1] = slope;
  SeriesPolynomial<T> sum{};
  for (std::size_t j = 0; j < static_cast<std::size_t>(terms); ++j) {  // <= 8 trips
    for (std::size_t i = 0; i <= j; ++i) sum[i] = sum[i] + c[j] * T(now[i]);
    before = now;
    now = next;
    for (std::size_t i = 0; i < max_series_terms; ++i)
      next[i] = (i == 0 ? 0.0 : 2.0 * now[i - 1]) - before[i];
  }
  return sum;
}

// F(arctan(1/kappa), k') with both complements known: no subtraction K' - F.
template <Real T>
T theta_shift(const PolhodeCurve<T>& c) {
  using std::sqrt;
  const T sin2 = T(1.0) / (T(1.0) + c.kap2);
  const T cos2 = c.kap2 * sin2;
  return sqrt(sin2) * elliptic::carlson_rf(cos2, cos2 + c.k2 * sin2, T(1.0));
}

// tan(theta/2) at u = 0, theta the angle between axis 3' and the momentum.
template <Real T>
T half_angle_tangent(const PolhodeCurve<T>& c) {
  return c.a1 / (c.G + c.a3);
}

// What term j of the theta functions is made of. In double every exponential is one of its own;
// with digits to spare they are powers of three, which takes a fifth of the time.
template <Real T>
struct ThetaPowers {
  ThetaPowers(const T& shift, const T& log_nome) : two_a(shift), log_p(log_nome) {
    using std::exp;
    using std::expm1;
    if constexpr (!has_bits_of_double) {
      p = exp(log_p);
      first = exp(T(log_p + two_a));
      shrunk = exp(T(-two_a));
      shrunk_rest = -expm1(T(-two_a));
      odd = shrunk;
      odd_rest = shrunk_rest;
    }
  }
  void advance() {
    using std::exp;
    using std::expm1;
    j += 1.0;
    if constexpr (has_bits_of_double) {
      const T jj(j), odd_angle = (T(2.0) * jj + T(1.0)) * two_a;
      low = exp(jj * (jj * log_p + two_a));
      even = exp(T(-2.0) * jj * two_a);
      even_rest = -expm1(T(-2.0) * jj * two_a);
      high = low * exp(jj * log_p);
      odd = exp(-odd_angle);
      odd_rest = -expm1(-odd_angle);
    } else {
      low = low * first * even_p;
      even_p = even_p * (p * p);
      p_to_j = p_to_j * p;
      high = low * p_to_j;
      even_rest = odd_rest + odd * shrunk_rest;  // 1 - x y = (1 - x) + x (1 - y)
      even = odd * shrunk;
      odd_rest = even_rest + even * shrunk_rest;
      odd = even * shrunk;
    }
  }

  static constexpr bool has_bits_of_double = RealTraits<T>::epsilon() > 1e-20;
  T two_a, log_p;
  T low = T(1.0);     // p^(j^2) e^(2ja) <= q^(2 j^2 - j)
  T high = T(1.0);    // p^(j(j+1)) e^(2ja)
  T even, even_rest;  // x and 1 - x of x = e^(-4ja)
  T odd, odd_rest;    // of x = e^(-2(2j+1)a)
  T p, first, shrunk, shrunk_rest, even_p = T(1.0), p_to_j = T(1.0);
  double j = 0.0;
};

template <Real T>
CayleyKleinSeries<T> trigonometric_series(const PolhodeCurve<T>& c) {
  using std::exp;
  using std::expm1;
  CayleyKleinSeries<T> s;
  const T one(1.0);
  SeriesPolynomial<T> A{}, B{}, C{}, D{};
  A[0] = one;
  C[0] = D[0] = one;  // the limit a = inf of 1 +- e^(-2a)
  T sum_a = one, sum_h = one;
  if (c.kap2 > T(0.0)) {
    const T two_a = pi<T>() * theta_shift(c) / c.K;
    C[0] = one + exp(-two_a);
    D[0] = sum_h = -expm1(-two_a);
    const bool has_nome = c.k2 > T(0.0);
    const T log_p = has_nome ? T(-2.0) * pi<T>() * c.Kp / c.K : T(0.0);
    ThetaPowers<T> power(two_a, log_p);
    for (int j = 1; has_nome && j < static_cast<int>(max_series_terms); ++j) {
      const auto i = static_cast<std::size_t>(j);
      const T sign = (j % 2 == 0) ? one : -one;
      power.advance();
      A[i] = sign * power.low * (one + power.even);
      B[i] = sign * power.low * power.even_rest;
      C[i] = sign * power.high * (one + power.odd);
      D[i] = sign * power.high * power.odd_rest;
      sum_a = sum_a + A[i];
      sum_h = sum_h + D[i];
      s.terms = j + 1;
      if (to_double(power.low) < 0.01 * epsilon<T>()) break;
    }
  }
  const T r = half_angle_tangent(c) * sum_a / sum_h;
  for (std::size_t i = 0; i < max_series_terms; ++i) {
    C[i] = r * C[i];
    D[i] = -(r * D[i]);
  }
  s.A = monomials(A, s.terms, 1.0, 0.0);  // T_j(cos 2x) = cos 2jx
  for (std::size_t i = 0; i + 1 < max_series_terms; ++i) B[i] = B[i + 1];
  B[max_series_terms - 1] = T(0.0);
  s.B = monomials(B, s.terms, 2.0, 0.0);   // U_(j-1), times sin 2x: sin 2jx
  s.C = monomials(C, s.terms, 2.0, 1.0);   // U_j + U_(j-1), times sin x: sin (2j+1)x
  s.D = monomials(D, s.terms, 2.0, -1.0);  // U_j - U_(j-1), times cos x: cos (2j+1)x
  return s;
}

// theta4(z | iT) and theta1(z | iT), T = 2K'/K, through theta2 and theta1 of z/(iT), nome
// exp(-pi/T).
template <Real T>
CayleyKleinSeries<T> hyperbolic_series(const PolhodeCurve<T>& c) {
  using std::cos;
  using std::exp;
  using std::sin;
  CayleyKleinSeries<T> s;
  s.hyperbolic = true;
  const T b = T(0.25) * pi<T>() * theta_shift(c) / c.Kp;
  s.chi_per_u = T(0.25) * pi<T>() / c.Kp;
  if (!c.separatrix) {
    s.nome = exp(T(-0.5) * pi<T>() * c.K / c.Kp);
    s.phase_per_u = b / c.K;
  }
  T even = T(0.0), odd = T(0.0), power = T(1.0);  // qt^(m^2)
  for (int m = 0; m < static_cast<int>(max_series_terms); ++m) {
    const auto i = static_cast<std::size_t>(m);
    const T sign = (m % 2 == 0) ? T(1.0) : T(-1.0);
    const T angle = T(2.0 * m + 1.0) * b;
    T shrink = T(1.0), step = T(1.0);  // qt^m and qt^(2m+1)
    for (int k = 0; k < m; ++k) shrink = shrink * s.nome;
    step = shrink * shrink * s.nome;
    s.A[i] = power * cos(angle);
    s.B[i] = power * sin(angle);
    even = even + shrink * s.A[i];
    odd = odd + sign * shrink * s.B[i];
    s.terms = m + 1;
    power = power * step;
    if (to_double(power) < 0.01 * epsilon<T>()) break;
  }
  if (s.terms == 1) s.nome = T(0.0);
  const T r = half_angle_tangent(c) * even / odd;
  for (std::size_t i = 0; i < max_series_terms; ++i) {
    const T sign = (i % 2 == 0) ? r : -r;
    s.C[i] = sign * s.A[i];
    s.D[i] = -(sign * s.B[i]);
  }
  return s;
}

template <Real T>
CayleyKleinSeries<T> cayley_klein_series(const PolhodeCurve<T>& c) {
  return to_double(c.kp2) < hyperbolic_below ? hyperbolic_series(c) : trigonometric_series(c);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
