// SPDX-License-Identifier: MIT
// [orbit.NAME] from a table of elements over ages.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polhode/rotor/attitude.hpp"
#include "scenario/detail/history_keys.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

enum class Direction { forward, before_present };

struct Arguments : PlaceKeys, ColumnKeys {
  std::string file;
  std::string axes;
  std::optional<std::array<double, 4>> attitude;
  Direction time_direction;
  std::optional<std::int64_t> order;
  bool allow_coarse;
};

constexpr std::array own_keys = {
    file_key<&Arguments::file>("file",
                               "A table of elements, separated by blanks or commas, .gz or not; "
                               "the path is from the folder of this file.")
        .required()
        .example("\"mars.csv\""),
    columns_key<&ColumnKeys::columns, Arguments>(
        "columns",
        "What its columns are, by the names that the file gives them or in their order: t; e, i, "
        "Omega and omega or varpi (Omega + omega), or k, h, q, p (e cos varpi, e sin varpi, "
        "sin(i/2) cos Omega, sin(i/2) sin Omega). a, M and lambda are not needed; - is a column "
        "that is not read.")
        .required()
        .example("[\"t\", \"a\", \"e\", \"i\", \"Omega\", \"omega\"]"),
    column_units_key<Arguments>.example("[\"yr\", \"au\", \"1\", \"deg\", \"deg\", \"deg\"]"),
    word_key<&Arguments::axes>(
        "axes", "ecliptic-J2000|equator-J2000|invariable-plane|inertial",
        "The axes of the elements. The invariable plane is that of the solar system, from its "
        "ascending node on the ecliptic of J2000; inertial axes are any.")
        .required()
        .example("\"ecliptic-J2000\""),
    quantity_key<&Arguments::attitude>(
        "attitude", Dimension::number,
        "Of the axes of the elements in those of `axes`, where they are others yet: a unit "
        "quaternion [w, x, y, z].")
        .example("[1, 0, 0, 0]"),
    choice_key<&Arguments::time_direction, Direction::forward, Direction::before_present>(
        "time_direction", "forward|before-present",
        "Whether t counts forward or, as in kyr BP, into the past. Rows may rise or fall.")
        .otherwise("\"forward\"")
        .example("\"before-present\""),
    order_key<&Arguments::order>("Order of the interpolation: 2 to 16, even. Left out: 10."),
    allow_coarse_key<&Arguments::allow_coarse>(),
};
constexpr auto keys = polhode::io::joined(place_keys<Arguments>, own_keys);

// In the order of `roles`.
enum Role : std::size_t {
  time,
  axis,
  eccentric,
  inclination,
  node,
  argument,
  pericentre,
  anomaly,
  longitude,
  k,
  h,
  q,
  p
};
constexpr ColumnRole roles[] = {{"t", Dimension::time},
                                {"a", Dimension::length, false},
                                {"e", Dimension::number},
                                {"i", Dimension::angle},
                                {"Omega", Dimension::angle},
                                {"omega", Dimension::angle},
                                {"varpi", Dimension::angle},
                                {"M", Dimension::angle, false},
                                {"lambda", Dimension::angle, false},
                                {"k", Dimension::number},
                                {"h", Dimension::number},
                                {"q", Dimension::number},
                                {"p", Dimension::number}};

bool has_all(const DeclaredColumns& columns, std::initializer_list<Role> wanted) {
  return std::all_of(wanted.begin(), wanted.end(), [&](Role role) { return columns.has(role); });
}

bool are_elements(const OrbitContext& at, const DeclaredColumns& columns) {
  const bool angles = has_all(columns, {time, eccentric, inclination, node}) &&
                      columns.has(argument) != columns.has(pericentre);
  if (!angles && !has_all(columns, {time, k, h, q, p}))
    at.refuse("columns",
              "expected t, e, i, Omega and one of omega and varpi among them, or t, k, h, q and p");
  return angles;
}

secular::OrbitElements row_of(const DeclaredColumns& columns, std::size_t row, bool angles) {
  const auto x = [&](Role role) { return columns.of(role)[row]; };
  if (!angles) return {x(k), x(h), x(q), x(p)};
  if (!(x(inclination) >= 0.0 && x(inclination) < pi<double>()))
    throw DomainError("an inclination of 180 degrees or more, or below 0; expected 0 to below 180");
  return secular::orbit_elements(x(eccentric), x(inclination), x(node),
                                 columns.has(argument) ? x(argument) : x(pericentre) - x(node));
}

// Along the axes of the experiment, or "mars.csv:17: ...".
secular::OrbitElements placed(const DeclaredColumns& columns, std::size_t row, bool angles,
                              const std::optional<Quaternion>& to_axes) {
  try {
    const secular::OrbitElements o = row_of(columns, row, angles);
    if (!(secular::eccentricity(o) < 1.0))
      throw DomainError("eccentricity " + polhode::detail::number_text(secular::eccentricity(o)) +
                        "; expected 0 to below 1");
    if (!(o.q * o.q + o.p * o.p < 1.0))
      throw DomainError("q and p of no inclination; expected q^2 + p^2 below 1");
    return to_axes ? secular::turned(o, *to_axes) : o;
  } catch (const DomainError& error) {
    throw DomainError(columns.place(row) + error.what());
  }
}

struct Rows {
  std::vector<double> times;
  std::vector<secular::OrbitElements> elements;
};

// Times rise in the result; in the file they may fall, but not turn round, and leave no gap.
void require_cadence(const DeclaredColumns& columns, const std::vector<double>& times) {
  const double time_unit = columns.unit(time);
  const double sense = times.size() > 1 && times[1] < times[0] ? -1.0 : 1.0;
  std::vector<double> rising;
  for (std::size_t row = 0; row < times.size(); ++row) {
    rising.push_back(sense * times[row]);
    if (row == 0) continue;
    const double step = rising[row] - rising[row - 1];
    const std::string text = polhode::detail::number_text(times[row] / time_unit);
    if (step == 0.0) throw DomainError(columns.place(row) + "time " + text + " comes twice");
    if (step < 0.0)
      throw DomainError(columns.place(row) + "time " + text +
                        " turns back; expected times that rise, or that fall, from row to row");
  }
  if (const std::size_t row = secular::row_after_gap(rising))
    throw DomainError(columns.place(row) + "a gap of " +
                      polhode::detail::number_text((rising[row] - rising[row - 1]) / time_unit) +
                      " before this row, more than three times the intervals beside it; expected a "
                      "table without gaps");
}

// From the axes of the file, where they are not those of the experiment.
std::optional<Quaternion> axes_of_file(const Arguments& a, const OrbitContext& at) {
  std::optional<Quaternion> to_axes;
  if (a.axes == "equator-J2000" || a.axes == "invariable-plane") to_axes = ecliptic_from(a.axes);
  if (!a.attitude) return to_axes;
  const Quaternion own = at.built("attitude", [&] {
    const auto& [w, x, y, z] = *a.attitude;
    return unit_quaternion(w, x, y, z);
  });
  return to_axes ? *to_axes * own : own;
}

Rows rows_of(const Arguments& a, const OrbitContext& at, const DeclaredColumns& columns) {
  const bool angles = are_elements(at, columns);
  const double sign = a.time_direction == Direction::before_present ? -1.0 : 1.0;
  const std::optional<Quaternion> to_axes = axes_of_file(a, at);
  Rows rows;
  for (std::size_t row = 0; row < columns.rows(); ++row) {
    rows.times.push_back(sign * columns.of(time)[row]);
    rows.elements.push_back(placed(columns, row, angles, to_axes));
  }
  require_cadence(columns, rows.times);
  if (rows.times.size() > 1 && rows.times[1] < rows.times[0]) {
    std::reverse(rows.times.begin(), rows.times.end());
    std::reverse(rows.elements.begin(), rows.elements.end());
  }
  return rows;
}

void add_small_angles(const OrbitContext& at, const DeclaredColumns& columns,
                      std::vector<std::string>& warnings) {
  const double degree = at.units().to_core(1.0, "deg", Dimension::angle);
  for (const Role role : {node, argument, pericentre, anomaly, longitude}) {
    if (columns.has(role) && columns.unit(role) == degree &&
        may_be_radians(columns.of(role), degree))
      warnings.push_back(at.noted("units", std::string("the column ") +
                                               std::string(roles[role].name) +
                                               " is declared in degrees, and none of its numbers "
                                               "exceeds 2 pi: are they radians?"));
  }
}

ScenarioHistory history(const Arguments& a, const OrbitContext& at) {
  constexpr std::size_t longest_file = 200;
  return at.built("file", [&]() -> ScenarioHistory {
    const DeclaredColumns columns(at, "file", a, roles);
    Rows rows = rows_of(a, at, columns);
    secular::ElementTable table(std::move(rows.times), rows.elements, order_of(a.order));
    std::vector<std::string> warnings =
        rows_warning(at, "file", table.interpolation_error(), 1e-3,
                     "the largest eccentricity or inclination", a.allow_coarse);
    add_small_angles(at, columns, warnings);
    return {secular::OrbitHistory(std::move(table)),
            "elements " + printable(a.file, longest_file) + ", " + std::to_string(columns.rows()) +
                " rows",
            std::move(warnings), a.axes == "inertial"};
  });
}

ScenarioOrbit made(const Arguments& a, const OrbitContext& at) {
  return positions_of(at, "file", history(a, at), a,
                      axes_of_file(a, at).value_or(Quaternion{1.0, 0.0, 0.0, 0.0}));
}

}  // namespace

OrbitKind elements_kind() {
  return history_kind<Arguments>(
      "elements",
      "Elements over ages, from a table: for kind obliquity, and with gm and semi_major_axis for "
      "rotations.",
      keys, history, made);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
