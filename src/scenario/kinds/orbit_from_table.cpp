// SPDX-License-Identifier: MIT
// [orbit.NAME] from a table, of its own or in a file.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "polhode/scenario/schema.hpp"
#include "polhode/tables/number_table.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/orbit_kinds.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/detail/table_check.hpp"
#include "scenario/value_access.hpp"
#include "text/date_text.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t longest_file = 200;
constexpr std::array<const char*, 7> usual_names = {"t", "x", "y", "z", "vx", "vy", "vz"};

// The columns that a file has where a scenario names none.
std::vector<std::string> usual_columns(const std::string& path) {
  const std::vector<std::string> own = table_columns(path);
  const auto has = [&](const char* name) {
    return std::find(own.begin(), own.end(), name) != own.end();
  };
  if (own.empty()) throw DomainError(path + ": holds no row");
  if (own.front() == "1")
    return {own.begin(), own.begin() + (own.size() == 7 ? 7 : std::min<long>(4, std::ssize(own)))};
  const bool slopes = std::all_of(usual_names.begin() + 4, usual_names.end(), has);
  return {usual_names.begin(), usual_names.begin() + (slopes ? 7 : 4)};
}

std::vector<std::string> columns_of(const OrbitContext& at, const std::string& path) {
  const std::string key = at.key("columns");
  if (!has(at.values(), key)) {
    const std::vector<std::string> usual = usual_columns(path);
    if (usual.size() < 4)
      throw DomainError(path + ": has " + std::to_string(usual.size()) +
                        " columns; expected time, x, y, z");
    return usual;
  }
  const std::vector<std::string>& columns = value_at(at.values(), key).words;
  if (columns.size() != 4 && columns.size() != 7)
    refuse(at.values(), key, at.name(), "expected 4 columns (t, x, y, z) or 7 (with vx, vy, vz)");
  return columns;
}

// What one unit of a column is in core units.
double unit_of(const OrbitContext& at, const char* key, Dimension dimension, double otherwise) {
  if (!has(at.values(), at.key(key))) return otherwise;
  return built(at.values(), at.key(key), at.name(), [&] {
    return at.file.units.to_core(1.0, word(at.values(), at.key(key)), dimension);
  });
}

// How the column of times is read, into core units.
FieldReader time_reader(const OrbitContext& at) {
  const std::string& format = word(at.values(), at.key("time_format"));
  if (format == "number") {
    const double unit = unit_of(at, "time_unit", Dimension::time, 1.0);
    return [unit](std::string_view field) { return unit * number_from_field(field); };
  }
  if (has(at.values(), at.key("time_unit")))
    refuse(at.values(), at.key("time_unit"), at.name(), "expected no unit together with dates");
  const Clock clock = clock_of(at.values(), at.file.units, at.key("time_format"), at.name());
  const TimeScale scale = *time_scale(word(at.values(), at.key("time_scale")));
  if (format == "date")
    return [=](std::string_view field) { return clock.core_time(date_in(field, scale)); };
  const double zero = format == "MJD" ? 2400000.5 : 0.0;
  return [=](std::string_view field) { return clock.core_time(julian_date(field, scale, zero)); };
}

// What the file says of itself must be how it is read.
void require_header(const OrbitContext& at, const NumberTable& file,
                    const std::vector<std::string>& columns) {
  const TableCheck check({at.values(), at.file.units, at.path, at.name()}, file, columns);
  const double time = unit_of(at, "time_unit", Dimension::time, 1.0);
  const double length = unit_of(at, "length_unit", Dimension::length, 1.0);
  const double speed = unit_of(at, "velocity_unit", Dimension::speed, length / time);
  check.axes(orbit_axes(at));
  for (std::size_t k = 1; k < columns.size(); ++k) {
    if (k < 4)
      check.unit(k, {"length_unit", length, Dimension::length});
    else
      check.unit(k, {"velocity_unit", speed, Dimension::speed});
  }
  if (word(at.values(), at.key("time_format")) != "number")
    return check.scale(word(at.values(), at.key("time_scale")));
  check.unit(0, {"time_unit", time, Dimension::time});
  check.epoch();
}

// Components that are columns of this file, each as long as the times.
std::vector<Vec3> own_rows(const OrbitContext& at, const std::array<const char*, 3>& names,
                           std::size_t count) {
  std::vector<Vec3> rows(count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string key = at.key(names[static_cast<std::size_t>(axis)]);
    const std::vector<double>& column = value_at(at.values(), key).numbers;
    if (column.size() != count)
      refuse(at.values(), key, at.name(),
             "expected " + std::to_string(count) + " numbers, as many as times has");
    for (std::size_t k = 0; k < count; ++k) rows[k][axis] = column[k];
  }
  const std::string &axes = orbit_axes(at), &of_state = word(at.values(), "state.axes");
  for (Vec3& row : rows) row = in_other_axes(row, axes, of_state);
  return rows;
}

// Rows that stand in the scenario itself.
PositionTable own_table(const OrbitContext& at) {
  for (const char* own :
       {"columns", "time_format", "time_scale", "time_unit", "length_unit", "velocity_unit"})
    if (is_explicit(at.values(), at.key(own)))
      refuse(at.values(), at.key(own), at.name(), "expected a key file as well, not times");
  PositionTable table{value_at(at.values(), at.key("times")).numbers, {}, {}};
  table.positions = own_rows(at, {"x", "y", "z"}, table.times.size());
  constexpr std::array<const char*, 3> slopes = {"vx", "vy", "vz"};
  const auto is_there = [&](const char* own) { return has(at.values(), at.key(own)); };
  if (std::all_of(slopes.begin(), slopes.end(), is_there)) {
    table.velocities = own_rows(at, slopes, table.times.size());
  } else {
    for (const char* own : slopes)
      if (is_there(own))
        refuse(at.values(), at.key(own), at.name(), "expected vx, vy and vz, or none of them");
  }
  return table;
}

PositionTable positions_of(const OrbitContext& at, const NumberTable& file) {
  const double time = unit_of(at, "time_unit", Dimension::time, 1.0);  // without: core units
  const double length = unit_of(at, "length_unit", Dimension::length, 1.0);
  const double speed = unit_of(at, "velocity_unit", Dimension::speed, length / time);
  const std::string& axes = orbit_axes(at);
  const std::string& of_state = word(at.values(), "state.axes");
  const auto rows = [&](std::size_t first, double unit) {
    std::vector<Vec3> vectors;
    vectors.reserve(file.rows());
    const auto& c = file.columns;
    for (std::size_t k = 0; k < file.rows(); ++k)
      vectors.push_back(in_other_axes(
          {unit * c[first][k], unit * c[first + 1][k], unit * c[first + 2][k]}, axes, of_state));
    return vectors;
  };
  PositionTable table{file.columns[0], rows(1, length), {}};
  if (file.columns.size() == 7) table.velocities = rows(4, speed);
  return table;
}

std::string file_path(const OrbitContext& at) {
  const std::filesystem::path folder = std::filesystem::path(at.name()).parent_path();
  return (folder / word(at.values(), at.key("file"))).string();
}

std::string own_name(const OrbitContext& at) { return std::string(key_name(at.path)); }

TableOrbit orbit_of_rows(const OrbitContext& at, PositionTable rows, int order, bool dates) {
  const double overhang = overhang_of(at, rows.times, dates);
  return TableOrbit(std::move(rows), order, overhang);
}

ScenarioOrbit file_orbit(const OrbitContext& at, int order) {
  const std::string path = file_path(at);
  for (const char* own : {"vx", "vy", "vz"})
    if (has(at.values(), at.key(own)))
      refuse(at.values(), at.key(own), at.name(), "expected keys times, x, y and z as well");
  if (path.ends_with(".oem")) return oem_orbit(at, path, order);
  const std::vector<std::string> columns = columns_of(at, path);
  const NumberTable file = read_number_table(path, columns, time_reader(at));
  require_header(at, file, columns);
  require_rising(file, 0, "time");
  const bool dates = word(at.values(), at.key("time_format")) != "number";
  return {own_name(at),
          orbit_of_rows(at, positions_of(at, file), order, dates),
          own_gm(at),
          {},
          "table " + printable(word(at.values(), at.key("file")), longest_file)};
}

}  // namespace

double overhang_of(const OrbitContext& at, const std::vector<double>& times, bool dates) {
  constexpr double of_dates = 2e-3, share = 1e-3;  // s, and of the spacing
  if (times.size() < 2) return 0.0;
  const double first = times.front(), last = times.back();
  const double rounding =
      dates ? at.file.units.to_core(of_dates, "s", Dimension::time)
            : 8.0 * epsilon<double>() * std::max(std::fabs(first), std::fabs(last));
  const double most = share * (last - first) / static_cast<double>(times.size() - 1);
  return std::max(0.0, std::min(rounding, most));
}

void require_cover(const OrbitContext& at, const char* key, const TableOrbit& orbit) {
  const std::optional<TimeSpan> span = run_span(at);
  if (!span || orbit.covers(span->first, span->last)) return;
  const auto text = [&](double t) {
    return number_text(at.file.units.from_core(t, Dimension::time));
  };
  refuse(at.values(), at.key(key), at.name(),
         "it covers the times " + text(orbit.first_time()) + " to " + text(orbit.last_time()) +
             " " + at.file.units.time() + "; expected all of the run, " + text(span->first) +
             " to " + text(span->last) + " (t = 0 is part of it)");
}

ScenarioOrbit table_orbit(const OrbitContext& at) {
  const int order = has(at.values(), at.key("order"))
                        ? static_cast<int>(std::clamp<std::int64_t>(
                              value_at(at.values(), at.key("order")).whole, 1, 99))
                        : 0;
  const char* const rows = has(at.values(), at.key("times")) ? "times" : "file";
  const ScenarioOrbit orbit = built(at.values(), at.key(rows), at.name(), [&]() -> ScenarioOrbit {
    if (rows == std::string_view("file")) return file_orbit(at, order);
    return {own_name(at), orbit_of_rows(at, own_table(at), order, false), own_gm(at), {}, "table"};
  });
  require_cover(at, rows, std::get<TableOrbit>(orbit.motion));
  return orbit;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
