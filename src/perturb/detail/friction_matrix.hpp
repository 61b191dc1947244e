// SPDX-License-Identifier: MIT
// What a matrix of friction must be: symmetric, and driving no motion.
#pragma once

#include <Eigen/Dense>
#include <string>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

Eigen::Matrix3d dense(const Mat3& m);
// The symmetric part, or a DomainError that begins with `name`: "LinearDamping: matrix".
Mat3 friction_matrix(const Mat3& m, const std::string& name);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
