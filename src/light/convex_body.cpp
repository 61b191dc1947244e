// SPDX-License-Identifier: MIT
#include "polhode/light/convex_body.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "math/is_finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
// The error of areas, of their mean, at which the method ends, and its steps.
constexpr double settled = 1e-9;
constexpr int most_steps = 100, most_halvings = 30;
// Half the side of the square that a facet is cut from, in distances from the origin.
constexpr double beyond = 1e3;
// Corners this near to each other, of the size of the body, are one.
constexpr double one_place = 1e-9;
// What is taken from the areas for closure, at most, of each.
constexpr double most_taken = 0.5;

[[noreturn]] void refuse(const std::string& what) { throw DomainError("convex_body: " + what); }

// A facet of the polyhedron: corners in order, and beyond the edge from each to the next, which.
struct Polygon {
  std::vector<Vec3> corners;
  std::vector<std::size_t> neighbours;
};

// The part of a polygon on the inner side of the plane n . x = h, of facet k.
void cut(Polygon& p, const Vec3& n, double h, std::size_t k, Polygon& spare) {
  spare.corners.clear();
  spare.neighbours.clear();
  const std::size_t count = p.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &a = p.corners[i], &b = p.corners[(i + 1) % count];
    const double da = dot(n, a) - h, db = dot(n, b) - h;
    const auto add = [&](const Vec3& corner, std::size_t neighbour) {
      spare.corners.push_back(corner);
      spare.neighbours.push_back(neighbour);
    };
    if (da <= 0.0) add(a, p.neighbours[i]);
    if ((da <= 0.0) == (db <= 0.0)) continue;
    add(a + (da / (da - db)) * (b - a), da <= 0.0 ? k : p.neighbours[i]);
  }
  std::swap(p, spare);
}

// The polyhedron n_j . x <= h_j with its areas, and their derivatives by h.
class Polyhedron {
 public:
  explicit Polyhedron(std::span<const Vec3> normals) : normals_(normals) {
    for (std::size_t j = 0; j < normals.size(); ++j) {
      std::vector<std::uint32_t> order(normals.size());
      std::iota(order.begin(), order.end(), std::uint32_t{0});
      std::ranges::stable_sort(order, std::ranges::greater{},
                               [&](std::uint32_t k) { return dot(normals[j], normals[k]); });
      std::erase(order, static_cast<std::uint32_t>(j));
      nearest_.push_back(std::move(order));
    }
  }

  Polygon polygon(std::size_t j, const Eigen::VectorXd& h) const {
    const Vec3& n = normals_[j];
    const double at = h[static_cast<Eigen::Index>(j)], half = beyond * h.maxCoeff();
    const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    Vec3 u = cross(n, other);
    u = (1.0 / norm(u)) * u;
    const Vec3 v = cross(n, u), foot = at * n;
    Polygon p{{foot - half * u - half * v, foot + half * u - half * v, foot + half * u + half * v,
               foot - half * u + half * v},
              {none, none, none, none}},
        spare;
    for (const std::uint32_t k : nearest_[j]) {
      const double edge = h[static_cast<Eigen::Index>(k)];
      const bool is_cut =
          std::ranges::any_of(p.corners, [&](const Vec3& x) { return dot(normals_[k], x) > edge; });
      if (is_cut) cut(p, normals_[k], edge, k, spare);
      if (p.corners.empty()) break;
    }
    return p;
  }

  // Areas; where `slopes` is not null their derivatives. Negative areas for a side that is open.
  Eigen::VectorXd areas(const Eigen::VectorXd& h, Eigen::MatrixXd* slopes) const {
    Eigen::VectorXd found(h.size());
    if (slopes != nullptr) slopes->setZero(h.size(), h.size());
    for (Eigen::Index j = 0; j < h.size(); ++j) {
      const Vec3& n = normals_[static_cast<std::size_t>(j)];
      const Polygon p = polygon(static_cast<std::size_t>(j), h);
      Vec3 twice;
      const std::size_t count = p.corners.size();
      bool is_open = false;
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 &a = p.corners[i], &b = p.corners[(i + 1) % count];
        twice = twice + cross(a - p.corners[0], b - p.corners[0]);
        if (p.neighbours[i] == none) {
          is_open = true;
          continue;
        }
        if (slopes == nullptr) continue;
        const auto k = static_cast<Eigen::Index>(p.neighbours[i]);
        const Vec3& m = normals_[p.neighbours[i]];
        const double sine = norm(cross(n, m)), length = norm(b - a);
        (*slopes)(j, k) += length / sine;
        (*slopes)(j, j) -= length * dot(n, m) / sine;
      }
      found[j] = is_open ? -1.0 : 0.5 * dot(twice, n);
    }
    return found;
  }

 private:
  std::span<const Vec3> normals_;
  std::vector<std::vector<std::uint32_t>> nearest_;  // to each normal, the nearest first
};

// Areas whose sum of A n is 0, of a mean of 1.
Eigen::VectorXd closed(std::span<const Vec3> normals, std::span<const double> areas) {
  Eigen::VectorXd A(std::ssize(areas));
  for (std::size_t j = 0; j < areas.size(); ++j) A[static_cast<Eigen::Index>(j)] = areas[j];
  A /= A.mean();
  // A_j (1 - n_j . t), with t from the tensor sum of A n n^T
  Eigen::Matrix3d T = Eigen::Matrix3d::Zero();
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
  for (std::size_t j = 0; j < areas.size(); ++j) {
    const Eigen::Vector3d n(normals[j].x, normals[j].y, normals[j].z);
    T += A[static_cast<Eigen::Index>(j)] * n * n.transpose();
    C += A[static_cast<Eigen::Index>(j)] * n;
  }
  const Eigen::Vector3d t = T.fullPivLu().solve(C);
  for (std::size_t j = 0; j < areas.size(); ++j) {
    const double taken = normals[j].x * t.x() + normals[j].y * t.y() + normals[j].z * t.z();
    if (!(std::abs(taken) <= most_taken))
      refuse("the sum of areas times normals, " + detail::tuple_text({C.x(), C.y(), C.z()}) +
             " mean areas, is too far from 0 for a closed body");
    A[static_cast<Eigen::Index>(j)] *= 1.0 - taken;
  }
  return A;
}

// Distances of the facets: Newton's method for a(h) = A, each step as long as leaves every facet
// half of what the smallest has and takes the residual down (Kitagawa, Merigot & Thibert 2019).
Eigen::VectorXd distances(const Polyhedron& body, std::span<const Vec3> normals,
                          const Eigen::VectorXd& A) {
  const Eigen::Index count = A.size();
  Eigen::MatrixXd N(count, 3), M;
  for (Eigen::Index j = 0; j < count; ++j) {
    const Vec3& n = normals[static_cast<std::size_t>(j)];
    N.row(j) << n.x, n.y, n.z;
  }
  Eigen::VectorXd h = Eigen::VectorXd::Ones(count), a = body.areas(h, nullptr);
  if (a.minCoeff() < 0.0) refuse("the normals leave a side of the body open");
  h *= std::sqrt(A.sum() / a.sum());
  a = body.areas(h, &M);
  const double least = 0.5 * std::min(a.minCoeff(), A.minCoeff());
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd off = A - a;
    if (off.cwiseAbs().maxCoeff() <= settled) return h;
    // a body that is moved has the same areas: the sum with N N^T has an inverse
    M.noalias() -= N * N.transpose();
    const Eigen::VectorXd d = M.partialPivLu().solve(off);
    double part = 1.0;
    int halvings = 0;
    for (; halvings < most_halvings; ++halvings, part *= 0.5) {
      const Eigen::VectorXd next = h + part * d;
      if (!(next.minCoeff() > 0.0)) continue;
      const Eigen::VectorXd there = body.areas(next, nullptr);
      if (!(there.minCoeff() >= least)) continue;
      if ((A - there).norm() <= (1.0 - 0.5 * part) * off.norm()) break;
    }
    if (halvings == most_halvings)
      refuse("no step makes the areas more alike; they are off by " +
             detail::rounded_text(off.cwiseAbs().maxCoeff()) + " mean areas");
    h += part * d;
    a = body.areas(h, &M);
  }
  refuse("the areas did not settle in " + std::to_string(most_steps) + " steps");
}

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

}  // namespace

FacetShape convex_body(std::span<const Vec3> normals, std::span<const double> areas) {
  if (normals.size() != areas.size())
    refuse(std::to_string(areas.size()) + " areas for " + std::to_string(normals.size()) +
           " normals; expected one for each");
  if (normals.size() < 4) refuse(std::to_string(normals.size()) + " facets; expected 4 or more");
  double mean = 0.0;
  std::vector<Vec3> unit;
  for (std::size_t j = 0; j < areas.size(); ++j) {
    if (!(areas[j] > 0.0) || !std::isfinite(areas[j]))
      refuse("area " + std::to_string(j + 1) + ", " + detail::number_text(areas[j]) +
             ", must be positive and finite");
    const double length = norm(normals[j]);
    if (!(length > 0.0) || !std::isfinite(length))
      refuse("normal " + std::to_string(j + 1) + " must be finite and not 0");
    unit.push_back((1.0 / length) * normals[j]);
    mean += areas[j] / static_cast<double>(areas.size());
  }
  const Eigen::VectorXd A = closed(unit, areas);
  const Polyhedron body(unit);
  const FacetShape found = meshed(body, distances(body, unit, A));
  require_closed(found, "convex_body");
  return found.moved(mass_properties(found, 1.0).centre, std::sqrt(mean));
}

}  // namespace v0
}  // namespace polhode
