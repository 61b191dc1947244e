// SPDX-License-Identifier: MIT
// FacetShape: the surface of a body as a mesh of triangles.
//
// Equations   facet (a, b, c): centre (a + b + c) / 3, area |(b - a) x (c - a)| / 2, normal along
//             that product: outward where the corners run counterclockwise as seen from outside.
// Units       vertices in any unit of length.
// Domain      at least one triangle of three vertices that are not on one line; coordinates whose
//             fourth powers are in the range of double. A mesh may have holes and several pieces:
//             what needs a volume asks for one that is closed (require_closed).
// Accuracy    a few roundings of the differences of the corners.
// Errors      DomainError naming the vertex or the facet, counted from 1: a coordinate that is not
//             finite, an index that no vertex has, a facet with no area. require_closed names an
//             edge.
// Cost        a constructor of one pass; require_closed sorts the edges. Copies share the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace shape {

struct Facet {
  Vec3 centre;
  Vec3 normal;  // of length 1
  double area;

  constexpr bool operator==(const Facet&) const = default;
};

// Of three corners. Where they are on one line, to the rounding of their coordinates, the area is
// 0.
Facet facet(const Vec3& a, const Vec3& b, const Vec3& c);

class FacetShape {
 public:
  using Triangle = std::array<std::uint32_t, 3>;  // places in the list of vertices

  FacetShape(std::vector<Vec3> vertices, std::vector<Triangle> triangles);

  std::span<const Vec3> vertices() const { return mesh_->vertices; }
  std::span<const Triangle> triangles() const { return mesh_->triangles; }
  // One per triangle, in their order.
  std::span<const Facet> facets() const { return mesh_->facets; }
  double area() const { return mesh_->area; }

  // Every edge is run through as often one way as the other: the surface has no border, and its
  // facets agree about the side that is outside; vertices in one place are one. The first edge that
  // breaks this, in words, or nothing.
  std::string open_edge() const;
  bool is_closed() const { return open_edge().empty(); }

  // x -> factor (x - origin)
  FacetShape moved(const Vec3& origin, double factor = 1.0) const;

 private:
  struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<Facet> facets;
    double area = 0.0;
  };
  std::shared_ptr<const Mesh> mesh_;
};

// DomainError, "FUNCTION: the mesh is not closed: edge ...".
void require_closed(const FacetShape& shape, const std::string& function);

}  // namespace shape
}  // namespace v0
}  // namespace polhode
