// SPDX-License-Identifier: MIT
// The brightness of a convex body by its facets: none shades another.
//
// Equations   sum over facets of A_j S(n_j . o, n_j . s), S the law of Scattering, s and o the
//             directions to the Sun and the observer.
// Units       that of the areas.
// Domain      normals of length 1, as many as areas; s and o of any length but 0. Facets that pass
//             a terminator bend the sum; it has no jump there.
// Accuracy    roundings of a sum of positive numbers.
// Errors      none of values; DomainError where numbers of normals and areas differ.
// Cost        some ns a facet (benchmarks/brightness.cpp).
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "polhode/light/brightness_gradient.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/scattering.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

void require_areas(std::span<const Vec3> normals, std::size_t areas);

template <Real T>
T facet_brightness(std::span<const Vec3> normals, std::span<const T> areas,
                   const BasicScattering<T>& law, const BasicVec3<T>& to_sun,
                   const BasicVec3<T>& to_observer) {
  using std::sqrt;
  require_areas(normals, areas.size());
  const BasicVec3<T> s = (T(1.0) / T(sqrt(dot(to_sun, to_sun)))) * to_sun;
  const BasicVec3<T> o = (T(1.0) / T(sqrt(dot(to_observer, to_observer)))) * to_observer;
  T sum(0.0);
  for (std::size_t j = 0; j < normals.size(); ++j) {
    const BasicVec3<T> n{T(normals[j].x), T(normals[j].y), T(normals[j].z)};
    sum += areas[j] * law.at(dot(n, o), dot(n, s));
  }
  return sum;
}

// By each area: S of the facet.
struct FacetGradient : BrightnessGradient {
  std::vector<double> by_areas;
};

FacetGradient facet_gradient(std::span<const Vec3> normals, std::span<const double> areas,
                             const Scattering& law, const Vec3& to_sun, const Vec3& to_observer);

}  // namespace v0
}  // namespace polhode
