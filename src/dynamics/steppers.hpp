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

// The stepper of a checked problem; it also moves the damper, if the system has one.
std::unique_ptr<Stepper> make_stepper(const Problem& problem);

// For systems without a damper.
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Collocation& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Splitting& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const VariationOfConstants& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const CustomMethod& method);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
