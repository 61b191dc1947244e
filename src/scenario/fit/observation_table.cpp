// SPDX-License-Identifier: MIT
#include "scenario/fit/observation_table.hpp"

#include "scenario/detail/history_keys.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

Quaternion axes_turn(const Observation& of, const std::string& state_axes) {
  const bool is_lc =
      of.kind == Observation::Kind::light_curve && of.light_format == Observation::LightFormat::lc;
  if (!is_lc && (!of.axes || *of.axes == Observation::Axes::inertial)) return {};
  const char* const own =
      is_lc || *of.axes == Observation::Axes::ecliptic ? "ecliptic-J2000" : "equator-J2000";
  if (own == state_axes) return {};
  return conj(ecliptic_from(state_axes)) * ecliptic_from(own);
}

}  // namespace

std::string observation_path(std::size_t table) {
  return "observation[" + std::to_string(table) + "]";
}

ObservationTable observation_table(const Scenario& scenario, std::size_t index,
                                   const std::string& path) {
  const Document& file = scenario.document;
  const Observation& of = require_fit(scenario).observations.at(index);
  const Values& values = file.checked->values;
  ObservationTable table{.scenario = scenario,
                         .of = of,
                         .keys = KeyValues(values, file.units, path, file.path),
                         .to_state = axes_turn(of, word(values, "state.axes"))};
  const bool is_rate = of.kind == Observation::Kind::rate;
  const auto own = [&](const char* key, Dimension dimension) {
    return table.keys.has(key) ? table.keys.unit(key, dimension)
                               : file.units.to_core(1.0, dimension);
  };
  table.value_unit =
      is_rate ? own("rate_unit", Dimension::rate) : own("angle_unit", Dimension::angle);
  if (of.time_format == Observation::TimeFormat::number)
    table.time_unit = table.keys.unit("time_unit", Dimension::time);
  else
    table.clock = clock_of(values, file.units, path + ".time_format", file.path);
  return table;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
