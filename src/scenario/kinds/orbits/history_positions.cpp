// SPDX-License-Identifier: MIT
// Positions of elements over ages: tabulated once, over the run.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "polhode/secular/history_orbit.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/history_keys.hpp"
#include "scenario/detail/orbit_kinds.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double most_rows = 4e6;
constexpr double tolerance = 1e-10;  // of the distance
constexpr int order = 12;

PositionTable tabulated(const HistoryOrbit& orbit, const TimeSpan& span, double rows) {
  PositionTable table;
  const auto count = static_cast<std::size_t>(rows);
  const double step = (span.last - span.first) / static_cast<double>(count - 1);
  for (std::size_t k = 0; k < count; ++k) {
    table.times.push_back(k + 1 == count ? span.last : span.first + static_cast<double>(k) * step);
    table.positions.push_back(orbit.position(table.times.back()));
  }
  return table;
}

// In the middle between rows, all along.
double misfit(const TableOrbit& table, const HistoryOrbit& orbit) {
  constexpr std::size_t probes = 60;
  const std::vector<double>& t = table.table().times;
  double worst = 0.0;
  for (std::size_t i = 0; i < probes; ++i) {
    const std::size_t k = i * (t.size() - 2) / (probes - 1);
    const double middle = 0.5 * (t[k] + t[k + 1]);
    const Vec3 truth = orbit.position(middle);
    worst = std::max(worst, norm(table.position(middle) - truth) / norm(truth));
  }
  return worst;
}

void require_cover(const OrbitContext& at, std::string_view key, const OrbitHistory& history,
                   const TimeSpan& span) {
  if (history.first_time() <= span.first && span.last <= history.last_time()) return;
  const auto text = [&](double t) { return time_and_date(at.values(), at.units(), t); };
  at.refuse(key, "it covers " + text(history.first_time()) + " to " + text(history.last_time()) +
                     "; expected all of the run, " + text(span.first) + " to " + text(span.last) +
                     " (t = 0 is part of it)");
}

}  // namespace

ScenarioOrbit positions_of(const OrbitContext& at, std::string_view key,
                           const ScenarioHistory& history) {
  for (const char* needed : {"gm", "semi_major_axis"})
    if (!at.has(needed))
      at.refuse(key, std::string("expected keys gm and semi_major_axis as well, since a rotation "
                                 "needs to know where the body is; there is no ") +
                         needed);
  const std::string axes = at.word("axes") == "inertial" ? "inertial" : "ecliptic-J2000";
  const std::string& of_state = at.state_axes();
  if ((axes == "inertial") != (of_state == "inertial"))
    at.refuse("axes",
              "expected axes that have a known place in those of the state, which are " + of_state);
  std::optional<TimeSpan> span = at.run_span();
  if (!span)
    at.refuse(key, "expected a table [time], since the positions are tabulated over the run");
  require_cover(at, key, history.elements, *span);
  const double gm = *at.gm();
  const HistoryOrbit orbit = at.built("semi_major_axis", [&] {
    return HistoryOrbit(history.elements, gm, at.number("semi_major_axis"),
                        at.number("mean_longitude"));
  });
  if (span->first == span->last) {  // one row
    const double width = 0.1 / orbit.mean_motion();
    if (span->last + width <= history.elements.last_time())
      span->last += width;
    else
      span->first -= width;
  }
  const double turns = (span->last - span->first) * orbit.mean_motion() / (2.0 * std::numbers::pi);
  double rows = std::max(40.0 * turns, 24.0);
  for (;; rows *= 2.0) {
    rows = std::ceil(rows);
    if (!(rows <= most_rows))
      at.refuse(key, number_text(std::round(turns)) +
                         " turns in the run are too many to tabulate, with " + number_text(rows) +
                         " rows; expected at most " + number_text(most_rows));
    PositionTable table = tabulated(orbit, *span, rows);
    const TableOrbit own(table, order);
    if (!(misfit(own, orbit) <= tolerance) && 2.0 * rows <= most_rows) continue;
    for (Vec3& x : table.positions) x = in_other_axes(x, axes, of_state);
    const double overhang = overhang_of(at, table.times, false);
    return {{}, TableOrbit(std::move(table), order, overhang), gm, {}, history.text};
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
