// SPDX-License-Identifier: MIT
// [orbit.NAME] from a table, of its own or in a file.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "polhode/scenario/schema.hpp"
#include "polhode/tables/number_table.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/other_names.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/detail/table_check.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "scenario/value_access.hpp"
#include "tables/table_header.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr Key keys[] = {
    orbit_gm_key,
    orbit_axes_key,
    {.path = "times",
     .type = KeyType::numbers,
     .presence = Presence::alternative,
     .dimension = Dimension::time,
     .example = "[0, 240, 480, 720]",
     .help = "Times of rows that stand here, rising, from t = 0."},
    {.path = "x",
     .type = KeyType::numbers,
     .presence = Presence::alternative,
     .dimension = Dimension::length,
     .example = "[149597871, 147389966, 140831424, 130115839]",
     .help = "The first component of the positions in these rows."},
    {.path = "y",
     .type = KeyType::numbers,
     .presence = Presence::alternative,
     .dimension = Dimension::length,
     .example = "[0, 25607048, 50458230, 73819993]",
     .help = "The second."},
    {.path = "z",
     .type = KeyType::numbers,
     .presence = Presence::alternative,
     .dimension = Dimension::length,
     .example = "[0, 0, 0, 0]",
     .help = "The third."},
    {.path = "vx",
     .type = KeyType::numbers,
     .dimension = Dimension::speed,
     .example = "[0, -18354, -36166, -52910]",
     .help = "The first component of their velocities; all three, or none."},
    {.path = "vy",
     .type = KeyType::numbers,
     .dimension = Dimension::speed,
     .example = "[107224, 105642, 100941, 93260]",
     .help = "The second."},
    {.path = "vz",
     .type = KeyType::numbers,
     .dimension = Dimension::speed,
     .example = "[0, 0, 0, 0]",
     .help = "The third."},
    {.path = "file",
     .type = KeyType::text,
     .presence = Presence::alternative,
     .example = "\"moon.csv.gz\"",
     .help = "A table of positions, CSV or separated by blanks, .gz or not, or a CCSDS Orbit "
             "Ephemeris Message (.oem, .oem.gz); the path is from the folder of this file.",
     .is_file = true},
    {.path = "columns",
     .type = KeyType::columns,
     .example = "[\"t\", \"x\", \"y\", \"z\"]",
     .help =
         "Columns that hold time, x, y, z and, where there are seven, the velocity: by the names "
         "that the file gives them or by their numbers from 1. Left out: t, x, y, z and, if "
         "there, vx, vy, vz, or where no line names them, the first four or seven."},
    {.path = "time_format",
     .type = KeyType::choice,
     .allowed = "number|JD|MJD|date",
     .fallback = "\"number\"",
     .example = "\"number\"",
     .help = "What the column of times holds: time from t = 0, Julian dates, modified ones, or "
             "dates like 2013-01-05T18:30:00. All but the first need `state.epoch`."},
    {.path = "time_scale",
     .type = KeyType::choice,
     .allowed = "UTC|TAI|TT|TDB",
     .fallback = "\"TT\"",
     .example = "\"TDB\"",
     .help = "Time scale of these dates."},
    {.path = "time_unit",
     .type = KeyType::unit,
     .example = "\"s\"",
     .help = "Unit of the column of times, which count from t = 0; left out, `units.time`."},
    {.path = "length_unit",
     .type = KeyType::unit,
     .example = "\"km\"",
     .help = "Unit of x, y, z; left out, `units.length`."},
    {.path = "velocity_unit",
     .type = KeyType::unit,
     .example = "\"km/s\"",
     .help = "Unit of the velocities; left out, that of lengths over that of times."},
    {.path = "order",
     .type = KeyType::integer,
     .example = "10",
     .help = "Order of the interpolation: 2 to 16, even; with velocities 4 to 32, a multiple of "
             "4. Left out: 10, with velocities 12."},
    allow_coarse_key,
};

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
  const std::string key = at.key_path("columns");
  if (!has(at.values(), key)) {
    std::vector<std::string> usual = usual_columns(path);
    if (usual.size() < 4)
      throw DomainError(path + ": has " + std::to_string(usual.size()) +
                        " columns; expected time, x, y, z");
    return usual;
  }
  const std::vector<std::string>& columns = value_at(at.values(), key).words;
  if (columns.size() != 4 && columns.size() != 7)
    refuse(at.values(), key, at.file(), "expected 4 columns (t, x, y, z) or 7 (with vx, vy, vz)");
  return columns;
}

// What one unit of a column is in core units.
double unit_of(const OrbitContext& at, const char* key, Dimension dimension, double otherwise) {
  if (!has(at.values(), at.key_path(key))) return otherwise;
  return built(at.values(), at.key_path(key), at.file(), [&] {
    return at.units().to_core(1.0, word(at.values(), at.key_path(key)), dimension);
  });
}

// How the column of times is read, into core units.
FieldReader time_reader(const OrbitContext& at) {
  const std::string& format = word(at.values(), at.key_path("time_format"));
  if (format == "number") {
    const double unit = unit_of(at, "time_unit", Dimension::time, 1.0);
    return [unit](std::string_view field) { return unit * number_from_field(field); };
  }
  if (has(at.values(), at.key_path("time_unit")))
    refuse(at.values(), at.key_path("time_unit"), at.file(),
           "expected no unit together with dates");
  const Clock clock = clock_of(at.file_values(), at.key_path("time_format"));
  const TimeScale scale = *time_scale(word(at.values(), at.key_path("time_scale")));
  if (format == "date")
    return [=](std::string_view field) { return clock.core_time(date_in(field, scale)); };
  const double zero = format == "MJD" ? 2400000.5 : 0.0;
  return [=](std::string_view field) { return clock.core_time(julian_date(field, scale, zero)); };
}

// What the file says of itself must be how it is read.
void require_header(const OrbitContext& at, const NumberTable& file,
                    const std::vector<std::string>& columns) {
  const TableCheck check({at.values(), at.units(), at.path(), at.file()}, file, columns);
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
  if (word(at.values(), at.key_path("time_format")) != "number")
    return check.scale(word(at.values(), at.key_path("time_scale")));
  check.unit(0, {"time_unit", time, Dimension::time});
  check.epoch();
}

// Components that are columns of this file, each as long as the times.
std::vector<Vec3> own_rows(const OrbitContext& at, const std::array<const char*, 3>& names,
                           std::size_t count) {
  std::vector<Vec3> rows(count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string key = at.key_path(names[static_cast<std::size_t>(axis)]);
    const std::vector<double>& column = value_at(at.values(), key).numbers;
    if (column.size() != count)
      refuse(at.values(), key, at.file(),
             "expected " + std::to_string(count) + " numbers, as many as times has");
    for (std::size_t k = 0; k < count; ++k) rows[k][axis] = column[k];
  }
  const std::string &axes = orbit_axes(at), &of_state = at.state_axes();
  for (Vec3& row : rows) row = in_other_axes(row, axes, of_state);
  return rows;
}

// Rows that stand in the scenario itself.
PositionTable own_table(const OrbitContext& at) {
  for (const char* own :
       {"columns", "time_format", "time_scale", "time_unit", "length_unit", "velocity_unit"})
    if (is_explicit(at.values(), at.key_path(own)))
      refuse(at.values(), at.key_path(own), at.file(), "expected a key file as well, not times");
  PositionTable table{value_at(at.values(), at.key_path("times")).numbers, {}, {}};
  table.positions = own_rows(at, {"x", "y", "z"}, table.times.size());
  constexpr std::array<const char*, 3> slopes = {"vx", "vy", "vz"};
  const auto is_there = [&](const char* own) { return has(at.values(), at.key_path(own)); };
  if (std::all_of(slopes.begin(), slopes.end(), is_there)) {
    table.velocities = own_rows(at, slopes, table.times.size());
  } else {
    for (const char* own : slopes)
      if (is_there(own))
        refuse(at.values(), at.key_path(own), at.file(), "expected vx, vy and vz, or none of them");
  }
  return table;
}

PositionTable positions_of(const OrbitContext& at, const NumberTable& file) {
  const double time = unit_of(at, "time_unit", Dimension::time, 1.0);  // without: core units
  const double length = unit_of(at, "length_unit", Dimension::length, 1.0);
  const double speed = unit_of(at, "velocity_unit", Dimension::speed, length / time);
  const std::string& axes = orbit_axes(at);
  const std::string& of_state = at.state_axes();
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
  const std::filesystem::path folder = std::filesystem::path(at.file()).parent_path();
  return (folder / word(at.values(), at.key_path("file"))).string();
}

TableOrbit orbit_of_rows(const OrbitContext& at, PositionTable rows, int order, bool dates) {
  const double overhang = overhang_of(at, rows.times, dates);
  return TableOrbit(std::move(rows), order, overhang);
}

ScenarioOrbit file_orbit(const OrbitContext& at, int order) {
  const std::string path = file_path(at);
  for (const char* own : {"vx", "vy", "vz"})
    if (has(at.values(), at.key_path(own)))
      refuse(at.values(), at.key_path(own), at.file(), "expected keys times, x, y and z as well");
  if (has_two_line_elements(path))
    throw DomainError("it holds two-line elements, no table: " + std::string(satellites_command));
  if (path.ends_with(".oem") || path.ends_with(".oem.gz")) return oem_orbit(at, path, order);
  const std::vector<std::string> columns = columns_of(at, path);
  const NumberTable file = read_number_table(path, columns, time_reader(at));
  require_header(at, file, columns);
  require_rising(file, 0, "time");
  const bool dates = word(at.values(), at.key_path("time_format")) != "number";
  return {{},
          orbit_of_rows(at, positions_of(at, file), order, dates),
          at.gm(),
          {},
          "table " + printable(word(at.values(), at.key_path("file")), longest_file)};
}

}  // namespace

double overhang_of(const OrbitContext& at, const std::vector<double>& times, bool dates) {
  constexpr double of_dates = 2e-3, share = 1e-3;  // s, and of the spacing
  if (times.size() < 2) return 0.0;
  const double first = times.front(), last = times.back();
  const double rounding =
      dates ? at.units().to_core(of_dates, "s", Dimension::time)
            : 8.0 * epsilon<double>() * std::max(std::fabs(first), std::fabs(last));
  const double most = share * (last - first) / static_cast<double>(times.size() - 1);
  return std::max(0.0, std::min(rounding, most));
}

namespace {

// Refuses a table that does not cover the run, at the place of `key`.
void require_cover(const OrbitContext& at, const char* key, const TableOrbit& orbit) {
  const std::optional<TimeSpan> span = at.run_span();
  if (!span || orbit.covers(span->first, span->last)) return;
  const auto text = [&](double t) { return number_text(at.units().from_core(t, Dimension::time)); };
  refuse(at.values(), at.key_path(key), at.file(),
         "it covers the times " + text(orbit.first_time()) + " to " + text(orbit.last_time()) +
             " " + at.units().time() + "; expected all of the run, " + text(span->first) + " to " +
             text(span->last) + " (t = 0 is part of it)");
}

ScenarioOrbit table_orbit(const OrbitContext& at) {
  const int order = has(at.values(), at.key_path("order"))
                        ? static_cast<int>(std::clamp<std::int64_t>(
                              value_at(at.values(), at.key_path("order")).whole, 1, 99))
                        : 0;
  const char* const rows = has(at.values(), at.key_path("times")) ? "times" : "file";
  ScenarioOrbit orbit = built(at.values(), at.key_path(rows), at.file(), [&]() -> ScenarioOrbit {
    if (rows == std::string_view("file")) return file_orbit(at, order);
    return {{}, orbit_of_rows(at, own_table(at), order, false), at.gm(), {}, "table"};
  });
  const auto& table = std::get<TableOrbit>(orbit.motion);
  require_cover(at, rows, table);
  const double error = interpolation_error(table);
  orbit.interpolation_error = error;
  orbit.warnings = rows_warning(at, rows, error, 1e-4, "the distance");
  return orbit;
}

}  // namespace

OrbitKind table_kind() {
  return {.name = "table",
          .help = "Rows of positions, here or in a file.",
          .keys = {std::begin(keys), std::end(keys)},
          .sets = "times+x+y+z|file",
          .made = table_orbit};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
