// SPDX-License-Identifier: MIT
#include "light/convex_polyhedron.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// The error of areas, of their mean, at which the method ends, and its steps.
constexpr double settled = 1e-9;
constexpr int most_steps = 100, most_halvings = 30;
// Half the side of the square that a facet is cut from, in distances from the origin.
constexpr double beyond = 1e3;
// What is taken from the areas for closure, at most, of each.
constexpr double most_taken = 0.5;
// Of the smallest facet that there will be: a start has all facets that are larger than this.
constexpr double least_of_start = 0.1;

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

}  // namespace

void refuse_body(const std::string& what) { throw DomainError("convex_body: " + what); }

Polyhedron::Polyhedron(std::span<const Vec3> normals) : normals_(normals) {
  for (std::size_t j = 0; j < normals.size(); ++j) {
    std::vector<std::uint32_t> order(normals.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::uint32_t k) { return dot(normals[j], normals[k]); });
    std::erase(order, static_cast<std::uint32_t>(j));
    nearest_.push_back(std::move(order));
  }
}

Polygon Polyhedron::polygon(std::size_t j, const Eigen::VectorXd& h) const {
  const Vec3& n = normals_[j];
  const double at = h[static_cast<Eigen::Index>(j)], half = beyond * h.maxCoeff();
  const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  Vec3 u = cross(n, other);
  u = (1.0 / norm(u)) * u;
  const Vec3 v = cross(n, u), foot = at * n;
  Polygon p{{foot - half * u - half * v, foot + half * u - half * v, foot + half * u + half * v,
             foot - half * u + half * v},
            {Polygon::none, Polygon::none, Polygon::none, Polygon::none}},
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

Eigen::VectorXd Polyhedron::areas(const Eigen::VectorXd& h, Eigen::MatrixXd* slopes) const {
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
      if (p.neighbours[i] == Polygon::none) {
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

Eigen::MatrixXd Polyhedron::rows() const {
  Eigen::MatrixXd N(std::ssize(normals_), 3);
  for (std::size_t j = 0; j < normals_.size(); ++j)
    N.row(static_cast<Eigen::Index>(j)) << normals_[j].x, normals_[j].y, normals_[j].z;
  return N;
}

ClosedAreas closed_areas(std::span<const Vec3> normals, std::span<const double> areas) {
  Eigen::VectorXd A(std::ssize(areas)), kept(A.size());
  for (std::size_t j = 0; j < areas.size(); ++j) A[static_cast<Eigen::Index>(j)] = areas[j];
  A /= A.mean();
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
      refuse_body("the sum of areas times normals, " + tuple_text({C.x(), C.y(), C.z()}) +
                  " mean areas, is too far from 0 for a closed body");
    kept[static_cast<Eigen::Index>(j)] = 1.0 - taken;
  }
  return {A.cwiseProduct(kept), kept, T};
}

namespace {

// The start, of the size of the areas; all distances alike where it lacks a facet.
Eigen::VectorXd first_distances(const Polyhedron& body, const Eigen::VectorXd& A,
                                std::span<const double> start) {
  Eigen::VectorXd h = Eigen::VectorXd::Ones(A.size());
  if (std::ssize(start) == A.size()) {
    h = Eigen::Map<const Eigen::VectorXd>(start.data(), A.size());
    if (h.minCoeff() > 0.0) {
      const Eigen::VectorXd a = body.areas(h, nullptr);
      if (a.minCoeff() >= least_of_start * A.minCoeff()) return h * std::sqrt(A.sum() / a.sum());
    }
    h.setOnes();
  }
  const Eigen::VectorXd a = body.areas(h, nullptr);
  if (a.minCoeff() < 0.0) refuse_body("the normals leave a side of the body open");
  return h * std::sqrt(A.sum() / a.sum());
}

}  // namespace

// Distances of the facets: Newton's method for a(h) = A, each step as long as leaves every facet
// half of what the smallest has and takes the residual down (Kitagawa, Merigot & Thibert 2019).
Eigen::VectorXd distances_of(const Polyhedron& body, const Eigen::VectorXd& A,
                             std::span<const double> start) {
  const Eigen::MatrixXd N = body.rows();
  Eigen::MatrixXd M;
  Eigen::VectorXd h = first_distances(body, A, start), a = body.areas(h, &M);
  const double least = 0.5 * std::min(a.minCoeff(), A.minCoeff());
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd off = A - a;
    if (off.cwiseAbs().maxCoeff() <= settled) return h;
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
      refuse_body("no step makes the areas more alike; they are off by " +
                  rounded_text(off.cwiseAbs().maxCoeff()) + " mean areas");
    h += part * d;
    a = body.areas(h, &M);
  }
  refuse_body("the areas did not settle in " + std::to_string(most_steps) + " steps");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
