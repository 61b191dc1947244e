// SPDX-License-Identifier: MIT
#include "scenario/fit/observation_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenario/detail/history_keys.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"
#include "text/number_text.hpp"

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

// A Julian date to all its digits: day and fraction as texts.
std::string julian_text(const Date& date, double zero) {
  const double day = date.day - std::floor(zero), rest = date.fraction - (zero - std::floor(zero));
  double whole = std::floor(day), part = (day - whole) + rest;
  whole += std::floor(part);
  part -= std::floor(part);
  std::string digits = fmt::format("{:.12f}", part);
  if (digits.front() == '1') {  // rounded up to a day
    whole += 1.0;
    digits.front() = '0';
  }
  return fmt::format("{:.0f}{}", whole, digits.substr(1));
}

std::string date_text(const Date& date) {
  const CalendarTime t = calendar_time(date);
  const double second = std::floor(t.second * 1e9) * 1e-9;
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:012.9f}", t.year, t.month, t.day, t.hour,
                     t.minute, second);
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

std::string clock_text(const ObservationTable& of, double t) {
  if (!of.clock) return detail::number_text(t / of.time_unit);
  const Date date = converted(date_after(of.clock->epoch, t / of.clock->second, of.clock->dut1),
                              *of.of.time_scale, of.clock->dut1);
  if (of.of.time_format == Observation::TimeFormat::date) return date_text(date);
  return julian_text(
      date, of.of.time_format == Observation::TimeFormat::modified_julian ? modified_zero : 0.0);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
