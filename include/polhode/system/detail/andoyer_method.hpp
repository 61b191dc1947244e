// SPDX-License-Identifier: MIT
// Variables at one point, with their derivatives: what polhode/system/andoyer_method.hpp needs of a
// callable.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace rates {

template <Real T>
using Variables = std::array<T, 6>;

namespace detail {

// A set of variables at one point: the hub state, its derivatives by z (columns) and by t.
struct VariablesAt {
  RotorState s;
  Matrix6 B;
  std::array<double, 6> by_t;
};

template <class F>
VariablesAt variables_at(const F& f, double t, const Variables<double>& z) {
  using D = Dual<double, 7>;
  Variables<D> dual;
  for (int i = 0; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(i);
    dual[k] = D::variable(z[k], i);
  }
  const BasicRotorState<D> s = [&] {
    if constexpr (std::invocable<const F&, const Variables<D>&, const D&>)
      return f(dual, D::variable(t, 6));
    else
      return f(dual);
  }();
  const Quaternion q{s.q.w.value, s.q.x.value, s.q.y.value, s.q.z.value};
  const double two_per_square = 2.0 / (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  VariablesAt at{{q, {s.g.x.value, s.g.y.value, s.g.z.value}}, {}, {}};
  for (std::size_t i = 0; i < 7; ++i) {
    const Quaternion turn = conj(q) * Quaternion{s.q.w.derivative[i], s.q.x.derivative[i],
                                                 s.q.y.derivative[i], s.q.z.derivative[i]};
    const std::array<double, 6> column{two_per_square * turn.x, two_per_square * turn.y,
                                       two_per_square * turn.z, s.g.x.derivative[i],
                                       s.g.y.derivative[i],     s.g.z.derivative[i]};
    if (i == 6) at.by_t = column;
    for (std::size_t k = 0; k < 6 && i < 6; ++k) at.B.a[k][i] = column[k];
  }
  return at;
}

Matrix6 lagrange_brackets(const VariablesAt& at);
double canonical_defect(const VariablesAt& at);
std::array<double, 6> equations_of_motion(const VariablesAt& at, const System& system, double t);

}  // namespace detail

}  // namespace rates
}  // namespace v0
}  // namespace polhode
