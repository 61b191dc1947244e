// SPDX-License-Identifier: MIT
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
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "polhode/light/scattering.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {

class ShadedMesh {
 public:
  explicit ShadedMesh(FacetShape shape);

  const FacetShape& shape() const { return shape_; }
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
  FacetShape shape_;
  std::shared_ptr<const Sky> sky_;
};

// Closed, and no vertex above the plane of a facet by more than the rounding of coordinates.
bool is_convex(const FacetShape& shape);

}  // namespace v0
}  // namespace polhode
