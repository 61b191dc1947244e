// SPDX-License-Identifier: MIT
// From the values of a file to its [ensemble].
#pragma once

#include <string>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where [ensemble] is read.
struct EnsembleContext {
  const Values& values;
  const Units& units;
  const std::string& name;  // of the file, for messages
};
// ScenarioError at the place of what is wrong.
EnsemblePlan ensemble_plan(const EnsembleContext& at, const Experiment& experiment);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
