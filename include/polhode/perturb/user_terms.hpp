// SPDX-License-Identifier: MIT
// Terms that the user writes: any Hamiltonian H'(t, state), any torque u(t, state).
//
// Equations   a Hamiltonian's effect is v = dH'/dg, u = -dH'/d(theta_B) by dual numbers, so that it
//             cannot be inconsistent with its energy [SA (107)].
// Units       time, momentum and energy in those of the system; a torque in body components.
// Domain      H is a generic callable: auto H(const auto& t, const BasicRotorState<T>& s), s =
//             {q_SB, g_B} in the reference frame. It may depend on q through q/|q| or through
//             products of two components; |q| = 1 holds to first order in the derivatives. A torque
//             is a callable on double, or generic like H: then double-double runs and state
//             transition matrices work too.
// Accuracy    a few roundings of H.
// Errors      none of its own; what the callable throws passes through.
// Cost        H on Dual<T, 6>: about seven times H.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

template <class F>
class HamiltonianTerm {
 public:
  explicit HamiltonianTerm(F H) : H_(std::move(H)) {}

  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    return H_(at.t, at.s);
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    using D = Dual<T, 6>;
    const D H = H_(D(at.t), detail::with_variables(at.s));
    return {{H.derivative[3], H.derivative[4], H.derivative[5]},
            {-H.derivative[0], -H.derivative[1], -H.derivative[2]}};
  }

 private:
  F H_;
};

template <class F>
class TorqueTerm {
 public:
  explicit TorqueTerm(F torque) : torque_(std::move(torque)) {}

  template <Real T>
    requires std::same_as<std::invoke_result_t<const F&, const T&, const BasicRotorState<T>&>,
                          BasicVec3<T>>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return {{}, torque_(at.t, at.s)};
  }

 private:
  F torque_;
};

}  // namespace v0
}  // namespace polhode
