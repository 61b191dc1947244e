// SPDX-License-Identifier: MIT
// Derivatives of a dual state in the tangent of the hub: (dtheta_B, dg_B), q -> q exp(dtheta_B /
// 2).
#pragma once

#include <array>
#include <cmath>

#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
Matrix6 hub_tangent(const BasicRotorState<Dual<T, 6>>& s) {
  const BasicQuaternion<T> inverse{s.q.w.value, -s.q.x.value, -s.q.y.value, -s.q.z.value};
  Matrix6 B;
  for (int j = 0; j < 6; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const BasicQuaternion<T> dq{s.q.w.derivative[i], s.q.x.derivative[i], s.q.y.derivative[i],
                                s.q.z.derivative[i]};
    const BasicQuaternion<T> half = inverse * dq;
    B(0, j) = to_double(T(2.0) * half.x);
    B(1, j) = to_double(T(2.0) * half.y);
    B(2, j) = to_double(T(2.0) * half.z);
    B(3, j) = to_double(s.g.x.derivative[i]);
    B(4, j) = to_double(s.g.y.derivative[i]);
    B(5, j) = to_double(s.g.z.derivative[i]);
  }
  return B;
}

// B where the unit of momentum is 2^momentum times smaller, and that of coordinate j
// 2^coordinate[j] times: numbers are so much larger.
inline Matrix6 in_units(Matrix6 B, int momentum, const std::array<int, 6>& coordinate) {
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      B.a[i][j] = std::ldexp(B.a[i][j], (i < 3 ? 0 : momentum) - coordinate[j]);
  return B;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
