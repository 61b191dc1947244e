// SPDX-License-Identifier: MIT
// From the values of a file to what moves the body: frame, orbits, terms, method, events.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// "; did you mean moon?", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

// Each throws a ScenarioError at the place of what is wrong. `name` stands for the file.
struct OrbitsPlace {
  const Values& values;
  const Units& units;
  const std::optional<SaveAt>& time;
  const std::string& name;
};
std::vector<ScenarioOrbit> orbits_of(const OrbitsPlace& at);
// What every file that the values name holds now; nothing of those that cannot be read.
std::vector<ScenarioFile> files_of(const Values& values, const std::string& name);
// The mesh of [body], and a mesh that the table at `path` names by `shape` and `scale`.
std::optional<ScenarioShape> shape_of(const Values& values, const std::string& name);
FacetShape mesh_of(const Values& values, const std::string& path, const std::string& name);
// "perturbation[0]", ... of the tables of an array.
std::vector<std::string> array_paths(const Values& values, const std::string& array);
// All tables [[surface]], along the principal axes; body and shape are there.
std::optional<Surface> surface_of(const Scenario& scenario, const Values& values,
                                  const std::string& name);
// The orbit whose name the value at `path` is.
const ScenarioOrbit& orbit_named(const std::vector<ScenarioOrbit>& orbits, const Values& values,
                                 const std::string& path, const std::string& name);
Crossing crossing_of(const std::string& word);
std::optional<Method> method_of(const Values& values, const std::string& name);
std::vector<ScenarioEvent> events_of(const Values& values, const Units& units,
                                     const std::string& name);
// [output.aem]
AemOptions aem_options_of(const Values& values, const std::string& name);
// Fills in frame, terms, damper and kinds; body and orbits are there.
void add_motion(Scenario& scenario, const Values& values, const std::string& name);
// The energy at t = 0; 0 where a term has none.
double initial_energy(const Scenario& scenario);
// What method, events, rows and columns ask of the system.
void check_motion(const Scenario& scenario, const Values& values, const std::string& name);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
