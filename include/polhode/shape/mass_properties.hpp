// SPDX-License-Identifier: MIT
// Mass properties of a closed facet shape filled with constant density: volume, mass, centre,
// inertia tensor, and the moments of degree 3 and 4.
//
// Equations   a sum over facets (a, b, c) of tetrahedra with a common corner 0 inside: for f
//             homogeneous of degree d, the integral over one of them is 6 V / (3 + d) times the
//             mean of f over the triangle / 2, V = a . (b x c) / 6 with its sign. The mean is that
//             of six points, exact to degree 4 (Dunavant 1985, Int. J. Numer. Meth. Eng. 21, 1129).
// Units       density in mass per length^3; inertia in mass length^2; moments in mass length^3 and
//             length^4.
// Domain      a closed mesh of positive volume, facets outward (FacetShape); density > 0.
// Accuracy    budget shape_mass: exact for polyhedra but for roundings, which do not grow with the
//             distance of the shape from the origin beyond those of its coordinates.
// Errors      DomainError naming an edge of a mesh that is not closed, a volume that is not
//             positive (facets inward), a density that is not.
// Cost        some 500 flops per facet.
#pragma once

#include "polhode/rotor/body.hpp"
#include "polhode/shape/facet_shape.hpp"
#include "polhode/shape/mass_moments.hpp"

namespace polhode {
inline namespace v0 {

struct MassProperties {
  double volume;
  double mass;
  Vec3 centre;          // of mass, in the axes of the mesh
  Mat3 inertia;         // tensor about the centre, axes of the mesh; (1, 2) is -int x y dm
  MassMoments moments;  // about the centre, in the axes of the mesh

  bool operator==(const MassProperties&) const = default;
};

MassProperties mass_properties(const FacetShape& shape, double density);

// Its principal moments, with the rotation to the axes of the mesh.
Body body(const MassProperties& properties);
// The moments of degree 3 and 4 along the principal axes of `body`, as terms take them.
MassMoments principal_moments(const MassProperties& properties, const Body& body);

}  // namespace v0
}  // namespace polhode
