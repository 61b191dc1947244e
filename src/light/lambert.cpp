// SPDX-License-Identifier: MIT
#include "polhode/light/lambert.hpp"

#include <cmath>

#include "light/direction.hpp"
#include "math/gauss_legendre.hpp"

namespace polhode {
inline namespace v0 {
namespace {

template <int points>
detail::LatitudeRule<points> made_rule() {
  constexpr auto count = static_cast<std::size_t>(points);
  const GaussRule<double, count> gauss = gauss_legendre<double, count>();
  detail::LatitudeRule<points> rule{};
  rule.x = gauss.x;
  rule.w = gauss.w;
  const double quarter = 0.5 * pi<double>();
  for (std::size_t i = 0; i < count; ++i) {
    rule.sine[i] = std::sin(quarter * gauss.x[i]);
    rule.cosine[i] = std::cos(quarter * gauss.x[i]);
    rule.weight[i] = quarter * gauss.w[i] * rule.cosine[i];
  }
  return rule;
}

// Of both laws, weighed.
EllipsoidGradient weighed(const EllipsoidGradient& first, double k, const EllipsoidGradient& second,
                          double l) {
  EllipsoidGradient out;
  out.value = k * first.value + l * second.value;
  out.by_sun = k * first.by_sun + l * second.by_sun;
  out.by_observer = k * first.by_observer + l * second.by_observer;
  out.by_single = first.value;
  out.by_multiple = second.value;
  out.by_axes = k * first.by_axes + l * second.by_axes;
  return out;
}

}  // namespace

namespace detail {

template <int points>
const LatitudeRule<points>& latitude_rule() {
  static const LatitudeRule<points> rule = made_rule<points>();
  return rule;
}

}  // namespace detail

template <int points>
EllipsoidGradient lambert_gradient(const Ellipsoid& body, const Vec3& to_sun,
                                   const Vec3& to_observer) {
  const Vec3 axes{body.a, body.b, body.c};
  const Vec3 inverse{1.0 / body.a, 1.0 / body.b, 1.0 / body.c};
  const Vec3 root{std::sqrt(inverse.x), std::sqrt(inverse.y), std::sqrt(inverse.z)};
  const Direction sun(to_sun), observer(to_observer);
  const Vec3 s = product(root, sun.unit), o = product(root, observer.unit);
  double sum = 0.0;
  Vec3 by_s, by_o;   // of the integral, by s' and o'
  Vec3 power, area;  // integrals of integrand v^2 / (v.R^2 v) and v^2 / (v.R^-2 v)
  detail::for_lune_points<points>(s, o, [&](const Vec3& v, double weight) {
    const Vec3 squares = product(v, v);
    const double U = 1.0 / dot(axes, squares), W = 1.0 / dot(inverse, squares);
    const double g = weight * U * U * std::sqrt(W);
    const double lit = dot(v, s), seen = dot(v, o), f = g * lit * seen;
    sum += f;
    by_s = by_s + (g * seen) * v;
    by_o = by_o + (g * lit) * v;
    power = power + (f * U) * squares;
    area = area + (f * W) * squares;
  });
  const double volume = 1.0 / (root.x * root.y * root.z);
  const double K = volume * volume * volume;
  EllipsoidGradient out;
  out.value = out.by_multiple = K * sum;
  out.by_sun = sun.by_vector(K * product(root, by_s));
  out.by_observer = observer.by_vector(K * product(root, by_o));
  // of the factor, of s' and o', of both denominators
  const Vec3 sums{1.5 * sum, 1.5 * sum, 1.5 * sum};
  const Vec3 turned = 0.5 * (product(s, by_s) + product(o, by_o));
  const Vec3 denominators = 0.5 * product(product(inverse, inverse), area) - 2.0 * power;
  out.by_axes = K * (product(inverse, sums - turned) + denominators);
  return out;
}

template <int points>
EllipsoidGradient brightness_gradient(const Ellipsoid& body, const Scattering& law,
                                      const Vec3& to_sun, const Vec3& to_observer) {
  const EllipsoidGradient first = lommel_seeliger_gradient(body, to_sun, to_observer);
  if (law.multiple == 0.0) return weighed(first, law.single, {}, 0.0);
  return weighed(first, law.single, lambert_gradient<points>(body, to_sun, to_observer),
                 law.multiple);
}

#define POLHODE_POINTS(points)                                                                     \
  template const detail::LatitudeRule<points>& detail::latitude_rule<points>();                    \
  template EllipsoidGradient lambert_gradient<points>(const Ellipsoid&, const Vec3&, const Vec3&); \
  template EllipsoidGradient brightness_gradient<points>(const Ellipsoid&, const Scattering&,      \
                                                         const Vec3&, const Vec3&);
POLHODE_POINTS(8)
POLHODE_POINTS(16)
POLHODE_POINTS(32)
POLHODE_POINTS(64)
#undef POLHODE_POINTS

}  // namespace v0
}  // namespace polhode
