// SPDX-License-Identifier: MIT
// Rows of numbers as the library's values, and back.
#pragma once

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode::web {

// States lie in the memory of the module as the library has them.
static_assert(sizeof(RotorState) == 7 * sizeof(double));

inline Vec3 vector(const double* x) { return {x[0], x[1], x[2]}; }
inline Quaternion quaternion(const double* x) { return {x[0], x[1], x[2], x[3]}; }
inline RotorState state(const double* x) { return {quaternion(x), vector(x + 4)}; }
inline Body body(const double* moments) { return {moments[0], moments[1], moments[2]}; }

inline Mat3 matrix(const double* x) {
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = x[i];
  return m;
}

inline double* put(double* to, const Vec3& v) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z;
  return to + 3;
}
inline double* put(double* to, const Quaternion& q) {
  to[0] = q.w, to[1] = q.x, to[2] = q.y, to[3] = q.z;
  return to + 4;
}
inline double* put(double* to, const RotorState& s) { return put(put(to, s.q), s.g); }
template <class... Numbers>
double* put_all(double* to, Numbers... numbers) {
  ((*to++ = static_cast<double>(numbers)), ...);
  return to;
}

}  // namespace polhode::web
