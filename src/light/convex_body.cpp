// SPDX-License-Identifier: MIT
// Convex bodies from the areas and normals of their facets: Minkowski's problem and its solution.
#include "polhode/light/convex_body.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

namespace {

// The error of areas, of their mean, at which the method ends, and its steps.
constexpr double settled = 1e-9;
constexpr int most_steps = 100, most_halvings = 30;
// Half the side of the square that a facet is cut from, in distances from the origin.
constexpr double beyond = 1e3;
// The part of each area that may be taken from it for closure.
constexpr double most_taken = 0.5;
// Of the smallest facet that there will be: a start has all facets that are larger than this.
constexpr double least_of_start = 0.1;

[[noreturn]] void refuse_body(const std::string& what) {
  throw DomainError("convex_body: " + what);
}

// A facet of the polyhedron: corners in order, and beyond the edge from each to the next, which.
struct Polygon {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::vector<Vec3> corners;
  std::vector<std::size_t> neighbours;
};

// n_j . x <= h_j, with its areas and their derivatives by h.
class Polyhedron {
 public:
  explicit Polyhedron(std::span<const Vec3> normals);

  Polygon polygon(std::size_t j, const Eigen::VectorXd& h) const;
  // Areas; where `slopes` is not null their derivatives. Negative areas for a side that is open.
  Eigen::VectorXd areas(const Eigen::VectorXd& h, Eigen::MatrixXd* slopes) const;
  std::span<const Vec3> normals() const { return normals_; }
  // Normals as rows: slopes less N N^T have an inverse, as a body that is moved has the same areas.
  Eigen::MatrixXd rows() const;

 private:
  std::span<const Vec3> normals_;
  std::vector<std::vector<std::uint32_t>> nearest_;  // to each normal, the nearest first
};

// Areas of a mean of 1 and a sum of A n that is 0: A_j (1 - n_j . t), t of the tensor sum A n n^T.
struct ClosedAreas {
  Eigen::VectorXd areas;
  Eigen::VectorXd kept;  // 1 - n_j . t
  Eigen::Matrix3d tensor;
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
      refuse_body("the sum of areas times normals, " +
                  polhode::detail::tuple_text({C.x(), C.y(), C.z()}) +
                  " mean areas, is too far from 0 for a closed body");
    kept[static_cast<Eigen::Index>(j)] = 1.0 - taken;
  }
  return {A.cwiseProduct(kept), kept, T};
}

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

// Distances of the facets that have areas A, from `start` if that has all facets: Newton's method
// for a(h) = A, each step as long as leaves every facet half of what the smallest has and takes the
// residual down (Kitagawa, Merigot & Thibert 2019).
Eigen::VectorXd distances_of(const Polyhedron& body, const Eigen::VectorXd& A,
                             std::span<const double> start = {}) {
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
                  polhode::detail::rounded_text(off.cwiseAbs().maxCoeff()) + " mean areas");
    h += part * d;
    a = body.areas(h, &M);
  }
  refuse_body("the areas did not settle in " + std::to_string(most_steps) + " steps");
}

// Corners this near to each other, of the size of the body, are one.
constexpr double one_place = 1e-9;

shape::FacetShape meshed(const Polyhedron& body, const Eigen::VectorXd& h) {
  const double same = one_place * h.maxCoeff();
  std::vector<Vec3> vertices;
  std::vector<shape::FacetShape::Triangle> triangles;
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
      refuse_body("area " + std::to_string(j + 1) + ", " + polhode::detail::number_text(areas[j]) +
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

Integrals over(const Polygon& p, const Vec3& normal) {
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

shape::FacetShape convex_body(std::span<const Vec3> normals, std::span<const double> areas) {
  const std::vector<Vec3> unit = unit_normals(normals, areas);
  double mean = 0.0;
  for (const double A : areas) mean += A / static_cast<double>(areas.size());
  const Polyhedron body(unit);
  const shape::FacetShape found = meshed(body, distances_of(body, closed_areas(unit, areas).areas));
  shape::require_closed(found, "convex_body");
  return found.moved(shape::mass_properties(found, 1.0).centre, std::sqrt(mean));
}

ConvexMoments convex_moments(std::span<const Vec3> normals, std::span<const double> areas,
                             std::span<const double> start) {
  const std::vector<Vec3> unit = unit_normals(normals, areas);
  const Polyhedron body(unit);
  const ClosedAreas closed = closed_areas(unit, areas);
  const Eigen::VectorXd h = distances_of(body, closed.areas, start);
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

}  // namespace light
}  // namespace v0
}  // namespace polhode
