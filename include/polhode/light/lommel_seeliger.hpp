// SPDX-License-Identifier: MIT
// The brightness of an ellipsoid that scatters by the law of Lommel and Seeliger, in closed form,
// with its gradient.
//
// Equations   the integral of mu mu0 / (mu + mu0) dA over what is lit and seen. With S = (s_x/a,
//             s_y/b, s_z/c) of the direction s to the Sun, O of the one to the observer, it is
//             (pi/2) a b c (|S||O| + S.O) / (|S| + |O|) F(w), w = |S + O| / (|S| + |O|) in [0, 1],
//             F = (1 - (1 - w^2) atanh(w) / w) / w^2 = sum over k >= 1 of 2 w^(2k-2) / (4k^2 - 1):
//             that of Muinonen & Lumme (2015, A&A 584, A23), whose half-angles and logarithms of
//             cotangents this has no need of; docs/design/0045-brightness.md derives it.
// Units       semi-axes in any unit of length, brightness in its square.
// Domain      semi-axes > 0; directions as vectors of any length but 0, squares in the range of T.
//             Sun and observer on one line: behind each other (w = 1) half the area seen, opposite
//             0; both with their derivatives. Second derivatives grow like the logarithm of the
//             phase angle as it goes to 0.
// Accuracy    budget light_ellipsoid, relative; times 1 / (pi - alpha) close to opposition to the
//             Sun. light_ellipsoid_gradient: of template and gradient, relative to the area.
// Errors      none; NaN in, NaN out.
// Cost        benchmarks/brightness.cpp: some tens of ns, the gradient twice that.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "polhode/light/detail/lune_function.hpp"
#include "polhode/light/detail/lune_points.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/scattering.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

template <Real T>
T lommel_seeliger_brightness(const BasicEllipsoid<T>& body, const BasicVec3<T>& to_sun,
                             const BasicVec3<T>& to_observer) {
  using std::sqrt;
  const auto scaled = [&body](const BasicVec3<T>& v) {
    const T k = T(1.0) / sqrt(dot(v, v));
    return BasicVec3<T>{k * v.x / body.a, k * v.y / body.b, k * v.z / body.c};
  };
  const BasicVec3<T> S = scaled(to_sun), O = scaled(to_observer), V = S + O;
  const T s = sqrt(dot(S, S)), o = sqrt(dot(O, O));
  const BasicVec3<T> u = (T(1.0) / s) * S, v = (T(1.0) / o) * O;
  const BasicVec3<T> q = u + v, d = u - v;
  // |S||O| + S.O and 1 - w^2 by these: as they are written above they cancel
  const T so = s * o, sum = s + o;
  const T p = T(0.5) * so * dot(q, q);
  const T e = so * dot(d, d) / (sum * sum);
  const T F = detail::lune_function<T>(dot(V, V) / (sum * sum), e);
  return T(0.5) * pi<T>() * body.a * body.b * body.c * (p / sum * F);
}

// The same with its derivatives.
EllipsoidGradient lommel_seeliger_gradient(const Ellipsoid& body, const Vec3& to_sun,
                                           const Vec3& to_observer);

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

}  // namespace light
}  // namespace v0
}  // namespace polhode
