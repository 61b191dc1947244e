// SPDX-License-Identifier: MIT
#include "polhode/shape/facet_shape.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace shape {
namespace {

using Triangle = FacetShape::Triangle;

std::string text(const Vec3& v) { return polhode::detail::tuple_text({v.x, v.y, v.z}); }

void require_vertices(const std::vector<Vec3>& vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& v = vertices[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
      throw DomainError("FacetShape: vertex " + std::to_string(i + 1) + " " + text(v) +
                        " must be finite");
  }
}

Facet facet_of(const std::vector<Vec3>& vertices, const Triangle& t, std::size_t number) {
  const std::string name = "FacetShape: facet " + std::to_string(number);
  for (const std::uint32_t i : t) {
    if (i >= vertices.size())
      throw DomainError(name + " asks for vertex " + std::to_string(std::uint64_t{i} + 1) + " of " +
                        std::to_string(vertices.size()));
  }
  const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
  const Facet made = facet(a, b, c);
  if (!(made.area > 0.0))
    throw DomainError(name + ", corners " + text(a) + ", " + text(b) + ", " + text(c) +
                      ", has no area");
  if (!std::isfinite(made.area)) throw DomainError(name + " is beyond the range of double");
  return made;
}

// For each vertex the first one in the same place.
std::vector<std::uint32_t> first_in_place(std::span<const Vec3> vertices) {
  std::vector<std::uint32_t> order(vertices.size()), first(vertices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](std::uint32_t i) {
    return std::tie(vertices[i].x, vertices[i].y, vertices[i].z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return key(i) != key(j) ? key(i) < key(j) : i < j;
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && vertices[order[k]] == vertices[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

// An edge from its lower to its higher vertex, and which way its facet runs through it.
struct Edge {
  std::uint32_t low, high;
  std::uint32_t facet;
  bool is_forward;
};

std::vector<Edge> sorted_edges(std::span<const Vec3> vertices,
                               std::span<const Triangle> triangles) {
  const std::vector<std::uint32_t> place = first_in_place(vertices);
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = place[triangles[f][k]];
      const std::uint32_t to = place[triangles[f][(k + 1) % 3]];
      edges.push_back(
          {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(f), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::pair(a.low, a.high) != std::pair(b.low, b.high)
               ? std::pair(a.low, a.high) < std::pair(b.low, b.high)
               : a.facet < b.facet;
  });
  return edges;
}

// What is wrong with the facets of one edge, or nothing.
std::string complaint(std::span<const Edge> facets) {
  const auto forward = static_cast<std::size_t>(
      std::count_if(facets.begin(), facets.end(), [](const Edge& e) { return e.is_forward; }));
  if (2 * forward == facets.size()) return {};
  const auto number = [](std::uint32_t i) { return std::to_string(std::uint64_t{i} + 1); };
  const Edge& first = facets.front();
  const std::string edge =
      "edge " + number(first.low) + "-" + number(first.high) + " of facet " + number(first.facet);
  if (facets.size() == 1) return edge + " has no facet on its other side";
  if (facets.size() == 2)
    return edge + " is run through the same way by facet " + number(facets[1].facet) +
           ": one of them is inside out";
  return edge + " joins " + std::to_string(facets.size()) + " facets, " + std::to_string(forward) +
         " of them one way";
}

}  // namespace

Facet facet(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const Vec3 n = cross(ab, ac);
  const double twice = norm(n);
  const double longest = std::max({norm(ab), norm(ac), norm(bc)});
  const double size = std::max({norm(a), norm(b), norm(c)});
  const bool is_line = twice <= 4.0 * 0x1p-52 * longest * size;
  return {a + (1.0 / 3.0) * (ab + ac), (1.0 / twice) * n, is_line ? 0.0 : 0.5 * twice};
}

FacetShape::FacetShape(std::vector<Vec3> vertices, std::vector<Triangle> triangles) {
  require_vertices(vertices);
  if (triangles.empty()) throw DomainError("FacetShape: got no facets; expected at least one");
  auto mesh = std::make_shared<Mesh>();
  mesh->facets.reserve(triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    mesh->facets.push_back(facet_of(vertices, triangles[f], f + 1));
    mesh->area += mesh->facets.back().area;
  }
  mesh->vertices = std::move(vertices);
  mesh->triangles = std::move(triangles);
  mesh_ = std::move(mesh);
}

std::string FacetShape::open_edge() const {
  const std::vector<Edge> edges = sorted_edges(vertices(), triangles());
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high)
      ++end;
    std::string wrong = complaint({edges.data() + begin, end - begin});
    if (!wrong.empty()) return wrong;
    begin = end;
  }
  return {};
}

FacetShape FacetShape::moved(const Vec3& origin, double factor) const {
  if (!(factor > 0.0) || !std::isfinite(factor))
    throw DomainError("FacetShape: factor " + polhode::detail::number_text(factor) +
                      " must be positive and finite");
  std::vector<Vec3> moved;
  moved.reserve(mesh_->vertices.size());
  for (const Vec3& v : mesh_->vertices) moved.push_back(factor * (v - origin));
  return {std::move(moved), mesh_->triangles};
}

void require_closed(const FacetShape& shape, const std::string& function) {
  const std::string edge = shape.open_edge();
  if (!edge.empty()) throw DomainError(function + ": the mesh is not closed: " + edge);
}

}  // namespace shape
}  // namespace v0
}  // namespace polhode
