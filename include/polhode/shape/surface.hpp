// SPDX-License-Identifier: MIT
// Surface: flat facets with what light and gas need to know of them, from a facet shape or from
// plates.
//
// Units       centres in any unit of length, areas in its square; fractions are pure numbers.
// Domain      centres are counted from the centre of mass, along the axes in which the surface is
//             used: `along` gets there from others. A facet has one side, that of its normal; a
//             plate with two is two facets. Fractions lie from 0 to 1, specular + diffuse <= 1;
//             what is neither is absorbed.
// Accuracy    normals are made of length 1.
// Errors      DomainError naming the facet, counted from 1, and the number it has wrong.
// Cost        one pass. Copies copy the facets.
#pragma once

#include <span>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {

struct Finish {
  double specular = 0.0;  // fraction of the light that is mirrored
  double diffuse = 0.0;   // scattered by Lambert's law
  double emitted = 0.0;   // of what is absorbed: given back at once as heat, by Lambert's law
  double normal_accommodation = 1.0;      // of molecules: 1 leaves with the wall's temperature
  double tangential_accommodation = 1.0;  // 0: mirrored along the wall

  constexpr bool operator==(const Finish&) const = default;
};

struct SurfaceFacet {
  Vec3 centre;
  Vec3 normal;
  double area;
  Finish finish;

  constexpr bool operator==(const SurfaceFacet&) const = default;
};

class Surface {
 public:
  explicit Surface(std::vector<SurfaceFacet> facets);
  // Every facet of a mesh, `centre` its centre of mass.
  static Surface of_shape(const shape::FacetShape& shape, const Vec3& centre, const Finish& finish);
  static Surface of_plate(const Vec3& centre, const Vec3& normal, double area, const Finish& finish,
                          bool both_sides = false);

  std::span<const SurfaceFacet> facets() const { return facets_; }
  // Of the same facets along axes B, q_FB the rotation from them to those of this surface.
  Surface along(const Quaternion& q_FB) const;

  bool operator==(const Surface&) const = default;

 private:
  std::vector<SurfaceFacet> facets_;
};

// The facets of several, in their order.
Surface joined(std::span<const Surface> parts);

}  // namespace v0
}  // namespace polhode
