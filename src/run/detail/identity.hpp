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
// The part of what acts on the body, in numbers that this machine has computed.
inline constexpr char surroundings_part[] = "orbits and torques";

// What is written: the names of files without their folders, and those of columns.
struct IdentityOutputs {
  std::vector<std::string> paths;
  std::string events = {};  // empty: none
  std::vector<std::string> columns;
};
// The version, the columns, the text and the files of the scenario, its method, what acts on the
// body at some times of the run, and each output. The scenario has [time].
Identity identity_of(const Scenario& scenario, const IdentityOutputs& outputs);
// "columns was "q g", is "q"": how the first part that differs does. Empty: none.
std::string difference(const Identity& theirs, const Identity& ours);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
