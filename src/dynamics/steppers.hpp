// SPDX-License-Identifier: MIT
// The steppers of a rotor, one for each method, and of a rotor with a damper.
#pragma once

#include <memory>

#include "polhode/dynamics/detail/stepper.hpp"
#include "polhode/dynamics/problem.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

using Stepper = BasicStepper<RotorState>;

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Collocation& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Splitting& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const VariationOfConstants& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const CustomMethod& method);
// The system has a damper.
std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem,
                                                             const Adaptive& method);
std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem,
                                                             const Collocation& method);
// By the method of a checked problem.
std::unique_ptr<Stepper> make_stepper(const Problem& problem);
std::unique_ptr<BasicStepper<DampedRotorState>> make_stepper(const DampedProblem& problem);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
