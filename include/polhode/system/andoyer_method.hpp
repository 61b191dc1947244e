// SPDX-License-Identifier: MIT
// Andoyer's general method: the equations of motion in any six variables, canonical or not, from
// their Lagrange brackets.
//
// Equations   [u, v] = sum of dx/du dy/dv - dy/du dx/dv over canonical pairs, which in the tangent
//             (theta_B, g_B) of the hub is theta_u . g_v - g_u . theta_v - theta_u . (g x theta_v);
//             dH/dz_k + [z_k, t] + sum over l of [z_k, z_l] dz_l/dt = 0 [SA "linear"]. In place of
//             dH/dz_k stands g_k . w_SB - theta_k . u, the same for a Hamiltonian system, and the
//             generalised force of a torque that has no energy.
// Corrections none here; what follows it in the paper is misprinted: docs/theory/errata.md.
// Units       any: z may be of any kind.
// Domain      f is a generic callable from six numbers to the hub state in the reference frame:
//             BasicRotorState<T> f(const std::array<T, 6>& z), or f(z, t) for variables that depend
//             on time explicitly. T is Dual<double, 7>. |q| need not be 1. Where f is singular
//             (det[z_k, z_l] = 0) the rates are NaN.
// Accuracy    budget andoyer_method in tests/budgets.hpp, away from singularities of f.
// Errors      what f or a term throws passes through.
// Cost        f on dual numbers, once, and a 6x6 linear system.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "polhode/math/dual.hpp"
#include "polhode/math/matrix6.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {

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

// Entry (k, l) is [z_k, z_l]; t is needed by sets that depend on it.
template <class F>
Matrix6 lagrange_brackets(const F& f, const Variables<double>& z, double t = 0.0) {
  return detail::lagrange_brackets(detail::variables_at(f, t, z));
}

// How far the set is from canonical at z, three coordinates, then their momenta: the largest
// |[z_k, z_l] - J| over what was added up to it. A few eps for a canonical set; of order one for
// one that is not.
template <class F>
double canonical_defect(const F& f, const Variables<double>& z, double t = 0.0) {
  return detail::canonical_defect(detail::variables_at(f, t, z));
}

// dz/dt under any system.
template <class F>
std::array<double, 6> equations_of_motion(const F& f, const System& system, double t,
                                          const Variables<double>& z) {
  return detail::equations_of_motion(detail::variables_at(f, t, z), system, t);
}

}  // namespace v0
}  // namespace polhode
