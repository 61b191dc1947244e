// SPDX-License-Identifier: MIT
// Scaling of least-squares problems: independent numbers of unit variance, columns of unit length.
#pragma once

#include <Eigen/Core>
#include <Eigen/Dense>

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// L^-1 of a covariance C = L L^T: numbers times it are independent and of unit variance.
template <class Matrix>
Matrix inverse_root(const Eigen::LLT<Matrix>& factor) {
  return factor.matrixL().solve(Matrix::Identity(factor.rows(), factor.cols()));
}

using RowByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Of the longest column: what is shorter is the rounding of a derivative that is 0.
inline constexpr double empty_column = 1e-14;

// Divides each column by its length, and returns the lengths; a column that is empty becomes 0, and
// its length 1.
inline Eigen::VectorXd to_unit_columns(RowByRow& jacobian) {
  Eigen::VectorXd lengths = jacobian.colwise().norm();
  const double least = lengths.size() == 0 ? 0.0 : empty_column * lengths.maxCoeff();
  for (Eigen::Index j = 0; j < lengths.size(); ++j) {
    if (lengths[j] > least) {
      jacobian.col(j) /= lengths[j];
    } else {
      jacobian.col(j).setZero();
      lengths[j] = 1.0;
    }
  }
  return lengths;
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
