// SPDX-License-Identifier: MIT
// The polyhedron of normals and distances, and Minkowski's problem: its distances from its areas.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

[[noreturn]] void refuse_body(const std::string& what);

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
ClosedAreas closed_areas(std::span<const Vec3> normals, std::span<const double> areas);

// Distances of the facets that have areas A, from `start` where that has all facets.
Eigen::VectorXd distances_of(const Polyhedron& body, const Eigen::VectorXd& A,
                             std::span<const double> start = {});

}  // namespace detail
}  // namespace v0
}  // namespace polhode
