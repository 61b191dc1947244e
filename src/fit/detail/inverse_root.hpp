// SPDX-License-Identifier: MIT
// What makes numbers of a covariance independent and of unit variance.
#pragma once

#include <Eigen/Dense>

namespace polhode {
inline namespace v0 {
namespace detail {

// L^-1 of C = L L^T.
template <class Matrix>
Matrix inverse_root(const Eigen::LLT<Matrix>& factor) {
  return factor.matrixL().solve(Matrix::Identity(factor.rows(), factor.cols()));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
