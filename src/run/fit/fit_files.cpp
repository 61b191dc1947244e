// SPDX-License-Identifier: MIT
// Files that a fit writes: residuals, covariances, scenarios that begin at a solution, and of light
// curves tables and meshes.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fit/free_motion.hpp"
#include "polhode/error.hpp"
#include "polhode/run/fit.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/scenario/changes.hpp"
#include "polhode/scenario/document.hpp"
#include "polhode/tables/obj.hpp"
#include "polhode/text/key.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_report.hpp"
#include "run/detail/output_checks.hpp"
#include "run/fit/fit_torques.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

namespace fs = std::filesystem;

// The folder that paths in a scenario written to `path` start from; on standard output that of this
// scenario.
std::string folder_of(const Document& document, const std::string& path) {
  return path == "-" ? document.folder : fs::path(path).parent_path().string();
}

}  // namespace
}  // namespace detail

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// One row of residuals.
struct Residual {
  double t;
  ObservedRow place;
  Vec3 turn{none, none, none}, rate{none, none, none};
  std::vector<double> sigmas = {};
};

// The smallest rotation, in body axes, that takes the direction that is predicted to the one seen.
Vec3 turn_to(const Vec3& predicted, const Vec3& seen) {
  const Vec3 across = cross(seen, predicted);
  const double sine = norm(across);
  return sine > 0.0 ? (std::atan2(sine, dot(seen, predicted)) / sine) * across : Vec3{};
}

std::vector<Residual> residuals_of(const FitReport& report, const fit::SpinSolution& found) {
  const ReadObservations& observed = report.observed;
  const fit::Snapshots& seen = observed.seen;
  const std::vector<double> times = fit::times_of(seen);
  const std::vector<fit::PredictedAttitude> at = detail::predicted_by(report, found, times);
  std::vector<Residual> all;
  std::size_t k = 0, number = 0;
  const auto add = [&](const ObservedRow& place, std::size_t size) -> Residual& {
    Residual& one = all.emplace_back(Residual{times[k++], place});
    for (std::size_t i = 0; i < size; ++i) one.sigmas.push_back(found.result.numbers.at(number++));
    return one;
  };
  for (std::size_t i = 0; i < seen.attitudes.size(); ++i) {
    const Quaternion& q = at[k].q;
    add(observed.attitudes[i], 3).turn = fit::attitude_residual(seen.attitudes[i].q, q);
  }
  for (std::size_t i = 0; i < seen.directions.size(); ++i) {
    const fit::ObservedDirection& one = seen.directions[i];
    const Vec3 in_body = rotate(conj(at[k].q), one.direction_I);
    const Vec3 turn = turn_to(one.axis_F, in_body);
    add(observed.directions[i], 2).turn = turn;
  }
  for (std::size_t i = 0; i < seen.rates.size(); ++i) {
    const Vec3 rate = at[k].w_F - seen.rates[i].w_F;
    add(observed.rates[i], 3).rate = rate;
  }
  for (std::size_t i = 0; i < seen.measurements.size(); ++i)
    add(observed.measurements[i], seen.measurements[i].seen.size());
  std::stable_sort(all.begin(), all.end(), [](const Residual& a, const Residual& b) {
    return std::pair(a.place.table, a.place.line) < std::pair(b.place.table, b.place.line);
  });
  return all;
}

void add_body(const Scenario& scenario, const FitReport& report, const fit::SpinState& state,
              std::vector<ScenarioChange>& changes) {
  const fit::SpinUnknowns& unknowns = report.problem.unknowns;
  if (!unknowns.moment_ratios && !unknowns.products) return;
  const Mat3& T = state.inertia_F;
  const bool has_moments =
      scenario.rotation().shape == nullptr && scenario.rotation().q_file == Quaternion{};
  const bool is_diagonal = T(0, 1) == 0.0 && T(0, 2) == 0.0 && T(1, 2) == 0.0;
  for (const char* const key : {"moments", "tensor", "shape", "density", "scale", "column_axes"})
    changes.push_back({std::string("body.") + key, ""});
  if (has_moments && is_diagonal && !unknowns.products)
    changes.push_back({"body.moments", detail::row_text(T(0, 0), T(1, 1), T(2, 2))});
  else
    changes.push_back({"body.tensor", "[" + detail::row_text(T(0, 0), T(0, 1), T(0, 2)) + ", " +
                                          detail::row_text(T(0, 1), T(1, 1), T(1, 2)) + ", " +
                                          detail::row_text(T(0, 2), T(1, 2), T(2, 2)) + "]"});
}

}  // namespace

void write_residuals(const Scenario& scenario, const FitReport& report, std::size_t solution,
                     const std::string& path) {
  const Units& units = scenario.units();
  const std::string angle = units.label(Dimension::angle), rate = units.label(Dimension::rate);
  const std::vector<Residual> residuals = residuals_of(report, report.solutions.at(solution).raw);
  std::size_t widest = 3;
  for (const Residual& one : residuals) widest = std::max(widest, one.sigmas.size());
  std::vector<ColumnGroup> groups = {
      {"t", {{"t", units.time()}}},
      {"observation", {{"table", "1"}, {"line", "1"}}},
      {"turn", {{"turn_x", angle}, {"turn_y", angle}, {"turn_z", angle}}},
      {"rate", {{"dw_x", rate}, {"dw_y", rate}, {"dw_z", rate}}},
      {"sigmas", {}}};
  for (std::size_t i = 1; i <= widest; ++i)
    groups.back().columns.push_back({"r" + std::to_string(i), "1"});
  std::vector<double> rows;
  for (const Residual& one : residuals) {
    rows.insert(rows.end(),
                {units.from_core(one.t, Dimension::time), static_cast<double>(one.place.table + 1),
                 static_cast<double>(one.place.line)});
    for (int i = 0; i < 3; ++i) rows.push_back(units.from_core(one.turn[i], Dimension::angle));
    for (int i = 0; i < 3; ++i) rows.push_back(units.from_core(one.rate[i], Dimension::rate));
    for (std::size_t i = 0; i < widest; ++i)
      rows.push_back(i < one.sigmas.size() ? one.sigmas[i] : none);
  }
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < require_fit(scenario).observations.size(); ++i) {
    const Observation& of = require_fit(scenario).observations[i];
    notes.push_back("table " + std::to_string(i + 1) + ": " + of.kind + ", " +
                    detail::printable(of.shown(), 500));
  }
  notes.emplace_back(
      "residuals: from what was seen to the solution, in body axes; r1, r2, r3 in standard errors "
      "as given");
  detail::write_fit_rows(scenario, groups, rows, notes, path);
}

void write_covariance(const Scenario& scenario, const FitReport& report, std::size_t solution,
                      const std::string& path) {
  const FoundSpin& found = report.solutions.at(solution);
  detail::write_fit_covariance(scenario, found.raw.covariance,
                               fit_numbers(scenario, report, solution), path);
}

std::string detail::text_from_state(const Scenario& scenario, const FitReport& report,
                                    const fit::SpinSolution& raw, const fit::SpinState& state,
                                    const std::string& folder) {
  std::vector<ScenarioChange> changes = relocated_paths(scenario.document, folder);
  const std::vector<ScenarioChange> none_seen = without_observations(scenario);
  changes.insert(changes.end(), none_seen.begin(), none_seen.end());
  add_body(scenario, report, state, changes);
  changes.push_back({"state." + scenario.rotation().chart, ""});
  changes.push_back(detail::state_change(scenario, state.q, state.w_F));
  detail::add_rows_of(scenario, fit::times_of(report.observed.seen), changes);
  return changed_text(text_with_torques(scenario, report, raw), changes);
}

std::string solution_text(const Scenario& scenario, const FitReport& report, std::size_t solution,
                          const std::optional<std::string>& folder) {
  const fit::SpinSolution& raw = report.solutions.at(solution).raw;
  return "# Solution " + std::to_string(solution + 1) + " of " +
         std::to_string(report.solutions.size()) + " of a fit of " +
         detail::printable(scenario.document.name, 200) + "\n" +
         detail::jump_comment(scenario, report) +
         detail::text_from_state(scenario, report, raw, detail::last_state(report, raw),
                                 folder.value_or(scenario.document.folder));
}

void write_solution(const Scenario& scenario, const FitReport& report, std::size_t solution,
                    const std::string& path) {
  const std::string folder = detail::folder_of(scenario.document, path);
  detail::write_fit_text(scenario, solution_text(scenario, report, solution, folder), path);
}

void write_landscape(const Scenario& scenario, const LightReport& report, const std::string& path) {
  if (!report.scan)
    throw DomainError(scenario.document.name +
                      ": no scan was made, and there is no landscape; expected fit.from = "
                      "\"search\" without fit.periods");
  const fit::Landscape& all = report.scan->landscape;
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

void write_residuals(const Scenario& scenario, const LightReport& report, std::size_t solution,
                     const std::string& path) {
  const std::vector<light::LightCurve>& curves = report.observed.curves;
  const std::vector<std::vector<double>> model = detail::fluxes_of(report, solution);
  std::vector<double> rows;
  std::vector<std::string> notes;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t k = 0; k < curves[c].points.size(); ++k) {
      const light::LightPoint& p = curves[c].points[k];
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

void write_covariance(const Scenario& scenario, const LightReport& report, std::size_t solution,
                      const std::string& path) {
  detail::write_fit_covariance(scenario, report.solutions.at(solution).solution.covariance,
                               fit_numbers(scenario, report, solution), path);
}

namespace {

using Changes = std::vector<ScenarioChange>;
using polhode::detail::number_text;

// Izz of a body of which the fit knows ratios alone: the greatest moment of the file.
double unit_moment(const Scenario& scenario) {
  const Vec3& I = scenario.rotation().body.moments();
  return std::fmax(I.x, std::fmax(I.y, I.z));
}

std::vector<double> times_of(const LightReport& report) {
  std::vector<double> times;
  for (const light::LightCurve& curve : report.observed.curves)
    for (const light::LightPoint& p : curve.points) times.push_back(p.t);
  return times;
}

void add_moments(const Scenario& scenario, const Mat3& T, Changes& changes) {
  for (const char* const key : {"moments", "tensor", "shape", "density", "scale", "column_axes"})
    changes.push_back({std::string("body.") + key, ""});
  const double unit = unit_moment(scenario);
  changes.push_back(
      {"body.moments", detail::row_text(unit * T(0, 0) / T(2, 2), unit * T(1, 1) / T(2, 2), unit)});
}

void add_state(const Scenario& scenario, const fit::SpinState& state, Changes& changes) {
  changes.push_back({"state." + scenario.rotation().chart, ""});
  changes.push_back(detail::state_change(scenario, state.q, state.w_F));
}

// The rest of [fit] looked for what is found: its loss alone stays.
void add_fit(const Scenario& scenario, Changes& changes) {
  for (const char* const key : {"fit", "map", "ensemble"}) changes.push_back({key, ""});
  const fit::Loss& loss = require_fit(scenario).loss;
  if (loss.kind == fit::Loss::Kind::squared) return;
  changes.push_back({"fit.loss", toml_text(detail::loss_word(loss))});
  changes.push_back({"fit.loss_scale", number_text(loss.scale)});
}

void add_mixed_law(double multiple, Changes& changes) {
  changes.push_back({"light.law", "\"mixed\""});
  changes.push_back({"light.multiple", number_text(multiple)});
}

// A fit of the mesh that begins at the solution: what was observed stays, so that it can be
// simulated and fitted again.
Changes mesh_changes(const Scenario& scenario, const LightReport& report,
                     const fit::FoundLight& found, const std::string& mesh,
                     const std::string& folder) {
  const bool is_convex = found.solution.body.is_convex();
  const fit::SpinState state = fit::detail::spin_at(found.solution.body.spin, 0.0);
  Changes changes;
  add_fit(scenario, changes);
  if (is_convex || report.unknowns.moments == fit::MomentSource::fit) {
    if (!is_convex && require_fit(scenario).light.mesh.empty())
      changes.push_back(
          {"light.mesh",
           toml_text(moved_path(scenario.document, scenario.rotation().shape->file, folder))});
    add_moments(scenario, state.inertia_F, changes);
  }
  add_state(scenario, state, changes);
  for (const char* const key : {"convex", "moments", "semiaxes"})
    changes.push_back({std::string("light.") + key, ""});
  if (is_convex) {
    changes.push_back({"light.shape", "\"mesh\""});
    changes.push_back({"light.mesh", toml_text(mesh)});
  }
  if (report.unknowns.multiple) add_mixed_law(found.solution.body.law.multiple, changes);
  changes.push_back({"free.unknowns", "[\"attitude\", \"rate\"]"});
  detail::add_rows_of(scenario, times_of(report), changes);
  return changes;
}

Changes ellipsoid_changes(const Scenario& scenario, const LightReport& report,
                          const fit::FoundLight& found) {
  const fit::LightModel& body = found.solution.body;
  const light::Ellipsoid& shape = body.ellipsoid();
  const fit::SpinState state = fit::detail::spin_at(body.spin, 0.0);
  Changes changes;
  add_fit(scenario, changes);
  add_moments(scenario, state.inertia_F, changes);
  add_state(scenario, state, changes);
  changes.push_back({"light.semiaxes", detail::row_text(shape.a, shape.b, shape.c)});
  if (report.unknowns.multiple && body.law.multiple > 0.0)
    add_mixed_law(body.law.multiple, changes);
  detail::add_rows_of(scenario, times_of(report), changes);
  return changes;
}

// What the file has no keys for.
std::string comment_of(const fit::FoundLight& found) {
  const fit::LightModel& body = found.solution.body;
  const light::Ellipsoid& e = found.ellipsoid;
  const char* const shape = body.is_convex() ? "convex body, like the "
                            : body.is_mesh() ? "mesh, like the "
                                             : "";
  return std::string("\n# ") + shape + "ellipsoid 1 : " + number_text(e.b / e.a) + " : " +
         number_text(e.c / e.a) + ", weight of Lambert's law " + number_text(body.law.multiple) +
         "\n";
}

}  // namespace

std::string solution_text(const Scenario& scenario, const LightReport& report, std::size_t solution,
                          const std::string& mesh, const std::optional<std::string>& folder) {
  const fit::FoundLight& found = report.solutions.at(solution);
  const std::string there = folder.value_or(scenario.document.folder);
  Changes changes = relocated_paths(scenario.document, there);
  const Changes own = found.solution.body.is_ellipsoid()
                          ? ellipsoid_changes(scenario, report, found)
                          : mesh_changes(scenario, report, found, mesh, there);
  changes.insert(changes.end(), own.begin(), own.end());
  return "# Solution " + std::to_string(solution + 1) + " of " +
         std::to_string(report.solutions.size()) + " of a fit of " +
         detail::printable(scenario.document.name, 200) + ":\n# " +
         (found.sentence.empty() ? found.solution.result.sentence : found.sentence) +
         comment_of(found) + changed_text(scenario.document.text, changes);
}

void write_solution(const Scenario& scenario, const LightReport& report, std::size_t solution,
                    const std::string& path) {
  const fit::LightModel& body = report.solutions.at(solution).solution.body;
  if (!body.is_convex()) {
    detail::write_fit_text(
        scenario,
        solution_text(scenario, report, solution, {}, detail::folder_of(scenario.document, path)),
        path);
    return;
  }
  const std::filesystem::path toml(path);
  if (path == "-" || toml.extension() == ".obj")
    throw DomainError(scenario.document.name + ": --solution " + detail::printable(path, 200) +
                      ": expected PATH.toml; the mesh of a convex body is written beside it");
  const std::string mesh = toml.stem().string() + "-seen.obj";
  const std::string files[] = {path, (toml.parent_path() / mesh).string()};
  detail::require_own_files(scenario.document, files);
  // both before the first is written
  const std::string text =
      solution_text(scenario, report, solution, mesh, detail::folder_of(scenario.document, path));
  const std::string obj = obj_text(body.convex().mesh());
  detail::write_fit_text(scenario, obj, files[1]);
  detail::write_fit_text(scenario, text, files[0]);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
