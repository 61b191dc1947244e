// SPDX-License-Identifier: MIT
// The papers that a scenario rests on.
//
// Equations   none.
// Units       none.
// Domain      any scenario.
// Accuracy    none.
// Errors      none.
// Cost        none.
#pragma once

#include <vector>

#include "polhode/scenario/citation.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {

std::vector<Citation> citations(const Scenario& scenario);

}  // namespace v0
}  // namespace polhode
