// SPDX-License-Identifier: MIT
#include "polhode/run/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polhode/free/rounding_sensitivity.hpp"
#include "polhode/text/epoch.hpp"
#include "run/detail/experiment_parts.hpp"
#include "run/detail/spin_lines.hpp"
#include "run/detail/summary_lines.hpp"
#include "text/json.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::Lines;

constexpr std::size_t most_events = 20;  // that a summary lists

std::string mode(Regime regime) {
  switch (regime) {
    case Regime::rest:
      return "rest";
    case Regime::steady:
      return "steady spin about a principal axis";
    case Regime::short_axis:
      return "short-axis mode (SAM)";
    case Regime::long_axis:
      return "long-axis mode (LAM)";
    case Regime::separatrix:
      return "separatrix: about the intermediate axis, without a period";
  }
  return {};
}

double largest_moment(const Vec3& I) { return std::max({I.x, I.y, I.z}); }

std::string crossing_text(Crossing crossing) {
  if (crossing == Crossing::both) return "";
  return crossing == Crossing::rising ? ", rising" : ", falling";
}

// "table moon.csv, 1441 rows, t = 0 to 86400 s"
std::string orbit_text(const Units& units, const ScenarioOrbit& orbit) {
  const auto* table = std::get_if<TableOrbit>(&orbit.motion);
  if (table == nullptr) return any_orbit(orbit).name();
  return fmt::format("{}, {} rows, t = {:.10g} to {:.10g} {}",
                     orbit.text.empty() ? orbit.kind : orbit.text, table->table().times.size(),
                     units.from_core(table->first_time(), Dimension::time),
                     units.from_core(table->last_time(), Dimension::time), units.time());
}

// The error between the rows of a file.
void add_interpolation(Lines& lines, const ScenarioOrbit& orbit) {
  if (!orbit.interpolation_error) return;
  lines.text("orbit_" + orbit.name + "_error", "orbit " + orbit.name + ": interpolation error",
             fmt::format("about {:.0e} of the distance{}", *orbit.interpolation_error,
                         orbit.warnings.empty() ? "" : ": rows are too far apart"));
}

// What the doubles of the input leave open at the end of a free rotation.
void add_sensitivity(Lines& lines, const Rotation& rotation, const Units& units,
                     const FreeRotation& motion) {
  if (propagation_method(rotation) || !rotation.time || motion.regime() == Regime::rest) return;
  const SaveAt& time = *rotation.time;
  if (time.size() == 0) return;
  const double moved =
      units.from_core(rounding_sensitivity(motion, time[time.size() - 1]), Dimension::angle);
  // Of an order of magnitude one digit is known.
  lines.number("rounding_sensitivity", "an input rounding moves the end by",
               units.to_core(std::stod(fmt::format("{:.0e}", moved)), Dimension::angle),
               Dimension::angle);
}

// "3 x 2 x 1 m, area 22 m2, 12 facets"
std::string size_text(const FacetShape& mesh, const Units& units) {
  Vec3 least = mesh.vertices().front(), most = least;
  for (const Vec3& x : mesh.vertices())
    for (int i = 0; i < 3; ++i) {
      least[i] = std::fmin(least[i], x[i]);
      most[i] = std::fmax(most[i], x[i]);
    }
  const auto length = [&](int i) { return units.from_core(most[i] - least[i], Dimension::length); };
  return fmt::format("{:.4g} x {:.4g} x {:.4g} {}, area {:.4g} {}, {} facets", length(0), length(1),
                     length(2), units.label(Dimension::length),
                     units.from_core(mesh.area(), Dimension::area), units.label(Dimension::area),
                     mesh.triangles().size());
}
void add_meshes(Lines& lines, const Rotation& rotation, const Units& units) {
  if (rotation.shape)
    lines.text("shape", "shape " + rotation.shape->file, size_text(rotation.shape->mesh, units));
  for (std::size_t i = 0; i < rotation.surface_meshes.size(); ++i) {
    const NamedMesh& one = rotation.surface_meshes[i];
    lines.text("surface_" + std::to_string(i + 1), "surface " + one.file,
               size_text(one.mesh, units));
  }
}

// The numbers of the torques, and in every table of the model what it leaves to defaults.
void add_values(Lines& lines, const Scenario& scenario) {
  for (const TableValues& of : model_values(scenario)) {
    std::string key = of.table;
    std::replace_if(
        key.begin(), key.end(), [](char c) { return c == '.' || c == '[' || c == '-'; }, '_');
    std::erase(key, ']');
    if (of.table.starts_with("perturbation")) lines.text(key + "_values", of.table, of.given);
    lines.text(key + "_defaults", of.table + ", not in the file", of.defaults);
  }
}

// What moves the body, apart from its own spin.
void add_motion(Lines& lines, const Rotation& rotation, const Units& units,
                std::span<const ChartKind> charts) {
  if (!rotation.frame.is_inertial()) lines.text("frame", "reference frame", rotation.frame_text);
  for (const ScenarioOrbit& orbit : rotation.orbits) {
    const std::string key = "orbit_" + orbit.name, label = "orbit " + orbit.name;
    const KeplerElements* elements = kepler_elements(orbit);
    if (elements == nullptr)
      lines.text(key, label, orbit_text(units, orbit));
    else if (elements->eccentricity < 1.0)
      lines.number(key, label + ": period", 2.0 * std::numbers::pi / mean_motion(*elements),
                   Dimension::time);
    else
      lines.text(key, label, "hyperbola");
  }
  for (const ScenarioOrbit& orbit : rotation.orbits) add_interpolation(lines, orbit);
  for (std::size_t i = 0; i < rotation.terms.size(); ++i)
    lines.text("perturbation_" + std::to_string(i + 1), "perturbation", rotation.terms[i].name());
  if (rotation.damper)
    lines.text("perturbation_" + std::to_string(rotation.terms.size() + 1), "perturbation",
               "Kane damper");
  lines.text("method", "method", detail::propagation_text(rotation, units));
  for (std::size_t i = 0; i < rotation.events.size(); ++i) {
    const ScenarioEvent& event = rotation.events[i];
    const Dimension dimension = column_dimension(event.column, charts);
    const std::string unit = units.label(dimension);
    lines.text("event_" + std::to_string(i + 1), "event " + event.name,
               event.column + " = " +
                   fmt::format("{:.10g}", units.from_core(event.value, dimension)) +
                   (unit == "1" ? "" : " " + unit) + crossing_text(event.crossing) +
                   (event.stops ? ", stops the run" : ""));
  }
}

std::string direction_text(int direction) {
  if (direction == 0) return "touching";
  return direction > 0 ? "rising" : "falling";
}

void add_cost(Lines& lines, const Statistics& statistics, const std::string& of) {
  lines.number("steps", "steps", static_cast<double>(statistics.steps), Dimension::number);
  lines.number("rejected", "steps repeated", static_cast<double>(statistics.rejected),
               Dimension::number);
  lines.number("evaluations", "evaluations of the " + of,
               static_cast<double>(statistics.evaluations), Dimension::number);
}

std::string outcome_text(const Outcome& outcome) {
  switch (outcome.status) {
    case Outcome::Status::completed:
      return "completed";
    case Outcome::Status::stopped_by_event:
      return "stopped by an event";
    case Outcome::Status::failed:
      return "failed: " + outcome.advice;
  }
  return {};
}

}  // namespace

std::vector<SummaryLine> detail::summary(const Rotation& rotation, const Scenario& scenario) {
  const FreeRotation motion = free_rotation(rotation);
  Lines lines(scenario.units());
  const Vec3& I = motion.body().moments();
  const double I3 = largest_moment(I);
  const double turn = 2.0 * std::numbers::pi;
  const bool tumbles =
      motion.regime() == Regime::short_axis || motion.regime() == Regime::long_axis;
  lines.text("title", "title", scenario.document.title);
  lines.text("mode",
             rotation.terms.empty() && !rotation.damper ? "mode" : "mode (if free from t = 0 on)",
             mode(motion.regime()));
  lines.numbers("moments", "moments I1, I2, I3", {I.x, I.y, I.z}, Dimension::moment);
  lines.numbers("moment_ratios", "their ratios to the largest", {I.x / I3, I.y / I3, I.z / I3},
                Dimension::number);
  lines.number("precession_period", "precession period P_phi (long axis)",
               turn / motion.precession_rate_long(), Dimension::time);
  if (tumbles)
    lines.number("rotation_period", "rotation period P_psi", motion.polhode_period(),
                 Dimension::time);
  lines.number("short_axis_period", "precession period of the short axis",
               turn / motion.precession_rate_short(), Dimension::time);
  if (motion.regime() == Regime::short_axis)
    lines.number("psi_max", "psi_max", psi_max(motion), Dimension::angle);
  lines.number("momentum", "angular momentum G", motion.momentum(), Dimension::momentum);
  lines.number("energy", "kinetic energy T", motion.energy(), Dimension::energy);
  add_spin(lines, rotation, motion);
  lines.number("modulus", "elliptic parameter m", motion.modulus().m(), Dimension::number);
  lines.number("complement", "its complement 1 - m", motion.modulus().m1(), Dimension::number);
  add_sensitivity(lines, rotation, scenario.units(), motion);
  lines.text("epoch", "epoch (t = 0)", rotation.epoch);
  if (!rotation.epoch.empty() && is_dubious(epoch_date(rotation.epoch)))
    lines.text("epoch_note", "of the epoch",
               "leap seconds of UTC are not known for this year; give the epoch in TT or TDB to be "
               "free of them");
  lines.text("axes", "inertial axes", rotation.axes);
  const Quaternion& q = motion.body().q_FB();
  if (!(q == Quaternion{}))
    lines.numbers("principal_axes", "principal axes in those of the tensor (quaternion)",
                  {q.w, q.x, q.y, q.z}, Dimension::number);
  add_motion(lines, rotation, scenario.units(), scenario.document.kinds->charts());
  add_meshes(lines, rotation, scenario.units());
  add_values(lines, scenario);
  add_doubts(lines, rotation, scenario);
  return lines.take();
}

std::vector<SummaryLine> detail::report_lines(const Rotation& rotation, const Scenario& scenario,
                                              const RunReport& report, const std::string& events) {
  Lines lines(scenario.units());
  const bool is_exact = !propagation_method(rotation);
  if (!is_exact || has_events(rotation))
    add_report(lines, report, is_exact ? "" : "perturbations", events);
  if (report.end) add_change(lines, rotation, scenario.units(), *report.end);
  return lines.take();
}

void detail::add_report(Lines& lines, const RunReport& report, const std::string& evaluated,
                        const std::string& events) {
  lines.text("outcome", "outcome", outcome_text(report.outcome));
  lines.number("end", "the run ended at t", report.outcome.t, Dimension::time);
  if (!evaluated.empty()) add_cost(lines, report.statistics, evaluated);
  if (report.energy_change)
    lines.number("energy_change", "change of energy E - E(0)", *report.energy_change,
                 Dimension::energy);
  const std::size_t shown = std::min(report.events.size(), most_events);
  for (std::size_t i = 0; i < shown; ++i) {
    const RunEvent& event = report.events[i];
    lines.number("event_time_" + std::to_string(i + 1),
                 event.name + ", " + direction_text(event.direction) + ", at t", event.t,
                 Dimension::time);
  }
  const auto more = std::max(report.events_met, static_cast<std::int64_t>(report.events.size())) -
                    static_cast<std::int64_t>(shown);
  if (more > 0) lines.text("more_events", "and", std::to_string(more) + " events more: " + events);
}

std::string shown_number(const std::string& key, double number) {
  std::string nearest = fmt::format("{:.10g}", number);
  if (key != "psi_max" || !(number > 0.0) || !(std::stod(nearest) > number)) return nearest;
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 9.0);
  return fmt::format("{:.10g}", std::stod(nearest) - unit);
}

std::string summary_table(const std::vector<SummaryLine>& lines) {
  std::size_t width = 0;
  for (const SummaryLine& line : lines) width = std::max(width, line.label.size());
  std::string table;
  for (const SummaryLine& line : lines) {
    std::string value = line.text;
    for (const double number : line.numbers)
      value += (value.empty() ? "" : ", ") + shown_number(line.key, number);
    table += fmt::format("{:<{}}  {}{}{}\n", line.label, width, value, line.unit.empty() ? "" : " ",
                         line.unit);
  }
  return table;
}

std::string summary_json(const std::vector<SummaryLine>& lines) {
  detail::JsonWriter json;
  json.begin_object();
  for (const SummaryLine& line : lines) {
    json.key(line.key);
    if (line.numbers.empty()) {
      json.value(line.text);
      continue;
    }
    json.begin_object().key("value");
    if (line.numbers.size() > 1) json.begin_array();
    for (const double number : line.numbers) json.value(number);
    if (line.numbers.size() > 1) json.end_array();
    json.key("unit").value(line.unit.empty() ? "1" : line.unit).end_object();
  }
  json.end_object();
  return json.text();
}

}  // namespace v0
}  // namespace polhode
