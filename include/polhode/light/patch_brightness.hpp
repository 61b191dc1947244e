// SPDX-License-Identifier: MIT
// The brightness of a smooth convex body by facets that each stand for a patch of directions of its
// normal: light without the bends of flat facets at the terminators.
//
// Equations   sum over facets of A_j S_h(n_j . o, n_j . s), s and o the directions to the Sun and
//             the observer; S_h is S of Scattering with smooth functions for max(mu, 0):
//             S_h = single m m0 / (M + M0) + multiple m m0, m = m(mu), m0 = m(mu0), M alike.
//             m(mu) = h (u / 2 + q(u^2)) where |u| < 1, u = mu / h, is the mean of max(mu + x, 0)
//             over a kernel of x within h:
//             512 q(z) = 35 + 420 z - 350 z^2 + 196 z^3 - 45 z^4, whose kernel has mean square 0,
//             so that a sum over facets all around gains no light at the terminators: the bias is
//             of order h^4, where a kernel that is positive has h^2. M has such a one,
//             32 q(z) = 5 + 15 z - 5 z^2 + z^3, and is never negative: it is divided by.
//             Beyond h both are max(mu, 0). Each has three derivatives that are continuous.
// Units       that of the areas; h is a cosine.
// Domain      normals of length 1, as many areas and half-widths h > 0; s and o of any length but
//             0. h about the distance of neighbouring normals (GaussianImage::widths). m is down to
//             -0.0164 h just below the horizon: the light of one facet alone may be negative.
// Accuracy    docs/design/0053-light-labels.md: up to three times nearer to a smooth ellipsoid
//             than flat facets, of as many. Roundings besides.
// Errors      none of values; DomainError where numbers of normals, areas and widths differ.
// Cost        as facet_brightness, and some ns for each facet near a terminator.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "polhode/light/facet_brightness.hpp"

namespace polhode {
inline namespace v0 {

// m and M, and their slopes by mu. In e = 1 + u and v = 1 - u both have the factor e^4, which is
// taken out: sums of powers of u leave of it, near u = -1, what roundings do, and M that is 0 or
// negative.
//     512 m / h = e^4 (32 + 32 v + 16 v^2 - 45 v^4),   32 M / h = e^4 (2 + 2 v + v^2)
template <Number T>
struct BasicSoftCosine {
  T even;      // m, of a kernel of mean square 0
  T positive;  // M: exactly 0 where mu <= -h, and positive beyond
  T even_slope, positive_slope;

  static constexpr BasicSoftCosine at(const T& mu, double h) {
    const T none(0.0), one(1.0), two(2.0);
    const T e0 = T(1.0 / h) * (mu + T(h));  // the sum is exact near -h
    const auto beyond = two < e0;
    const T e = select(e0 < none, none, select(beyond, two, e0)), v = two - e;
    const T cube = e * e * e, quartic = T(h) * (cube * e);
    const T r = T(32.0) + v * (T(32.0) + v * (T(16.0) - T(45.0) * (v * v)));
    const T p = two + v * (two + v);
    const T r_slope = T(8.0) + v * (T(12.0) + v * (T(12.0) + v * (T(45.0) - T(45.0) * v)));
    const T p_slope = two + v * (T(3.0) + T(3.0) * v);
    return {select(beyond, mu, quartic * (T(1.0 / 512.0) * r)),
            select(beyond, mu, quartic * (T(1.0 / 32.0) * p)),
            select(beyond, one, cube * (T(1.0 / 64.0) * r_slope)),
            select(beyond, one, cube * (T(1.0 / 16.0) * p_slope))};
  }
};

// S_h
template <Number T>
constexpr T patch_scattering(const BasicScattering<T>& law, const T& mu, const T& mu0, double h) {
  const auto a = BasicSoftCosine<T>::at(mu, h), b = BasicSoftCosine<T>::at(mu0, h);
  const T both = a.even * b.even;
  const T sum = a.positive + b.positive;
  // 0 / 0 is 0, as the limit is
  return law.single * (both / select(sum == T(0.0), T(1.0), sum)) + law.multiple * both;
}

void require_widths(std::span<const Vec3> normals, std::size_t widths);

template <Real T>
T patch_brightness(std::span<const Vec3> normals, std::span<const double> widths,
                   std::span<const T> areas, const BasicScattering<T>& law,
                   const BasicVec3<T>& to_sun, const BasicVec3<T>& to_observer) {
  using std::sqrt;
  require_areas(normals, areas.size());
  require_widths(normals, widths.size());
  const BasicVec3<T> s = (T(1.0) / T(sqrt(dot(to_sun, to_sun)))) * to_sun;
  const BasicVec3<T> o = (T(1.0) / T(sqrt(dot(to_observer, to_observer)))) * to_observer;
  T sum(0.0);
  for (std::size_t j = 0; j < normals.size(); ++j) {
    const BasicVec3<T> n{T(normals[j].x), T(normals[j].y), T(normals[j].z)};
    const T mu = dot(n, o), mu0 = dot(n, s);
    if (mu <= T(-widths[j]) || mu0 <= T(-widths[j])) continue;  // NaN goes on
    sum += areas[j] * patch_scattering(law, mu, mu0, widths[j]);
  }
  return sum;
}

FacetGradient patch_gradient(std::span<const Vec3> normals, std::span<const double> widths,
                             std::span<const double> areas, const Scattering& law,
                             const Vec3& to_sun, const Vec3& to_observer);

}  // namespace v0
}  // namespace polhode
