// SPDX-License-Identifier: MIT
// The brightness of an ellipsoid that scatters by Lambert's law, by Gauss' quadrature over what is
// lit and seen, with its gradient; and that of one that scatters by both laws.
//
// Equations   the integral of mu mu0 dA. With R = diag(a, b, c)^(1/2), points of the unit sphere v
//             = R n / |R n| of the normals n, s' = R^-1 s and o' = R^-1 o of the directions to the
//             Sun and the observer, it is (abc)^(3/2) times the integral of (v.s') (v.o') / ((v.R^2
//             v)^2 (v.R^-2 v)^(1/2)) over the lune v.s' > 0, v.o' > 0: between normals and points
//             of the body stretched to a sphere, so that the integrand is as even as it gets.
//             Derivatives are those of the integrand at points that stay, as it is 0 on the border.
// Units       semi-axes in any unit of length, brightness in its square.
// Domain      as lommel_seeliger.hpp. `points` is 8, 16, 32 or 64: along each of two directions.
//             Dual numbers give first derivatives, not second: the border moves.
// Accuracy    budgets light_lambert_16 for axes within 2 : 1 and light_lambert_32 within 4 : 1,
//             relative to (abc)^(2/3); light_lambert_sphere: a sphere, with 16.
// Errors      none; NaN in, NaN out.
// Cost        points^2 evaluations of some ns (benchmarks/brightness.cpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "polhode/light/detail/lune_points.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/light/scattering.hpp"

namespace polhode {
inline namespace v0 {

template <int points = 16, Real T>
T lambert_brightness(const BasicEllipsoid<T>& body, const BasicVec3<T>& to_sun,
                     const BasicVec3<T>& to_observer) {
  using std::sqrt;
  const BasicVec3<T> root{sqrt(body.a), sqrt(body.b), sqrt(body.c)};
  const auto scaled = [&root](const BasicVec3<T>& v) {
    const T k = T(1.0) / sqrt(dot(v, v));
    return BasicVec3<T>{k * v.x / root.x, k * v.y / root.y, k * v.z / root.z};
  };
  const BasicVec3<T> s = scaled(to_sun), o = scaled(to_observer);
  const BasicVec3<T> inverse{T(1.0) / body.a, T(1.0) / body.b, T(1.0) / body.c};
  T sum(0.0);
  detail::for_lune_points<points>(
      detail::plain_vector(s), detail::plain_vector(o), [&](const auto& v, const auto& weight) {
        const BasicVec3<T> at{T(v.x), T(v.y), T(v.z)};
        const T x = at.x * at.x, y = at.y * at.y, z = at.z * at.z;
        const T power = body.a * x + body.b * y + body.c * z;
        const T area = inverse.x * x + inverse.y * y + inverse.z * z;
        sum += T(weight) * (dot(at, s) * dot(at, o)) / (power * power * sqrt(area));
      });
  const T volume = root.x * root.y * root.z;
  return volume * volume * volume * sum;
}

// The same with its derivatives, at the same points.
template <int points = 16>
EllipsoidGradient lambert_gradient(const Ellipsoid& body, const Vec3& to_sun,
                                   const Vec3& to_observer);

// By both laws; the second costs nothing where its weight is a constant 0.
template <int points = 16, Real T>
T brightness(const BasicEllipsoid<T>& body, const BasicScattering<T>& law,
             const BasicVec3<T>& to_sun, const BasicVec3<T>& to_observer) {
  const T first = law.single * lommel_seeliger_brightness(body, to_sun, to_observer);
  if (detail::is_constant_zero(law.multiple)) return first;
  return first + law.multiple * lambert_brightness<points>(body, to_sun, to_observer);
}

// by_multiple is 0 where the weight of Lambert's law is: nothing is computed for it.
template <int points = 16>
EllipsoidGradient brightness_gradient(const Ellipsoid& body, const Scattering& law,
                                      const Vec3& to_sun, const Vec3& to_observer);

}  // namespace v0
}  // namespace polhode
