// SPDX-License-Identifier: MIT
// What a fit of light curves leaves on the disk.
#include <cmath>

#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/run/light_report.hpp"
#include "run/detail/fit_tables.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Izz of a body of which the fit knows ratios alone: the greatest moment of the file.
double unit_moment(const Scenario& scenario) {
  const Vec3& I = scenario.rotation().body.moments();
  return std::fmax(I.x, std::fmax(I.y, I.z));
}

// The state at t = 0 of the file.
SpinState at_zero(const SpinState& s) {
  if (s.t0 == 0.0) return s;
  const Mat3& T = s.inertia_F;
  const Body body(T(0, 0) / T(2, 2), T(1, 1) / T(2, 2), 1.0);
  const Vec3 I = body.moments();
  const FreeRotation motion(body, {normalized(s.q), {I.x * s.w_F.x, I.y * s.w_F.y, I.z * s.w_F.z}},
                            s.t0);
  const RotorState there = motion.at(0.0);
  return {0.0, there.q, angular_velocity(body, there), T};
}

std::vector<double> times_of(const LightReport& report) {
  std::vector<double> times;
  for (const LightCurve& curve : report.observed.curves)
    for (const LightPoint& p : curve.points) times.push_back(p.t);
  return times;
}

}  // namespace

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
       " frequencies, f2 changes first"},
      path);
}

void write_light_residuals(const Scenario& scenario, const LightReport& report,
                           std::size_t solution, const std::string& path) {
  const std::vector<LightCurve>& curves = report.observed.curves;
  const BrightEllipsoid& body = report.solutions.at(solution).solution.body;
  const std::vector<std::vector<double>> model = model_fluxes(body, curves);
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

std::string light_solution_text(const Scenario& scenario, const LightReport& report,
                                std::size_t solution) {
  const FoundLight& found = report.solutions.at(solution);
  const BrightEllipsoid& body = found.solution.body;
  const SpinState state = at_zero(body.spin);
  std::vector<ScenarioChange> changes = detail::without_observations(scenario);
  for (const char* const key : {"moments", "tensor", "shape", "density", "scale", "column_axes"})
    changes.push_back({std::string("body.") + key, ""});
  const double unit = unit_moment(scenario);
  const Mat3& T = state.inertia_F;
  changes.push_back(
      {"body.moments", detail::row_text(unit * T(0, 0) / T(2, 2), unit * T(1, 1) / T(2, 2), unit)});
  changes.push_back({"state." + scenario.rotation().chart, ""});
  changes.push_back(detail::state_change(scenario, state.q, state.w_F));
  detail::add_rows_of(scenario, times_of(report), changes);
  return "# Solution " + std::to_string(solution + 1) + " of " +
         std::to_string(report.solutions.size()) + " of a fit of " +
         detail::printable(scenario.document.name, 200) + ":\n# " + found.sentence +
         "\n# ellipsoid 1 : " + detail::number_text(body.shape.b / body.shape.a) + " : " +
         detail::number_text(body.shape.c / body.shape.a) + ", weight of Lambert's law " +
         detail::number_text(body.law.multiple) + "\n" +
         changed_text(scenario.document.text, changes);
}

void write_light_solution(const Scenario& scenario, const LightReport& report, std::size_t solution,
                          const std::string& path) {
  detail::write_fit_text(scenario, light_solution_text(scenario, report, solution), path);
}

}  // namespace v0
}  // namespace polhode
