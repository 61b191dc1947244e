// SPDX-License-Identifier: MIT
// Elementary functions of DoubleDouble: a double result corrected once by Newton (log, atan2), or a
// Taylor series after reduction (exp, sin) whose small terms are summed in double.
#include "polhode/math/double_double.hpp"

#include <algorithm>
#include <array>

namespace polhode {
inline namespace v0 {
namespace {

// 1/n!, n <= 14: n! is exact in double.
constexpr DoubleDouble inverse_factorial(int n) {
  double f = 1.0;
  for (int i = 2; i <= n; ++i) f *= i;
  return DoubleDouble(1.0) / f;
}

template <std::size_t N>
constexpr std::array<DoubleDouble, N> inverse_factorials(int first, int step, bool alternate) {
  std::array<DoubleDouble, N> c;
  for (std::size_t i = 0; i < N; ++i) {
    const DoubleDouble value = inverse_factorial(first + step * static_cast<int>(i));
    c[i] = alternate && i % 2 == 1 ? -value : value;
  }
  return c;
}

constexpr DoubleDouble ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
// ln 2 = high + low, the high part of 40 bits: its products with exponents are exact.
constexpr double ln2_high = 0x1.62e42fefa2000p-1;
constexpr DoubleDouble ln2_low{0x1.9ef35793c7673p-41, 0x1.f97b57a079a19p-103};
// Where sincos keeps 32 digits.
constexpr double largest_angle = 1e10;
// pi/2 to 212 bits.
constexpr DoubleDouble half_pi_high{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr DoubleDouble half_pi_low{-0x1.f1976b7ed8fbcp-110, 0x1.4cf98e804177dp-164};
constexpr DoubleDouble sixteenth_pi{0x1.921fb54442d18p-3, 0x1.1a62633145c07p-57};
// sin(j pi/16), j = 0..8; the cosine is read backwards.
constexpr std::array<DoubleDouble, 9> sine_table{
    DoubleDouble{0.0},
    DoubleDouble{0x1.8f8b83c69a60bp-3, -0x1.26d19b9ff8d82p-57},
    DoubleDouble{0x1.87de2a6aea963p-2, -0x1.72cedd3d5a610p-57},
    DoubleDouble{0x1.1c73b39ae68c8p-1, 0x1.b25dd267f6600p-55},
    DoubleDouble{0x1.6a09e667f3bcdp-1, -0x1.bdd3413b26456p-55},
    DoubleDouble{0x1.a9b66290ea1a3p-1, 0x1.9f630e8b6dac8p-60},
    DoubleDouble{0x1.d906bcf328d46p-1, 0x1.457e610231ac2p-56},
    DoubleDouble{0x1.f6297cff75cb0p-1, 0x1.562172a361fd3p-56},
    DoubleDouble{1.0}};

// expm1(r) for |r| <= 0.35. With t = r/16 the series ends at t^14/14!; from t^9/9! on, double
// suffices. Then four doublings e -> e (2 + e), which keep the relative error of a small e.
DoubleDouble reduced_expm1(DoubleDouble r) {
  static constexpr auto c = inverse_factorials<14>(1, 1, false);
  const DoubleDouble t = ldexp(r, -4);
  double tail = c[13].hi;
  for (std::size_t i = 13; i-- > 8;) tail = tail * t.hi + c[i].hi;
  DoubleDouble e = t * tail;
  for (std::size_t i = 8; i-- > 1;) e = (e + c[i]) * t;
  e = e * t + t;
  for (int i = 0; i < 4; ++i) e = e * (e + 2.0);
  return e;
}

// sin(t) for |t| <= pi/32, where the series ends at t^17/17!.
DoubleDouble reduced_sin(DoubleDouble t) {
  static constexpr auto c = inverse_factorials<6>(3, 2, true);  // 1/3!, -1/5!, ..., -1/13!
  const DoubleDouble t2 = t * t;
  const double x = t2.hi;
  // + 1/15! - 1/17!
  const double end = x * (1.0 / 1307674368000.0 - x * (1.0 / 355687428096000.0));
  const double tail = c[4].hi + x * (c[5].hi + end);
  DoubleDouble s = t2 * tail;
  for (std::size_t i = 4; i-- > 0;) s = (s + c[i]) * t2;
  return t - t * s;
}

struct ReducedAngle {
  DoubleDouble rest;
  int quadrant;
};

// x - k pi/2, without loss of digits next to a zero of sine or cosine.
ReducedAngle quadrant_reduced(DoubleDouble x) {
  const double k = std::nearbyint(x.hi * 0.6366197723675814);
  if (k == 0.0) return {x, 0};
  DoubleDouble r = x - DoubleDouble::product(k, half_pi_high.hi);
  r = r - DoubleDouble::product(k, half_pi_high.lo);
  r = r - k * half_pi_low;
  return {r, static_cast<int>(k - 4.0 * std::floor(0.25 * k))};
}

}  // namespace

DoubleDouble hypot(DoubleDouble x, DoubleDouble y) {
  const double largest = std::max(std::abs(x.hi), std::abs(y.hi));
  if (!(largest > 0.0) || !std::isfinite(x.hi) || !std::isfinite(y.hi)) {
    return std::hypot(x.hi, y.hi);
  }
  const int e = std::ilogb(largest);
  const DoubleDouble u = ldexp(x, -e);
  const DoubleDouble v = ldexp(y, -e);
  return ldexp(sqrt(u * u + v * v), e);
}

DoubleDouble exp(DoubleDouble x) {
  if (!(std::abs(x.hi) < 746.0)) return std::exp(x.hi);
  const double k = std::nearbyint(x.hi * 1.4426950408889634);
  const DoubleDouble e = 1.0 + reduced_expm1((x - k * ln2_high) - k * ln2_low);
  const DoubleDouble y = ldexp(e, static_cast<int>(k));
  return std::isfinite(y.hi) ? y : DoubleDouble(y.hi);
}

DoubleDouble expm1(DoubleDouble x) {
  if (x.hi == 0.0) return x;
  return std::abs(x.hi) <= 0.34 ? reduced_expm1(x) : exp(x) - 1.0;
}

DoubleDouble log1p(DoubleDouble x) {
  if (x.hi == 0.0) return x;
  if (!(x.hi >= -0.5 && x.hi <= 1.0)) return log(x + 1.0);
  const double y = std::log1p(x.hi);
  const DoubleDouble e = expm1(y);
  const DoubleDouble d = (x - e) / (1.0 + e);
  return y + (d - 0.5 * d.hi * d.hi);
}

DoubleDouble log(DoubleDouble x) {
  if (!(x.hi > 0.0) || std::isinf(x.hi)) return std::log(x.hi);
  int k = std::ilogb(x.hi);
  DoubleDouble m = ldexp(x, -k);
  if (m.hi > 1.4142135623730951) {
    m = ldexp(m, -1);
    ++k;
  }
  const DoubleDouble y = log1p(m - 1.0);
  return k == 0 ? y : ln2 * static_cast<double>(k) + y;
}

SinCos<DoubleDouble> sincos(DoubleDouble x) {
  if (x.hi == 0.0) return {x, 1.0};
  if (!std::isfinite(x.hi)) return {x.hi - x.hi, x.hi - x.hi};
  if (std::abs(x.hi) > largest_angle) {  // the reduction below would leave its quadrant
    const double s = std::sin(x.hi), c = std::cos(x.hi);
    const double s_lo = std::sin(x.lo), c_lo = std::cos(x.lo);
    return {s * c_lo + c * s_lo, c * c_lo - s * s_lo};
  }
  const ReducedAngle r = quadrant_reduced(x);
  const double j = std::nearbyint(r.rest.hi * 5.092958178940651);
  DoubleDouble s = reduced_sin(r.rest - j * sixteenth_pi);
  DoubleDouble c = sqrt(1.0 - s * s);
  if (j != 0.0) {
    const auto i = static_cast<std::size_t>(std::abs(j));
    const DoubleDouble sin_j = j < 0.0 ? -sine_table[i] : sine_table[i];
    const DoubleDouble cos_j = sine_table[8 - i];
    const DoubleDouble s0 = s;
    s = s0 * cos_j + c * sin_j;
    c = c * cos_j - s0 * sin_j;
  }
  switch (r.quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

DoubleDouble sin(DoubleDouble x) { return sincos(x).sin; }
DoubleDouble cos(DoubleDouble x) { return sincos(x).cos; }

DoubleDouble tan(DoubleDouble x) {
  const SinCos<DoubleDouble> r = sincos(x);
  return r.sin / r.cos;
}

DoubleDouble atan2(DoubleDouble y, DoubleDouble x) {
  const double whole = std::atan2(y.hi, x.hi);
  if (y.hi == 0.0) return whole == 0.0 ? DoubleDouble(whole) : copysign(DoubleDouble::pi(), y);
  const double largest = std::max(std::abs(x.hi), std::abs(y.hi));
  if (!std::isfinite(largest) || std::isnan(x.hi)) {  // multiples of pi/4, or NaN
    return ldexp(DoubleDouble::pi() * std::nearbyint(whole * 1.2732395447351628), -2);
  }
  const int e = std::ilogb(largest);
  const DoubleDouble u = ldexp(x, -e);
  const DoubleDouble v = ldexp(y, -e);
  const double angle = std::atan2(v.hi, u.hi);
  const SinCos<DoubleDouble> r = sincos(DoubleDouble(angle));
  return angle + (v * r.cos - u * r.sin) / (u * r.cos + v * r.sin);
}

DoubleDouble atan(DoubleDouble x) { return atan2(x, 1.0); }
DoubleDouble asin(DoubleDouble x) { return atan2(x, sqrt((1.0 - x) * (1.0 + x))); }
DoubleDouble acos(DoubleDouble x) { return atan2(sqrt((1.0 - x) * (1.0 + x)), x); }

// Beyond 40, exp(-x) is below the last digit; exp(x/2)^2 does not overflow before the result does.
DoubleDouble sinh(DoubleDouble x) {
  const DoubleDouble a = abs(x);
  if (a.hi > 40.0) {
    const DoubleDouble h = exp(ldexp(a, -1));
    return copysign(ldexp(h, -1) * h, x);
  }
  const DoubleDouble e = expm1(a);
  return copysign(ldexp(e + e / (1.0 + e), -1), x);
}

DoubleDouble cosh(DoubleDouble x) {
  const DoubleDouble a = abs(x);
  if (a.hi > 40.0) {
    const DoubleDouble h = exp(ldexp(a, -1));
    return ldexp(h, -1) * h;
  }
  const DoubleDouble e = exp(a);
  return ldexp(e + 1.0 / e, -1);
}

DoubleDouble tanh(DoubleDouble x) {
  if (std::abs(x.hi) > 40.0) return std::tanh(x.hi);
  const DoubleDouble e = expm1(ldexp(abs(x), 1));
  return copysign(e / (e + 2.0), x);
}

}  // namespace v0
}  // namespace polhode
