// SPDX-License-Identifier: MIT
#include "polhode/orbit/kepler_equation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "orbit/detail/sine_excess.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double pi_ = RealTraits<double>::pi();

// 1 - cos x from sin x and cos x, relative.
template <Real T>
T versine(const T& s, const T& c) {
  const T one(1.0);
  return T(0.0) < c ? s * s / (one + c) : one - c;
}

// --- ellipses, 0 <= m <= pi ---

// Markley (1995), section 2: the root of a cubic from a Pade approximant of sin E.
double elliptic_start(double m, const Eccentricity& e) {
  constexpr double pi2 = pi_ * pi_;
  const double alpha = (3.0 * pi2 + 1.6 * pi_ * (pi_ - m) / (1.0 + e.e)) / (pi2 - 6.0);
  const double d = 3.0 * e.complement + alpha * e.e;
  const double q = 2.0 * alpha * d * e.complement - m * m;
  const double r = (3.0 * alpha * d * (d - e.complement) + m * m) * m;
  const double root = std::cbrt(r + std::sqrt(q * q * q + r * r));
  const double w = root * root;
  const double denominator = w * w + w * q + q * q;
  // 0 only where its terms are smaller than the smallest number
  return ((denominator > 0.0 ? 2.0 * r * w / denominator : 0.0) + m) / d;
}

// The step of fifth order from x, Markley (1995), section 4.
KeplerAnomaly elliptic_solution(double m, const Eccentricity& e) {
  const double x = elliptic_start(m, e);
  const double s = std::sin(x), c = std::cos(x);
  const double v = versine(s, c);
  const double f0 = (e.complement * x - m) + e.e * detail::sine_excess(x, s);
  const double f1 = e.complement + e.e * v, f2 = 0.5 * e.e * s, f3 = e.e * c * (1.0 / 6.0);
  const double d3 = -f0 / (f1 - f0 * f2 / f1);
  const double d4 = -f0 / (f1 + d3 * (f2 + d3 * f3));
  const double d = -f0 / (f1 + d4 * (f2 + d4 * (f3 - d4 * f2 * (1.0 / 12.0))));
  // |d| < 1e-3: sin and cos of x + d by the addition theorem
  const double dd = d * d;
  const double sd = d - d * dd * (1.0 / 6.0) * (1.0 - dd * (1.0 / 20.0));
  const double vd = 0.5 * dd * (1.0 - dd * (1.0 / 12.0) * (1.0 - dd * (1.0 / 30.0)));
  return {x + d, s + (c * sd - s * vd), v + (s * sd + c * vd)};
}

// One step of Halley from the solution in double: the error is cubed.
BasicKeplerAnomaly<DoubleDouble> elliptic_solution(const DoubleDouble& m,
                                                   const BasicEccentricity<DoubleDouble>& e) {
  const DoubleDouble x = elliptic_solution(m.hi, {e.e.hi, e.complement.hi}).anomaly;
  const SinCos<DoubleDouble> at = sincos(x);
  const DoubleDouble v = versine(at.sin, at.cos);
  const DoubleDouble f0 = (e.complement * x - m) + e.e * detail::sine_excess(x, at.sin);
  const DoubleDouble f1 = e.complement + e.e * v;
  const DoubleDouble d = -f0 / (f1 - 0.5 * f0 * e.e * at.sin / f1);
  const DoubleDouble vd = 0.5 * d * d;
  return {x + d, at.sin + (at.cos * d - at.sin * vd), v + (at.sin * d + at.cos * vd)};
}

// --- hyperbolas, m >= 0 ---

// The root of (e - 1) H + e H^3/6 = m, not less than that of Kepler's equation, since sinh H - H >=
// H^3/6; and e sinh H = m + H carried through asinh from there is not less either.
double hyperbolic_start(double m, const Eccentricity& e) {
  constexpr double cbrt_of_6 = 1.8171205928321397;
  const double ratio = m / e.e;
  double bound = std::min(m / e.complement, cbrt_of_6 * std::cbrt(ratio));
  if (ratio < 1.0) {
    const double scale = std::sqrt(2.0 * e.complement / e.e);
    bound = std::min(
        bound, 2.0 * scale * std::sinh(std::asinh(3.0 * ratio / scale / scale / scale) / 3.0));
  }
  return std::asinh(ratio + bound / e.e);
}

KeplerAnomaly hyperbolic_solution(double m, const Eccentricity& e) {
  constexpr double far = 1e20;  // m/e beyond which H in m + H needs no digits
  double x = hyperbolic_start(m, e);
  if (m > far * e.e) {
    x = std::asinh((m + x) / e.e);
  } else {
    for (int step = 0; step < 3; ++step) {
      const double s = std::sinh(x);
      const double f0 = (e.complement * x - m) + e.e * detail::sinh_excess(x, s);
      const double half = std::sinh(0.5 * x);
      const double f1 = e.complement + 2.0 * e.e * half * half;
      x -= f0 / (f1 - 0.5 * (f0 / f1) * e.e * s);
    }
  }
  // not sinh x: its error grows with x
  const double sine = m / e.e + x / e.e;
  const double cosine = sine < 1e150 ? std::sqrt(1.0 + sine * sine) : sine;
  return {x, sine, sine * (sine / (1.0 + cosine))};
}

BasicKeplerAnomaly<DoubleDouble> hyperbolic_solution(const DoubleDouble& m,
                                                     const BasicEccentricity<DoubleDouble>& e) {
  DoubleDouble x = hyperbolic_solution(m.hi, {e.e.hi, e.complement.hi}).anomaly;
  const DoubleDouble s = sinh(x), half = sinh(0.5 * x);
  const DoubleDouble f0 = (e.complement * x - m) + e.e * detail::sinh_excess(x, s);
  const DoubleDouble f1 = e.complement + 2.0 * e.e * half * half;
  x -= f0 / (f1 - 0.5 * (f0 / f1) * e.e * s);
  const DoubleDouble sine = (m + x) / e.e;
  return {x, sine, sine * sine / (1.0 + sqrt(1.0 + sine * sine))};
}

// --- any M ---

struct Reduced {
  DoubleDouble rest;   // in [-pi, pi]
  DoubleDouble turns;  // M - rest
};
Reduced reduced(const DoubleDouble& M) {
  constexpr double last_known = 1e30;  // beyond, no digit of the phase is known: any will do
  if (std::abs(M.hi) <= pi_) return {M, 0.0};
  const double turn = DoubleDouble::two_pi().hi;
  if (std::abs(M.hi) > last_known) return {std::remainder(M.hi, turn), M};
  DoubleDouble rest = M, turns = 0.0;
  for (int step = 0; step < 2; ++step) {  // the second where the first quotient has no fraction
    const DoubleDouble whole = DoubleDouble::two_pi() * std::rint(rest.hi / turn);
    rest = rest - whole;
    turns = turns + whole;
  }
  return {rest, turns};
}

template <Real T>
BasicKeplerAnomaly<T> with_sign(const BasicKeplerAnomaly<T>& x, bool negative) {
  return negative ? BasicKeplerAnomaly<T>{-x.anomaly, -x.sine, x.versine} : x;
}

template <Real T>
bool out_of_domain(const T& M, const BasicEccentricity<T>& e) {
  return !std::isfinite(to_double(M)) || !std::isfinite(to_double(e.e)) ||
         !(to_double(e.e) >= 0.0) || !(to_double(e.complement) > 0.0);
}

}  // namespace

KeplerAnomaly eccentric_anomaly(double M, const Eccentricity& e) {
  if (out_of_domain(M, e)) return {not_a_number, not_a_number, not_a_number};
  const bool negative = std::signbit(M);
  if (e.e > 1.0) {
    if (M == 0.0) return {M, M, 0.0};
    return with_sign(hyperbolic_solution(std::abs(M), e), negative);
  }
  const Reduced m = reduced(M);
  KeplerAnomaly x = with_sign(elliptic_solution(std::abs(m.rest.hi), e), std::signbit(m.rest.hi));
  x.anomaly += m.turns.hi;
  return x;
}

BasicKeplerAnomaly<DoubleDouble> eccentric_anomaly(const DoubleDouble& M,
                                                   const BasicEccentricity<DoubleDouble>& e) {
  if (out_of_domain(M, e)) return {not_a_number, not_a_number, not_a_number};
  const bool negative = std::signbit(M.hi);
  if (e.e > DoubleDouble(1.0)) {
    if (M.hi == 0.0) return {M, M, 0.0};
    return with_sign(hyperbolic_solution(abs(M), e), negative);
  }
  const Reduced m = reduced(M);
  auto x = with_sign(elliptic_solution(abs(m.rest), e), std::signbit(m.rest.hi));
  x.anomaly += m.turns;
  return x;
}

}  // namespace v0
}  // namespace polhode
