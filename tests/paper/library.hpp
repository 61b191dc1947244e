// SPDX-License-Identifier: MIT
// The library's doubles as exact 50-digit numbers, so that what it returns can be judged.
#pragma once

#include <vector>

#include "paper/support.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode::paper {

inline Vec exact(const Vec3& v) { return {Mp(v.x), Mp(v.y), Mp(v.z)}; }
inline Mat exact(const Mat3& m) { return {exact(m.row[0]), exact(m.row[1]), exact(m.row[2])}; }
inline Phase exact(const AndoyerState& a) {
  return {Mp(a.l), Mp(a.g), Mp(a.h), Mp(a.L), Mp(a.G), Mp(a.H)};
}
inline Phase exact(const EulerState& e) {
  return {Mp(e.phi), Mp(e.theta), Mp(e.psi), Mp(e.Phi), Mp(e.Theta), Mp(e.Psi)};
}
// Row i of a Jacobian.
inline Phase exact_row(const Matrix6& m, int i) {
  Phase row;
  for (int j = 0; j < 6; ++j) row[static_cast<std::size_t>(j)] = Mp(m(i, j));
  return row;
}
inline Vec first_half(const Phase& x) { return {x[0], x[1], x[2]}; }
inline Vec second_half(const Phase& x) { return {x[3], x[4], x[5]}; }
inline Body body_of(const Vec& moments) {
  return {static_cast<double>(moments[0]), static_cast<double>(moments[1]),
          static_cast<double>(moments[2])};
}
// A hub state next to an Andoyer case; what it is exactly, exact_euler says.
inline RotorState hub_state(const AndoyerCase& e) {
  std::array<double, 6> a;
  for (std::size_t i = 0; i < 6; ++i) a[i] = static_cast<double>(e.a[i]);
  return to_rotor(AndoyerState{a[0], a[1], a[2], a[3], a[4], a[5]});
}

// R of q/|q|: inertial to body, so the transpose of the active rotation.
inline Mat matrix_of(const Mp& w, const Vec& v) {
  const Mp size2 = w * w + dot(v, v);
  Mat R;
  for (std::size_t j = 0; j < 3; ++j) {
    Vec axis{};
    axis[j] = 1;
    R[j] = (1 / size2) * ((w * w - dot(v, v)) * axis + 2 * dot(v, axis) * v +
                          2 * w * cross(v, axis));  // q b_j q*
  }
  return R;
}
inline Mat exact(const Quaternion& q) { return matrix_of(Mp(q.w), {Mp(q.x), Mp(q.y), Mp(q.z)}); }

// Euler variables of a hub state, exactly.
inline Phase exact_euler(const RotorState& s) {
  const Vec q = euler_angles(exact(s.q)), p = euler_momenta(q, exact(s.g));
  return {q[0], q[1], q[2], p[0], p[1], p[2]};
}

// Seeded hub states away from theta, J, I = 0 and pi, where every chart is well conditioned.
inline std::vector<RotorState> hub_states(std::uint64_t seed, int count) {
  Random random(seed);
  const auto unit = [&] { return random.number(-1.0, 1.0); };
  std::vector<RotorState> all;
  while (all.size() < static_cast<std::size_t>(count)) {
    const RotorState s{{unit(), unit(), unit(), unit()}, {unit(), unit(), unit()}};
    const Phase x = exact_euler(s);
    const Phase a = andoyer_of_euler(x);
    const Mp G2 = squared(a[4]);
    const bool generic = paper::s(x[1]) > Mp("0.3");
    if (generic && squared(a[3]) < Mp("0.8") * G2 && squared(a[5]) < Mp("0.8") * G2 &&
        G2 > Mp("0.1"))
      all.push_back(s);
  }
  return all;
}

// B Jc B^T against the Poisson tensor [[0, 1], [-1, hat(g)]] of (theta_B, g_B), for the Jacobian B
// of a chart.
inline void add_poisson_defect(Gap& gap, const Matrix6& B, const Vec& g) {
  const Mat hat_g = hat(g);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const auto m = static_cast<std::size_t>(i % 3), n = static_cast<std::size_t>(j % 3);
      const Mp one = m == n ? 1 : 0;
      const Mp expected = i < 3 ? (j < 3 ? Mp(0) : one) : (j < 3 ? -one : hat_g[m][n]);
      gap.add(bracket(exact_row(B, i), exact_row(B, j)), expected);
    }
}

}  // namespace polhode::paper
