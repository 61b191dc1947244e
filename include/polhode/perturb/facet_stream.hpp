// SPDX-License-Identifier: MIT
// FacetStream: force and torque of a parallel stream, of light or of molecules, on flat facets.
//
// Equations   facet of area A, normal n, centre r, stream from direction e, c = n . e > 0:
//             F = -p A c (a e + (m c + s k) n), torque r x F; nothing where c <= 0.
//             light: a = 1 - specular, m = 2 specular, s = (2/3)(diffuse + emitted absorbed), k =
//             1 (Wertz 1978, section 17.2).
//             molecules: a = sigma_t, m = 2 - sigma_n - sigma_t, s = sigma_n, k = exit speed over
//             speed (Schaaf & Chambre 1961 where molecules are slow against the body; Hughes 1986,
//             chapter 8).
// Units       p a pressure (light), or density times speed squared (molecules); the rest as in
//             Surface.
// Domain      e of length 1 in the axes of the surface. Facets do not shade each other, nor do
//             they get what others scatter: exact for convex bodies.
// Accuracy    a few roundings of the sum of the moduli.
// Errors      none.
// Cost        some 25 flops per facet; 2 to 4 ns (benchmarks/surface.cpp).
#pragma once

#include <vector>

#include "polhode/shape/surface.hpp"

namespace polhode {
inline namespace v0 {

// a, m, s of one facet.
struct StreamLaw {
  double along;
  double mirrored;
  double normal;
};
StreamLaw light_law(const Finish& finish);
StreamLaw molecule_law(const Finish& finish);

class FacetStream {
 public:
  FacetStream(const Surface& surface, StreamLaw (*law)(const Finish&));

  const Surface& surface() const { return surface_; }

  // At p = 1.
  template <Real T>
  BasicVec3<T> torque(const BasicVec3<T>& e, const T& k = T(1.0)) const {
    BasicVec3<T> shifted, turned;
    for (const Row& row : rows_) {
      const T c = lit(row, e);
      shifted = shifted + c * converted<T>(row.along_arm);
      turned = turned + (c * (T(row.mirrored) * c + T(row.normal) * k)) * converted<T>(row.arm);
    }
    return cross(e, shifted) - turned;
  }
  template <Real T>
  BasicVec3<T> force(const BasicVec3<T>& e, const T& k = T(1.0)) const {
    T along(0.0);
    BasicVec3<T> normal;
    for (const Row& row : rows_) {
      const T c = lit(row, e);
      along = along + T(row.along_area) * c;
      normal = normal +
               (c * T(row.area) * (T(row.mirrored) * c + T(row.normal) * k)) * converted<T>(row.n);
    }
    return -(along * e + normal);
  }

 private:
  struct Row {
    Vec3 n;
    Vec3 along_arm;  // A a r
    Vec3 arm;        // A r x n
    double mirrored, normal;
    double area, along_area;
  };
  template <Real T>
  static BasicVec3<T> converted(const Vec3& v) {
    return {T(v.x), T(v.y), T(v.z)};
  }
  template <Real T>
  static T lit(const Row& row, const BasicVec3<T>& e) {
    const T c = T(row.n.x) * e.x + T(row.n.y) * e.y + T(row.n.z) * e.z;
    return c < T(0.0) ? T(0.0) : c;
  }

  Surface surface_;
  std::vector<Row> rows_;
};

}  // namespace v0
}  // namespace polhode
