// SPDX-License-Identifier: MIT
// States that charts are measured on, and the error of one: its largest number against the same in
// double-double, in eps, angles modulo 2 pi; |g| = 1.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "polhode/math/double_double.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "worst.hpp"

namespace polhode::chart_bench {

using Wide = DoubleDouble;
using polhode::test::Worst;

constexpr double eps = std::numeric_limits<double>::epsilon();

inline std::vector<RotorState> drawn_states(std::size_t count) {
  std::mt19937_64 engine(20250101);
  std::normal_distribution<double> n;
  std::vector<RotorState> s(count);
  for (RotorState& state : s) {
    const Vec3 v{n(engine), n(engine), n(engine)};
    const double size = norm(v);
    state = {normalized(Quaternion{n(engine), n(engine), n(engine), n(engine)}),
             {v.x / size, v.y / size, v.z / size}};
  }
  return s;
}

inline BasicRotorState<Wide> wide(const RotorState& s) {
  return {{s.q.w, s.q.x, s.q.y, s.q.z}, {s.g.x, s.g.y, s.g.z}};
}
inline BasicAndoyerState<Wide> wide(const AndoyerState& a) {
  return {a.l, a.g, a.h, a.L, a.G, a.H};
}
inline BasicEulerState<Wide> wide(const EulerState& e) {
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}
inline BasicPoincareState<Wide> wide(const PoincareState& p) {
  return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2, p.pole_J, p.pole_I};
}

template <class T>
std::array<T, 6> numbers(const BasicAndoyerState<T>& a) {
  return {a.l, a.g, a.h, a.L, a.G, a.H};
}
template <class T>
std::array<T, 6> numbers(const BasicEulerState<T>& e) {
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}
template <class T>
std::array<T, 6> numbers(const BasicPoincareState<T>& p) {
  return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2};
}
template <class T>
std::array<T, 7> numbers(const BasicRotorState<T>& s) {
  const BasicQuaternion<T> q = normalized(s.q);
  return {q.w, q.x, q.y, q.z, s.g.x, s.g.y, s.g.z};
}

template <class A, class B>
double error(const A& value, const B& exact) {
  const auto v = numbers(value);
  const auto e = numbers(exact);
  Worst worst;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double d = (Wide(v[i]) - e[i]).hi;
    worst.add(std::abs(std::remainder(d, 2.0 * pi<double>())));
  }
  return worst.value() / eps;
}

}  // namespace polhode::chart_bench
