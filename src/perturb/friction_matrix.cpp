// SPDX-License-Identifier: MIT
#include "perturb/detail/friction_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double symmetry = 8.0 * std::numeric_limits<double>::epsilon();

std::string text(const Vec3& v) { return tuple_text({v.x, v.y, v.z}); }

}  // namespace

Eigen::Matrix3d dense(const Mat3& m) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out(i, j) = m(i, j);
  }
  return out;
}

Mat3 friction_matrix(const Mat3& D, const std::string& called) {
  const std::string name =
      called + " (" + text(D.row[0]) + ", " + text(D.row[1]) + ", " + text(D.row[2]) + ")";
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!std::isfinite(D(i, j))) throw DomainError(name + " must be finite");
      largest = std::max(largest, std::abs(D(i, j)));
    }
  }
  Mat3 even;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(D(i, j) - D(j, i)) > symmetry * largest)
        throw DomainError(name + " must be symmetric");
      even(i, j) = 0.5 * D(i, j) + 0.5 * D(j, i);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(dense(even), Eigen::EigenvaluesOnly);
  if (!(solver.eigenvalues()(0) >= -symmetry * largest))
    throw DomainError(name + " has the eigenvalue " + number_text(solver.eigenvalues()(0)) +
                      ": damping must not drive the body, eigenvalues >= 0");
  return even;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
