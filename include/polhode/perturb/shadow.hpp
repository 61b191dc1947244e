// SPDX-License-Identifier: MIT
// Shadow: how much of the Sun a spherical body leaves visible.
//
// Equations   cylinder: dark where the centre of the body lies towards the Sun, nearer than its
//             radius to the ray; the axis of the cylinder is the direction from the lit body to the
//             Sun, not that from the shading one: in a low orbit they differ by 5e-5 rad. cone:
//             the fraction of the Sun's disc that the body's disc leaves, discs of angular radii
//             asin(R/d) as circles in a plane (Montenbruck & Gill 2000, section 3.4.2): total,
//             annular, partial. Borders: away^2 - max(ahead, 0)^2 = radius^2 for the cylinder; for
//             the cone the distance of the centres of the discs is the sum of their radii, or the
//             difference.
// Units       any unit of length.
// Domain      a place inside the body is dark; NaN is not. The border of the cylinder is a jump of
//             the light, those of the cone are kinks: `borders` is zero there, and Adaptive and
//             Collocation end their steps at both (docs/guide/torques/sunlight-and-air.md); a
//             splitting with fixed steps has there the error of order 1 and 2. With `sides`, those
//             of the borders are taken and not found.
// Accuracy    the formula to a few roundings. The plane of the discs costs budget shadow_plane of
//             the full light at most within the penumbra of a low orbit, less further out.
// Errors      DomainError for radii that are not positive.
// Cost        cylinder some 30 flops; cone two arcsines and at most three arctangents.
#pragma once

#include <span>
#include <vector>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

enum class ShadowShape { cylinder, cone };

class Shadow {
 public:
  static Shadow cylinder(double radius);
  static Shadow cone(double radius, double sun_radius);

  ShadowShape shape() const { return shape_; }
  double radius() const { return radius_; }
  double sun_radius() const { return sun_radius_; }  // 0: cylinder

  // One for the cylinder, below zero in the dark; for the cone two: of any shade, and of that where
  // one disc is within the other. Differences of squares: smooth where the centres meet.
  std::vector<double> borders(const Vec3& to_sun, const Vec3& to_body) const;

  // From 0, dark, to 1. Both vectors from the place of the observer.
  template <Real T>
  T visible(const BasicVec3<T>& to_sun, const BasicVec3<T>& to_body,
            std::span<const double> sides = {}) const {
    using std::asin;
    using std::atan2;
    const T sun = norm(to_sun), away = norm(to_body), radius(radius_);
    if (away < radius || away == radius) return T(0.0);
    const BasicVec3<T> s = (T(1.0) / sun) * to_sun;
    const T across = norm(cross(s, to_body)), ahead = dot(s, to_body);
    const bool has_sides = !sides.empty();
    if (shape_ == ShadowShape::cylinder) {
      const bool dark = has_sides ? sides[0] < 0.0 : T(0.0) < ahead && across < radius;
      return dark ? T(0.0) : T(1.0);
    }
    if (!(T(sun_radius_) < sun)) return T(1.0);
    const T a = asin(T(sun_radius_) / sun), b = asin(radius / away), c = atan2(across, ahead);
    if (has_sides ? sides[0] > 0.0 : !(c < a + b)) return T(1.0);
    const T apart = b < a ? a - b : b - a;
    if (has_sides ? !(sides[1] < 0.0) : apart < c) return uncovered(a, b, c);
    return b < a ? T(1.0) - (b / a) * (b / a) : T(0.0);
  }

  bool operator==(const Shadow&) const = default;

 private:
  Shadow(ShadowShape shape, double radius, double sun_radius)
      : shape_(shape), radius_(radius), sun_radius_(sun_radius) {}

  // The fraction of a disc of radius a that one of radius b leaves, their centres at a distance c:
  // partly, or a little beyond that.
  template <Real T>
  static T uncovered(const T& a, const T& b, const T& c) {
    using std::atan2;
    using std::sqrt;
    const T zero(0.0), one(1.0), two(2.0);
    const T difference = (a - b) * (a + b), square = c * c;
    const T x_a = (square + difference) / (two * c), x_b = (square - difference) / (two * c);
    // half the common chord: Heron's triangle, not sqrt(a^2 - x_a^2): cancels
    const T square_of_y = (a + b + c) * (b + c - a) * (a + c - b) * (a + b - c);
    const T y = square_of_y < zero ? zero : sqrt(square_of_y) / (two * c);
    const T at_a = atan2(y, x_a), at_b = atan2(y, x_b);
    const T covered = (a * a * at_a - x_a * y) + (b * b * at_b - x_b * y);
    const T left = one - covered / (pi<T>() * a * a);
    return left < zero ? zero : left;
  }

  ShadowShape shape_;
  double radius_;
  double sun_radius_;
};

}  // namespace v0
}  // namespace polhode
