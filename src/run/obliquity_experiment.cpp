// SPDX-License-Identifier: MIT
// How an experiment of kind "obliquity", a spin axis over ages, is run and described.
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/detail/scenario/obliquity.hpp"
#include "polhode/run/detail/integrated_run.hpp"
#include "polhode/run/detail/rows_maker.hpp"
#include "polhode/secular/planet.hpp"
#include "run/detail/experiments.hpp"
#include "run/detail/summary_lines.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

std::vector<ColumnGroup> row_groups(const Obliquity& of, const Scenario& scenario) {
  return SpinLayout(of.columns, scenario.units()).groups();
}

void add_facts(const Obliquity& of, RunFacts& facts) { facts.axes = of.axes; }

std::string propagation_text(const Obliquity& of, const Units& units) {
  return method_in_units(of.method, units);
}

std::vector<std::string> notes_of(const Obliquity& of, const Scenario& scenario) {
  std::vector<std::string> notes = {"kind: obliquity", "axes: " + of.axes,
                                    "orbit: " + of.orbit_text};
  if (!of.planet.empty())
    notes.push_back("planet: " + of.planet + ", unless the scenario says otherwise from " +
                    std::string(secular::planet_spin(of.planet)->source));
  for (std::string& note : file_notes(scenario)) notes.push_back(std::move(note));
  notes.push_back("method: " + propagation_text(of, scenario.units()));
  return notes;
}

std::vector<std::string> cited_parts(const Obliquity& of) {
  std::vector<std::string> parts = {"obliquity"};
  if (!of.planet.empty()) {
    parts.push_back("planet pole");
    parts.push_back("spin of " + of.planet);
  }
  if (of.tides) parts.push_back("tides");
  if (of.insolation) parts.push_back("insolation");
  return parts;
}

RunReport rows_of(const Obliquity& of, const Scenario& scenario,
                  std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control) {
  const SpinLayout layout(of.columns, scenario.units());
  RowWriter writer(layout.width(), sinks, control.rows);
  return with_problem(of, [&]<class Model>(const BasicProblem<Model>& problem) {
    const auto write = [&](std::span<const BasicSample<typename Model::State>> samples,
                           std::span<double> numbers) {
      for (std::size_t k = 0; k < samples.size(); ++k) {
        const double t = samples[k].t;
        layout.write(t,
                     spin_row(secular::tidal_spin(samples[k].s), of.history.at(t), of.insolation),
                     numbers.subspan(k * layout.width(), layout.width()));
      }
    };
    const RowsOfMotion<Model> motion{problem, *of.time, write};
    return completed(integrated_run(motion, writer, control).report, writer);
  });
}

namespace {

// What tides do at t = 0, as fractions per time.
void add_tides(Lines& lines, const Obliquity& of) {
  if (!of.tides) return;
  const TidalSpinOnHistory model(of.history, of.rates, *of.tides);
  const auto change =
      model.rates(DoubleDouble(0.0), model.values<double>(secular::tidal_spin(of.initial)));
  lines.number("spin_growth", "growth of the spin by tides, of itself", change[3],
               Dimension::growth);
  if (of.tides->satellite > 0.0)
    lines.number("distance_growth", "growth of the satellite's distance", change[4],
                 Dimension::growth);
}

}  // namespace

std::vector<SummaryLine> summary(const Obliquity& of, const Scenario& scenario) {
  Lines lines(scenario.units());
  lines.text("title", "title", scenario.document.title);
  lines.text("kind", "kind", "obliquity");
  lines.text("planet", "planet", of.planet);
  lines.text("orbit", "orbit " + of.orbit, of.orbit_text);
  const secular::OrbitElements start = of.history.at(0.0);
  const secular::SpinAngles angles = secular::spin_angles(of.initial, start);
  const double rate =
      of.rates.torque(0.0, secular::orbit_plane(start).e2) * std::cos(angles.obliquity) -
      of.rates.geodetic;
  lines.number("obliquity", "obliquity at t = 0", angles.obliquity, Dimension::angle);
  lines.number("precession_constant", "precession constant, on a circle",
               of.rates.star + of.rates.satellites, Dimension::rate);
  lines.number("precession_rate", "precession at t = 0", rate, Dimension::rate);
  if (rate != 0.0)
    lines.number("precession_period", "period of precession then",
                 2.0 * std::numbers::pi / std::fabs(rate), Dimension::time);
  add_tides(lines, of);
  lines.text("method", "method", propagation_text(of, scenario.units()));
  add_table_values(lines, scenario);
  return lines.take();
}

std::vector<SummaryLine> report_lines(const Obliquity&, const Scenario& scenario,
                                      const RunReport& report, const std::string& events) {
  Lines lines(scenario.units());
  add_report(lines, report, "torque", events);
  return lines.take();
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
