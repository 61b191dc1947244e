// SPDX-License-Identifier: MIT
// LightModel: a tumbling body that scatters light. Its shape is an ellipsoid, a convex body by the
// areas of its facets, or a given mesh.
//
// Units       of spin those of light curves; lengths in any unit, since a light curve knows no
//             size; moments in any unit.
// Domain      axes F are those of the shape. Moments along them are arbitrary; MomentSource
//             (light_fit.hpp) chooses those of a fit. A convex body with the light of a body that
//             has hollows is only a model of it.
// Errors      DomainError as GaussianImage, ShadedMesh and convex_body.
// Cost        a mesh and the basis of a convex body are shared by copies.
#pragma once

#include <variant>
#include <vector>

#include "polhode/fit/spin_fit.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/gaussian_image.hpp"
#include "polhode/light/scattering.hpp"
#include "polhode/light/shaded_mesh.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {

struct ConvexShape {
  GaussianImage image;
  std::vector<double> coefficients;  // of `image`

  // The facets of an ellipsoid, in units of its b.
  static ConvexShape of(const Ellipsoid& ellipsoid, int degree = 6, int rows = 8);

  std::vector<double> areas() const { return image.areas(coefficients); }
  // The body itself, its centre of mass in the origin, along axes F.
  FacetShape mesh() const;
};

using LightShape = std::variant<Ellipsoid, ConvexShape, ShadedMesh>;

struct LightModel {
  SpinState spin;
  LightShape shape = Ellipsoid{1.0, 1.0, 1.0};
  Scattering law;

  // An ellipsoid with the moments of an even filling.
  static LightModel homogeneous(double t0, const Quaternion& q, const Vec3& w_F,
                                const Ellipsoid& shape, const Scattering& law = {});

  bool is_ellipsoid() const { return std::holds_alternative<Ellipsoid>(shape); }
  bool is_convex() const { return std::holds_alternative<ConvexShape>(shape); }
  bool is_mesh() const { return std::holds_alternative<ShadedMesh>(shape); }
  // std::bad_variant_access for other shapes.
  const Ellipsoid& ellipsoid() const { return std::get<Ellipsoid>(shape); }
  const ConvexShape& convex() const { return std::get<ConvexShape>(shape); }
  const ShadedMesh& mesh() const { return std::get<ShadedMesh>(shape); }
};

// The inertia at constant density about the centre of mass, along the axes of the mesh, in units of
// its Izz.
Mat3 homogeneous_inertia(const FacetShape& shape);

// The ellipsoid of constant density with the principal moments of a tensor, 1 = a >= b >= c.
// DomainError if no body has them.
Ellipsoid ellipsoid_of_moments(const Mat3& inertia);

// The inertia of a convex body of constant density.
struct ShapeInertia {
  double Ixx, Iyy;  // over Izz, about the axes F
  double axes_off;  // rad: the greatest angle between its principal axes and those of F
};
ShapeInertia shape_inertia(const ConvexShape& shape);

}  // namespace v0
}  // namespace polhode
