// SPDX-License-Identifier: MIT
// convex_body(): the convex body whose facets have given normals and areas, as a mesh.
//
// Equations   Minkowski's theorem: areas A_j > 0 on normals n_j that do not lie in a half space,
//             with sum A_j n_j = 0, are those of one convex polyhedron. Its distances h_j of facets
//             from an inner point are the least of sum A_j h_j at a given volume (Little 1983;
//             Lamberg & Kaasalainen 2001); there the areas a_j = dV/dh_j are proportional to A_j.
//             Newton's method for a(h) = A, da_j/dh_k the edge lengths over sines of angles.
// Corrections none.
// Units       areas in any unit of length squared, vertices in that of length.
// Domain      areas need not close exactly: what sum A_j n_j is off 0 is taken from the areas, each
//             by its part along the sum, before the body is looked for.
// Accuracy    budget convex_areas: areas of the mesh, of the total. The origin is the centre of
//             mass of an even filling.
// Errors      DomainError for numbers of areas and normals that differ, areas that are not
//             positive, closure that takes more than an area has, normals that leave a side open,
//             and where the method does not end.
// Cost        some ten to thirty times the pairs of facets: half a second for 512 facets.
#pragma once

#include <span>

#include "polhode/math/vector.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {

FacetShape convex_body(std::span<const Vec3> normals, std::span<const double> areas);

}  // namespace v0
}  // namespace polhode
