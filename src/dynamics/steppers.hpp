// SPDX-License-Identifier: MIT
// The steppers of a System, one for each method.
#pragma once

#include <memory>

#include "polhode/dynamics/detail/stepper.hpp"
#include "polhode/dynamics/problem.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

using Stepper = BasicStepper<SystemState>;

// By the method of a checked problem; where the system has a damper, it moves with the rotor.
std::unique_ptr<Stepper> make_stepper(const Problem& problem);

// Of a rotor without a damper.
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Collocation& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Splitting& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const VariationOfConstants& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const CustomMethod& method);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
