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

#include <memory>
#include <span>
#include <vector>

#include "polhode/light/facet_brightness.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

shape::FacetShape convex_body(std::span<const Vec3> normals, std::span<const double> areas);

struct ConvexMoments {
  double Ixx, Iyy;  // over Izz, of an even filling about its centre of mass, along the axes
  std::vector<double> Ixx_by_areas, Iyy_by_areas;
  std::vector<double> distances;  // of the facets, of a body whose mean area is 1
};
// From `start`, distances of a body that is much like it, where they are given.
ConvexMoments convex_moments(std::span<const Vec3> normals, std::span<const double> areas,
                             std::span<const double> start = {});

// GaussianImage: a convex body by the areas of its facets on fixed normals, positive whatever their
// coefficients are.
//
// Equations   A_j = w_j exp(sum over l <= degree, m of c_lm Y_lm(n_j)) (Kaasalainen & Torppa 2001,
//             Icarus 153, 24), w_j the solid angle of normal n_j, so that coefficients do not
//             depend on the number of normals. By Minkowski's theorem such areas are those of one
//             convex body if sum of A_j n_j = 0: `closure`, with its derivatives, is to be fitted
//             to 0. Y_lm: real, of mean square 1 over the sphere, sin(|m| phi) for m < 0; c_lm at
//             place l^2 + l + m.
// Units       areas in any unit of length squared; a sphere of radius r has c_00 = 2 ln r alone.
// Domain      normals: those of an octahedron whose faces are divided into rows^2 triangles each,
//             as projected onto the sphere: 8 rows^2. degree 0 .. 40, rows 1 .. 200, as many
//             normals as coefficients or more, and at most 2^24 values of Y_lm in all: degree 40
//             with rows 35, rows 200 with degree 6. The fewest rows are not always enough for
//             coefficients from areas: symmetry leaves some undetermined at degrees 4, 6, 7 and 10,
//             say; one more row is.
// Accuracy    budget light_harmonics: of Y_lm.
// Errors      DomainError naming a degree, rows or a number of coefficients or areas that does not
//             fit; `coefficients` where the normals do not determine them.
// Cost        areas: an exponential and (degree + 1)^2 flops a normal. Copies share the basis, of
//             64 rows^2 (degree + 1)^2 bytes, 128 MiB at most. coefficients: as many bytes again,
//             and 16 rows^2 (degree + 1)^4 flops.

class GaussianImage {
 public:
  GaussianImage(int degree, int rows);

  int degree() const { return basis_->degree; }
  int rows() const { return basis_->rows; }
  std::size_t coefficient_count() const { return basis_->count; }
  std::span<const Vec3> normals() const { return basis_->normals; }
  std::span<const double> solid_angles() const { return basis_->solid_angles; }
  // 1.5 sqrt(solid angle), half of a patch for patch_brightness: 1.5 times how far the next normals
  // are.
  std::span<const double> widths() const { return basis_->widths; }
  // Y of normal j, in the order of the coefficients.
  std::span<const double> harmonics(std::size_t j) const {
    return std::span<const double>(basis_->harmonics).subspan(j * basis_->count, basis_->count);
  }

  std::vector<double> areas(std::span<const double> coefficients) const;
  // The series that is nearest to the logarithms of areas / solid angles, all > 0, by least squares
  // over the sphere: a start from a body that is known.
  std::vector<double> coefficients(std::span<const double> areas) const;
  // Areas / solid angles of an ellipsoid: (abc)^2 / (a^2 n_x^2 + b^2 n_y^2 + c^2 n_z^2)^2.
  std::vector<double> coefficients(const Ellipsoid& body) const;

  // sum of A_j n_j, in units of area.
  Vec3 closure(std::span<const double> areas) const;
  // Its derivative by each coefficient.
  std::vector<Vec3> closure_gradient(std::span<const double> areas) const;
  // l (l + 1) for each coefficient: times the coefficient, a residual whose sum of squares is the
  // mean square of the Laplacian of ln(A / w), 0 for a sphere.
  std::vector<double> roughness() const;

  // Derivatives of a sum over facets by the coefficients, from those by the areas.
  std::vector<double> by_coefficients(std::span<const double> by_areas,
                                      std::span<const double> areas) const;

 private:
  struct Basis {
    int degree = 0;
    int rows = 0;
    std::size_t count = 0;
    std::vector<Vec3> normals;
    std::vector<double> solid_angles;
    std::vector<double> widths;
    std::vector<double> harmonics;
  };
  std::shared_ptr<const Basis> basis_;
};

}  // namespace light
}  // namespace v0
}  // namespace polhode
