// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "orbit/detail/elliptic_anomaly.hpp"
#include "orbit/detail/sine_excess.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

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

// One lane of a pack, which has the bits of any.
KeplerAnomaly elliptic_solution(double m, const Eccentricity& e) {
  using One = Pack<InstructionSet::baseline>;
  const auto x = detail::elliptic_solution(One(m), One(e.e), One(e.complement));
  return {x.anomaly.lanes[0], x.sine.lanes[0], x.versine.lanes[0]};
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
