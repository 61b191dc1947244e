// SPDX-License-Identifier: MIT
// In this header: brightness_gradient, facet_brightness, shaded_mesh, patch_brightness.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/scattering.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

// A brightness with its first derivatives.
//
// Units       brightness in units of area; by an axis, in units of length.
// Domain      to_sun and to_observer along the axes of the body, of any length: derivatives are by
//             their components as given, so at right angles to them. A small rotation d of the
//             body, along its own axes, turns v into v + v x d: its derivative is by_sun x to_sun
//             + by_observer x to_observer. By the weights of Scattering: single, multiple.
// Accuracy    plain values.

struct BrightnessGradient {
  double value = 0.0;
  Vec3 by_sun = {};
  Vec3 by_observer = {};
  double by_single = 0.0;
  double by_multiple = 0.0;
};

// Of an ellipsoid, by its semi-axes a, b, c too.
struct EllipsoidGradient : BrightnessGradient {
  Vec3 by_axes = {};
};

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

// ShadedMesh: the brightness of a mesh whose facets may shade and hide each other.
//
// Equations   sum over facets of A S(mu, mu0), S the law of Scattering, without the facets whose
//             centre does not see the Sun or is not seen by the observer: where a ray from it
//             meets another facet (Moller & Trumbore 1997).
// Units       those of the mesh.
// Domain      any mesh; a hole shows the inside of what is behind it, which sends no light and lets
//             none through. to_sun and to_observer along the axes of the mesh, far away, of any
//             length but 0. Light is scattered once: no facet lights another.
// Accuracy    a facet is in shadow or not: errors of the size of the facets that the border of a
//             shadow meets, with jumps when it passes a centre. No derivatives.
// Errors      none beyond those of FacetShape; NaN in, NaN out.
// Cost        the constructor looks at each pair of facets (benchmarks/brightness.cpp); copies
//             share what it found. A value: as facet_brightness, and some ns for each facet above
//             the horizon of one that is lit and seen; nothing where the direction is above all of
//             its horizon.

class ShadedMesh {
 public:
  explicit ShadedMesh(shape::FacetShape shape);

  const shape::FacetShape& shape() const { return shape_; }
  // No facet can shade another: convex, or as good as that.
  bool is_shadowless() const { return sky_->above.empty(); }
  // Facets that stand above the horizon of facet i, the largest in its sky first.
  std::size_t obstacles(std::size_t i) const { return sky_->first[i + 1] - sky_->first[i]; }

  // Whether a ray from the centre of facet i leaves the body, for a direction of length 1 above
  // its plane.
  bool is_free(std::size_t i, const Vec3& direction) const;
  double brightness(const Scattering& law, const Vec3& to_sun, const Vec3& to_observer) const;

 private:
  struct Sky {
    std::vector<std::size_t> first;    // of facet i: above[first[i]] .. above[first[i + 1]]
    std::vector<std::uint32_t> above;  // facets
    std::vector<double> horizon;       // sine of the highest elevation that one of them reaches
  };
  shape::FacetShape shape_;
  std::shared_ptr<const Sky> sky_;
};

// Closed, and no vertex above the plane of a facet by more than the rounding of coordinates.
bool is_convex(const shape::FacetShape& shape);

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

}  // namespace light
}  // namespace v0
}  // namespace polhode
