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
//             they get what others scatter: exact for convex bodies. Where a facet turns edge-on
//             its part has a kink: `add_edges` says n . e once for each direction, or its opposite,
//             that facets look along, up to `most_edges` of them. A surface of more says none: its
//             kinks are many and small. `sides` are those of the edges.
// Accuracy    a few roundings of the sum of the moduli.
// Cost        some 25 flops per facet; 2 to 4 ns (benchmarks/surface.cpp).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/perturb/effect.hpp"
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
  // What the stream does to the facets, apart from where it comes from.
  struct Law;

  FacetStream(const Surface& surface, StreamLaw (*law)(const Finish&));

  static constexpr std::size_t most_edges = 32;

  const Surface& surface() const { return surface_; }
  // Of a surface of more edges.
  bool has_unnamed_kinks() const { return edges_.empty() && !rows_.empty(); }

  // n . e of every edge, behind what is in `values`.
  void add_edges(const Vec3& e, std::vector<double>& values) const {
    for (const Vec3& n : edges_) values.push_back(n.x * e.x + n.y * e.y + n.z * e.z);
  }

  // At p = 1.
  template <Number T>
  BasicVec3<T> torque(const BasicVec3<T>& e, const T& k = T(1.0),
                      std::span<const double> sides = {}) const {
    BasicVec3<T> shifted, turned;
    const bool found = sides.empty();
    for (const Row& row : rows_) {
      const T c = found ? lit(row, e) : lit_by(row, e, sides);
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
    std::size_t edge = 0;
    double towards = 1.0;  // the edge's normal is n, or -n

    bool operator==(const Row&) const = default;
  };
  template <Number T>
  static BasicVec3<T> converted(const Vec3& v) {
    return {T(v.x), T(v.y), T(v.z)};
  }
  template <Number T>
  static T lit(const Row& row, const BasicVec3<T>& e) {
    const T c = T(row.n.x) * e.x + T(row.n.y) * e.y + T(row.n.z) * e.z;
    return select(c < T(0.0), T(0.0), c);
  }
  // On the side given: 0, or n . e whatever its sign.
  template <Number T>
  static T lit_by(const Row& row, const BasicVec3<T>& e, std::span<const double> sides) {
    if (sides[row.edge] * row.towards < 0.0) return T(0.0);
    return T(row.n.x) * e.x + T(row.n.y) * e.y + T(row.n.z) * e.z;
  }
  void find_edges();

  Surface surface_;
  std::vector<Row> rows_;
  std::vector<Vec3> edges_;
};

struct FacetStream::Law {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  const FacetStream* stream;
  std::size_t first_side = 0;  // of those of the edges, in `sides`

  // The same facets, wherever they lie.
  bool operator==(const Law& other) const {
    return first_side == other.first_side && stream->rows_ == other.stream->rows_;
  }

  template <Number T>
  struct OfTime {
    BasicVec3<T> from_S;  // unit vector that the stream comes from; none where nothing comes
    T k;
    T pressure;
  };
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& flow, const BasicPose<T>& at) const {
    const std::span<const double> lit = at.sides.empty() ? at.sides : at.sides.subspan(first_side);
    return {{}, flow.pressure * stream->torque(body_from_reference(at, flow.from_S), flow.k, lit)};
  }
};

}  // namespace v0
}  // namespace polhode
