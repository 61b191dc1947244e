// SPDX-License-Identifier: MIT
// From light curves to solutions: from a start in the file, or by scan, labels and search.
#include "run/detail/light_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/scenario/scenario.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_report.hpp"
#include "text/number_text.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

// For light curves. ScenarioError unless nothing acts on the body, no torque or jump is unknown,
// and the state is relative to inertial axes.
void require_free_fit(const Scenario& scenario) {
  const FitPlan::Places& places = require_fit(scenario).places;
  if (!places.perturbations.empty())
    places.perturbations.front().refuse("expected no perturbation: a fit is one of free rotation");
  if (places.drive) places.drive->refuse("expected none: light curves are fitted in free rotation");
  detail::require_inertial(scenario);
}

constexpr double speed_of_light = 299792458.0;  // m/s
// Starts of each pair of periods where the file does not say how many there are.
constexpr std::size_t starts_of_periods = 20;

// v_F = R v_B with the numbers k_B rising along F.
Mat3 sorted_axes(const Vec3& k_B) {
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return k_B[i] < k_B[j]; });
  Mat3 R;
  for (int i = 0; i < 3; ++i) R(i, order[static_cast<std::size_t>(i)]) = 1.0;
  if (dot(R.row[0], cross(R.row[1], R.row[2])) < 0.0) R.row[2] = -1.0 * R.row[2];
  return R;
}

Vec3 permuted(const Mat3& R, const Vec3& k_B) {
  const Vec3 k = R * k_B;
  return {std::fabs(k.x), std::fabs(k.y), std::fabs(k.z)};
}

// The state of the file at t = 0, along axes with falling semi-axes, or rising moments.
fit::LightModel start_of(const Scenario& scenario, const LightPlan& plan) {
  const Rotation& rotation = scenario.rotation();
  const RotorState& s = initial_state(rotation);
  const Vec3 I = rotation.body.moments();
  const bool by_shape = plan.unknowns.moments == fit::MomentSource::shape && plan.semiaxes;
  const Mat3 R = sorted_axes(by_shape ? -1.0 * *plan.semiaxes : I);
  const Quaternion q_BF = attitude(R);
  const Vec3 w = R * angular_velocity(rotation.body, s);
  const Vec3 moments = permuted(R, I);
  light::Ellipsoid shape = light::homogeneous_ellipsoid(moments, 1.0);
  if (plan.semiaxes) {
    const Vec3 axes = permuted(R, *plan.semiaxes);
    shape = {axes.x, axes.y, axes.z};
  }
  fit::LightModel start =
      fit::LightModel::homogeneous(0.0, normalized(s.q * q_BF), w, shape, plan.law);
  if (plan.unknowns.moments == fit::MomentSource::shape) return start;
  start.spin.inertia_F = Mat3::identity();
  for (int i = 0; i < 2; ++i) start.spin.inertia_F(i, i) = moments[i] / moments.z;
  return start;
}

// Shape and unknowns into the report; and what the scenario asks that no fit can do.
void begin_surfaces(const Scenario& scenario, LightReport& report) {
  const FitPlan& plan = require_fit(scenario);
  report.shape = plan.light.shape;
  if (report.shape == LightPlan::Shape::mesh) {
    if (plan.light.unknowns.shape)
      plan.places.unknowns.refuse(
          "expected no shape with light.shape = \"mesh\": the mesh is given");
    report.unknowns.shape = false;
  }
  if (report.shape != LightPlan::Shape::convex) return;
  // says what is wrong with degree and rows before the search
  plan.light.places.degree.built(
      [&] { return light::GaussianImage(plan.light.convex.degree, plan.light.convex.rows); });
  report.unknowns = {.shape = true,
                     .moments = plan.light.convex.moments,
                     .multiple = plan.light.unknowns.multiple};
}

// A convex body begins with the ellipsoid of the first session.
void extend_from_start(const Scenario& scenario, const FitPlan& plan, const FitOptions& options,
                       LightReport& report) {
  const std::vector<light::LightCurve>& curves = report.observed.curves;
  fit::LightModel start = report.shape == LightPlan::Shape::mesh
                              ? *detail::surface_search(scenario, report.unknowns).mesh
                              : start_of(scenario, plan.light);
  const std::size_t first = detail::nearest_session(curves, start, plan.loss);
  if (report.shape == LightPlan::Shape::convex) {
    const fit::LightSolution found = fit::fit_light(
        {{curves[first]}, start, plan.light.unknowns, plan.loss, plan.most_iterations});
    if (!found.is_found()) {
      report.failure = found.result.sentence;
      return;
    }
    start = found.body;
    report.converged = 1;
  }
  detail::extend_to_sessions(scenario, first, {start}, options, report);
  const std::size_t converged = report.is_found() ? 1 : 0;
  if (report.shape == LightPlan::Shape::ellipsoid) {
    report.converged = converged;
  } else {
    report.surfaces = 1;
    report.surfaces_converged = converged;
  }
}

// The mesh in the state of the file, or a convex body from an ellipsoid that was fitted.
void fit_surface(const Scenario& scenario, const fit::LightModel& begun, LightReport& report) {
  const fit::SurfaceSearch surface = detail::surface_search(scenario, report.unknowns);
  const fit::LightModel start = surface.mesh ? *surface.mesh : surface.convex_of(begun);
  fit::FoundLight one = fit::found_light(fit::fit_light(surface.fit_from(
      start, report.observed.curves, require_fit(scenario).loss, surface.most_iterations)));
  report.surfaces = 1;
  if (!one.solution.is_found()) {
    report.failure = one.solution.result.sentence;
    return;
  }
  report.surfaces_converged = 1;
  one.starts = 1;
  one.begun = begun;
  if (start.is_convex()) one.ellipsoid = begun.ellipsoid();
  fit::detail::set_ellipsoid(one);
  report.solutions = {std::move(one)};
}

// A mesh from the file; a convex body from the ellipsoid that is found first.
void fit_from_start(const Scenario& scenario, const FitPlan& plan, const FitOptions& options,
                    LightReport& report) {
  if (plan.light.one_by_one) return extend_from_start(scenario, plan, options, report);
  if (report.shape == LightPlan::Shape::mesh) {
    report.start = fit::LightModel{spin_state(scenario.rotation()), light::Ellipsoid{1.0, 1.0, 1.0},
                                   plan.light.law};
    return fit_surface(scenario, *report.start, report);
  }
  report.start = start_of(scenario, plan.light);
  const fit::LightFit fit{report.observed.curves, *report.start, plan.light.unknowns, plan.loss,
                          plan.most_iterations};
  fit::FoundLight found = fit::found_light(fit::fit_light(fit));
  found.starts = 1;
  if (!found.solution.is_found()) {
    report.failure = found.solution.result.sentence;
    return;
  }
  report.converged = 1;
  if (report.shape == LightPlan::Shape::convex)
    return fit_surface(scenario, found.solution.body, report);
  report.solutions.push_back(std::move(found));
}

// Of the ellipsoids that convex bodies and meshes begin with, which have shapes of their own.
fit::LightUnknowns unknowns_of_search(const LightPlan& plan) {
  if (plan.shape == LightPlan::Shape::ellipsoid) return plan.unknowns;
  return {.shape = true,
          .moments = plan.unknowns.moments == fit::MomentSource::fit ? fit::MomentSource::fit
                                                                     : fit::MomentSource::shape,
          .multiple = plan.unknowns.multiple};
}

// Notes pairs of periods whose fits are no solutions, although they came as low.
void note_unfinished(const FitPlan& plan, LightReport& report) {
  if (!report.is_found()) return;
  const double most = plan.light.within_factor * report.solutions.front().solution.result.cost;
  const auto count = std::ranges::count_if(report.pairs, [&](const PairFound& pair) {
    return pair.surface && !pair.surface->is_found() && pair.surface->result.cost <= most;
  });
  if (count > 0)
    report.notes.push_back(
        polhode::detail::counted(static_cast<std::size_t>(count), "pair of periods",
                                 "pairs of periods") +
        " came as low as the solutions, but the fits did not converge: the table has them, and "
        "fit.iterations takes them further");
}

void search(const Scenario& scenario, const FitPlan& plan, const FitOptions& options,
            LightReport& report) {
  fit::LightSearch how;
  how.curves = report.observed.curves;
  const std::size_t first = detail::longest_session(how.curves);
  if (plan.light.one_by_one) how.curves = {how.curves[first]};
  how.periods = plan.light.periods;
  if (how.periods.empty()) {
    report.scan = detail::light_scan(scenario, how.curves, options);
    if (options.scans_only || !plan.light.is_tumbler)
      report.verdict = detail::scan_verdict(scenario, *report.scan, how.curves);
    if (options.scans_only) {
      report.failure = "only the scan was requested";
      return;
    }
    if (!report.verdict.empty()) {
      report.failure = std::string(report.scan->constant->suffices ? "no variation is seen"
                                                                   : "one period is enough") +
                       "; set fit.rotation = \"tumbler\" to search for two periods";
      return;
    }
    how.periods = fit::labelled_periods(report.scan->minima, plan.light.scan.labels);
  }
  if (how.periods.empty()) {
    report.failure =
        "no minimum of the scan is resolved and inside of its grid: other limits, or fit.periods";
    return;
  }
  how.starts = plan.light.starts.value_or(starts_of_periods * how.periods.size());
  how.within = plan.light.within_factor;
  how.unknowns = unknowns_of_search(plan.light);
  how.law = plan.light.law;
  how.loss = plan.loss;
  how.most_iterations = plan.light.most_iterations.value_or(how.most_iterations);
  how.seed = plan.seed;
  if (report.shape != LightPlan::Shape::ellipsoid)
    how.surface = detail::surface_search(scenario, report.unknowns);
  std::string where = "in the search";
  how.begins = [&](const std::string& stage, const std::string& work) {
    if (stage == "surfaces")
      where = how.surface->mesh ? "in the fits of the mesh" : "in the fits of convex bodies";
    if (options.begins) options.begins(stage, work);
  };
  detail::follow(scenario, options, where, how);
  fit::LightSearchResult found = fit::search_light(how);
  report.starts = found.starts;
  report.finalists = found.finalists;
  report.converged = found.converged;
  report.surfaces = found.surfaces;
  report.surfaces_converged = found.surfaces_converged;
  found.surface_of_periods.resize(how.periods.size());
  for (std::size_t p = 0; p < how.periods.size(); ++p)
    report.pairs.push_back({how.periods[p], found.best_of_periods[p], found.surface_of_periods[p]});
  report.notes = std::move(found.notes);
  report.solutions = std::move(found.solutions);
  report.failure = std::move(found.failure);
  note_unfinished(plan, report);
  if (report.solutions.empty() || !plan.light.one_by_one) return;
  for (std::string& note : report.notes)
    note = "search of session " + std::to_string(first + 1) + ": " + note;
  std::vector<fit::LightModel> starts;
  for (const fit::FoundLight& one : report.solutions)
    starts.push_back(report.shape == LightPlan::Shape::convex ? *one.begun : one.solution.body);
  detail::extend_to_sessions(scenario, first, std::move(starts), options, report);
}

// A sentence for each table whose points have light times of their own.
void add_light_times(const Scenario& scenario, LightReport& report) {
  const std::vector<Observation>& tables = require_fit(scenario).observations;
  const auto text = [&](double time) {
    return polhode::detail::rounded_text(scenario.units().from_core(time, Dimension::time)) + " " +
           scenario.units().time();
  };
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (tables[i].times != light::LightTime::at_observer || tables[i].light_time) continue;
    const double c = scenario.units().to_core(speed_of_light, "m/s", Dimension::speed);
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (std::size_t k = 0; k < report.observed.curves.size(); ++k) {
      if (report.observed.curve_rows[k].front().table != i) continue;
      for (const light::LightPoint& p : report.observed.curves[k].points) {
        least = std::fmin(least, norm(p.to_observer) / c);
        most = std::fmax(most, norm(p.to_observer) / c);
      }
    }
    report.notes.push_back("times of " + tables[i].shown() +
                           " are those at the body, earlier by the light time of each point from "
                           "its distance to the observer, " +
                           text(least) + " to " + text(most));
  }
}

}  // namespace

std::size_t LightReport::points() const { return detail::count_points(observed.curves); }

bool LightReport::has_errors() const {
  return std::ranges::any_of(
      solutions, [](const fit::FoundLight& one) { return one.solution.describes_data(); });
}

bool observes_light(const Scenario& scenario) {
  const FitPlan* const plan = scenario.fit.get();
  return plan != nullptr && plan->has_light();
}

fit::SurfaceSearch detail::surface_search(const Scenario& scenario,
                                          const fit::LightUnknowns& unknowns) {
  const LightPlan& plan = require_fit(scenario).light;
  fit::SurfaceSearch surface{.degree = plan.convex.degree,
                             .rows = plan.convex.rows,
                             .unknowns = unknowns,
                             .regularisation = {.roughness_error = plan.convex.roughness_error,
                                                .moments_error = plan.convex.moments_error},
                             .pairs = plan.convex.pairs};
  surface.most_iterations = plan.most_iterations.value_or(surface.most_iterations);
  if (plan.shape == LightPlan::Shape::mesh)
    surface.mesh = fit::LightModel{spin_state(scenario.rotation()),
                                   light::ShadedMesh(light_mesh(scenario)), plan.law};
  return surface;
}

fit::LightFit light_fit_at(const Scenario& scenario, const LightReport& report,
                           std::size_t solution) {
  const fit::FoundLight& found = report.solutions.at(solution);
  const fit::SurfaceSearch surface = detail::surface_search(scenario, report.unknowns);
  fit::LightFit fit = surface.fit_from(found.solution.body, report.observed.curves,
                                       require_fit(scenario).loss, surface.most_iterations);
  if (found.solution.body.is_convex()) fit.regularisation.about = found.begun;
  return fit;
}

LightReport fit_light_scenario(const Scenario& scenario, const FitOptions& options) {
  const FitPlan& plan = require_fit(scenario);
  require_free_fit(scenario);
  if (!plan.has_light()) plan.observations.at(0).place.refuse("expected \"light-curve\"");
  if (plan.light.unknowns.moments == fit::MomentSource::start && plan.light.searches &&
      plan.light.shape != LightPlan::Shape::mesh)
    plan.light.places.moments.refuse(
        "expected \"of-shape\", or moments among free.unknowns: a search has bodies of its own");
  LightReport report;
  report.unknowns = plan.light.unknowns;
  report.observed = read_observations(scenario);
  const std::vector<light::LightCurve>& curves = report.observed.curves;
  light::require_sound(curves, {.vectors = true});
  if (plan.light.one_by_one) detail::require_sessions(scenario, curves);
  begin_surfaces(scenario, report);
  report.chosen = detail::chosen_pairs(scenario, curves);
  plan.places.unknowns.built([&] {
    if (plan.light.searches)
      search(scenario, plan, options, report);
    else
      fit_from_start(scenario, plan, options, report);
    return 0;
  });
  if (report.verdict.empty()) report.verdict = detail::misfit_text(scenario, report);
  add_light_times(scenario, report);
  for (std::string& note : detail::data_notes(scenario, report))
    report.notes.push_back(std::move(note));
  return report;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
