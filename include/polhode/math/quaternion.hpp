// SPDX-License-Identifier: MIT
// Quaternions: Hamilton's product, scalar first. As an attitude q is active, body to inertial:
// v_I = q v_B q*.
//
// Equations   rotation_matrix(q) is R of [SA (2)] transposed: its columns are the body axes in
//             inertial components.
// Domain      rotation functions expect |q| = 1 and do not renormalise; normalized(0) is 0/0 = NaN.
// Accuracy    plain rounded formulas.
// Cost        product 28 flops; everything is inline.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicQuaternion {
  T w = T(1.0);
  T x = T(0.0);
  T y = T(0.0);
  T z = T(0.0);

  bool operator==(const BasicQuaternion&) const
    requires Real<T>
  = default;
};
using Quaternion = BasicQuaternion<double>;

template <Number T>
constexpr BasicQuaternion<T> operator*(const BasicQuaternion<T>& a, const BasicQuaternion<T>& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
template <Number T>
constexpr BasicQuaternion<T> conj(const BasicQuaternion<T>& q) {
  return {q.w, -q.x, -q.y, -q.z};
}

template <Number T>
BasicQuaternion<T> normalized(const BasicQuaternion<T>& q) {
  using std::abs;
  using std::sqrt;
  const T aw = abs(q.w), ax = abs(q.x), ay = abs(q.y), az = abs(q.z);
  T s = select(aw < ax, ax, aw);  // scale first: |q|^2 of 1e-200 would underflow
  s = select(s < ay, ay, s);
  s = select(s < az, az, s);
  const T w = q.w / s, x = q.x / s, y = q.y / s, z = q.z / s;
  const T n = sqrt(w * w + x * x + y * y + z * z);
  return {w / n, x / n, y / n, z / n};
}

// Of packs, lane by lane.
template <Number T>
  requires(!Real<T>)
BasicQuaternion<T> select(const Mask<T>& mask, const BasicQuaternion<T>& a,
                          const BasicQuaternion<T>& b) {
  return {select(mask, a.w, b.w), select(mask, a.x, b.x), select(mask, a.y, b.y),
          select(mask, a.z, b.z)};
}

// v_I = q v_B q*
template <Number T>
constexpr BasicVec3<T> rotate(const BasicQuaternion<T>& q, const BasicVec3<T>& v) {
  const BasicVec3<T> u{q.x, q.y, q.z};
  const BasicVec3<T> t = T(2.0) * cross(u, v);
  return v + q.w * t + cross(u, t);
}

// The matrix A = R^T of the attitude: v_I = A v_B; columns are the body axes in inertial
// components.
template <Number T>
constexpr BasicMat3<T> rotation_matrix(const BasicQuaternion<T>& q) {
  const T one(1.0), two(2.0);
  return {{{one - two * (q.y * q.y + q.z * q.z), two * (q.x * q.y - q.w * q.z),
            two * (q.x * q.z + q.w * q.y)},
           {two * (q.x * q.y + q.w * q.z), one - two * (q.x * q.x + q.z * q.z),
            two * (q.y * q.z - q.w * q.x)},
           {two * (q.x * q.z - q.w * q.y), two * (q.y * q.z + q.w * q.x),
            one - two * (q.x * q.x + q.y * q.y)}}};
}

// Rotations about the first and third axis by an angle: q = qz(phi) qx(theta) qz(psi) is the 3-1-3
// attitude [SA (1), (2)].
template <Number T>
BasicQuaternion<T> rotation_x(const T& angle) {
  using std::cos;
  using std::sin;
  const T half = T(0.5) * angle;
  return {cos(half), sin(half), T(0.0), T(0.0)};
}
template <Number T>
BasicQuaternion<T> rotation_z(const T& angle) {
  using std::cos;
  using std::sin;
  const T half = T(0.5) * angle;
  return {cos(half), T(0.0), T(0.0), sin(half)};
}

}  // namespace v0
}  // namespace polhode
