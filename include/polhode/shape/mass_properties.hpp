// SPDX-License-Identifier: MIT
// In this header: mass_moments, mass_properties.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "polhode/detail/shape/moment_order.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/shape/detail/row_products.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {
namespace shape {

// MassMoments: the third- and fourth-degree inertia integrals of a body, which its inertia tensor
// does not have and its gravity of degree 3 and 4 needs.
//
// Equations   m(a, b, c) = integral of x^a y^b z^c dm over the body, (x, y, z) from its centre of
//             mass along body axes; a + b + c = 3 for `third`, 4 for `fourth`. Nothing is divided
//             by the mass, nothing is normalised, no traces are taken out.
// Units       mass length^3, mass length^4.
// Domain      the order within a degree is xxx xxy xxz xyy xyz xzz yyy yyz yzz zzz, and xxxx xxxy
//             xxxz xxyy xxyz xxzz xyyy xyyz xyzz xzzz yyyy yyyz yyzz yzzz zzzz: moment_place. The
//             axes are principal (Body's b1, b2, b3) wherever a term takes the type; `rotated` gets
//             there from others.
// Accuracy    sums and products as written.
// Cost        rotated: some 600 multiplications.

template <Real T>
struct BasicMassMoments {
  BasicMoments<T, 3> third{};
  BasicMoments<T, 4> fourth{};

  constexpr bool operator==(const BasicMassMoments&) const = default;
};
using MassMoments = BasicMassMoments<double>;

template <Real T>
struct BasicPointMass {
  T mass;
  BasicVec3<T> position;
};
using PointMass = BasicPointMass<double>;

// The moments of one degree along the axes in which x becomes R x.
template <int degree, Real T>
constexpr BasicMoments<T, degree> rotated_moments(const BasicMoments<T, degree>& m,
                                                  const BasicMat3<T>& R) {
  BasicMoments<T, degree> out{};
  for (int c = 0; c <= degree; ++c) {
    for (int b = 0; b + c <= degree; ++b) {
      const BasicMoments<T, degree> p = detail::product_of_rows<degree>(R, b, c);
      T sum(0.0);
      for (std::size_t i = 0; i < m.size(); ++i) sum += p[i] * m[i];
      out[moment_place(b, c)] = sum;
    }
  }
  return out;
}

// x' = R x: with R = rotation_matrix(conj(body.q_FB())) from the axes F to the principal ones.
template <Real T>
constexpr BasicMassMoments<T> rotated(const BasicMassMoments<T>& m, const BasicMat3<T>& R) {
  return {rotated_moments<3>(m.third, R), rotated_moments<4>(m.fourth, R)};
}

// Of point masses; positions are taken as they are, so from the centre of mass.
template <Real T>
constexpr BasicMassMoments<T> mass_moments(std::span<const BasicPointMass<T>> points) {
  BasicMassMoments<T> out;
  const auto add = [](auto& sum, const T& mass, const auto& powers, int degree) {
    for (int c = 0; c <= degree; ++c)
      for (int b = 0; b + c <= degree; ++b)
        sum[moment_place(b, c)] +=
            mass *
            (powers[0][static_cast<std::size_t>(degree - b - c)] *
             (powers[1][static_cast<std::size_t>(b)] * powers[2][static_cast<std::size_t>(c)]));
  };
  for (const BasicPointMass<T>& p : points) {
    std::array<std::array<T, 5>, 3> powers;
    for (int i = 0; i < 3; ++i) {
      auto& of = powers[static_cast<std::size_t>(i)];
      of[0] = T(1.0);
      for (std::size_t k = 1; k < 5; ++k) of[k] = of[k - 1] * p.position[i];
    }
    add(out.third, p.mass, powers, 3);
    add(out.fourth, p.mass, powers, 4);
  }
  return out;
}

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

}  // namespace shape
}  // namespace v0
}  // namespace polhode
