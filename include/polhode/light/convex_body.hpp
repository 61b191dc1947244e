// SPDX-License-Identifier: MIT
// convex_body(): the convex body whose facets have given normals and areas, as a mesh; and
// convex_moments(), ratios of its moments of inertia with their derivatives by the areas.
//
// Equations   Minkowski's theorem: areas A_j > 0 on normals n_j that do not lie in a half space,
//             with sum A_j n_j = 0, are those of one convex polyhedron. Its distances h_j of facets
//             from an inner point are the least of sum A_j h_j at a given volume (Little 1983;
//             Lamberg & Kaasalainen 2001); there the areas a_j = dV/dh_j are proportional to A_j.
//             Newton's method for a(h) = A, da_j/dh_k the edge lengths over sines of angles. An
//             integral over the body changes by that over facet j times dh_j; so do moments, and
//             their derivatives by A are those by h times the inverse of da/dh.
// Units       areas in any unit of length squared, vertices in that of length.
// Domain      areas need not close exactly: what sum A_j n_j is off 0 is taken from the areas, each
//             by its part along the sum, before the body is looked for.
// Accuracy    budget convex_areas: areas of the mesh, of the total; convex_moments_by_areas:
//             derivatives, of the largest, closed or not. The origin is the centre of mass of an
//             even filling.
// Errors      DomainError for numbers of areas and normals that differ, areas that are not
//             positive, closure that takes more than an area has, normals that leave a side open,
//             and where the method does not end.
// Cost        some ten to thirty times the pairs of facets: half a second for 512 facets; moments
//             from a start that is near, a fifth of it.
#pragma once

#include <span>
#include <vector>

#include "polhode/math/vector.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {

FacetShape convex_body(std::span<const Vec3> normals, std::span<const double> areas);

struct ConvexMoments {
  double Ixx, Iyy;  // over Izz, of an even filling about its centre of mass, along the axes
  std::vector<double> Ixx_by_areas, Iyy_by_areas;
  std::vector<double> distances;  // of the facets, of a body whose mean area is 1
};
// From `start`, distances of a body that is much like it, where they are given.
ConvexMoments convex_moments(std::span<const Vec3> normals, std::span<const double> areas,
                             std::span<const double> start = {});

}  // namespace v0
}  // namespace polhode
