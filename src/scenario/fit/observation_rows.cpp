// SPDX-License-Identifier: MIT
// The rows of [[observation]]: read for a fit, written for a simulation, with the same columns,
// units, clock and axes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polhode/error.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/tables/number_table.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/history_keys.hpp"
#include "scenario/fit/observation_table.hpp"
#include "scenario/tables/state.hpp"
#include "scenario/values.hpp"
#include "text/dates.hpp"
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

ObservationTable observation_table(const Scenario& scenario, std::size_t index) {
  const FileValues file = file_values(scenario.document);
  const Observation& of = require_fit(scenario).observations.at(index);
  ObservationTable table{.scenario = scenario,
                         .of = of,
                         .place = placed_observation(file, index),
                         .to_state = axes_turn(of, state_table(file)->axes)};
  const Dimension dimension =
      of.kind == Observation::Kind::rate ? Dimension::rate : Dimension::angle;
  table.value_unit = of.value_unit.empty() ? file.units.to_core(1.0, dimension)
                                           : table.place.unit<&Observation::value_unit>(dimension);
  if (of.time_format == Observation::TimeFormat::number)
    table.time_unit = table.place.unit<&Observation::time_unit>(Dimension::time);
  else
    table.clock = clock_of(file, table.place.key_path<&Observation::time_format>());
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

namespace {

using O = Observation;
using Kind = Observation::Kind;
using Form = Observation::Form;
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
  const TimeScale scale = *table.of.time_scale;
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
    return detail::number_text(of.scenario.units().from_core(t, Dimension::time)) + " " +
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

// The numbers of a row after its time and before its errors.
class RowReader {
 public:
  RowReader(const ObservationTable& of, const NumberTable& table) : of_(of), table_(table) {}

  double at(std::size_t place, std::size_t row) const { return table_.columns[place + 1][row]; }
  double value(std::size_t place, std::size_t row) const { return of_.value_unit * at(place, row); }

  Quaternion attitude_at(std::size_t row) const {
    const auto in_state = [&](const Quaternion& q) { return normalized(of_.to_state * q); };
    if (of_.of.form == Form::euler)
      return in_state(attitude(EulerAngles{value(0, row), value(1, row), value(2, row)}));
    try {
      if (of_.of.form == Form::quaternion)
        return in_state(unit_quaternion(at(0, row), at(1, row), at(2, row), at(3, row)));
      Mat3 R;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int place = 3 * i + j;
          R(i, j) = at(static_cast<std::size_t>(place), row);
        }
      return in_state(attitude(R));
    } catch (const DomainError& error) {
      refuse_row(table_, row, error.what());
    }
  }
  Vec3 direction_at(std::size_t row) const {
    if (of_.of.form == Form::angles) {
      const double lon = value(0, row), lat = value(1, row);
      return rotate(of_.to_state, Vec3{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon),
                                       std::sin(lat)});
    }
    const Vec3 d{at(0, row), at(1, row), at(2, row)};
    if (!(norm(d) > 0.0)) refuse_row(table_, row, "direction 0, 0, 0; expected one with a length");
    return rotate(of_.to_state, d);
  }
  Vec3 rate_at(std::size_t row) const { return {value(0, row), value(1, row), value(2, row)}; }

  Vec3 sigma_at(std::size_t row) const {
    if (of_.of.sigma) return {*of_.of.sigma, *of_.of.sigma, *of_.of.sigma};
    if (of_.of.sigmas) return *of_.of.sigmas;
    const std::size_t first = of_.of.columns.size() - 1, count = of_.of.sigma_columns.size();
    Vec3 sigma;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t place = first + (count == 1 ? 0 : i);
      if (!(at(place, row) > 0.0))
        refuse_row(table_, row,
                   "error " + detail::number_text(at(place, row)) + "; expected one above 0");
      sigma[static_cast<int>(i)] = value(place, row);
    }
    return sigma;
  }

 private:
  const ObservationTable& of_;
  const NumberTable& table_;
};

NumberTable rows_of(const ObservationTable& of) {
  std::vector<std::string> columns = of.of.columns;
  columns.insert(columns.end(), of.of.sigma_columns.begin(), of.of.sigma_columns.end());
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
  if (of.value_unit != degree) return;
  for (std::size_t place = 0; place < 3; ++place) {
    const bool turns =
        of.of.form == Form::angles ? place == 0 : of.of.form == Form::euler && place != 1;
    if (!turns) continue;
    std::vector<double> angles = table.columns[place + 1];
    for (double& x : angles) x *= degree;
    if (detail::may_be_radians(angles, degree))
      notes.push_back("the column " + of.of.columns[place + 1] + " of " + of.of.shown() +
                      " is declared in degrees, and none of its numbers exceeds 2 pi: are they "
                      "radians?");
  }
}

void read_table(const ObservationTable& of, std::size_t index, ReadObservations& all) {
  if (of.of.kind == Kind::light_curve) return detail::read_light_curves(of, index, all);
  const NumberTable table = rows_of(of);
  add_small_angles(of, table, all.notes);
  const RowReader read(of, table);
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const double t = table.columns[0][k];
    const Vec3 sigma = read.sigma_at(k);
    const ObservedRow place{index, table.lines[k]};
    switch (of.of.kind) {
      case Kind::attitude:
        all.seen.attitudes.push_back({t, read.attitude_at(k), covariance_of(sigma)});
        all.attitudes.push_back(place);
        break;
      case Kind::direction:
        all.seen.directions.push_back({t, of.of.axis, read.direction_at(k), sigma.x});
        all.directions.push_back(place);
        break;
      case Kind::rate:
        all.seen.rates.push_back({t, read.rate_at(k), covariance_of(sigma)});
        all.rates.push_back(place);
        break;
      case Kind::light_curve:  // above
        break;
    }
  }
}

// The time of a row as its file has it.
std::string time_text(const ObservationTable& of, double t) {
  return detail::clock_text(of, t + of.light_time());
}

std::vector<double> numbers_of(const ObservationTable& of, const Quaternion& q_state) {
  const Quaternion q = conj(of.to_state) * q_state;
  const double unit = of.value_unit;
  if (of.of.form == Form::quaternion) return {q.w, q.x, q.y, q.z};
  if (of.of.form == Form::euler) {
    const EulerAngles e = euler_angles(q);
    return {e.phi / unit, e.theta / unit, e.psi / unit};
  }
  const Mat3 R = attitude_matrix(q);
  std::vector<double> numbers;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) numbers.push_back(R(i, j));
  return numbers;
}

std::vector<double> numbers_of(const ObservationTable& of, const Vec3& d_state) {
  const Vec3 d = rotate(conj(of.to_state), d_state);
  if (of.of.form == Form::vector) return {d.x, d.y, d.z};
  return {std::atan2(d.y, d.x) / of.value_unit,
          std::atan2(d.z, std::hypot(d.x, d.y)) / of.value_unit};
}

void append_row(std::string& text, const ObservationTable& of, double t,
                const std::vector<double>& numbers) {
  text += time_text(of, t);
  for (const double x : numbers) text += "," + detail::number_text(x);
  text += "\n";
}

void require_names(const ObservationTable& of) {
  for (const std::string& column : of.of.columns)
    if (column.empty() ||
        std::all_of(column.begin(), column.end(), [](char c) { return c >= '0' && c <= '9'; }))
      of.place.refuse<&O::columns>(
          "expected names: a simulation has no file whose columns it could "
          "count");
  if (!of.of.sigma_columns.empty())
    of.place.refuse<&O::sigma_columns>(
        "expected sigma or sigmas: a simulation has no file to take errors from");
}

}  // namespace

ReadObservations read_observations(const Scenario& scenario) {
  ReadObservations all;
  for (std::size_t i = 0; i < require_fit(scenario).observations.size(); ++i)
    read_table(observation_table(scenario, i), i, all);
  return all;
}

std::string observation_text(const Scenario& scenario, std::size_t index, const Snapshots& rows,
                             std::span<const std::string> notes) {
  static_cast<void>(require_fit(scenario));
  const ObservationTable of = observation_table(scenario, index);
  require_names(of);
  std::string text;
  for (const std::string& note : notes) text += "# " + note + "\n";
  for (const std::string& column : of.of.columns)
    text += (&column == of.of.columns.data() ? "" : ",") + column;
  text += "\n";
  for (const ObservedAttitude& one : rows.attitudes)
    append_row(text, of, one.t, numbers_of(of, one.q));
  for (const ObservedDirection& one : rows.directions)
    append_row(text, of, one.t, numbers_of(of, one.direction_I));
  for (const ObservedRate& one : rows.rates)
    append_row(text, of, one.t,
               {one.w_F.x / of.value_unit, one.w_F.y / of.value_unit, one.w_F.z / of.value_unit});
  return text;
}

}  // namespace v0
}  // namespace polhode
