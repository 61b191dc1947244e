// SPDX-License-Identifier: MIT
// Points and weights on the part of the unit sphere with v.s > 0 and v.o > 0: Gauss' rule along
// longitude and latitude, counted from the plane of s and o.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace light {
namespace detail {

// A number without its derivatives.
template <Real T>
const T& plain(const T& x) {
  return x;
}
template <Real T, int N>
auto plain(const Dual<T, N>& x) {
  return plain(x.value);
}
template <Real T>
auto plain_vector(const BasicVec3<T>& v) {
  using P = std::remove_cvref_t<decltype(plain(v.x))>;
  return BasicVec3<P>{plain(v.x), plain(v.y), plain(v.z)};
}

template <Real T>
bool is_constant_zero(const T& x) {
  return x == T(0.0);
}
template <Real T, int N>
bool is_constant_zero(const Dual<T, N>& x) {
  return x.value == T(0.0) && x.is_constant();
}

template <int points>
struct LatitudeRule {
  static constexpr auto count = static_cast<std::size_t>(points);
  std::array<double, count> x;  // of Gauss and Legendre on [-1, 1]
  std::array<double, count> w;
  std::array<double, count> sine;  // of the latitude pi/2 x
  std::array<double, count> cosine;
  std::array<double, count> weight;  // pi/2 w cosine
};
// points = 8, 16, 32, 64
template <int points>
const LatitudeRule<points>& latitude_rule();

template <Real T>
BasicVec3<T> perpendicular(const BasicVec3<T>& e) {
  using std::abs;
  using std::sqrt;
  const BasicVec3<T> axis = abs(e.x) < T(0.6) ? BasicVec3<T>{T(1.0), T(0.0), T(0.0)}
                                              : BasicVec3<T>{T(0.0), T(1.0), T(0.0)};
  const BasicVec3<T> c = cross(e, axis);
  return (T(1.0) / T(sqrt(dot(c, c)))) * c;
}

// f(point, weight) for each of points^2. s and o of any length but 0.
template <int points, Real T, class F>
void for_lune_points(const BasicVec3<T>& s, const BasicVec3<T>& o, const F& f) {
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const BasicVec3<T> u = (T(1.0) / T(sqrt(dot(s, s)))) * s;
  const BasicVec3<T> v = (T(1.0) / T(sqrt(dot(o, o)))) * o;
  const BasicVec3<T> q = u + v, d = u - v;
  const T along = sqrt(dot(q, q)), across = sqrt(dot(d, d));
  // Where both directions are opposite to half of the digits, q is rounding, which may be parallel
  // to d: the lune is a line then, anywhere, with 1e-24 of the light and 1e-16 of its derivatives.
  const bool is_thin = along < T(1e-8);
  const BasicVec3<T> middle = is_thin ? perpendicular(u) : (T(1.0) / along) * q;
  // Where both directions are one to half of the digits any plane does: the border is where the
  // integrand is 0.
  const BasicVec3<T> aside = d - dot(d, middle) * middle;
  const BasicVec3<T> east =
      across < T(1e-8) ? perpendicular(middle) : (T(1.0) / T(sqrt(dot(aside, aside)))) * aside;
  const BasicVec3<T> north = cross(middle, east);
  const T half = atan2(along, across);  // half of the width, pi/2 - alpha/2
  const LatitudeRule<points>& rule = latitude_rule<points>();
  for (std::size_t i = 0; i < rule.count; ++i) {
    const T longitude = half * T(rule.x[i]);
    const BasicVec3<T> level = T(cos(longitude)) * middle + T(sin(longitude)) * east;
    const T wide = half * T(rule.w[i]);
    for (std::size_t j = 0; j < rule.count; ++j)
      f(T(rule.cosine[j]) * level + T(rule.sine[j]) * north, T(wide * T(rule.weight[j])));
  }
}

}  // namespace detail
}  // namespace light
}  // namespace v0
}  // namespace polhode
