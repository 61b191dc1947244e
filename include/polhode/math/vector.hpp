// SPDX-License-Identifier: MIT
// Vectors of three numbers and 3x3 matrices: aggregates with the operations that rotation needs,
// and no more.
//
// Equations   hat map [SA (4)]: hat(w) v = w x v.
// Units       those of the components.
// Domain      any components; NaN in, NaN out. norm() scales, so it neither overflows nor
//             underflows.
// Accuracy    each operation is the plain rounded formula.
// Cost        a few flops each; everything is inline.
#pragma once

#include <array>
#include <cstddef>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicVec3 {
  T x = T(0.0);
  T y = T(0.0);
  T z = T(0.0);

  constexpr const T& operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr T& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  bool operator==(const BasicVec3&) const
    requires Real<T>
  = default;
};
using Vec3 = BasicVec3<double>;

template <Number T>
constexpr BasicVec3<T> operator+(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <Number T>
constexpr BasicVec3<T> operator-(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <Number T>
constexpr BasicVec3<T> operator-(const BasicVec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <Number T>
constexpr BasicVec3<T> operator*(const T& s, const BasicVec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <Number T>
constexpr T dot(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <Number T>
constexpr BasicVec3<T> cross(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Euclidean length; scaled by the largest component, so that 1e-200 and 1e200 keep their digits.
template <Number T>
T norm(const BasicVec3<T>& a) {
  using std::abs;
  using std::sqrt;
  const T ax = abs(a.x), ay = abs(a.y), az = abs(a.z);
  T s = select(ax < ay, ay, ax);
  s = select(s < az, az, s);
  const auto none = s == T(0.0);
  if (all(none)) return ax + ay + az;  // 0, or NaN
  const BasicVec3<T> b{a.x / s, a.y / s, a.z / s};
  return select(none, T(ax + ay + az), T(s * sqrt(dot(b, b))));
}

// Of packs, lane by lane.
template <Number T>
  requires(!Real<T>)
BasicVec3<T> select(const Mask<T>& mask, const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

template <Number T>
struct BasicMat3 {
  BasicVec3<T> row[3];

  static constexpr BasicMat3 identity() {
    return {{{T(1.0), T(0.0), T(0.0)}, {T(0.0), T(1.0), T(0.0)}, {T(0.0), T(0.0), T(1.0)}}};
  }
  constexpr const T& operator()(int i, int j) const { return row[i][j]; }
  constexpr T& operator()(int i, int j) { return row[i][j]; }
  bool operator==(const BasicMat3&) const
    requires Real<T>
  = default;
};
using Mat3 = BasicMat3<double>;

template <Number T>
constexpr BasicMat3<T> transpose(const BasicMat3<T>& a) {
  return {{{a(0, 0), a(1, 0), a(2, 0)}, {a(0, 1), a(1, 1), a(2, 1)}, {a(0, 2), a(1, 2), a(2, 2)}}};
}
template <Number T>
constexpr BasicVec3<T> operator*(const BasicMat3<T>& a, const BasicVec3<T>& v) {
  return {dot(a.row[0], v), dot(a.row[1], v), dot(a.row[2], v)};
}
template <Number T>
constexpr BasicMat3<T> operator*(const BasicMat3<T>& a, const BasicMat3<T>& b) {
  const BasicMat3<T> bt = transpose(b);
  return {{bt * a.row[0], bt * a.row[1], bt * a.row[2]}};
}

// hat(w) v = w x v  [SA (4)]
template <Number T>
constexpr BasicMat3<T> hat(const BasicVec3<T>& w) {
  return {{{T(0.0), -w.z, w.y}, {w.z, T(0.0), -w.x}, {-w.y, w.x, T(0.0)}}};
}

// 6x6 matrices: Jacobians of charts and state transition matrices.
//
// Units       mixed: row i, column j carries unit(output i) / unit(input j).
// Domain      any entries.
// Accuracy    products are plain rounded sums.
// Cost        a product is 432 flops.

template <Number T>
struct BasicMatrix6 {
  std::array<std::array<T, 6>, 6> a{};

  static constexpr BasicMatrix6 identity() {
    BasicMatrix6 m;
    for (int i = 0; i < 6; ++i) m(i, i) = T(1.0);
    return m;
  }
  constexpr const T& operator()(int i, int j) const {
    return a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  constexpr T& operator()(int i, int j) {
    return a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  bool operator==(const BasicMatrix6&) const
    requires Real<T>
  = default;
};
using Matrix6 = BasicMatrix6<double>;

template <Number T>
constexpr BasicMatrix6<T> operator*(const BasicMatrix6<T>& a, const BasicMatrix6<T>& b) {
  BasicMatrix6<T> c;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) c(i, j) = c(i, j) + a(i, k) * b(k, j);
  return c;
}

template <Number T>
constexpr std::array<T, 6> operator*(const BasicMatrix6<T>& a, const std::array<T, 6>& x) {
  std::array<T, 6> y{};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      y[static_cast<std::size_t>(i)] += a(i, j) * x[static_cast<std::size_t>(j)];
  return y;
}

template <Number T>
constexpr BasicMatrix6<T> transpose(const BasicMatrix6<T>& a) {
  BasicMatrix6<T> c;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) c(i, j) = a(j, i);
  return c;
}

}  // namespace v0
}  // namespace polhode
