// SPDX-License-Identifier: MIT
// What the kinds of [orbit.NAME] share that are elements over ages: columns that a scenario
// declares, and positions, tabulated once, over the run.
#include "scenario/detail/history_keys.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "polhode/secular/orbit_history.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/other_names.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "tables/number_table.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr std::string_view unread = "-";

const ColumnRole* role_of(std::span<const ColumnRole> roles, std::string_view name) {
  const auto found = std::find_if(roles.begin(), roles.end(),
                                  [&](const ColumnRole& one) { return one.name == name; });
  return found == roles.end() ? nullptr : &*found;
}

void require_words(const KeyValues& at, const ColumnKeys& keys, std::span<const ColumnRole> roles) {
  const std::vector<std::string>& columns = keys.columns;
  if (keys.units.size() != columns.size())
    at.refuse("units", "expected " + std::to_string(columns.size()) +
                           " units, one for each of columns; \"1\" for numbers and for columns "
                           "that are not read");
  std::vector<std::string_view> known;
  for (const ColumnRole& role : roles) known.push_back(role.name);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == unread) continue;
    if (role_of(roles, columns[i]) == nullptr) {
      const std::string meant(meant_column(columns[i], known));
      at.refuse("columns", "expected words out of " + one_of(known, "\"") +
                               ", and \"-\" for a column that is not read; got \"" + columns[i] +
                               "\"" + (meant.empty() ? "" : "; did you mean \"" + meant + "\"?"));
    }
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i), columns[i]) !=
        columns.begin() + static_cast<std::ptrdiff_t>(i))
      at.refuse("columns", "expected each word once; got \"" + columns[i] + "\" twice");
  }
}

}  // namespace

DeclaredColumns::DeclaredColumns(const KeyValues& at, std::string_view file, const ColumnKeys& keys,
                                 std::span<const ColumnRole> roles)
    : columns_(roles.size()), units_(roles.size(), 1.0) {
  require_words(at, keys, roles);
  const std::vector<std::string>&words = keys.columns, &units = keys.units;
  const std::string path = at.file_at(file);
  const std::vector<std::string> own = table_columns(path);
  const bool by_name = std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    return word == unread || std::find(own.begin(), own.end(), word) != own.end();
  });
  std::vector<std::string> wanted;
  std::vector<std::pair<const ColumnRole*, double>> read;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const ColumnRole* const role = role_of(roles, words[i]);
    if (role == nullptr || !role->is_read) continue;
    const double unit =
        at.built("units", [&] { return at.units().to_core(1.0, units[i], role->dimension); });
    wanted.push_back(by_name ? words[i] : std::to_string(i + 1));
    read.emplace_back(role, unit);
  }
  NumberTable table = read_number_table(path, wanted);
  for (std::size_t i = 0; i < read.size(); ++i) {
    for (double& x : table.columns[i]) x *= read[i].second;
    const auto place = static_cast<std::size_t>(read[i].first - roles.data());
    columns_[place] = std::move(table.columns[i]);
    units_[place] = read[i].second;
  }
  if (table.lines.empty()) at.refuse(file, "expected a table with rows; this file has none");
  file_ = std::move(table.file);
  lines_ = std::move(table.lines);
}

std::string DeclaredColumns::place(std::size_t row) const {
  return file_ + ":" + std::to_string(lines_.at(row)) + ": ";
}

bool may_be_radians(std::span<const double> angles, double degree) {
  constexpr std::size_t few = 8;  // of which nothing is said
  if (angles.size() < few) return false;
  const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
  const double turn = 2.0 * std::numbers::pi * degree;
  return *least >= -turn && *most <= turn && *most - *least > 0.5 * turn;
}

Quaternion ecliptic_from(std::string_view axes) {
  const auto about = [](int axis, double angle) {
    const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
    return axis == 1 ? Quaternion{c, s, 0.0, 0.0} : Quaternion{c, 0.0, 0.0, s};
  };
  if (axes == "equator-J2000") return about(1, -obliquity_J2000);
  // of the solar system: Souami & Souchay (2012). Axis 1 is its ascending node on the ecliptic.
  constexpr double degree = std::numbers::pi / 180.0;
  if (axes == "invariable-plane")
    return about(3, 107.582273 * degree) * about(1, 1.578703 * degree);
  return {};
}

namespace {

constexpr double most_rows = 4e6;
constexpr double tolerance = 1e-10;  // of the distance
constexpr int order = 12;

PositionTable tabulated(const secular::HistoryOrbit& orbit, const TimeSpan& span, double rows) {
  PositionTable table;
  const auto count = static_cast<std::size_t>(rows);
  const double step = (span.last - span.first) / static_cast<double>(count - 1);
  for (std::size_t k = 0; k < count; ++k) {
    table.times.push_back(k + 1 == count ? span.last : span.first + static_cast<double>(k) * step);
    table.positions.push_back(orbit.position(table.times.back()));
  }
  return table;
}

// Where it is largest in the span.
struct LargestEccentricity {
  double time;
  double value;
};
LargestEccentricity largest_eccentricity(const secular::OrbitHistory& elements,
                                         const TimeSpan& span) {
  constexpr int looks = 4000;
  LargestEccentricity largest{span.first, -1.0};
  for (int i = 0; i <= looks; ++i) {
    const double t = i == looks ? span.last : span.first + i * ((span.last - span.first) / looks);
    const double e = secular::eccentricity(elements.at(t));
    if (e > largest.value) largest = {t, e};
  }
  return largest;
}

// In the middle between rows, all along one turn: the first, the last, and that of the largest
// eccentricity. The error is that of the pericentres, which probes at even steps may all miss.
double misfit(const TableOrbit& table, const secular::HistoryOrbit& orbit, double largest_at) {
  const std::vector<double>& t = table.table().times;
  const std::size_t intervals = t.size() - 1;
  const double turns = (t.back() - t.front()) * orbit.mean_motion() / (2.0 * std::numbers::pi);
  const auto of_turn = std::min(
      intervals, static_cast<std::size_t>(std::ceil(static_cast<double>(intervals) / turns)));
  const auto row =
      static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), largest_at) - t.begin());
  const std::size_t last = intervals - of_turn;
  const std::size_t middle = std::min(row - std::min(row, of_turn / 2), last);
  double worst = 0.0;
  for (const std::size_t first : {std::size_t{0}, middle, last})
    for (std::size_t k = first; k < first + of_turn; ++k) {
      const double between = 0.5 * (t[k] + t[k + 1]);
      const Vec3 truth = orbit.position(between);
      worst = std::max(worst, norm(table.position(between) - truth) / norm(truth));
    }
  return worst;
}

void require_cover(const OrbitContext& at, std::string_view key,
                   const secular::OrbitHistory& history, const TimeSpan& span) {
  if (history.first_time() <= span.first && span.last <= history.last_time()) return;
  const auto text = [&](double t) { return time_and_date(at.file_values(), t); };
  at.refuse(key, "it covers " + text(history.first_time()) + " to " + text(history.last_time()) +
                     "; expected all of the run, " + text(span.first) + " to " + text(span.last) +
                     " (t = 0 is part of it)");
}

// Of the origin of longitudes in the plane of t = 0, where `from_file` turned the elements.
double shift_of_origin(const secular::OrbitHistory& elements, const Quaternion& from_file) {
  const secular::OrbitElements now = elements.at(0.0),
                               in_file = secular::turned(now, conj(from_file));
  const Vec3 own = rotate(secular::equinoctial_attitude(in_file), Vec3{1.0, 0.0, 0.0});
  const Vec3 x = rotate(conj(secular::equinoctial_attitude(now)), rotate(from_file, own));
  return std::atan2(x.y, x.x);
}

// One row is no table.
TimeSpan lengthened(TimeSpan span, const secular::HistoryOrbit& orbit) {
  if (span.first != span.last) return span;
  const double width = 0.1 / orbit.mean_motion();
  if (span.last + width <= orbit.elements().last_time())
    span.last += width;
  else
    span.first -= width;
  return span;
}

// As few rows as the tolerance takes.
PositionTable dense_enough(const OrbitContext& at, std::string_view key,
                           const secular::HistoryOrbit& orbit, const TimeSpan& span) {
  const double turns = (span.last - span.first) * orbit.mean_motion() / (2.0 * std::numbers::pi);
  const LargestEccentricity largest = largest_eccentricity(orbit.elements(), span);
  const std::string what = polhode::detail::number_text(std::round(turns)) + " turns in the run";
  double rows = std::max(std::ceil(40.0 * turns), 24.0);
  if (!(rows <= most_rows))
    at.refuse(key, what + " are too many to tabulate, with " + polhode::detail::number_text(rows) +
                       " rows; expected at most " + polhode::detail::number_text(most_rows));
  for (;; rows = std::min(2.0 * rows, most_rows)) {
    PositionTable table = tabulated(orbit, span, rows);
    const double off = misfit(TableOrbit(table, order), orbit, largest.time);
    if (off <= tolerance) return table;
    if (!(rows < most_rows))
      at.refuse(key, what + ", with an eccentricity of up to " +
                         polhode::detail::number_text(rounded(largest.value)) +
                         ", are too many to tabulate: " + polhode::detail::number_text(most_rows) +
                         " rows are off by " + polhode::detail::number_text(rounded(off)) +
                         " of the distance between them; expected at most " +
                         polhode::detail::number_text(tolerance));
  }
}

}  // namespace

ScenarioOrbit positions_of(const OrbitContext& at, std::string_view key,
                           const ScenarioHistory& history, const PlaceKeys& place,
                           const Quaternion& from_file) {
  if (!place.gm || !place.semi_major_axis)
    at.refuse(key, std::string("expected keys gm and semi_major_axis as well, since a rotation "
                               "needs to know where the body is; there is no ") +
                       (place.gm ? "semi_major_axis" : "gm"));
  const std::string axes = history.is_inertial ? "inertial" : "ecliptic-J2000";
  const std::string of_state = at.state_axes();
  if (history.is_inertial != (of_state == "inertial"))
    at.refuse("axes",
              "expected axes that have a known place in those of the state, which are " + of_state);
  const std::optional<TimeSpan> span = at.run_span();
  if (!span)
    at.refuse(key, "expected a table [time], since the positions are tabulated over the run");
  require_cover(at, key, history.elements, *span);
  const double gm = *positive_gm(at, place.gm);
  const secular::HistoryOrbit orbit = at.built("semi_major_axis", [&] {
    return secular::HistoryOrbit(
        history.elements, gm, *place.semi_major_axis,
        place.mean_longitude + shift_of_origin(history.elements, from_file));
  });
  PositionTable table = dense_enough(at, key, orbit, lengthened(*span, orbit));
  for (Vec3& x : table.positions) x = in_other_axes(x, axes, of_state);
  const double overhang = overhang_of(at, table.times, false);
  return {.motion = TableOrbit(std::move(table), order, overhang),
          .gm = gm,
          .text = history.text,
          .warnings = history.warnings};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
