// SPDX-License-Identifier: MIT
// Moments of inertia that the data do not determine, because the body rotates about a fixed axis.
#pragma once

#include <functional>

#include "polhode/fit/spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// `found`, or the solution with the moments held at their start if two others describe the data as
// well: a body of equal moments, and the body of the start. What was found for the moments is noise
// in that case. `fitted` fits with some of the unknowns of `fit`.
SpinSolution with_undetermined_moments(const SpinFit& fit, SpinSolution found,
                                       const std::function<SpinSolution(const SpinFit&)>& fitted);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
