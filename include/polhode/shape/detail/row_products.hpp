// SPDX-License-Identifier: MIT
// Products of the rows of a matrix, as homogeneous polynomials.
#pragma once

#include "polhode/detail/shape/moment_order.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace shape {
namespace detail {

// The product of a homogeneous polynomial of `degree` and the linear form l . x.
template <int degree, Real T>
constexpr BasicMoments<T, degree + 1> times(const BasicMoments<T, degree>& p,
                                            const BasicVec3<T>& l) {
  BasicMoments<T, degree + 1> out{};
  for (int c = 0; c <= degree; ++c) {
    for (int b = 0; b + c <= degree; ++b) {
      const T& coefficient = p[moment_place(b, c)];
      out[moment_place(b, c)] += l.x * coefficient;
      out[moment_place(b + 1, c)] += l.y * coefficient;
      out[moment_place(b, c + 1)] += l.z * coefficient;
    }
  }
  return out;
}

// (R_0 . x)^a (R_1 . x)^b (R_2 . x)^c, R_i the rows.
template <int degree, Real T>
constexpr BasicMoments<T, degree> product_of_rows(const BasicMat3<T>& R, int b, int c) {
  if constexpr (degree == 0) {
    return {T(1.0)};
  } else {
    if (c > 0) return times<degree - 1>(product_of_rows<degree - 1>(R, b, c - 1), R.row[2]);
    if (b > 0) return times<degree - 1>(product_of_rows<degree - 1>(R, b - 1, c), R.row[1]);
    return times<degree - 1>(product_of_rows<degree - 1>(R, b, c), R.row[0]);
  }
}

}  // namespace detail
}  // namespace shape
}  // namespace v0
}  // namespace polhode
