// SPDX-License-Identifier: MIT
// [orbit.NAME] from a table, of its own or in a file.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/other_names.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/detail/table_check.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "tables/number_table.hpp"
#include "tables/table_header.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

using Column = std::optional<std::vector<double>>;

enum class TimeFormat { number, julian, modified_julian, date };

struct Arguments {
  std::optional<double> gm;
  std::optional<std::string> axes;
  Column times, x, y, z, vx, vy, vz;
  std::optional<std::string> file;
  std::optional<std::vector<std::string>> columns;
  TimeFormat time_format;
  ephemeris::TimeScale time_scale;
  std::optional<std::string> time_unit, length_unit, velocity_unit;
  std::optional<std::int64_t> order;
  bool allow_coarse;
};

template <auto at>
consteval KindKey<Arguments> position_key(std::string_view name, std::string_view help) {
  return quantity_key<at>(name, Dimension::length, help).alternative();
}
template <auto at>
consteval KindKey<Arguments> velocity_key(std::string_view name, std::string_view help) {
  return quantity_key<at>(name, Dimension::speed, help);
}

constexpr KindKey<Arguments> keys[] = {
    orbit_gm_key<&Arguments::gm>(),
    orbit_axes_key<&Arguments::axes>(),
    quantity_key<&Arguments::times>("times", Dimension::time,
                                    "Times of rows that stand here, rising, from t = 0.")
        .alternative()
        .example("[0, 240, 480, 720]"),
    position_key<&Arguments::x>("x", "The first component of the positions in these rows.")
        .example("[149597871, 147389966, 140831424, 130115839]"),
    position_key<&Arguments::y>("y", "The second.").example("[0, 25607048, 50458230, 73819993]"),
    position_key<&Arguments::z>("z", "The third.").example("[0, 0, 0, 0]"),
    velocity_key<&Arguments::vx>("vx",
                                 "The first component of their velocities; all three, or none.")
        .example("[0, -18354, -36166, -52910]"),
    velocity_key<&Arguments::vy>("vy", "The second.").example("[107224, 105642, 100941, 93260]"),
    velocity_key<&Arguments::vz>("vz", "The third.").example("[0, 0, 0, 0]"),
    file_key<&Arguments::file>(
        "file",
        "A table of positions, CSV or separated by blanks, .gz or not, or a CCSDS Orbit Ephemeris "
        "Message (.oem, .oem.gz); the path is from the folder of this file.")
        .alternative()
        .example("\"moon.csv.gz\""),
    columns_key<&Arguments::columns>(
        "columns",
        "Columns that hold time, x, y, z and, where there are seven, the velocity: by the names "
        "that the file gives them or by their numbers from 1. Left out: t, x, y, z and, if there, "
        "vx, vy, vz, or where no line names them, the first four or seven.")
        .example("[\"t\", \"x\", \"y\", \"z\"]"),
    choice_key<&Arguments::time_format, TimeFormat::number, TimeFormat::julian,
               TimeFormat::modified_julian, TimeFormat::date>(
        "time_format", "number|JD|MJD|date",
        "What the column of times holds: time from t = 0, Julian dates, modified ones, or dates "
        "like 2013-01-05T18:30:00. All but the first need `state.epoch`.")
        .otherwise("\"number\""),
    choice_key<&Arguments::time_scale, ephemeris::TimeScale::UTC, ephemeris::TimeScale::TAI,
               ephemeris::TimeScale::TT, ephemeris::TimeScale::TDB>("time_scale", "UTC|TAI|TT|TDB",
                                                                    "Time scale of these dates.")
        .otherwise("\"TT\"")
        .example("\"TDB\""),
    unit_key<&Arguments::time_unit>(
        "time_unit", "Unit of the column of times, which count from t = 0; left out, `units.time`.")
        .example("\"s\""),
    unit_key<&Arguments::length_unit>("length_unit", "Unit of x, y, z; left out, `units.length`.")
        .example("\"km\""),
    unit_key<&Arguments::velocity_unit>(
        "velocity_unit", "Unit of the velocities; left out, that of lengths over that of times.")
        .example("\"km/s\""),
    order_key<&Arguments::order>(
        "Order of the interpolation: 2 to 16, even; with velocities 4 to 32, a multiple of 4. Left "
        "out: 10, with velocities 12."),
    allow_coarse_key<&Arguments::allow_coarse>(),
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

std::vector<std::string> columns_of(const Arguments& a, const OrbitContext& at,
                                    const std::string& path) {
  if (!a.columns) {
    std::vector<std::string> usual = usual_columns(path);
    if (usual.size() < 4)
      throw DomainError(path + ": has " + std::to_string(usual.size()) +
                        " columns; expected time, x, y, z");
    return usual;
  }
  if (a.columns->size() != 4 && a.columns->size() != 7)
    at.refuse("columns", "expected 4 columns (t, x, y, z) or 7 (with vx, vy, vz)");
  return *a.columns;
}

// How the column of times is read, into core units.
FieldReader time_reader(const Arguments& a, const OrbitContext& at) {
  if (a.time_format == TimeFormat::number) {
    const double unit = at.unit("time_unit", Dimension::time);
    return [unit](std::string_view field) { return unit * number_from_field(field); };
  }
  if (a.time_unit) at.refuse("time_unit", "expected no unit together with dates");
  const Clock clock = clock_of(at.file_values(), at.key_path("time_format"));
  const ephemeris::TimeScale scale = a.time_scale;
  if (a.time_format == TimeFormat::date)
    return [=](std::string_view field) { return clock.core_time(date_in(field, scale)); };
  const double zero = a.time_format == TimeFormat::modified_julian ? 2400000.5 : 0.0;
  return [=](std::string_view field) { return clock.core_time(julian_date(field, scale, zero)); };
}

// The units of the columns, in core units.
struct ColumnUnits {
  double time, length, speed;
};
ColumnUnits units_of(const Arguments& a, const OrbitContext& at) {
  const double time = at.unit("time_unit", Dimension::time);
  const double length = at.unit("length_unit", Dimension::length);
  return {time, length,
          a.velocity_unit ? at.unit("velocity_unit", Dimension::speed) : length / time};
}

// What the file says of itself must be how it is read.
void require_header(const Arguments& a, const OrbitContext& at, const NumberTable& file,
                    const std::vector<std::string>& columns) {
  const TableCheck check(at, file, columns);
  const ColumnUnits units = units_of(a, at);
  check.axes(orbit_axes(at, a.axes));
  for (std::size_t k = 1; k < columns.size(); ++k) {
    if (k < 4)
      check.unit(k, {"length_unit", units.length, Dimension::length});
    else
      check.unit(k, {"velocity_unit", units.speed, Dimension::speed});
  }
  if (a.time_format != TimeFormat::number)
    return check.scale(std::string(ephemeris::name(a.time_scale)));
  check.unit(0, {"time_unit", units.time, Dimension::time});
  check.epoch();
}

// A component that is a column of this file, by its key.
struct OwnColumn {
  const char* key;
  const Column& numbers;
};

// Reads three columns; each must be as long as the times.
std::vector<Vec3> own_rows(const Arguments& a, const OrbitContext& at,
                           const std::array<OwnColumn, 3>& columns) {
  const std::size_t count = a.times->size();
  std::vector<Vec3> rows(count);
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [key, numbers] = columns[static_cast<std::size_t>(axis)];
    if (numbers->size() != count)
      at.refuse(key, "expected " + std::to_string(count) + " numbers, as many as times has");
    for (std::size_t k = 0; k < count; ++k) rows[k][axis] = (*numbers)[k];
  }
  const std::string axes = orbit_axes(at, a.axes), of_state = at.state_axes();
  for (Vec3& row : rows) row = in_other_axes(row, axes, of_state);
  return rows;
}

// Rows that stand in the scenario itself.
PositionTable own_table(const Arguments& a, const OrbitContext& at) {
  for (const char* own :
       {"columns", "time_format", "time_scale", "time_unit", "length_unit", "velocity_unit"})
    if (at.is_explicit(own)) at.refuse(own, "expected a key file as well, not times");
  PositionTable table{*a.times, own_rows(a, at, {{{"x", a.x}, {"y", a.y}, {"z", a.z}}}), {}};
  const std::array<OwnColumn, 3> slopes = {{{"vx", a.vx}, {"vy", a.vy}, {"vz", a.vz}}};
  if (a.vx && a.vy && a.vz) {
    table.velocities = own_rows(a, at, slopes);
  } else {
    for (const OwnColumn& own : slopes)
      if (own.numbers) at.refuse(own.key, "expected vx, vy and vz, or none of them");
  }
  return table;
}

PositionTable positions_of(const Arguments& a, const OrbitContext& at, const NumberTable& file) {
  const ColumnUnits units = units_of(a, at);
  const std::string axes = orbit_axes(at, a.axes), of_state = at.state_axes();
  const auto rows = [&](std::size_t first, double unit) {
    std::vector<Vec3> vectors;
    vectors.reserve(file.rows());
    const auto& c = file.columns;
    for (std::size_t k = 0; k < file.rows(); ++k)
      vectors.push_back(in_other_axes(
          {unit * c[first][k], unit * c[first + 1][k], unit * c[first + 2][k]}, axes, of_state));
    return vectors;
  };
  PositionTable table{file.columns[0], rows(1, units.length), {}};
  if (file.columns.size() == 7) table.velocities = rows(4, units.speed);
  return table;
}

TableOrbit orbit_of_rows(const Arguments& a, const OrbitContext& at, PositionTable rows,
                         bool dates) {
  const double overhang = overhang_of(at, rows.times, dates);
  return TableOrbit(std::move(rows), order_of(a.order), overhang);
}

ScenarioOrbit file_orbit(const Arguments& a, const OrbitContext& at) {
  const std::string path = at.file_at("file");
  for (const char* own : {"vx", "vy", "vz"})
    if (at.has(own)) at.refuse(own, "expected keys times, x, y and z as well");
  if (has_two_line_elements(path))
    throw DomainError("it holds two-line elements, no table: " + std::string(satellites_command));
  if (path.ends_with(".oem") || path.ends_with(".oem.gz"))
    return oem_orbit(at, *a.file, a.gm, order_of(a.order));
  const std::vector<std::string> columns = columns_of(a, at, path);
  const NumberTable file = read_number_table(path, columns, time_reader(a, at));
  require_header(a, at, file, columns);
  require_rising(file, 0, "time");
  return {{},
          orbit_of_rows(a, at, positions_of(a, at, file), a.time_format != TimeFormat::number),
          positive_gm(at, a.gm),
          {},
          "table " + printable(*a.file, longest_file)};
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
  const auto text = [&](double t) {
    return polhode::detail::number_text(at.units().from_core(t, Dimension::time));
  };
  at.refuse(key, "it covers the times " + text(orbit.first_time()) + " to " +
                     text(orbit.last_time()) + " " + at.units().time() +
                     "; expected all of the run, " + text(span->first) + " to " + text(span->last) +
                     " (t = 0 is part of it)");
}

ScenarioOrbit made(const Arguments& a, const OrbitContext& at) {
  const char* const rows = a.times ? "times" : "file";
  ScenarioOrbit orbit = at.built(rows, [&]() -> ScenarioOrbit {
    if (!a.times) return file_orbit(a, at);
    return {{}, orbit_of_rows(a, at, own_table(a, at), false), positive_gm(at, a.gm), {}, "table"};
  });
  const auto& table = std::get<TableOrbit>(orbit.motion);
  require_cover(at, rows, table);
  const double error = interpolation_error(table);
  orbit.interpolation_error = error;
  orbit.warnings = rows_warning(at, rows, error, 1e-4, "the distance", a.allow_coarse);
  return orbit;
}

}  // namespace

OrbitKind table_kind() {
  OrbitKind kind =
      orbit_kind<Arguments>("table", "Rows of positions, here or in a file.", keys, made);
  kind.sets = "times+x+y+z|file";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
