// SPDX-License-Identifier: MIT
// Scenarios that begin at a solution of light curves, and the meshes beside them.
#include <cmath>
#include <filesystem>

#include "fit/free_rotation_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/tables/obj.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_words.hpp"
#include "run/detail/moved_files.hpp"
#include "run/detail/own_files.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using Changes = std::vector<ScenarioChange>;
using detail::number_text;

// Izz of a body of which the fit knows ratios alone: the greatest moment of the file.
double unit_moment(const Scenario& scenario) {
  const Vec3& I = scenario.rotation().body.moments();
  return std::fmax(I.x, std::fmax(I.y, I.z));
}

std::vector<double> times_of(const LightReport& report) {
  std::vector<double> times;
  for (const LightCurve& curve : report.observed.curves)
    for (const LightPoint& p : curve.points) times.push_back(p.t);
  return times;
}

void add_moments(const Scenario& scenario, const Mat3& T, Changes& changes) {
  for (const char* const key : {"moments", "tensor", "shape", "density", "scale", "column_axes"})
    changes.push_back({std::string("body.") + key, ""});
  const double unit = unit_moment(scenario);
  changes.push_back(
      {"body.moments", detail::row_text(unit * T(0, 0) / T(2, 2), unit * T(1, 1) / T(2, 2), unit)});
}

void add_state(const Scenario& scenario, const SpinState& state, Changes& changes) {
  changes.push_back({"state." + scenario.rotation().chart, ""});
  changes.push_back(detail::state_change(scenario, state.q, state.w_F));
}

// The rest of [fit] looked for what is found: its loss alone stays.
void add_fit(const Scenario& scenario, Changes& changes) {
  for (const char* const key : {"fit", "map", "ensemble"}) changes.push_back({key, ""});
  const Loss& loss = require_fit(scenario).loss;
  if (loss.kind == Loss::Kind::squared) return;
  changes.push_back({"fit.loss", detail::quoted_path(detail::loss_word(loss))});
  changes.push_back({"fit.loss_scale", number_text(loss.scale)});
}

void add_mixed_law(double multiple, Changes& changes) {
  changes.push_back({"light.law", "\"mixed\""});
  changes.push_back({"light.multiple", number_text(multiple)});
}

// A fit of the mesh that begins at the solution: what was observed stays, so that it can be
// simulated and fitted again.
Changes mesh_changes(const Scenario& scenario, const LightReport& report, const FoundLight& found,
                     const std::string& mesh, const std::string& folder) {
  const bool is_convex = !report.convex.empty();
  const SpinState state = detail::spin_at(found.solution.body.spin, 0.0);
  Changes changes;
  add_fit(scenario, changes);
  if (is_convex || report.unknowns.moments == MomentSource::fit) {
    if (!is_convex && require_fit(scenario).light.mesh.empty())
      changes.push_back(
          {"light.mesh", detail::quoted_path(detail::moved_path(
                             scenario.document, scenario.rotation().shape->file, folder))});
    add_moments(scenario, state.inertia_F, changes);
  }
  add_state(scenario, state, changes);
  for (const char* const key : {"convex", "moments", "semiaxes"})
    changes.push_back({std::string("light.") + key, ""});
  if (is_convex) {
    changes.push_back({"light.shape", "\"mesh\""});
    changes.push_back({"light.mesh", detail::quoted_path(mesh)});
  }
  if (report.unknowns.multiple) add_mixed_law(found.solution.body.law.multiple, changes);
  changes.push_back({"free.unknowns", "[\"attitude\", \"rate\"]"});
  detail::add_rows_of(scenario, times_of(report), changes);
  return changes;
}

Changes ellipsoid_changes(const Scenario& scenario, const LightReport& report,
                          const FoundLight& found) {
  const BrightEllipsoid& body = found.solution.body;
  const SpinState state = detail::spin_at(body.spin, 0.0);
  Changes changes;
  add_fit(scenario, changes);
  add_moments(scenario, state.inertia_F, changes);
  add_state(scenario, state, changes);
  changes.push_back({"light.semiaxes", detail::row_text(body.shape.a, body.shape.b, body.shape.c)});
  if (report.unknowns.multiple && body.law.multiple > 0.0)
    add_mixed_law(body.law.multiple, changes);
  detail::add_rows_of(scenario, times_of(report), changes);
  return changes;
}

// What the file has no keys for.
std::string comment_of(const LightReport& report, const FoundLight& found) {
  const BrightEllipsoid& body = found.solution.body;
  const char* const shape = report.shape == LightPlan::Shape::convex ? "convex body, like the "
                            : report.mesh                            ? "mesh, like the "
                                                                     : "";
  return std::string("\n# ") + shape + "ellipsoid 1 : " + number_text(body.shape.b / body.shape.a) +
         " : " + number_text(body.shape.c / body.shape.a) + ", weight of Lambert's law " +
         number_text(body.law.multiple) + "\n";
}

}  // namespace

std::string light_solution_text(const Scenario& scenario, const LightReport& report,
                                std::size_t solution, const std::string& mesh,
                                const std::optional<std::string>& folder) {
  const FoundLight& found = report.solutions.at(solution);
  const std::string there = folder.value_or(scenario.document.folder);
  Changes changes = detail::moved_files(scenario.document, there);
  const Changes own = report.shape != LightPlan::Shape::ellipsoid
                          ? mesh_changes(scenario, report, found, mesh, there)
                          : ellipsoid_changes(scenario, report, found);
  changes.insert(changes.end(), own.begin(), own.end());
  return "# Solution " + std::to_string(solution + 1) + " of " +
         std::to_string(report.solutions.size()) + " of a fit of " +
         detail::printable(scenario.document.name, 200) + ":\n# " +
         (found.sentence.empty() ? found.solution.result.sentence : found.sentence) +
         comment_of(report, found) + changed_text(scenario.document.text, changes);
}

void write_light_solution(const Scenario& scenario, const LightReport& report, std::size_t solution,
                          const std::string& path) {
  if (report.convex.empty()) {
    detail::write_fit_text(scenario,
                           light_solution_text(scenario, report, solution, {},
                                               detail::folder_of(scenario.document, path)),
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
  const std::string text = light_solution_text(scenario, report, solution, mesh,
                                               detail::folder_of(scenario.document, path));
  const std::string obj = obj_text(report.convex.at(solution).mesh());
  detail::write_fit_text(scenario, obj, files[1]);
  detail::write_fit_text(scenario, text, files[0]);
}

}  // namespace v0
}  // namespace polhode
