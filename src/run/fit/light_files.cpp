// SPDX-License-Identifier: MIT
// Tables that a fit of light curves leaves on the disk.
#include "polhode/error.hpp"
#include "polhode/run/light_report.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_words.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {

void write_landscape(const Scenario& scenario, const LightReport& report, const std::string& path) {
  if (!report.scan)
    throw DomainError(scenario.document.name +
                      ": no scan was made, and there is no landscape; expected fit.from = "
                      "\"search\" without fit.periods");
  const Landscape& all = report.scan->landscape;
  const std::string unit = "1/" + scenario.units().time();
  const double period = scenario.units().from_core(1.0, Dimension::time);
  std::vector<double> rows;
  rows.reserve(3 * all.chi_square.size());
  for (std::size_t i = 0; i < all.first.count; ++i)
    for (std::size_t j = 0; j < all.second.count; ++j)
      rows.insert(rows.end(), {all.first.at(i) / period, all.second.at(j) / period, all.at(i, j)});
  detail::write_fit_rows(
      scenario,
      {{"f1", {{"f1", unit}}}, {"f2", {{"f2", unit}}}, {"chi_square", {{"chi_square", "1"}}}}, rows,
      {"scan of order " + std::to_string(all.orders.second) + ": " +
       std::to_string(all.first.count) + " by " + std::to_string(all.second.count) +
       " frequencies, f2 changes first" +
       (report.scan->separate ? "; the sum of " + std::to_string(report.scan->separate->sessions) +
                                    " sessions with series of their own"
                              : std::string())},
      path);
}

void write_light_residuals(const Scenario& scenario, const LightReport& report,
                           std::size_t solution, const std::string& path) {
  const std::vector<LightCurve>& curves = report.observed.curves;
  const std::vector<std::vector<double>> model = detail::fluxes_of(report, solution);
  std::vector<double> rows;
  std::vector<std::string> notes;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t k = 0; k < curves[c].points.size(); ++k) {
      const LightPoint& p = curves[c].points[k];
      const ObservedRow& place = report.observed.curve_rows.at(c).at(k);
      const double difference = model[c][k] - p.flux;
      rows.insert(rows.end(), {scenario.units().from_core(p.t, Dimension::time),
                               static_cast<double>(place.table + 1),
                               static_cast<double>(place.line), static_cast<double>(c + 1), p.flux,
                               p.sigma, model[c][k], difference, difference / p.sigma});
    }
    notes.push_back("session " + std::to_string(c + 1) + ": " +
                    (curves[c].is_calibrated ? "calibrated" : "relative") +
                    (curves[c].name.empty() ? "" : ", " + detail::printable(curves[c].name, 500)));
  }
  notes.emplace_back(
      "difference: from what was seen to the solution; r in standard errors as given");
  detail::write_fit_rows(scenario,
                         {{"t", {{"t", scenario.units().time()}}},
                          {"observation", {{"table", "1"}, {"line", "1"}, {"session", "1"}}},
                          {"light", {{"flux", "1"}, {"sigma", "1"}, {"model", "1"}}},
                          {"residual", {{"difference", "1"}, {"r", "1"}}}},
                         rows, notes, path);
}

void write_light_covariance(const Scenario& scenario, const LightReport& report,
                            std::size_t solution, const std::string& path) {
  detail::write_fit_covariance(scenario, report.solutions.at(solution).solution.covariance,
                               light_numbers(scenario, report, solution), path);
}

}  // namespace v0
}  // namespace polhode
