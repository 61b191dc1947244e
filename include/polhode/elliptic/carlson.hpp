// SPDX-License-Identifier: MIT
// Carlson's symmetric elliptic integrals RF, RC, RD and RJ.
//
// Equations   RF = (1/2) int_0^inf dt / s,  RJ = (3/2) int_0^inf dt / (s (t + p)),
//             s = sqrt((t + x)(t + y)(t + z));  RC(x, y) = RF(x, y, y);  RD(x, y, z) =
//             RJ(x, y, z, z). Duplication, then Taylor to degree 7 [Carlson 1995; DLMF 19.36].
//             Derivatives differentiate the duplication itself, where every step is smooth: they
//             hold at equal arguments, where the closed rule dRJ/dx = (RJ - RD(y,z,x))/(2(x-p))
//             is 0/0. They equal dRF/dx = -RD(y,z,x)/6 and its like.
// Units       RF, RC: argument^(-1/2); RD, RJ: argument^(-3/2).
// Domain      x, y, z >= 0, at most one of them 0 (two: inf); RC: y > 0; RD: z > 0; RJ: p > 0.
//             Otherwise NaN. At x = 0 the derivative with respect to x is infinite; a Dual whose
//             derivatives are 0 there is a constant.
// Accuracy    budget elliptic_carlson: relative, also for extreme ratios of the arguments.
// Errors      none.
// Cost        4 to 7 trips in double (at most 14 for ratios up to 1e300), 7 to 10 in DoubleDouble;
//             a trip is three roots; RJ adds a division and, while p is far from the others, an
//             arctangent or a logarithm.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {

// The neglected terms are of degree 8 in the deviations: deviations below this are small enough.
template <class T>
double carlson_tolerance() {
  return std::sqrt(std::sqrt(std::sqrt(epsilon<T>())));
}

inline double largest(double a, double b) { return a < b ? b : a; }

// The largest deviation from the mean a.
template <class T>
double deviation(const T& a, const T& x, const T& y, const T& z) {
  const double m = to_double(a);
  return largest(largest(std::abs(m - to_double(x)), std::abs(m - to_double(y))),
                 std::abs(m - to_double(z)));
}

// 1/(2k + 1), k < 64.
inline constexpr std::array<DoubleDouble, 64> odd_reciprocals = [] {
  std::array<DoubleDouble, 64> r;
  for (std::size_t k = 0; k < 64; ++k)
    r[k] = DoubleDouble(1.0) / (2.0 * static_cast<double>(k) + 1.0);
  return r;
}();
template <class T>
auto odd_reciprocal(std::size_t k) {
  if constexpr (std::same_as<T, double>) {
    return odd_reciprocals[k].hi;
  } else if constexpr (std::same_as<T, DoubleDouble>) {
    return odd_reciprocals[k];
  } else if constexpr (requires { typename T::Scalar; }) {
    return odd_reciprocal<typename T::Scalar>(k);
  } else {
    return T(T(1.0) / T(2.0 * static_cast<double>(k) + 1.0));
  }
}

// RC(1, 1 + e) = arctan(sqrt e)/sqrt e for |e| < 0.05, by its series.
template <class T>
T carlson_rc_near_one(const T& e) {
  T term(1.0);
  T sum(1.0);
  for (std::size_t k = 1; k < 64; ++k) {  // at most 12 in double, 24 in DoubleDouble
    term = -(term * e);
    sum = sum + term * odd_reciprocal<T>(k);
    if (std::abs(to_double(term)) < epsilon<T>() && k > derivative_order<T>) break;
  }
  return sum;
}

// The same for any e > -1. w = 1 + e is given apart: it is small where e is near -1.
template <class T>
T carlson_rc_unit(const T& e, const T& w) {
  using std::atan;
  using std::log;
  using std::log1p;
  using std::sqrt;
  if (std::abs(to_double(e)) < 0.05) return carlson_rc_near_one(e);
  if (e > T(0.0)) {
    const T r = sqrt(e);
    return atan(r) / r;
  }
  // artanh(r)/r with r = sqrt(-e): (1 + r)/(1 - r) = (1 + r)^2/w = 1 + 2 r (1 + r)/w
  const T r = sqrt(-e);
  if (e > T(-0.5)) return T(0.5) * log1p(T(2.0) * r * (T(1.0) + r) / w) / r;
  return log((T(1.0) + r) / sqrt(w)) / r;
}

// The degree-7 polynomial that RD and RJ share  [DLMF 19.36.2].
template <class T>
T carlson_rj_series(const T& e2, const T& e3, const T& e4, const T& e5) {
  const T sum = (471240.0 - 540540.0 * e2) * e5 + (612612.0 * e2 - 540540.0 * e3 - 556920.0) * e4 +
                (306306.0 * e3 + e2 * (675675.0 * e2 - 706860.0) + 680680.0) * e3 +
                e2 * ((417690.0 - 255255.0 * e2) * e2 - 875160.0);
  return T(1.0) + sum / 4084080.0;  // one common denominator
}

// The factor exp2(-2 n) of n duplications, and whether deviations are small enough to stop.
template <class T>
class CarlsonTrips {
 public:
  explicit CarlsonTrips(double first_deviation)
      : deviation_(first_deviation / carlson_tolerance<T>()) {}
  bool converged(const T& mean) {
    const bool small = !(factor_ * deviation_ >= to_double(mean));
    return (small && more_-- == 0) || factor_ < 0x1p-80;
  }
  void next() { factor_ *= 0.25; }
  double factor() const { return factor_; }

 private:
  double deviation_;
  double factor_ = 1.0;
  std::size_t more_ = derivative_order<T>;
};

// RC(1, 1 + e)/d of one duplication: d = product of (sp + s_i), e = product of (sp - s_i)/(sp +
// s_i).
template <class T>
T carlson_rj_term(const T& sx, const T& sy, const T& sz, const T& sp) {
  const T d = (sp + sx) * (sp + sy) * (sp + sz);
  const T e = (sp - sx) * (sp - sy) * (sp - sz) / d;
  if (!(e < T(-0.5))) return carlson_rc_unit(e, T(1.0) + e) / d;
  // 1 - (1 - t1)(1 - t2)(1 - t3) as a sum of positive terms; not 1 + e: cancels
  const T tx = 2.0 * (sx < sp ? sx : sp) / (sp + sx);
  const T ty = 2.0 * (sy < sp ? sy : sp) / (sp + sy);
  const T tz = 2.0 * (sz < sp ? sz : sp) / (sp + sz);
  const T w = tx + (T(1.0) - tx) * (ty + (T(1.0) - ty) * tz);
  return carlson_rc_unit(e, w) / d;
}

inline bool two_zeros(bool x, bool y, bool z) { return (x && y) || (y && z) || (x && z); }

}  // namespace detail

template <Real T>
T carlson_rf(T x, T y, T z) {
  using std::sqrt;
  const T zero(0.0);
  if (detail::two_zeros(x == zero, y == zero, z == zero)) {
    return T(std::numeric_limits<double>::infinity());
  }
  T a = (x + y + z) / 3.0;
  detail::CarlsonTrips<T> trips(detail::deviation(a, x, y, z));
  while (!trips.converged(a)) {  // at most 40
    const T sx = sqrt(x), sy = sqrt(y), sz = sqrt(z);
    const T lambda = sx * (sy + sz) + sy * sz;
    a = 0.25 * (a + lambda);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
    trips.next();
  }
  const T dx = (a - x) / a;
  const T dy = (a - y) / a;
  const T dz = -(dx + dy);
  const T e2 = dx * dy - dz * dz;
  const T e3 = dx * dy * dz;
  const T sum = e3 * (6930.0 * e3 + e2 * (15015.0 * e2 - 16380.0) + 17160.0) +
                e2 * ((10010.0 - 5775.0 * e2) * e2 - 24024.0);
  return (T(1.0) + sum / 240240.0) / sqrt(a);  // [DLMF 19.36.1]
}

template <Real T>
T carlson_rc(const T& x, const T& y) {
  using std::atan2;
  using std::log;
  using std::sqrt;
  const T difference = y - x;
  if (std::abs(to_double(difference)) < 0.05 * to_double(x)) {
    return detail::carlson_rc_near_one(difference / x) / sqrt(x);
  }
  if (difference > T(0.0)) {
    const T r = sqrt(difference);
    return atan2(r, sqrt(x)) / r;
  }
  if (y > T(0.5) * x) return detail::carlson_rc_unit(difference / x, y / x) / sqrt(x);
  const T r = sqrt(-difference);
  return log((sqrt(x) + r) / sqrt(y)) / r;  // NaN for y < 0, inf for y = 0
}

template <Real T>
T carlson_rd(T x, T y, T z) {
  using std::sqrt;
  const T zero(0.0);
  if (z == zero || (x == zero && y == zero)) return T(std::numeric_limits<double>::infinity());
  T a = (x + y + 3.0 * z) / 5.0;
  T sum(0.0);
  detail::CarlsonTrips<T> trips(detail::deviation(a, x, y, z));
  while (!trips.converged(a)) {  // at most 40
    const T sx = sqrt(x), sy = sqrt(y), sz = sqrt(z);
    const T lambda = sx * (sy + sz) + sy * sz;
    sum = sum + trips.factor() / (sz * (z + lambda));
    a = 0.25 * (a + lambda);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
    trips.next();
  }
  const T dx = (a - x) / a;
  const T dy = (a - y) / a;
  const T dz = -(dx + dy) / 3.0;
  const T xy = dx * dy;
  const T z2 = dz * dz;
  const T series = detail::carlson_rj_series<T>(xy - 6.0 * z2, (3.0 * xy - 8.0 * z2) * dz,
                                                3.0 * (xy - z2) * z2, xy * z2 * dz);
  return 3.0 * sum + trips.factor() * series / (a * sqrt(a));
}

template <Real T>
T carlson_rj(T x, T y, T z, T p) {
  using std::abs;
  using std::sqrt;
  const T zero(0.0);
  if (p == zero || detail::two_zeros(x == zero, y == zero, z == zero)) {
    return T(std::numeric_limits<double>::infinity());
  }
  T a = (x + y + z + 2.0 * p) / 5.0;
  T sum(0.0);
  detail::CarlsonTrips<T> trips(
      detail::largest(detail::deviation(a, x, y, z), std::abs(to_double(a - p))));
  while (!trips.converged(a)) {  // at most 40
    const T sx = sqrt(x), sy = sqrt(y), sz = sqrt(z), sp = sqrt(p);
    const T lambda = sx * (sy + sz) + sy * sz;
    sum = sum + trips.factor() * detail::carlson_rj_term(sx, sy, sz, sp);
    a = 0.25 * (a + lambda);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
    p = 0.25 * (p + lambda);
    trips.next();
  }
  const T dx = (a - x) / a;
  const T dy = (a - y) / a;
  const T dz = (a - z) / a;
  const T dp = -0.5 * (dx + dy + dz);
  const T xyz = dx * dy * dz;
  const T p2 = dp * dp;
  const T e2 = dx * dy + dz * (dx + dy) - 3.0 * p2;
  const T e3 = xyz + 2.0 * dp * (e2 + 2.0 * p2);
  const T e4 = dp * (2.0 * xyz + dp * (e2 + 3.0 * p2));
  const T series = detail::carlson_rj_series<T>(e2, e3, e4, xyz * p2);
  return 6.0 * sum + trips.factor() * series / (a * sqrt(a));
}

// Compiled once, in the library.
extern template double carlson_rf<double>(double, double, double);
extern template double carlson_rc<double>(const double&, const double&);
extern template double carlson_rd<double>(double, double, double);
extern template double carlson_rj<double>(double, double, double, double);
extern template DoubleDouble carlson_rf<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);
extern template DoubleDouble carlson_rc<DoubleDouble>(const DoubleDouble&, const DoubleDouble&);
extern template DoubleDouble carlson_rd<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);
extern template DoubleDouble carlson_rj<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble,
                                                      DoubleDouble);

}  // namespace v0
}  // namespace polhode
