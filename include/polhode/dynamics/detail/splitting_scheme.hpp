// SPDX-License-Identifier: MIT
// Coefficients of the symmetric splittings, as the full palindrome of drifts and kicks of one step.
#pragma once

#include <vector>

#include "polhode/dynamics/method.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Fractions of the step, in turn: drift, kick, drift, ... when drift_first, else kick, drift, ...
struct SplittingCoefficients {
  bool drift_first;
  std::vector<double> drifts;
  std::vector<double> kicks;
};

// `exact_kick`: whether a kick is the exact flow of all terms together. Where it is one kick, its
// torque at the end of a step serves the next one too, so kicks go outside; where it is composed of
// flows that do not commute, two of them in a row are not one, and compositions need drifts
// outside.
SplittingCoefficients splitting_coefficients(SplittingScheme scheme, bool exact_kick);

// Whether the scheme composes order-2 steps, for which a symmetric kick of order 2 is enough. The
// others want the kick itself to order 4 at least.
bool composes_order2(SplittingScheme scheme);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
