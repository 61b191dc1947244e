// SPDX-License-Identifier: MIT
#include "scenario/map_plan.hpp"

#include <algorithm>

#include "output/obliquity_columns.hpp"
#include "polhode/error.hpp"
#include "polhode/output/columns.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double most_cells = 1e9;
constexpr std::int64_t least_samples = 8;  // of spectrum

MapAxis axis_of(const Values& values, const Units& units, const std::string& path,
                const std::string& name) {
  const std::string& key = word(values, path + ".key");
  const std::optional<NumberLocation> place = number_location(values, key);
  if (!place) {
    const std::vector<std::string> paths = number_keys(values, key);
    const std::vector<std::string_view> known(paths.begin(), paths.end());
    refuse(values, path + ".key", name,
           "expected a key that holds a number and stands in this file or has a fallback, such as "
           "state.euler.theta or planet.pole.dec" +
               did_you_mean(key, known));
  }
  const std::int64_t count = value_at(values, path + ".count").whole;
  if (count < 1 || static_cast<double>(count) > most_cells)
    refuse(values, path + ".count", name, "expected a whole number from 1 to 1e9");
  const Value& value = values.find(place->path)->second;
  const std::string& unit = value.units[place->index];
  return {key, number(values, path + ".from"), number(values, path + ".to"), count,
          unit.empty() ? units.label(value.key->dimension) : unit};
}

std::string column_of(const MapContext& at, const System& system) {
  const Values& values = at.values;
  const std::string& name = at.name;
  const std::string& column = word(values, "map.column");
  const std::vector<std::string_view> known = column_names(at.charts);
  if (std::find(known.begin(), known.end(), column) == known.end())
    refuse(values, "map.column", name,
           "expected a column such as \"theta\", \"L\" or \"w3\" (docs/reference/files.md)" +
               did_you_mean(column, known));
  if (needs_energy(column) && !system.has_energy())
    refuse(values, "map.column", name,
           "expected another column, since a perturbation has no energy");
  const bool equator = word(values, "state.axes") == "equator-J2000";
  if (column.starts_with("pole_") && equator != (column == "pole_ra" || column == "pole_dec"))
    refuse(values, "map.column", name,
           std::string("expected ") + (equator ? "pole_ra or pole_dec" : "pole_lon or pole_lat") +
               ", by state.axes");
  return column;
}

SectionSurface surface_of(const Values& values, const std::string& name) {
  const bool by_period = has(values, "map.period");
  for (const char* const key : {"map.value", "map.crossing", "map.epoch"})
    if (is_explicit(values, key) && by_period != (std::string_view(key) == "map.epoch"))
      refuse(values, key, name,
             by_period ? "expected only with angle" : "expected only with period");
  if (!by_period) {
    const std::string& angle = word(values, "map.angle");
    return AndoyerSurface{angle == "l"   ? AndoyerAngle::l
                          : angle == "g" ? AndoyerAngle::g
                                         : AndoyerAngle::h,
                          number(values, "map.value"), crossing_of(word(values, "map.crossing"))};
  }
  require_range(values, "map.period", name);
  return Strobe{number(values, "map.period"), number(values, "map.epoch")};
}

std::string section_orbit(const Values& values, const std::vector<ScenarioOrbit>& orbits,
                          const std::string& name) {
  const ScenarioOrbit& orbit = orbit_named(orbits, values, "map.orbit", name);
  const KeplerElements* const elements = kepler_elements(orbit);
  if (elements == nullptr)
    refuse(values, "map.orbit", name, "expected an orbit with elements: others have no pericentre");
  built(values, "map.orbit", name, [&] {
    require_pericentres(*elements, "map");
    return true;
  });
  return orbit.name;
}

// All but the grid.
MapPlan plan_of(const Rotation& rotation, const MapContext& at) {
  const Values& values = at.values;
  const std::string& name = at.name;
  const std::string& kind = word(values, "map.kind");
  if (kind == "frequency")
    refuse(values, "map.kind", name,
           "expected \"chaos\", \"column\", \"andoyer-section\" or \"spin-orbit-section\", since "
           "the frequency is that of the precession in a file of kind \"obliquity\"");
  if (kind == "chaos" && rotation.damper)
    refuse(values, "map.kind", name,
           "expected another kind, since the state of a Kane damper has no indicator of chaos");
  if (kind == "chaos") return {.kind = MapKind::chaos};
  if (kind == "column") {
    const std::string column = column_of(at, rotor_system(rotation));
    return {.kind = MapKind::column,
            .column = column,
            .unit = at.units.label(column_dimension(column, at.charts))};
  }
  if (kind == "andoyer-section")
    return {.kind = MapKind::andoyer_section, .surface = surface_of(values, name)};
  return {.kind = MapKind::spin_orbit_section,
          .orbit = section_orbit(values, rotation.orbits, name)};
}

MapPlan plan_of(const Obliquity& of, const MapContext& at) {
  const std::string& kind = word(at.values, "map.kind");
  if (kind == "frequency") {
    if (of.time && of.time->size() < 2 * least_samples)
      refuse(at.values, "time", at.name,
             "expected 16 rows or more, since each half of them has a frequency");
    return {.kind = MapKind::frequency};
  }
  if (kind != "column")
    refuse(at.values, "map.kind", at.name,
           "expected \"column\" or \"frequency\" in a file of kind \"obliquity\"");
  const std::string& column = word(at.values, "map.column");
  const SpinColumn* const found = spin_column(column);
  if (found == nullptr) {
    const std::vector<std::string_view> known = spin_column_names();
    refuse(
        at.values, "map.column", at.name,
        "expected a column of kind \"obliquity\": " + one_of(known) + did_you_mean(column, known));
  }
  if (column == "insolation" && !of.insolation)
    refuse(at.values, "map.column", at.name,
           "expected a table planet.insolation for the column insolation");
  return {.kind = MapKind::column, .column = column, .unit = unit_of(*found, at.units)};
}

MapPlan plan_of(const CustomExperiment& of, const MapContext& at) {
  refuse(at.values, "map", at.name,
         "kind: got \"" + of.kind + "\"; expected \"rotation\" or \"obliquity\"");
}

MapPlan without_axes(const MapContext& at, const Experiment& experiment) {
  return std::visit([&](const auto& of) { return plan_of(of, at); }, experiment);
}

const std::optional<SaveAt>& rows_of(const Experiment& experiment) {
  return std::visit([](const auto& of) -> const std::optional<SaveAt>& { return row_times(of); },
                    experiment);
}

void require_rows(const Values& values, const std::optional<SaveAt>& time,
                  const std::string& name) {
  if (!time) refuse(values, "map", name, "expected a table [time] as well");
  const SaveAt& rows = *time;
  const double first = rows[0], last = rows[rows.size() - 1];
  if (last == 0.0 || first * last < 0.0 || rows.is_list())
    refuse(values, "time", name,
           "expected, for a map, rows by step or count on one side of t = 0, where cells start");
}

}  // namespace

MapPlan map_plan(const MapContext& at, const Experiment& experiment) {
  const Values& values = at.values;
  const std::string& name = at.name;
  MapPlan plan = without_axes(at, experiment);
  double cells = 1.0;
  for (std::size_t i = 0; has(values, "map.axis[" + std::to_string(i) + "].key"); ++i) {
    const std::string path = "map.axis[" + std::to_string(i) + "]";
    MapAxis axis = axis_of(values, at.units, path, name);
    for (const MapAxis& other : plan.axes)
      if (other.key == axis.key)
        refuse(values, path + ".key", name, "expected a key of its own: another axis has it");
    cells *= static_cast<double>(axis.count);
    if (cells > most_cells)
      refuse(values, path + ".count", name, "expected a map of at most 1e9 cells");
    plan.axes.push_back(std::move(axis));
  }
  require_rows(values, rows_of(experiment), name);
  return plan;
}

void require_map(const MapContext& at, const Experiment& experiment) {
  static_cast<void>(without_axes(at, experiment));
  require_rows(at.values, rows_of(experiment), at.name);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
