// SPDX-License-Identifier: MIT
// The rows of [[observation]]: read for a fit, written for a simulation, with the same columns,
// units, clock and axes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polhode/error.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/history_keys.hpp"
#include "scenario/fit/observation_table.hpp"
#include "scenario/values.hpp"
#include "tables/number_table.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

// A Julian date to all its digits: day and fraction as texts.
std::string julian_text(const ephemeris::Date& date, double zero) {
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

std::string date_text(const ephemeris::Date& date) {
  const ephemeris::CalendarTime t = ephemeris::calendar_time(date);
  const double second = std::floor(t.second * 1e9) * 1e-9;
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:012.9f}", t.year, t.month, t.day, t.hour,
                     t.minute, second);
}

}  // namespace

ObservationTable observation_table(const Scenario& scenario, std::size_t index) {
  const FileValues file = file_values(scenario.document);
  ObservationTable table{.scenario = scenario,
                         .of = require_fit(scenario).observations.at(index),
                         .place = placed_observation(file, index)};
  if (table.of.time_format == Observation::TimeFormat::number)
    table.time_unit = table.place.unit<&Observation::time_unit>(Dimension::time);
  else
    table.clock = clock_of(file, table.place.key_path<&Observation::time_format>());
  return table;
}

std::string clock_text(const ObservationTable& of, double t) {
  if (!of.clock) return polhode::detail::number_text(t / of.time_unit);
  const ephemeris::Date date = ephemeris::converted(
      ephemeris::date_after(of.clock->epoch, t / of.clock->second, of.clock->dut1),
      *of.of.time_scale, of.clock->dut1);
  if (of.of.time_format == Observation::TimeFormat::date) return date_text(date);
  return julian_text(
      date, of.of.time_format == Observation::TimeFormat::modified_julian ? modified_zero : 0.0);
}

}  // namespace detail

namespace {

using O = Observation;
using TimeFormat = Observation::TimeFormat;
using detail::modified_zero;
using detail::observation_table;
using detail::ObservationTable;

FieldReader time_reader(const ObservationTable& table) {
  const double lag = table.light_time();
  if (!table.clock)
    return [unit = table.time_unit, lag](std::string_view field) {
      return unit * number_from_field(field) - lag;
    };
  const detail::Clock clock = *table.clock;
  const ephemeris::TimeScale scale = *table.of.time_scale;
  if (table.of.time_format == TimeFormat::date)
    return [=](std::string_view field) {
      return clock.core_time(detail::date_in(field, scale)) - lag;
    };
  const double zero = table.of.time_format == TimeFormat::modified_julian ? modified_zero : 0.0;
  return [=](std::string_view field) {
    return clock.core_time(detail::julian_date(field, scale, zero)) - lag;
  };
}

// What is wrong with a row.
[[noreturn]] void refuse_row(const NumberTable& table, std::size_t row, const std::string& text) {
  throw DomainError(table.file + ":" + std::to_string(table.lines[row]) + ": " + text);
}

void require_order(const ObservationTable& of, const NumberTable& table) {
  const auto shown = [&](double t) {
    return polhode::detail::number_text(of.scenario.units().from_core(t, Dimension::time)) + " " +
           of.scenario.units().time();
  };
  for (std::size_t k = 1; k < table.rows(); ++k) {
    const double t = table.columns[0][k], before = table.columns[0][k - 1];
    if (t < before)
      refuse_row(table, k,
                 "time " + shown(t) + " is before that of the row above, " + shown(before) +
                     "; expected rows in order of time");
    for (std::size_t i = k; i-- > 0 && table.columns[0][i] == t;)
      if (std::all_of(table.columns.begin(), table.columns.end(),
                      [&](const std::vector<double>& c) { return c[i] == c[k]; }))
        refuse_row(table, k,
                   "repeats line " + std::to_string(table.lines[i]) +
                       " in every number; expected each observation once");
  }
}

// The errors of a row in core units: those of the keys, or in its last columns.
std::vector<double> sigmas_of(const ObservedRows& of, const NumberTable& table, std::size_t row) {
  if (!of.sigmas.empty()) return of.sigmas;
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < of.error_units.size(); ++i) {
    const std::size_t place = of.columns.size() + (of.sigma_columns.size() == 1 ? 0 : i);
    const double sigma = table.columns[place][row];
    if (!(sigma > 0.0))
      refuse_row(table, row,
                 "error " + polhode::detail::number_text(sigma) + "; expected one above 0");
    sigmas.push_back(of.error_units[i] * sigma);
  }
  return sigmas;
}

NumberTable rows_of(const ObservationTable& of) {
  const ObservedRows& rows = of.of.rows;
  std::vector<std::string> columns = rows.columns;
  columns.insert(columns.end(), rows.sigma_columns.begin(), rows.sigma_columns.end());
  NumberTable table =
      read_number_table(of.place.file_at<&Observation::file>(), columns, time_reader(of));
  if (table.rows() == 0)
    of.place.refuse<&O::file>("expected a table with rows; this file has none");
  require_order(of, table);
  return table;
}

// The columns of angles that run through whole turns.
void add_small_angles(const ObservationTable& of, const NumberTable& table,
                      std::vector<std::string>& notes) {
  const double degree = of.scenario.units().to_core(1.0, "deg", Dimension::angle);
  for (const std::size_t place : of.of.rows.turning_degrees) {
    std::vector<double> angles = table.columns[place + 1];
    for (double& x : angles) x *= degree;
    if (detail::may_be_radians(angles, degree))
      notes.push_back("the column " + of.of.rows.columns[place + 1] + " of " + of.of.shown() +
                      " is declared in degrees, and none of its numbers exceeds 2 pi: are they "
                      "radians?");
  }
}

// Where rows of a table were read, in the order of the list that they were added to.
void add_places(std::size_t count, const ObservedRow& place, std::vector<ObservedRow>& places) {
  while (places.size() < count) places.push_back(place);
}

void read_table(const ObservationTable& of, std::size_t index, ReadObservations& all) {
  if (of.of.light) return detail::read_light_curves(of, index, all);
  const ObservedRows& rows = of.of.rows;
  const NumberTable table = rows_of(of);
  add_small_angles(of, table, all.notes);
  for (std::size_t k = 0; k < table.rows(); ++k) {
    FileRow row{table.columns[0][k], {}, sigmas_of(rows, table, k)};
    for (std::size_t i = 0; i < rows.numbers; ++i) row.numbers.push_back(table.columns[i + 1][k]);
    try {
      rows.read(row, all.seen);
    } catch (const DomainError& error) {
      refuse_row(table, k, error.what());
    }
    const ObservedRow place{index, table.lines[k]};
    add_places(all.seen.attitudes.size(), place, all.attitudes);
    add_places(all.seen.directions.size(), place, all.directions);
    add_places(all.seen.rates.size(), place, all.rates);
    add_places(all.seen.measurements.size(), place, all.measurements);
  }
}

// The time of a row as its file has it.
std::string time_text(const ObservationTable& of, double t) {
  return detail::clock_text(of, t + of.light_time());
}

void append_row(std::string& text, const ObservationTable& of, const FileRow& row) {
  text += time_text(of, row.t);
  for (const double x : row.numbers) text += "," + polhode::detail::number_text(x);
  text += "\n";
}

void require_names(const ObservationTable& of) {
  for (const std::string& column : of.of.rows.columns)
    if (column.empty() ||
        std::all_of(column.begin(), column.end(), [](char c) { return c >= '0' && c <= '9'; }))
      of.place.at().refuse("columns",
                           "expected names: a simulation has no file whose columns it could "
                           "count");
  if (!of.of.rows.sigma_columns.empty())
    of.place.at().refuse("sigma_columns",
                         "expected sigma or sigmas: a simulation has no file to take errors from");
}

}  // namespace

ReadObservations read_observations(const Scenario& scenario) {
  ReadObservations all;
  for (std::size_t i = 0; i < require_fit(scenario).observations.size(); ++i)
    read_table(observation_table(scenario, i), i, all);
  return all;
}

std::string observation_text(const Scenario& scenario, std::size_t index,
                             const fit::Snapshots& rows, std::span<const std::string> notes) {
  static_cast<void>(require_fit(scenario));
  const ObservationTable of = observation_table(scenario, index);
  require_names(of);
  std::string text;
  for (const std::string& note : notes) text += "# " + note + "\n";
  const std::vector<std::string>& columns = of.of.rows.columns;
  for (const std::string& column : columns) text += (&column == columns.data() ? "" : ",") + column;
  text += "\n";
  for (const FileRow& row : of.of.rows.written(rows)) append_row(text, of, row);
  return text;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
