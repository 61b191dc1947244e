// SPDX-License-Identifier: MIT
// The solutions of a fit for people and for programs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "fit/free_motion.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/run/fit.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/run/summary.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/summary_lines.hpp"
#include "run/fit/fit_torques.hpp"
#include "text/json.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::add_fit_line;
using detail::euler_text;
using polhode::detail::counted;

std::string observed_text(const Scenario& scenario, const FitReport& report) {
  const fit::Snapshots& seen = report.observed.seen;
  std::string text;
  const auto add = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) text += (text.empty() ? "" : ", ") + counted(n, one, many);
  };
  add(seen.attitudes.size(), "attitude", "attitudes");
  add(seen.directions.size(), "direction", "directions");
  add(seen.rates.size(), "rate", "rates");
  const std::vector<Observation>& tables = require_fit(scenario).observations;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto rows = std::ranges::count(report.observed.measurements, i, &ObservedRow::table);
    add(static_cast<std::size_t>(rows), ("row of " + tables[i].kind).c_str(),
        ("rows of " + tables[i].kind).c_str());
  }
  return text + fmt::format(" ({} numbers) of ", seen.numbers()) +
         counted(require_fit(scenario).observations.size(), "table", "tables");
}

std::string number_or_dash(const std::optional<double>& x, const char* form) {
  return x ? fmt::format(fmt::runtime(form), *x) : std::string("-");
}

// Mode, periods and pole of a spin state, in free rotation.
std::vector<SummaryLine> state_lines(const Scenario& scenario, const fit::SpinState& state) {
  const FreeRotation motion = fit::detail::free_rotation_of(state);
  const Rotation& rotation = scenario.rotation();
  detail::Lines lines(scenario.units());
  detail::add_mode(lines, rotation, motion);
  detail::add_periods(lines, motion);
  if (motion.regime() != Regime::rest) detail::add_pole(lines, rotation, motion.initial_state());
  return lines.take();
}

// Of periods and pole, with errors as given and scaled; those that the data leave open are
// infinite.
std::string error_lines(const Scenario& scenario, const FoundSpin& found) {
  using Error = double fit::DerivedParameters::*;
  const Units& units = scenario.units();
  std::vector<fit::DerivedParameters> all{fit::derived_parameters(found.raw)};
  if (found.scaled) all.push_back(fit::derived_parameters(*found.scaled));
  std::string text;
  const auto add = [&](const char* label, Dimension dimension, Error error, Error minor = nullptr) {
    std::string errors;
    for (const fit::DerivedParameters& one : all) {
      if (!errors.empty()) errors += ", scaled ";
      errors += fmt::format("{:.2g}", units.from_core(one.*error, dimension));
      if (minor != nullptr)
        errors += fmt::format(" by {:.2g}", units.from_core(one.*minor, dimension));
    }
    text += fmt::format("{:<37}{} {}\n", label, errors, units.label(dimension));
  };
  if (all.front().periods.precession_period > 0.0) {
    add("error of P_phi", Dimension::time, &fit::DerivedParameters::precession_error);
    add("error of P_psi", Dimension::time, &fit::DerivedParameters::rotation_error);
    add("error of the short-axis period", Dimension::time, &fit::DerivedParameters::short_error);
  }
  add("error of the pole", Dimension::angle, &fit::DerivedParameters::pole_major,
      &fit::DerivedParameters::pole_minor);
  return text;
}

void add_table(std::string& text, const std::vector<FitNumber>& numbers) {
  std::size_t name = 9, unit = 9;  // of the columns
  for (const FitNumber& one : numbers) {
    name = std::max(name, one.name.size() + 2);
    unit = std::max(unit, one.unit.size() + 2);
  }
  text += fmt::format("\n{:<{}}{:<{}}{:>13}{:>13}{:>11}{:>13}{:>11}\n", "unknown", name, "unit",
                      unit, "start", "value", "error", "scaled", "error");
  for (const FitNumber& one : numbers)
    text += fmt::format("{:<{}}{:<{}}{:>13.6g}{:>13.6g}{:>11.3g}{:>13}{:>11}\n", one.name, name,
                        one.unit, unit, *one.start, one.value, one.error,
                        number_or_dash(one.scaled_value, "{:.6g}"),
                        number_or_dash(one.scaled_error, "{:.3g}"));
}

void add_correlations(std::string& text, const fit::UnknownsCovariance& c) {
  if (c.names.size() < 2) return;
  text += "\ncorrelations, in hundredths\n";
  std::size_t width = 9;
  for (const std::string& name : c.names) width = std::max(width, name.size() + 2);
  for (std::size_t i = 1; i < c.names.size(); ++i) {
    text += fmt::format("{:<{}}", c.names[i], width);
    for (std::size_t j = 0; j < i; ++j) {
      const double r = c.correlation(i, j);
      text += std::isfinite(r) ? fmt::format("{:>9.0f}", std::round(100.0 * r) + 0.0)
                               : fmt::format("{:>9}", "-");
    }
    text += "\n";
  }
  text += fmt::format("{:<{}}", "", width);
  // a key is longer than its column: its place in the table above
  for (std::size_t j = 0; j + 1 < c.names.size(); ++j)
    text += fmt::format("{:>9}", c.names[j].size() < 9 ? c.names[j] : fmt::format("no. {}", j + 1));
  text += "\n";
}

void add_solution(std::string& text, const Scenario& scenario, const FitReport& report,
                  std::size_t place, std::span<const double> times) {
  const FoundSpin& found = report.solutions[place];
  const fit::SpinSolution& raw = found.raw;
  const Units& units = scenario.units();
  text += "\n";
  add_fit_line(text, fmt::format("solution {} of {}", place + 1, report.solutions.size()),
               raw.result.sentence + (report.starts > 1 ? fmt::format(", from {} of {} starts",
                                                                      found.starts, report.starts)
                                                        : ""));
  add_fit_line(text, "chi-square",
               fmt::format("{:.4g} on {:.4g} degrees of freedom", raw.result.chi_square,
                           raw.degrees_of_freedom));
  if (std::isfinite(raw.attitude_rms))
    add_fit_line(text, "rms of attitudes",
                 fmt::format("{:.3g} {} about each axis",
                             units.from_core(raw.attitude_rms, Dimension::angle), units.angle()));
  if (found.scaled)
    add_fit_line(text, "errors scaled by", fmt::format("{:.4g}", found.scaled->error_factor));
  if (report.drive && !report.drive->jumps.empty()) text += "at t = 0, before the jumps:\n";
  add_fit_line(text, "phi, theta, psi", euler_text(scenario, raw.state.q));
  text += summary_table(state_lines(scenario, raw.state));
  text += error_lines(scenario, found);
  add_table(text, fit_numbers(scenario, report, place));
  add_correlations(text, raw.covariance);
  for (const std::string& note : raw.notes) text += "note: " + note + "\n";
  if (!times.empty()) text += prediction_text(scenario, fit_predictions(report, place, times));
}

// With errors as given, in the units of the file.
void add_figures(detail::JsonWriter& json, const Scenario& scenario, const FoundSpin& found) {
  const fit::DerivedParameters f = fit::derived_parameters(found.raw);
  const Units& units = scenario.units();
  const auto add = [&](const char* key, double value, double error) {
    json.key(key).object("value", units.from_core(value, Dimension::time), "error",
                         units.from_core(error, Dimension::time), "unit", units.time());
  };
  if (f.periods.precession_period > 0.0) {
    add("precession_period", f.periods.precession_period, f.precession_error);
    add("rotation_period", f.periods.rotation_period, f.rotation_error);
    add("short_axis_period", f.short_period, f.short_error);
  }
  json.key("pole").object("direction", f.pole_I, "error_major",
                          units.from_core(f.pole_major, Dimension::angle), "error_minor",
                          units.from_core(f.pole_minor, Dimension::angle), "unit", units.angle());
}

void add_solution(detail::JsonWriter& json, const Scenario& scenario, const FitReport& report,
                  std::size_t place, std::span<const double> times) {
  const FoundSpin& found = report.solutions[place];
  const fit::SpinSolution& raw = found.raw;
  json.begin_object().members("converged", true, "sentence", raw.result.sentence, "starts",
                              found.starts, "iterations", raw.result.iterations, "chi_square",
                              raw.result.chi_square, "degrees_of_freedom", raw.degrees_of_freedom,
                              "cost", raw.result.cost, "attitude_rms",
                              scenario.units().from_core(raw.attitude_rms, Dimension::angle));
  if (found.scaled) json.members("error_factor", found.scaled->error_factor);
  add_figures(json, scenario, found);
  json.members("quaternion", raw.state.q);
  detail::add_unknowns(json, fit_numbers(scenario, report, place), raw.covariance);
  if (!times.empty())
    detail::add_predictions(json.key("predicted"), scenario, fit_predictions(report, place, times));
  json.members("notes", raw.notes).end_object();
}

}  // namespace

std::vector<FitNumber> fit_numbers(const Scenario& scenario, const FitReport& report,
                                   std::size_t solution) {
  const FoundSpin& found = report.solutions.at(solution);
  const auto at = [&](const fit::SpinSolution& of) {
    return detail::unknowns_of(report, report.problem.start, of);
  };
  const std::vector<double> raw = at(found.raw), start = detail::starts_of(report);
  const std::vector<double> scaled =
      found.scaled ? at(*found.scaled) : std::vector<double>(raw.size());
  std::vector<FitNumber> numbers;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const std::string& name = found.raw.covariance.names[i];
    const detail::ShownUnit unit = detail::unit_of(scenario, name);
    const auto shown = [&](double x) { return unit.of(x); };
    FitNumber one{name, unit.label, shown(raw[i]), shown(found.raw.covariance.error(i)),
                  shown(start[i])};
    if (found.scaled) {
      one.scaled_value = shown(scaled[i]);
      one.scaled_error = shown(found.scaled->covariance.error(i));
    }
    numbers.push_back(std::move(one));
  }
  return numbers;
}

std::string fit_text(const Scenario& scenario, const FitReport& report,
                     std::span<const double> times) {
  std::string text;
  if (!scenario.document.title.empty()) text += scenario.document.title + "\n";
  add_fit_line(text, "observed", observed_text(scenario, report));
  if (report.starts > 1)
    add_fit_line(text, "starts",
                 fmt::format("{}, of which {} did not converge", report.starts, report.failed));
  const std::size_t count = std::min(report.solutions.size(), require_fit(scenario).most_solutions);
  for (std::size_t i = 0; i < count; ++i) add_solution(text, scenario, report, i, times);
  detail::add_end(text, report, count, report.observed.notes);
  return text;
}

std::string fit_json(const Scenario& scenario, const FitReport& report,
                     std::span<const double> times) {
  detail::JsonWriter json;
  const fit::Snapshots& seen = report.observed.seen;
  json.begin_object().members("scenario", scenario.document.name, "attitudes",
                              seen.attitudes.size(), "directions", seen.directions.size(), "rates",
                              seen.rates.size());
  if (!seen.measurements.empty()) json.members("measurements", seen.measurements.size());
  json.members("starts", report.starts, "failed", report.failed);
  if (!report.failure.empty()) json.members("failure", report.failure);
  json.key("solutions").begin_array();
  for (std::size_t i = 0; i < report.solutions.size(); ++i)
    add_solution(json, scenario, report, i, times);
  json.end_array().members("notes", report.observed.notes).end_object();
  return json.text();
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
