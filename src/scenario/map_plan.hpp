// SPDX-License-Identifier: MIT
// From the values of a file to its [map], and to the numbers that a map changes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct NumberPlace {
  std::string path;
  std::size_t index;
};
// Where "state.euler.theta" or "body.moments[1]" is; none where there is no such number.
std::optional<NumberPlace> number_place(const Values& values, std::string_view key);

// The scenario is complete but for its map. ScenarioError at the place of what is wrong.
MapPlan map_plan(const Values& values, const Units& units, const Scenario& scenario,
                 const std::string& name);

// From values that the table of keys has let pass. `text` is the file.
Scenario scenario_of(const Values& values, const Units& units, std::string_view text,
                     const std::string& name);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
