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

#include <string>
#include <vector>

#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {

struct Citation {
  std::string key;     // "sadov1970"
  std::string text;    // authors, year, title, place
  std::string reason;  // what the scenario takes from it
};

// In the order of their weight, each once.
std::vector<Citation> citations(const Scenario& scenario);

}  // namespace v0
}  // namespace polhode
