// SPDX-License-Identifier: MIT
// From the values of a file to the parts of a rotation: orbits, frame, terms, method, events.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/scenario/orbit_kind.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// "; did you mean moon?", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

// Each throws a ScenarioError at the place of what is wrong. `name` stands for the file.
struct OrbitsContext {
  const Values& values;
  const Units& units;
  const std::optional<SaveAt>& time;
  const std::string& name;
  const Kinds& kinds;
};
// "orbit.moon" for each table [orbit.NAME], and what one of them describes.
std::vector<std::string> orbit_paths(const Values& values);
ScenarioOrbit orbit_of(const OrbitsContext& at, const std::string& path, OrbitUses& uses);
// What every file that the values name holds now; nothing of those that cannot be read.
std::vector<ScenarioFile> files_of(const Values& values, const std::string& name);
// The mesh of [body], and a mesh that the table at `path` names by `shape` and `scale`.
std::shared_ptr<const ScenarioShape> shape_of(const Values& values, const std::string& name);
FacetShape mesh_of(const Values& values, const std::string& path, const std::string& name);
// "perturbation[0]", ... of the tables of an array.
std::vector<std::string> array_paths(const Values& values, const std::string& array);
// All tables [[surface]], along the principal axes, into the rotation, which has body and shape.
void add_surface(Rotation& rotation, const Values& values, const std::string& name);
// The orbit whose name the value at `path` is.
const ScenarioOrbit& orbit_named(const std::vector<ScenarioOrbit>& orbits, const Values& values,
                                 const std::string& path, const std::string& name);
Crossing crossing_of(const std::string& word);
std::optional<Method> method_of(const KindContext& at);
// A step is one from start towards stop; `any_sign`: whatever its sign is.
std::optional<SaveAt> times_of(const Values& values, const std::string& name,
                               bool any_sign = false);
// step = "auto": start and stop, and the rows between them that the motion needs.
bool has_automatic_rows(const Values& values);
std::optional<SaveAt> span_of(const Values& values, const std::string& name);
std::optional<SaveAt> automatic_times(const Rotation& rotation, const Values& values,
                                      const std::string& name);
std::vector<ScenarioEvent> events_of(const KindContext& at);
// Of the formats that have a table [output.NAME].
FormatOptions format_options_of(const Values& values, const OutputFormats& formats,
                                const std::string& name);
// Fills in frame, frame_text and precession; the orbits are there.
void add_frame(Rotation& rotation, const KindContext& at);
// DomainError where the kind is another than "rotation".
const Rotation& rotation_of(const Experiment& experiment);
// The energy where it starts; 0 where a term has none.
double initial_energy(const DampedProblem& problem);
// What method, events, rows and columns ask of the system.
void check_motion(const Rotation& rotation, const OutputPlan& output, const Values& values,
                  const std::string& name);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
