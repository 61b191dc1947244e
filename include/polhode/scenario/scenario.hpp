// SPDX-License-Identifier: MIT
// Scenario: a TOML file that has been read and checked completely. The file (Document), what is run
// (Experiment, of the kind that the file names), what is written (OutputPlan), and the plans of
// `polhode map`, `ensemble` and `fit`, if the file has them. The keys are in
// polhode/scenario/schema.hpp.
//
// Equations   none of its own.
// Units       numbers are in core units (polhode/text/units.hpp).
// Domain      schema 1; kind "rotation", which is what a file without the key describes,
//             "obliquity", or one from outside (polhode/scenario/experiment_kind.hpp).
// Accuracy    as polhode/scenario/document.hpp and rotation.hpp.
// Errors      ScenarioError (polhode/scenario/document.hpp). What a chart or body refuses is
//             reported there too.
// Cost        milliseconds, of which one preparation of the motion.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "polhode/detail/scenario/ensemble_plan.hpp"
#include "polhode/detail/scenario/map_plan.hpp"
#include "polhode/detail/scenario/obliquity.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/scenario/changes.hpp"
#include "polhode/scenario/document.hpp"
#include "polhode/scenario/experiment_kind.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

struct FitPlan;

// One struct for each kind.
using Experiment = std::variant<Rotation, Obliquity, CustomExperiment>;

struct Scenario {
  Document document;
  Experiment experiment;
  OutputPlan output;
  std::optional<MapPlan> map = std::nullopt;
  std::optional<EnsemblePlan> ensemble = std::nullopt;
  std::shared_ptr<const FitPlan> fit =
      nullptr;  // of kind "fit": polhode/detail/scenario/fit_plan.hpp

  const Units& units() const { return document.units; }
  // DomainError where the kind is another than "rotation".
  const Rotation& rotation() const;
};

// `path` stands for the file in messages, its last part in outputs.
Scenario scenario_from_text(std::string_view text, const std::string& path,
                            const Kinds& kinds = default_kinds());
// "-" is standard input. DomainError when there is no such file, or it is a folder. With changes
// the text of the scenario is the changed one.
Scenario read_scenario(const std::string& path, const Kinds& kinds = default_kinds(),
                       std::span<const ScenarioChange> changes = {});

// The scenario with these tables [ensemble] and [[ensemble.vary]], as TOML, in place of its own.
// The rest is shared with it. ScenarioError: errors in these tables name keys without places.
Scenario with_ensemble(const Scenario& scenario, std::string_view tables);

// Checks the experiment of a cell, which has other numbers, against [map]. ScenarioError.
void require_map(const Scenario& scenario, const Experiment& cell);
// ScenarioError at a column of [ensemble] that neither the rows of a member nor the keys that vary
// have, and at a name that one of the rows or an event has.
void require_ensemble_columns(const Scenario& scenario, std::span<const ColumnGroup> rows,
                              std::span<const std::string> events);

// What the tables of the model say, and what they leave to defaults: "density = 1e-12, ...".
struct TableValues {
  std::string table;  // "perturbation[0]", "orbit.moon"
  std::string given;
  std::string defaults;
};
// The values of [body], [state.NAME], [planet], [orbit.NAME], [frame.NAME], [[perturbation]],
// [[surface]], [[observation]] and the table named as the kind of the scenario, in this order.
std::vector<TableValues> model_values(const Scenario& scenario);
// What a user should know of the file, though it can be run: each "FILE:LINE:COLUMN: KEY: ...".
std::vector<std::string> warnings(const Scenario& scenario);
// A core time: of a number in the unit of time of the file, or of a date, in the scale of the epoch
// if it names none. DomainError with the word for what is neither, and for a date without an epoch.
double time_of_word(const Scenario& scenario, const std::string& word);
// "1996-11-25T19:48 UTC"; empty if the file has no epoch.
std::string date_of_time(const Scenario& scenario, double t);
// The times of its rows, whether it has events, and what moves it, of any kind.
const std::optional<SaveAt>& row_times(const Scenario& scenario);
bool has_events(const Scenario& scenario);
std::optional<Method> propagation_method(const Scenario& scenario);
// Of a rotation (polhode/scenario/rotation.hpp). DomainError where the kind is another.
Problem problem(const Experiment& experiment);
inline const System& rotor_system(const Scenario& scenario) {
  return rotor_system(scenario.rotation());
}
inline const RotorState& initial_state(const Scenario& scenario) {
  return initial_state(scenario.rotation());
}
inline const FreeRotation& free_rotation(const Scenario& scenario) {
  return free_rotation(scenario.rotation());
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
