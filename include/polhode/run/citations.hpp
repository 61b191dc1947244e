// SPDX-License-Identifier: MIT
// The papers that a scenario rests on.
//
// Domain      any scenario.
#pragma once

#include <vector>

#include "polhode/scenario/scenario.hpp"
#include "polhode/text/citation.hpp"

namespace polhode {
inline namespace v0 {

// In the order of their weight, each once.
std::vector<Citation> citations(const Scenario& scenario);

}  // namespace v0
}  // namespace polhode
