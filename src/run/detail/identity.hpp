// SPDX-License-Identifier: MIT
// What a checkpoint must agree in with the run or map that goes on from it.
#pragma once

#include <string>
#include <vector>

#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct IdentityPart {
  std::string name;  // as messages call it: "columns"
  std::string text;
};
using Identity = std::vector<IdentityPart>;

// The version, the outputs, the columns, the text and the files of the scenario, and what acts on
// the body at some times of the run. The scenario has [time].
Identity identity_of(const Scenario& scenario, const std::string& outputs,
                     const std::string& columns);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
