// SPDX-License-Identifier: MIT
// RC by elementary functions and its series, RJ by duplication.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

#include "polhode/elliptic/carlson_rf_rd.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

namespace detail {

// 1/(2k + 1), k < 64.
inline constexpr std::array<DoubleDouble, 64> odd_reciprocals = [] {
  std::array<DoubleDouble, 64> r;
  for (std::size_t k = 0; k < 64; ++k)
    r[k] = DoubleDouble(1.0) / (2.0 * static_cast<double>(k) + 1.0);
  return r;
}();
template <class T>
auto odd_reciprocal(std::size_t k) {
  if constexpr (!Real<T>) {
    const auto one = odd_reciprocal<ScalarOf<T>>(k);
    return each_lane([&](const auto& /*lane*/) { return one; }, T(0.0));
  } else if constexpr (std::same_as<T, double>) {
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
  Lockstep<T> trips;
  T term(1.0);
  T sum(1.0);
  for (std::size_t k = 1; k < 64; ++k) {  // at most 12 in double, 24 in DoubleDouble
    term = -(term * e);
    sum = trips.kept(sum, sum + term * odd_reciprocal<T>(k));
    trips.stop(rounded_size(term) < Rounded<T>(epsilon<T>()) && k > derivative_order<T>);
    if (trips.all_done()) break;
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
  const T zero(0.0), one(1.0);
  const auto near = rounded_size(e) < Rounded<T>(0.05);
  const auto by_series = [&]() -> T { return carlson_rc_near_one(select(near, e, zero)); };
  const auto by_arctangent = [&]() -> T {
    const T r = sqrt(e);
    return atan(r) / r;
  };
  // artanh(r)/r with r = sqrt(-e): (1 + r)/(1 - r) = (1 + r)^2/w = 1 + 2 r (1 + r)/w
  const auto by_logarithm = [&]() -> T {
    const T r = sqrt(-e);
    return where(
        e > T(-0.5), [&]() -> T { return T(0.5) * log1p(T(2.0) * r * (one + r) / w) / r; },
        [&]() -> T { return log((one + r) / sqrt(w)) / r; });
  };
  return where(near, by_series,
               [&]() -> T { return where(e > zero, by_arctangent, by_logarithm); });
}

// RC(1, 1 + e)/d of one duplication: d = product of (sp + s_i), e = product of (sp - s_i)/(sp +
// s_i).
template <class T>
T carlson_rj_term(const T& sx, const T& sy, const T& sz, const T& sp) {
  const T d = (sp + sx) * (sp + sy) * (sp + sz);
  const T e = (sp - sx) * (sp - sy) * (sp - sz) / d;
  // 1 - (1 - t1)(1 - t2)(1 - t3) as a sum of positive terms; not 1 + e: cancels
  const auto small_w = [&]() -> T {
    const T tx = 2.0 * select(sx < sp, sx, sp) / (sp + sx);
    const T ty = 2.0 * select(sy < sp, sy, sp) / (sp + sy);
    const T tz = 2.0 * select(sz < sp, sz, sp) / (sp + sz);
    return tx + (T(1.0) - tx) * (ty + (T(1.0) - ty) * tz);
  };
  const T w = where(e < T(-0.5), small_w, [&]() -> T { return T(1.0) + e; });
  return carlson_rc_unit(e, w) / d;
}

// x >= 0 and y > 0 (of a scalar, y = 0 and NaN too), both finite.
template <class T>
T carlson_rc_of(const T& x, const T& y) {
  using std::atan2;
  using std::log;
  using std::sqrt;
  const T difference = y - x;
  const auto near =
      rounded_size(difference) < in_double([](const auto& at) { return 0.05 * at; }, x);
  const auto by_series = [&]() -> T {
    return carlson_rc_near_one(select(near, T(difference / x), T(0.0))) / sqrt(x);
  };
  const auto by_arctangent = [&]() -> T {
    const T r = sqrt(difference);
    return atan2(r, T(sqrt(x))) / r;
  };
  const auto by_unit = [&]() -> T {
    return carlson_rc_unit(T(difference / x), T(y / x)) / sqrt(x);
  };
  const auto by_logarithm = [&]() -> T {
    const T r = sqrt(-difference);
    return log((sqrt(x) + r) / sqrt(y)) / r;  // NaN for y < 0, inf for y = 0
  };
  const auto not_above = [&]() -> T { return where(y > T(0.5) * x, by_unit, by_logarithm); };
  return where(near, by_series,
               [&]() -> T { return where(difference > T(0.0), by_arctangent, not_above); });
}

}  // namespace detail

template <Number T>
T carlson_rc(const T& x, const T& y) {
  using std::sqrt;
  const T zero(0.0);
  if constexpr (Real<T>) {
    if (y < zero && x >= zero) {  // [DLMF 19.2.20], by quarters: x - y may overflow
      const T quarter = T(0.25) * x - T(0.25) * y;
      return T(0.25) * (sqrt(x / quarter) * carlson_rc(quarter, T(-0.25 * y)));
    }
  } else {
    const T infinity(std::numeric_limits<double>::infinity());
    if (!all(x >= zero && y > zero && x < infinity && y < infinity))
      return each_lane([](const auto& a, const auto& b) { return carlson_rc(a, b); }, x, y);
  }
  if constexpr (derivative_order<T> > 0) {
    // By the closed rule: the formulas below lose digits of the slope around x = y.
    const auto &a = x.value, &b = y.value;
    const auto slope_x = x.is_constant() ? 0.0 * a : carlson_rd(b, b, a) / -6.0;
    return T::chained(carlson_rc(a, b), slope_x, x, carlson_rd(a, b, b) / -3.0, y);
  } else {
    if constexpr (NarrowRange<T>) {
      if (std::isinf(to_double(x)) || std::isinf(to_double(y))) return T(1.0) / (x + y);
    }
    return detail::carlson_rc_of(x, y);
  }
}

template <Number T>
T carlson_rj(T x, T y, T z, T p);

namespace detail {

template <class T>
auto is_far(const T& x, const T& y, const T& z, const T& p) {
  return p > T(4096.0) * largest(largest(x, y), z);
}
// p far above the others, where each duplication brings it down by 4 only: exchanged for q next to
// the least of them  [DLMF 19.21.12]. RF dominates the difference.
template <class T>
T carlson_rj_far(T x, T y, T z, const T& p) {
  using std::sqrt;
  if (y < x) std::swap(x, y);
  if (z < x) std::swap(x, z);
  const T r = (y - x) * (z - x) / (p - x);
  const T q = x + r;
  const T rc = sqrt(x) * carlson_rc(T(y * z), T(p * q));  // RC(y z/x, p q/x)
  return (3.0 * (carlson_rf(x, y, z) - rc) - r * carlson_rj(x, y, z, q)) / (p - x);
}

// The principal value at p = -q < 0  [DLMF 19.20.14]; y between the others, so that p - y >= 0.
template <class T>
T carlson_rj_principal(T x, T y, T z, const T& q) {
  using std::sqrt;
  if (y < x) std::swap(x, y);
  if (z < y) std::swap(y, z);
  if (y < x) std::swap(x, y);
  const T above = (z - y) * (y - x) / (y + q);
  const T p = y + above;
  const T xz = x * z;
  const T pq = p * q;
  // sqrt(y), not sqrt(x y z): at x = 0, where a Dual has no root, the term is 0.
  T rc(0.0);
  if (x > T(0.0)) rc = sqrt(xz / (xz + pq)) * sqrt(y) * carlson_rc(T(xz + pq), pq);
  return (above * carlson_rj(x, y, z, p) + 3.0 * (rc - carlson_rf(x, y, z))) / (y + q);
}

}  // namespace detail

template <Number T>
T carlson_rj(T x, T y, T z, T p) {
  const T zero(0.0);
  const auto infinite = p == zero || detail::two_zeros(x == zero, y == zero, z == zero);
  if constexpr (!Real<T>) {
    const auto ordinary =
        !infinite && x >= zero && y >= zero && z >= zero && p > zero && !detail::is_far(x, y, z, p);
    if (!all(ordinary) || !lanes_within(0x1p-320, 0x1p320, x, y, z, p))
      return each_lane([](const auto&... v) { return carlson_rj(v...); }, x, y, z, p);
    return detail::carlson_rj_of(x, y, z, p);
  } else {
    if (infinite) return T(std::numeric_limits<double>::infinity());
    // The exchanges below do not end where one of these is negative.
    if (x < zero || y < zero || z < zero) return T(std::numeric_limits<double>::quiet_NaN());
    if constexpr (std::same_as<T, double>) {
      if (p < 0.0) return to_double(carlson_rj<DoubleDouble>(x, y, z, p));
    }
    const bool principal = p < zero;
    if constexpr (NarrowRange<T> || is_wide<T>) {
      if (is_wide<T> || !within(0x1p-320, 0x1p320, x, y, z, p)) {
        const auto f = [principal](auto&&... at) {
          return principal ? detail::carlson_rj_principal(std::move(at)...)
                           : detail::carlson_rj_of(std::move(at)...);
        };
        return detail::carlson_scaled(3, f, x, y, z, principal ? T(-p) : p);
      }
    }
    return principal ? detail::carlson_rj_principal(x, y, z, T(-p))
                     : detail::carlson_rj_of(x, y, z, p);
  }
}

template <class T>
T detail::carlson_rj_of(T x, T y, T z, T p) {
  using std::sqrt;
  if constexpr (Real<T>) {
    if (detail::is_far(x, y, z, p)) return detail::carlson_rj_far(x, y, z, p);
  }
  T a = (x + y + z + 2.0 * p) / 5.0;
  T sum(0.0);
  detail::CarlsonTrips<T> trips(
      detail::largest(detail::deviation(a, x, y, z), detail::rounded_size(T(a - p))));
  while (!trips.converged(a)) {  // at most 40
    const T sx = sqrt(x), sy = sqrt(y), sz = sqrt(z), sp = sqrt(p);
    const T lambda = sx * (sy + sz) + sy * sz;
    sum = trips.kept(sum, sum + trips.factor() * detail::carlson_rj_term(sx, sy, sz, sp));
    trips.duplicate(lambda, a, x, y, z, p);
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
extern template double carlson_rc<double>(const double&, const double&);
extern template double carlson_rj<double>(double, double, double, double);
extern template DoubleDouble carlson_rc<DoubleDouble>(const DoubleDouble&, const DoubleDouble&);
extern template DoubleDouble carlson_rj<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble,
                                                      DoubleDouble);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
