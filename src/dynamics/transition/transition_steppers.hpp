// SPDX-License-Identifier: MIT
// Runs with derivatives of the motion: the methods that carry them, and the steppers of a rotor
// with its transition matrix.
#pragma once

#include <memory>
#include <string>

#include "dynamics/augmented.hpp"
#include "dynamics/steppers.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

template <class Visit>
void each_number(Matrix6& M, Visit&& visit) {
  for (auto& row : M.a)
    for (double& x : row) visit(x);
}

// A rotor with the derivative of its state by that of the start.
using TransitionState = Augmented<Matrix6>;

namespace detail {

// The method that carries derivatives, in double: that of a problem, or one with the same motion
// to the same tolerance (Adaptive, Collocation or Splitting). `what` names the derivatives.
// DomainError of `function` for a tolerance that double does not reach, and for a custom method,
// which knows only states.
Method derivative_method(const std::string& function, const std::string& what,
                         const Method& method);

// For a problem whose method is one of these.
std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem);

}  // namespace detail

}  // namespace v0
}  // namespace polhode
