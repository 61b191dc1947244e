// SPDX-License-Identifier: MIT
#include "scenario/tables/map.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/output/column_kind.hpp"
#include "scenario/number_location.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/state.hpp"
#include "scenario/tables/time.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::int64_t most_cells = 1'000'000'000;
constexpr std::int64_t least_samples = 8;  // of spectrum

struct MapTable {
  MapKind kind = MapKind::chaos;
  std::string column, orbit;
  std::optional<analysis::AndoyerAngle> angle;
  double value = 0.0;
  Crossing crossing = Crossing::rising;
  std::optional<double> period;
  double epoch = 0.0;
};

constexpr std::array keys_of_map = {
    choice_key<&MapTable::kind, MapKind::chaos, MapKind::column, MapKind::andoyer_section,
               MapKind::spin_orbit_section, MapKind::frequency>(
        "kind", "chaos|column|andoyer-section|spin-orbit-section|frequency",
        "What a cell gives: mean MEGNO and Lyapunov indicator; the extremes and the last "
        "value of a column; or a row for every point of a surface of section: Andoyer's "
        "elements, or angle, spin and tilt at every pericentre. Of a file of kind "
        "\"obliquity\": a column, or the frequency of the precession in the first and in the "
        "second half of the rows, and by what fraction it changed, which shows chaos.")
        .required()
        .example("\"chaos\""),
    text_key<&MapTable::column>("column", "Any column but t, of any group, at the rows of [time].")
        .required()
        .example("\"theta\"")
        .of_kinds("column"),
    text_key<&MapTable::orbit>(
        "orbit", "The name of an ellipse of this file, e > 0: its pericentres are the section.")
        .required()
        .example("\"saturn\"")
        .of_kinds("spin-orbit-section"),
    choice_key<&MapTable::angle, analysis::AndoyerAngle::l, analysis::AndoyerAngle::g,
               analysis::AndoyerAngle::h>(
        "angle", "l|g|h",
        "The section is where this angle of Andoyer's passes a value; g or h for the plane of "
        "l and L.")
        .alternative()
        .example("\"g\"")
        .of_kinds("andoyer-section"),
    quantity_key<&MapTable::value>("value", Dimension::angle, "That value, modulo a turn.")
        .otherwise("0")
        .of_kinds("andoyer-section"),
    choice_key<&MapTable::crossing, Crossing::both, Crossing::rising, Crossing::falling>(
        "crossing", "both|rising|falling", "Which passages count.")
        .otherwise("\"rising\"")
        .of_kinds("andoyer-section"),
    quantity_key<&MapTable::period>("period", Dimension::time,
                                    "The section is once in a period, as that of what acts.")
        .alternative()
        .example("1")
        .of_kinds("andoyer-section")
        .positive(),
    quantity_key<&MapTable::epoch>("epoch", Dimension::time,
                                   "One of the times of a section by period.")
        .otherwise("0")
        .of_kinds("andoyer-section"),
};
constexpr Alternatives sets_of_map[] = {{"map", "angle|period", "andoyer-section"}};
constexpr Table<MapTable> map_description = {
    {.path = "map",
     .help = "What `polhode map` makes: one run for every cell of a grid, up to the last row of "
             "[time]."},
    keys_of_map,
    sets_of_map};

constexpr std::array keys_of_axis = {
    text_key<&MapAxis::key>(
        "key",
        "A number of this file by its keys, also one with a fallback; perturbation[0] is the "
        "first of its tables, omega_body[2] the third number of an array, body.tensor[0][1] a "
        "product of inertia with its mirror.")
        .required()
        .example("\"state.attitude-rate.omega_body[2]\""),
    quantity_key<&MapAxis::from>(
        "from", Dimension::number,
        "Its first value, in the unit that the key has in this file: its own, where it was written "
        "with one, or that of [units].")
        .required()
        .example("0"),
    quantity_key<&MapAxis::to>("to", Dimension::number, "Its last value.").required().example("1"),
    integer_key<&MapAxis::count>("count", "How many values, both ends included; 1 takes from.")
        .from_to(1, most_cells, "1e9")
        .required()
        .example("11"),
};
constexpr Table<MapAxis> axis_description = {
    {.path = "map.axis[]",
     .help = "The axes of the grid; the last one runs fastest. A section without an axis has one "
             "start.",
     .needed_by = "chaos|column|frequency"},
    keys_of_axis};

MapAxis axis_of(const Placed<MapAxis>& from) {
  const Values& values = from.at().values();
  MapAxis axis = *from;
  const std::optional<NumberLocation> place = number_location(values, axis.key);
  if (!place) {
    const std::vector<std::string> paths = number_keys(values, axis.key);
    const std::vector<std::string_view> known(paths.begin(), paths.end());
    from.refuse<&MapAxis::key>(
        "expected a key that holds a number and stands in this file or has a fallback, such as "
        "state.euler.theta or planet.pole.dec" +
        did_you_mean(axis.key, known));
  }
  axis.unit = unit_in_file(value_at(values, place->path), place->index, from.at().units());
  return axis;
}

std::string column_of(const Placed<MapTable>& map, const System& system,
                      const ColumnKinds& columns) {
  const std::string& column = map->column;
  const std::vector<std::string_view> known = column_names(columns);
  if (std::ranges::find(known, column) == known.end())
    map.refuse<&MapTable::column>(
        "expected a column such as \"theta\", \"L\" or \"w3\" (docs/reference/files.md)" +
        did_you_mean(column, known));
  if (columns.needs_energy(column) && !system.has_energy())
    map.refuse<&MapTable::column>("expected another column, since a perturbation has no energy");
  if (columns.needs_damper(column) && !system.damper())
    map.refuse<&MapTable::column>("expected a perturbation of kind \"kane-damper\" for it");
  const bool equator = state_table(map.at().file_values())->axes == "equator-J2000";
  if (column.starts_with("pole_") && equator != (column == "pole_ra" || column == "pole_dec"))
    map.refuse<&MapTable::column>(std::string("expected ") +
                                  (equator ? "pole_ra or pole_dec" : "pole_lon or pole_lat") +
                                  ", by state.axes");
  return column;
}

analysis::SectionSurface surface_of(const Placed<MapTable>& map) {
  if (map->angle) {
    map.refuse_any<&MapTable::epoch>("expected only with period");
    return analysis::AndoyerSurface{*map->angle, map->value, map->crossing};
  }
  map.refuse_any<&MapTable::value, &MapTable::crossing>("expected only with angle");
  return analysis::Strobe{*map->period, map->epoch};
}

std::string section_orbit(const Placed<MapTable>& map, const std::vector<ScenarioOrbit>& orbits) {
  const KeyValues& at = map.at();
  const ScenarioOrbit& orbit =
      orbit_named(orbits, at.values(), at.key_path(map.name<&MapTable::orbit>()), at.file());
  const KeplerElements* const elements = kepler_elements(orbit);
  if (elements == nullptr)
    map.refuse<&MapTable::orbit>("expected an orbit with elements: others have no pericentre");
  map.built<&MapTable::orbit>([&] { analysis::require_pericentres(*elements, "map"); });
  return orbit.name;
}

// The plan without its axes.
MapPlan plan_of(const Rotation& rotation, const Placed<MapTable>& map, const ColumnKinds& columns) {
  MapPlan plan{.kind = map->kind};
  switch (map->kind) {
    case MapKind::chaos:
      if (rotation.damper)
        map.refuse<&MapTable::kind>(
            "expected another kind, since the state of a Kane damper has no indicator of chaos");
      break;
    case MapKind::column:
      plan.column = column_of(map, rotor_system(rotation), columns);
      plan.unit = map.at().units().label(column_dimension(plan.column, columns));
      break;
    case MapKind::andoyer_section:
      plan.surface = surface_of(map);
      break;
    case MapKind::spin_orbit_section:
      plan.orbit = section_orbit(map, rotation.orbits);
      break;
    case MapKind::frequency:
      map.refuse<&MapTable::kind>(
          "expected \"chaos\", \"column\", \"andoyer-section\" or \"spin-orbit-section\", since "
          "the frequency is that of the precession in a file of kind \"obliquity\"");
  }
  return plan;
}

MapPlan plan_of(const Obliquity& of, const Placed<MapTable>& map, const ColumnKinds&) {
  if (map->kind == MapKind::frequency) {
    if (of.time && of.time->size() < 2 * least_samples)
      time_table(map.at().file_values())
          .refuse("expected 16 rows or more, since each half of them has a frequency");
    return {.kind = MapKind::frequency};
  }
  if (map->kind != MapKind::column)
    map.refuse<&MapTable::kind>(
        "expected \"column\" or \"frequency\" in a file of kind \"obliquity\"");
  const std::string& column = map->column;
  const SpinColumn* const found = spin_column(column);
  if (found == nullptr) {
    const std::vector<std::string_view> known = spin_column_names();
    map.refuse<&MapTable::column>("expected a column of kind \"obliquity\": " + one_of(known) +
                                  did_you_mean(column, known));
  }
  if (column == "insolation" && !of.insolation)
    map.refuse<&MapTable::column>("expected a table planet.insolation for the column insolation");
  return {.kind = MapKind::column, .column = column, .unit = unit_of(*found, map.at().units())};
}

MapPlan plan_of(const CustomExperiment& of, const Placed<MapTable>& map, const ColumnKinds&) {
  map.refuse("kind: got \"" + of.kind + "\"; expected \"rotation\" or \"obliquity\"");
}

MapPlan without_axes(const Placed<MapTable>& map, const ColumnKinds& columns,
                     const Experiment& experiment) {
  return std::visit([&](const auto& of) { return plan_of(of, map, columns); }, experiment);
}

void require_rows(const Placed<MapTable>& map, const std::optional<SaveAt>& time) {
  if (!time) map.refuse("expected a table [time] as well");
  const SaveAt& rows = *time;
  const double first = rows[0], last = rows[rows.size() - 1];
  if (last == 0.0 || first * last < 0.0 || rows.is_list())
    time_table(map.at().file_values())
        .refuse(
            "expected, for a map, rows by step or count on one side of t = 0, where cells start");
}

}  // namespace

SchemaPart map_keys() { return part_of<map_description, axis_description>(); }

std::optional<MapPlan> map_plan(const FileValues& file, const ColumnKinds& columns,
                                const Experiment& experiment) {
  const Placed<MapTable> map(map_description, file);
  if (!map.is_there()) return std::nullopt;
  MapPlan plan = without_axes(map, columns, experiment);
  double cells = 1.0;
  for (const Placed<MapAxis>& one : placed_tables(axis_description, file)) {
    MapAxis axis = axis_of(one);
    if (std::ranges::find(plan.axes, axis.key, &MapAxis::key) != plan.axes.end())
      one.refuse<&MapAxis::key>("expected a key of its own: another axis has it");
    cells *= static_cast<double>(axis.count);
    if (cells > static_cast<double>(most_cells))
      one.refuse<&MapAxis::count>("expected a map of at most 1e9 cells");
    plan.axes.push_back(std::move(axis));
  }
  require_rows(map, rows_of(experiment));
  return plan;
}

}  // namespace detail

void require_map(const Scenario& scenario, const Experiment& cell) {
  const Document& of = scenario.document;
  const detail::Placed<detail::MapTable> map(detail::map_description, detail::file_values(of));
  static_cast<void>(detail::without_axes(map, of.kinds->columns(), cell));
  detail::require_rows(map, detail::rows_of(cell));
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
