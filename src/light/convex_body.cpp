// SPDX-License-Identifier: MIT
#include "polhode/light/convex_body.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "light/convex_polyhedron.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::Polyhedron;
using detail::refuse_body;

// Corners this near to each other, of the size of the body, are one.
constexpr double one_place = 1e-9;

FacetShape meshed(const Polyhedron& body, const Eigen::VectorXd& h) {
  const double same = one_place * h.maxCoeff();
  std::vector<Vec3> vertices;
  std::vector<FacetShape::Triangle> triangles;
  const auto place_of = [&](const Vec3& x) {
    const auto known =
        std::ranges::find_if(vertices, [&](const Vec3& v) { return norm(v - x) <= same; });
    if (known != vertices.end()) return static_cast<std::uint32_t>(known - vertices.begin());
    vertices.push_back(x);
    return static_cast<std::uint32_t>(vertices.size() - 1);
  };
  for (Eigen::Index j = 0; j < h.size(); ++j) {
    std::vector<std::uint32_t> ring;
    for (const Vec3& x : body.polygon(static_cast<std::size_t>(j), h).corners) {
      const std::uint32_t place = place_of(x);
      if (ring.empty() || ring.back() != place) ring.push_back(place);
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
      triangles.push_back({ring[0], ring[k], ring[k + 1]});
  }
  return {std::move(vertices), std::move(triangles)};
}

// Normals of length 1.
std::vector<Vec3> unit_normals(std::span<const Vec3> normals, std::span<const double> areas) {
  if (normals.size() != areas.size())
    refuse_body(std::to_string(areas.size()) + " areas for " + std::to_string(normals.size()) +
                " normals; expected one for each");
  if (normals.size() < 4)
    refuse_body(std::to_string(normals.size()) + " facets; expected 4 or more");
  std::vector<Vec3> unit;
  for (std::size_t j = 0; j < areas.size(); ++j) {
    if (!(areas[j] > 0.0) || !std::isfinite(areas[j]))
      refuse_body("area " + std::to_string(j + 1) + ", " + detail::number_text(areas[j]) +
                  ", must be positive and finite");
    const double length = norm(normals[j]);
    if (!(length > 0.0) || !std::isfinite(length))
      refuse_body("normal " + std::to_string(j + 1) + " must be finite and not 0");
    unit.push_back((1.0 / length) * normals[j]);
  }
  return unit;
}

// Integrals over a plane polygon, and over the cone from the origin to it: of 1, x, and x^2, y^2,
// z^2.
struct Integrals {
  double size = 0.0;
  Vec3 first, second;
};

Integrals over(const detail::Polygon& p, const Vec3& normal) {
  Integrals sum;
  for (std::size_t i = 1; i + 1 < p.corners.size(); ++i) {
    const Vec3 &a = p.corners[0], &b = p.corners[i], &c = p.corners[i + 1];
    const double t = 0.5 * dot(cross(b - a, c - a), normal);
    sum.size += t;
    sum.first = sum.first + (t / 3.0) * (a + b + c);
    for (int k = 0; k < 3; ++k)
      sum.second[k] +=
          t / 6.0 * (a[k] * (a[k] + b[k]) + b[k] * (b[k] + c[k]) + c[k] * (c[k] + a[k]));
  }
  return sum;
}

// Moments about the centre of mass of a change d of the integrals of a body.
Vec3 moments_by(const Integrals& body, const Integrals& d) {
  const double V = body.size;
  Vec3 square;  // of d (second - first^2 / V)
  for (int k = 0; k < 3; ++k) {
    const double c = body.first[k] / V;
    square[k] = d.second[k] - 2.0 * c * d.first[k] + c * c * d.size;
  }
  return {square.y + square.z, square.x + square.z, square.x + square.y};
}

}  // namespace

FacetShape convex_body(std::span<const Vec3> normals, std::span<const double> areas) {
  const std::vector<Vec3> unit = unit_normals(normals, areas);
  double mean = 0.0;
  for (const double A : areas) mean += A / static_cast<double>(areas.size());
  const Polyhedron body(unit);
  const FacetShape found =
      meshed(body, detail::distances_of(body, detail::closed_areas(unit, areas).areas));
  require_closed(found, "convex_body");
  return found.moved(mass_properties(found, 1.0).centre, std::sqrt(mean));
}

ConvexMoments convex_moments(std::span<const Vec3> normals, std::span<const double> areas,
                             std::span<const double> start) {
  const std::vector<Vec3> unit = unit_normals(normals, areas);
  const Polyhedron body(unit);
  const detail::ClosedAreas closed = detail::closed_areas(unit, areas);
  const Eigen::VectorXd h = detail::distances_of(body, closed.areas, start);
  // a facet that moves out by dh adds its integrals times dh
  std::vector<Integrals> facets;
  Integrals whole;
  for (std::size_t j = 0; j < unit.size(); ++j) {
    const double height = h[static_cast<Eigen::Index>(j)];
    facets.push_back(over(body.polygon(j, h), unit[j]));
    whole.size += height / 3.0 * facets[j].size;
    whole.first = whole.first + (height / 4.0) * facets[j].first;
    whole.second = whole.second + (height / 5.0) * facets[j].second;
  }
  Vec3 I;
  {
    const Vec3 c = (1.0 / whole.size) * whole.first;
    const Vec3 square{whole.second.x - c.x * whole.first.x, whole.second.y - c.y * whole.first.y,
                      whole.second.z - c.z * whole.first.z};
    I = {square.y + square.z, square.x + square.z, square.x + square.y};
  }
  ConvexMoments found{I.x / I.z, I.y / I.z, {}, {}, {h.data(), h.data() + h.size()}};
  Eigen::MatrixXd by_h(h.size(), 2);
  for (std::size_t j = 0; j < unit.size(); ++j) {
    const Vec3 d = moments_by(whole, facets[j]);
    by_h.row(static_cast<Eigen::Index>(j)) << (d.x - found.Ixx * d.z) / I.z,
        (d.y - found.Iyy * d.z) / I.z;
  }
  Eigen::MatrixXd M;
  static_cast<void>(body.areas(h, &M));
  const Eigen::MatrixXd N = body.rows();
  M.noalias() -= N * N.transpose();
  // symmetric; then through closure, da_j = kept_j dA_j - A_j n_j . dt, where the tensor times dt
  // is the sum of kept_k n_k dA_k
  const Eigen::MatrixXd by_closed = M.partialPivLu().solve(by_h);
  const Eigen::VectorXd given = closed.areas.cwiseQuotient(closed.kept);
  const Eigen::MatrixXd taken =
      closed.tensor.inverse() * (N.transpose() * given.asDiagonal() * by_closed);
  const Eigen::MatrixXd by = closed.kept.asDiagonal() * (by_closed - N * taken);
  double mean = 0.0;
  for (const double A : areas) mean += A / static_cast<double>(areas.size());
  for (Eigen::Index j = 0; j < h.size(); ++j) {
    found.Ixx_by_areas.push_back(by(j, 0) / mean);
    found.Iyy_by_areas.push_back(by(j, 1) / mean);
  }
  return found;
}

}  // namespace v0
}  // namespace polhode
