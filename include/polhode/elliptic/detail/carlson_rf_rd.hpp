// SPDX-License-Identifier: MIT
// Duplication for RF and RD, and when it stops.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "polhode/detail/math/wide_range.hpp"
#include "polhode/elliptic/detail/lockstep.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

namespace detail {

// The neglected terms are of degree 8 in the deviations: deviations below this are small enough.
template <class T>
double carlson_tolerance() {
  return std::sqrt(std::sqrt(std::sqrt(epsilon<T>())));
}

// The largest deviation from the mean a.
template <class T>
Rounded<T> deviation(const T& a, const T& x, const T& y, const T& z) {
  const auto off = [&](const T& v) {
    return in_double(
        [](const auto& mean, const auto& at) {
          using std::abs;
          return abs(mean - at);
        },
        a, v);
  };
  return largest(largest(off(x), off(y)), off(z));
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
  using Stop = Rounded<T>;
  explicit CarlsonTrips(const Stop& first_deviation)
      : deviation_(
            in_double([](const auto& d) { return d / carlson_tolerance<T>(); }, first_deviation)) {}
  bool converged(const T& mean) {
    const Stop now =
        in_double([](const auto& f, const auto& d) { return f * d; }, factor_, deviation_);
    trips_.converge(!(now >= rounded(mean)));
    trips_.stop(factor_ < Stop(0x1p-80));
    return trips_.all_done();
  }
  T kept(const T& before, const T& now) const { return trips_.kept(before, now); }
  // One duplication of the mean and of every argument  [DLMF 19.26.18].
  template <class... Arguments>
  void duplicate(const T& lambda, Arguments&... arguments) {
    ((arguments = kept(arguments, 0.25 * (arguments + lambda))), ...);
    if constexpr (Real<T>) {
      factor_ *= 0.25;
    } else {
      factor_ = trips_.kept(factor_, Stop(0.25) * factor_);
    }
  }
  const Stop& factor() const { return factor_; }

 private:
  Stop deviation_;
  Stop factor_{1.0};
  Lockstep<T> trips_;
};

template <class Mask>
Mask two_zeros(const Mask& x, const Mask& y, const Mask& z) {
  return (x && y) || (y && z) || (x && z);
}

// Carlson's functions where T has room for every step.
template <class T>
T carlson_rf_of(T x, T y, T z);
template <class T>
T carlson_rd_of(T x, T y, T z);
template <class T>
T carlson_rj_of(T x, T y, T z, T p);

// f of degree -halves/2, of arguments of any size, one of which is not ordinary: in WideRange, with
// the largest argument brought to 1.
template <class T, class Function, class... Rest>
T carlson_scaled(int halves, const Function& f, const T& first, const Rest&... rest) {
  if constexpr (NarrowRange<T>) {
    const auto usual = [](const T& x) { return to_double(x) >= 0.0; };
    if (!(usual(first) && (usual(rest) && ...))) {
      return T(std::numeric_limits<double>::quiet_NaN());
    }
    if (std::isinf(to_double(first)) || (std::isinf(to_double(rest)) || ...)) return T(0.0);
    return Widening<T>::narrowed(carlson_scaled(halves, f, widened(first), widened(rest)...));
  } else {
    using std::ldexp;
    T most = first;
    ((most = most < rest ? rest : most), ...);
    const int pairs = binary_exponent(most) / 2;
    return ldexp(f(T(ldexp(first, -2 * pairs)), T(ldexp(rest, -2 * pairs))...), -halves * pairs);
  }
}

// f(x, y, z), of degree -halves/2, where it is finite and T has room: of lanes that are not all
// such by the function of one lane; of numbers outside (least, most) scaled.
template <class T, class Mask, class OfLane, class Function>
T carlson_symmetric(int halves, double least, double most, const Mask& infinite,
                    const OfLane& of_lane, const Function& f, const T& x, const T& y, const T& z) {
  if constexpr (Real<T>) {
    if (infinite) return T(std::numeric_limits<double>::infinity());
  } else {
    const T zero(0.0);
    if (!all(!infinite && x >= zero && y >= zero && z >= zero) ||
        !lanes_within(least, most, x, y, z))
      return each_lane(of_lane, x, y, z);
  }
  if constexpr (NarrowRange<T> || is_wide<T>) {
    if (is_wide<T> || !within(least, most, x, y, z)) return carlson_scaled(halves, f, x, y, z);
  }
  return f(x, y, z);
}

}  // namespace detail

template <Number T>
T carlson_rf(T x, T y, T z) {
  const T zero(0.0);
  return detail::carlson_symmetric(
      1, 0x1p-900, 0x1p1000, detail::two_zeros(x == zero, y == zero, z == zero),
      [](const auto&... lane) { return carlson_rf(lane...); },
      [](const auto&... at) { return detail::carlson_rf_of(at...); }, x, y, z);
}

template <class T>
T detail::carlson_rf_of(T x, T y, T z) {
  using std::sqrt;
  T a = (x + y + z) / 3.0;
  detail::CarlsonTrips<T> trips(detail::deviation(a, x, y, z));
  while (!trips.converged(a)) {  // at most 40
    const T sx = sqrt(x), sy = sqrt(y), sz = sqrt(z);
    const T lambda = sx * (sy + sz) + sy * sz;
    trips.duplicate(lambda, a, x, y, z);
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

template <Number T>
T carlson_rd(T x, T y, T z) {
  const T zero(0.0);
  return detail::carlson_symmetric(
      3, 0x1p-320, 0x1p320, z == zero || (x == zero && y == zero),
      [](const auto&... lane) { return carlson_rd(lane...); },
      [](const auto&... at) { return detail::carlson_rd_of(at...); }, x, y, z);
}

template <class T>
T detail::carlson_rd_of(T x, T y, T z) {
  using std::sqrt;
  T a = (x + y + 3.0 * z) / 5.0;
  T sum(0.0);
  detail::CarlsonTrips<T> trips(detail::deviation(a, x, y, z));
  while (!trips.converged(a)) {  // at most 40
    const T sx = sqrt(x), sy = sqrt(y), sz = sqrt(z);
    const T lambda = sx * (sy + sz) + sy * sz;
    sum = trips.kept(sum, sum + trips.factor() / (sz * (z + lambda)));
    trips.duplicate(lambda, a, x, y, z);
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

// Compiled once, in the library.
extern template double carlson_rf<double>(double, double, double);
extern template double carlson_rd<double>(double, double, double);
extern template DoubleDouble carlson_rf<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);
extern template DoubleDouble carlson_rd<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
