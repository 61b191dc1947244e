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

#include "polhode/system/detail/andoyer_method.hpp"

namespace polhode {
inline namespace v0 {
namespace rates {

// Entry (k, l) is [z_k, z_l]; t is needed by sets that depend on it.
// [SA "Lagrange brackets", "[u, v]"]
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

// dz/dt under any system [SA "linear"].
template <class F>
std::array<double, 6> equations_of_motion(const System& system, double t,
                                          const Variables<double>& z, const F& f) {
  return detail::equations_of_motion(detail::variables_at(f, t, z), system, t);
}

}  // namespace rates
}  // namespace v0
}  // namespace polhode
