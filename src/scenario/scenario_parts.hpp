// SPDX-License-Identifier: MIT
// From the values of a file to the parts of a rotation: orbits, frame, terms, method, events.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/orbit_kind.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Each throws a ScenarioError at the place of what is wrong. `name` stands for the file.
struct OrbitsContext : FileValues {
  const std::optional<SaveAt>& time;
  const Kinds& kinds;
};
// "orbit.moon" for each table [orbit.NAME], and what one of them describes.
std::vector<std::string> orbit_paths(const Values& values);
ScenarioOrbit orbit_of(const OrbitsContext& at, const std::string& path, OrbitUses& uses);
// The values of a text. ScenarioError with everything that is wrong in it.
ReadFile read_file(std::string_view text, const std::string& path, const Kinds& kinds);
// The scenario of what was read, with the experiment that `make` returns.
Scenario scenario_of(Document document, ReadFile read,
                     const std::function<MadeExperiment(const KindContext&)>& make);
// What every file that the values name holds now; nothing of those that cannot be read.
std::vector<ScenarioFile> files_of(const Values& values, const std::string& name);
// The orbit whose name the value at `path` is.
const ScenarioOrbit& orbit_named(const std::vector<ScenarioOrbit>& orbits, const Values& values,
                                 const std::string& path, const std::string& name);
std::optional<Method> method_of(const KindContext& at);
// Throws a ScenarioError at method.kind.
[[noreturn]] void refuse_method(const FileValues& file, std::string_view message);
// Of the formats that have a table [output.NAME].
FormatOptions format_options_of(const FileValues& file, const OutputFormats& formats);
// Fills in frame, frame_text and precession; the orbits are there.
void add_frame(Rotation& rotation, const KindContext& at);
// The times of its rows, of any kind.
const std::optional<SaveAt>& rows_of(const Experiment& experiment);
// DomainError where the kind is another than "rotation".
const Rotation& rotation_of(const Experiment& experiment);
// Fills in the motion; all else is there. ScenarioError at the state.
void prepare_motion(Rotation& rotation, const FileValues& file);
// What method, events, rows and columns ask of the system.
void check_motion(const Rotation& rotation, const KindContext& at);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
