// SPDX-License-Identifier: MIT
// Signed permutations of body axes with determinant +1: how FreeRotation sorts moments and primes
// axes without ever leaving the proper rotations (an odd permutation reverses one axis).
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Component i of the new axes is sign[i] times component axis[i] of the old ones.
struct AxisOrder {
  std::array<int, 3> axis{0, 1, 2};
  std::array<double, 3> sign{1.0, 1.0, 1.0};
};

template <Real T>
BasicVec3<T> reordered(const AxisOrder& p, const BasicVec3<T>& v) {
  return {T(p.sign[0]) * v[p.axis[0]], T(p.sign[1]) * v[p.axis[1]], T(p.sign[2]) * v[p.axis[2]]};
}

// The same order without the signs.
template <Real T>
BasicVec3<T> permuted(const AxisOrder& p, const BasicVec3<T>& v) {
  return {v[p.axis[0]], v[p.axis[1]], v[p.axis[2]]};
}

template <Real T>
BasicVec3<T> restored(const AxisOrder& p, const BasicVec3<T>& v) {
  BasicVec3<T> u;
  u[p.axis[0]] = T(p.sign[0]) * v.x;
  u[p.axis[1]] = T(p.sign[1]) * v.y;
  u[p.axis[2]] = T(p.sign[2]) * v.z;
  return u;
}

// What `restored` does, as an order.
inline AxisOrder inverse(const AxisOrder& p) {
  AxisOrder r;
  for (std::size_t i = 0; i < 3; ++i) {
    const int j = static_cast<int>(i);
    r.axis[i] = p.axis[0] == j ? 0 : p.axis[1] == j ? 1 : 2;
    r.sign[i] = p.sign[static_cast<std::size_t>(r.axis[i])];
  }
  return r;
}

// First `first`, then `second`.
inline AxisOrder composed(const AxisOrder& first, const AxisOrder& second) {
  AxisOrder p;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto j = static_cast<std::size_t>(second.axis[i]);
    p.axis[i] = first.axis[j];
    p.sign[i] = second.sign[i] * first.sign[j];
  }
  return p;
}

// Axes in the order of rising moments; equal moments keep their order; the middle axis is reversed
// where the permutation is odd.
inline AxisOrder ascending_order(const Vec3& moments) {
  AxisOrder p;
  int swaps = 0;
  const auto sort_pair = [&](std::size_t i, std::size_t j) {
    if (moments[p.axis[j]] < moments[p.axis[i]]) {
      std::swap(p.axis[i], p.axis[j]);
      ++swaps;
    }
  };
  sort_pair(0, 1);
  sort_pair(1, 2);
  sort_pair(0, 1);
  if (swaps % 2 != 0) p.sign[1] = -1.0;
  return p;
}

// q_P with v' = q_P v q_P*, the rotation that `reordered` performs on components.
template <Real T>
BasicQuaternion<T> quaternion_of(const AxisOrder& p) {
  using std::sqrt;
  double r[3][3] = {};
  for (std::size_t i = 0; i < 3; ++i) r[i][p.axis[i]] = p.sign[i];
  // Every radicand below is 0, 1/2, 1, 2 or 4, so the roots are as good as T allows.
  const double ww = 1.0 + r[0][0] + r[1][1] + r[2][2];
  if (ww > 0.0) {
    const T root = sqrt(T(ww));
    const T h = T(0.5) / root;
    return {T(0.5) * root, h * T(r[2][1] - r[1][2]), h * T(r[0][2] - r[2][0]),
            h * T(r[1][0] - r[0][1])};
  }
  // A half turn: w = 0 and the axis a is the eigenvector, (R + 1)/2 = a a^T.
  BasicVec3<T> a{sqrt(T(0.5 * (1.0 + r[0][0]))), sqrt(T(0.5 * (1.0 + r[1][1]))),
                 sqrt(T(0.5 * (1.0 + r[2][2])))};
  if (r[0][1] < 0.0 || r[1][2] < 0.0) a.y = -a.y;
  if (r[0][2] < 0.0) a.z = -a.z;
  return {T(0.0), a.x, a.y, a.z};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
