// SPDX-License-Identifier: MIT
#include "polhode/light/shaded_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "light/direction.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// What stands above a plane by less than this part of the size of the body lies in it.
constexpr double flat = 1e-12;

using Corners = std::array<Vec3, 3>;

Corners corners(const FacetShape& shape, std::size_t facet) {
  const FacetShape::Triangle& t = shape.triangles()[facet];
  return {shape.vertices()[t[0]], shape.vertices()[t[1]], shape.vertices()[t[2]]};
}

double size_of(const FacetShape& shape) {
  const Vec3& origin = shape.vertices().front();
  double square = 0.0;
  for (const Vec3& v : shape.vertices()) square = std::max(square, dot(v - origin, v - origin));
  return std::sqrt(square);
}

// Whether the ray from x along d, ahead of x, meets the triangle.
bool meets(const Vec3& x, const Vec3& d, const Corners& at) {
  const Vec3 e1 = at[1] - at[0], e2 = at[2] - at[0], p = cross(d, e2);
  const double det = dot(e1, p);
  if (det == 0.0) return false;  // along the triangle
  const Vec3 t = x - at[0], q = cross(t, e1);
  const double k = 1.0 / det, u = k * dot(t, p), v = k * dot(d, q);
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && k * dot(e2, q) > 0.0;
}

// The sine of the highest elevation over the plane of normal n that the triangle reaches, as seen
// from x: of its inside, of an edge (the top of the great circle, where the edge has it), or of a
// corner.
double highest(const Vec3& x, const Vec3& n, const Corners& at) {
  if (meets(x, n, at)) return 1.0;
  double sine = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = at[k] - x, q = at[(k + 1) % 3] - x, m = cross(p, q);
    sine = std::max(sine, dot(n, p) / std::sqrt(dot(p, p)));
    const double square = dot(m, m);
    if (!(square > 0.0)) continue;
    const Vec3 top = n - (dot(n, m) / square) * m;
    if (dot(cross(p, top), m) > 0.0 && dot(cross(top, q), m) > 0.0)
      sine = std::max(sine, std::sqrt(dot(top, top)));
  }
  return sine;
}

struct Obstacle {
  std::uint32_t facet;
  double width;  // square of the angle that it takes
};

// Facets with a part above the plane of facet i. Of a closed mesh those that turn their face to its
// centre: a ray goes in by one of them before it comes out again.
std::vector<Obstacle> obstacles_of(const FacetShape& shape, std::size_t i, double least,
                                   bool is_closed) {
  const Facet& own = shape.facets()[i];
  std::vector<Obstacle> found;
  for (std::size_t j = 0; j < shape.facets().size(); ++j) {
    if (j == i) continue;
    const FacetShape::Triangle& t = shape.triangles()[j];
    double height = 0.0;
    for (const std::uint32_t k : t)
      height = std::max(height, dot(own.normal, shape.vertices()[k] - own.centre));
    if (height <= least) continue;
    const Facet& other = shape.facets()[j];
    const Vec3 way = own.centre - other.centre;
    const double turned = dot(other.normal, way);
    if (is_closed && turned <= 0.0) continue;
    const double square = dot(way, way);
    found.push_back({static_cast<std::uint32_t>(j),
                     other.area * std::fabs(turned) / (square * std::sqrt(square))});
  }
  std::sort(found.begin(), found.end(), [](const Obstacle& a, const Obstacle& b) {
    return a.width != b.width ? a.width > b.width : a.facet < b.facet;
  });
  return found;
}

}  // namespace

ShadedMesh::ShadedMesh(FacetShape shape) : shape_(std::move(shape)) {
  const std::size_t count = shape_.facets().size();
  const double least = flat * size_of(shape_);
  const bool is_closed = shape_.is_closed();
  first_.assign(1, 0);
  horizon_.assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Facet& own = shape_.facets()[i];
    for (const Obstacle& o : obstacles_of(shape_, i, least, is_closed)) {
      above_.push_back(o.facet);
      const double sine = highest(own.centre, own.normal, corners(shape_, o.facet));
      horizon_[i] = std::max(horizon_[i], sine);
    }
    first_.push_back(above_.size());
  }
}

bool ShadedMesh::is_free(std::size_t i, const Vec3& direction) const {
  const Facet& own = shape_.facets()[i];
  constexpr double margin = 1e-9;  // of the horizon, which has roundings
  if (dot(own.normal, direction) > horizon_[i] + margin) return true;
  for (std::size_t k = first_[i]; k < first_[i + 1]; ++k)
    if (meets(own.centre, direction, corners(shape_, above_[k]))) return false;
  return true;
}

double ShadedMesh::brightness(const Scattering& law, const Vec3& to_sun,
                              const Vec3& to_observer) const {
  const Vec3 s = Direction(to_sun).unit, o = Direction(to_observer).unit;
  double sum = 0.0;
  for (std::size_t i = 0; i < shape_.facets().size(); ++i) {
    const Facet& f = shape_.facets()[i];
    const double mu = dot(f.normal, o), mu0 = dot(f.normal, s);
    if (mu <= 0.0 || mu0 <= 0.0) continue;  // NaN goes on
    if (first_[i] != first_[i + 1] && !(is_free(i, s) && is_free(i, o))) continue;
    sum += f.area * law.at(mu, mu0);
  }
  return sum;
}

bool is_convex(const FacetShape& shape) {
  const double least = flat * size_of(shape);
  for (const Facet& f : shape.facets())
    for (const Vec3& v : shape.vertices())
      if (dot(f.normal, v - f.centre) > least) return false;
  return shape.is_closed();
}

}  // namespace v0
}  // namespace polhode
