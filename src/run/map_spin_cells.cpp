// SPDX-License-Identifier: MIT
// The cells of a map over spin axes: extremes of a column, and how steady the precession is.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/analysis/spectrum.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/scenario/obliquity.hpp"
#include "run/detail/map_cells.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// seen(t, state) for every row.
template <class Seen>
Outcome run_rows_of(const Obliquity& obliquity, const Progress& progress, const Seen& seen) {
  return with_problem(obliquity, [&]<class Model>(const BasicProblem<Model>& problem) {
    const auto each = [&](std::span<const BasicSample<typename Model::State>> samples) {
      for (const auto& one : samples) seen(one.t, tidal_spin(one.s));
    };
    return integrate(problem, *obliquity.time, each, progress).outcome();
  });
}

MapCell column_cell(const Obliquity& obliquity, const CellContext& of, const Progress& progress) {
  const SpinColumn& column = *spin_column(of.plan.column);
  Extremes extremes;
  const Outcome outcome = run_rows_of(obliquity, progress, [&](double t, const TidalSpin& at) {
    extremes.add(column.value(spin_row(at, obliquity.history.at(t), obliquity.insolation)));
  });
  return ended(extremes.in(of.units, column.dimension), outcome, 3);
}

// The largest line of sin(obliquity) exp(i psi), which has no singularity.
double precession_frequency(std::span<const std::complex<double>> equinox, double interval) {
  const Spectrum found = spectrum(0.0, interval, equinox, {.lines = 1});
  return found.lines.empty() ? std::nan("") : found.lines.front().frequency;
}

// Why rows like these tell no frequency of a precession of up to this constant; empty: they do.
std::string frequency_obstacle(double constant, const SaveAt& rows, const Units& units) {
  constexpr double least_turns = 5.0;  // of a half
  const double turn = 2.0 * std::numbers::pi, period = turn / constant;
  const double interval = std::fabs(rows[1] - rows[0]);
  const double half = 0.5 * interval * static_cast<double>(rows.size());
  const auto text = [&](double t) {
    return fmt::format("{:.4g}", units.from_core(t, Dimension::time));
  };
  const std::string of = "the precession, with a period of " + text(period) + " " + units.time() +
                         " on a circle at obliquity 0, ";
  if (interval > 0.5 * period)
    return of + "needs rows at most " + text(0.5 * period) + " apart; got " + text(interval);
  if (half < least_turns * period)
    return of + "needs rows over " + text(2.0 * least_turns * period) + " or more; got " +
           text(2.0 * half);
  return "";
}

// The frequencies of the first and of the second half of the rows: where they differ, the motion is
// chaotic (Laskar & Robutel 1993).
MapCell frequency_cell(const Obliquity& obliquity, const CellContext& of,
                       const Progress& progress) {
  const std::string obstacle =
      frequency_obstacle(std::fabs(obliquity.rates.torque(0.0, 0.0)), *obliquity.time, of.units);
  if (!obstacle.empty()) return failed_cell(3, obstacle);
  std::vector<std::complex<double>> equinox;
  const Outcome outcome = run_rows_of(obliquity, progress, [&](double t, const TidalSpin& at) {
    const SpinAngles angles = spin_angles({at.s}, obliquity.history.at(t));
    const double size = std::sin(angles.obliquity);
    equinox.push_back(size > 0.0 ? std::polar(size, angles.precession) : 0.0);
  });
  if (!outcome.ok()) return failed_cell(3, outcome.advice);
  const SaveAt& rows = *obliquity.time;
  const double interval = rows[1] - rows[0];
  const std::size_t half = equinox.size() / 2;
  const std::span all(equinox);
  const double first = precession_frequency(all.first(half), std::fabs(interval)),
               later = precession_frequency(all.last(half), std::fabs(interval));
  const double sign = interval < 0.0 ? -1.0 : 1.0;
  const auto shown = [&](double rate) { return of.units.from_core(rate, Dimension::rate); };
  return {{shown(sign * first), shown(sign * later), std::fabs(1.0 - later / first)}, ""};
}

}  // namespace

MapCell map_cell(const Obliquity& obliquity, const CellContext& of, const Progress& progress) {
  return of.plan.kind == MapKind::frequency ? frequency_cell(obliquity, of, progress)
                                            : column_cell(obliquity, of, progress);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
