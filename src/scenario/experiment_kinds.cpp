// SPDX-License-Identifier: MIT
#include "scenario/detail/experiment_kinds.hpp"

#include <algorithm>
#include <stdexcept>

#include "scenario/detail/made_experiments.hpp"
#include "scenario/fit/fit_plan.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/body.hpp"
#include "scenario/tables/event.hpp"
#include "scenario/tables/fit.hpp"
#include "scenario/tables/head.hpp"
#include "scenario/tables/light.hpp"
#include "scenario/tables/planet.hpp"
#include "scenario/tables/surface.hpp"
#include "scenario/tables/time.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

MadeExperiment made_rotation_of(const KindContext& of) {
  const auto base = std::make_shared<const MadeRotation>(made_rotation(of));
  return {base->rotation,
          [base](const KindContext& at, std::span<const std::string> changed) -> Experiment {
            return made_rotation(at, base.get(), changed).rotation;
          }};
}

// The orbit, most of the work, is made again only where a number of its table changes.
MadeExperiment made_obliquity_of(const KindContext& of) {
  const auto base = std::make_shared<const Obliquity>(made_obliquity(of));
  return {*base, [base](const KindContext& at, std::span<const std::string> changed) -> Experiment {
            const bool keeps_orbit = std::ranges::none_of(
                changed, [](const std::string& path) { return path.starts_with("orbit."); });
            return made_obliquity(at, keeps_orbit ? base.get() : nullptr);
          }};
}

CustomExperiment made_own(const KindContext& at) {
  const std::string path = head_table(at)->kind;  // its table has the same name
  const ExperimentKind* const kind = at.kinds.experiment(path);
  if (kind == nullptr)
    throw std::logic_error("kind: the schema allows one without a description: " + path);
  if (output_table(at).is_explicit<&OutputTable::columns>())
    refuse_columns(at, "expected none: rows of kind " + path + " have all of its columns");
  const std::optional<SaveAt> rows = times_of(time_table(at));
  if (!rows) head_table(at).refuse<&HeadTable::kind>("expected a table [time] as well");
  const Method method = method_of(at).value_or(default_model_method);
  const KeyValues table(at.values, at.units, path, at.name);
  return built(at.values, path, at.name,
               [&] { return kind->made(ExperimentContext(table, *rows, method)); });
}

}  // namespace

ExperimentRow rotation_row(const DescribedParts& described) {
  return {"rotation",
          {body_keys(), described.state, described.frames, described.orbit_table, described.orbits,
           described.perturbations, surface_keys(), described.methods, event_keys(), time_keys()}};
}

// A rotation, and what was observed of it.
ExperimentRow fit_row(const DescribedParts& described) {
  ExperimentRow row = rotation_row(described);
  row.name = "fit";
  for (const SchemaPart& part :
       {described.observations, free_keys(), prior_keys(), fit_keys(), light_keys(), drive_keys()})
    row.parts.push_back(part);
  return row;
}

ExperimentRow obliquity_row(const DescribedParts& described) {
  return {"obliquity",
          {planet_keys(), described.orbit_table, described.orbits, described.methods, time_keys()}};
}

ExperimentRow row_of(const ExperimentKind& kind, const SchemaPart& own,
                     const DescribedParts& described) {
  return {kind.name, {own, described.methods, time_keys()}};
}

MadeExperiment made_experiment(const KindContext& at) {
  const std::string kind = head_table(at)->kind;
  if (kind == "rotation" || kind == "fit") return made_rotation_of(at);
  if (kind == "obliquity") return made_obliquity_of(at);
  return {made_own(at), [](const KindContext& of, std::span<const std::string>) -> Experiment {
            return made_own(of);
          }};
}

}  // namespace detail

void ExperimentContext::require_method(bool is_frozen) const {
  if (moves_any_state(method_)) return;
  if (is_frozen && method_of_frozen_models(method_) != nullptr) return;
  detail::refuse_method(
      file_values(),
      std::string("expected \"adaptive\"") +
          (is_frozen ? ", \"collocation\" or \"splitting\"" : " or \"collocation\"") +
          ", since kind \"" + path() + "\" has a state of its own");
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
