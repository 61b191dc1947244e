// SPDX-License-Identifier: MIT
// A rotor with the derivative of its state by that of the start, and the methods that step it.
#pragma once

#include <memory>

#include "dynamics/steppers.hpp"
#include "polhode/math/matrix6.hpp"

namespace polhode {
inline namespace v0 {

struct TransitionState {
  RotorState rotor;
  Matrix6 transition;

  constexpr bool operator==(const TransitionState&) const = default;
};

template <class Visit>
void each_number(TransitionState& s, Visit&& visit) {
  each_number(s.rotor, visit);
  for (auto& row : s.transition.a)
    for (double& x : row) visit(x);
}

namespace detail {

// Why a run with derivatives ends at a jump of a torque that the state decides.
inline constexpr const char* no_transition_at_jump =
    "its transition matrix is not known; take differences of runs";

std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem,
                                                                  const Adaptive& method);
std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem,
                                                                  const Collocation& method);
// Where a step is longer than what is left to a sample, a part of it is made for the sample, and
// the run goes on from the start of the step.
std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem,
                                                                  const Splitting& method);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
