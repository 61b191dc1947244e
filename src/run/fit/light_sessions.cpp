// SPDX-License-Identifier: MIT
// Light curves fitted session by session: which session is first, and the way to the others.
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "run/detail/fit_tables.hpp"
#include "run/detail/light_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

void require_sessions(const Scenario& scenario, std::span<const light::LightCurve> curves) {
  if (curves.size() > 1) return;
  require_fit(scenario).light.places.one_by_one.refuse(
      "expected more than one session: one for each table [[observation]], or by session_column");
}

std::size_t longest_session(std::span<const light::LightCurve> curves) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < curves.size(); ++k)
    if (curves[k].points.size() > curves[longest].points.size()) longest = k;
  return longest;
}

// By how much its model is better than a constant: errors as large as the light would hide any
// body.
std::size_t nearest_session(std::span<const light::LightCurve> curves, const fit::LightModel& body,
                            const fit::Loss& loss) {
  std::size_t nearest = 0;
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const light::LightCurve& curve = curves[k];
    const std::vector<double> model = fit::model_fluxes(body, {&curve, 1}, loss).front();
    double weight = 0.0, mean = 0.0;
    for (const light::LightPoint& p : curve.points) {
      const double w = 1.0 / (p.sigma * p.sigma);
      weight += w;
      mean += w * (p.flux - mean) / weight;
    }
    const auto lost = [&](double flux, const light::LightPoint& p) {
      const double miss = (flux - p.flux) / p.sigma, z = miss * miss / (loss.scale * loss.scale);
      return z * fit::value(loss, z).ratio;
    };
    double gain = 0.0;
    for (std::size_t i = 0; i < model.size(); ++i)
      gain += lost(mean, curve.points[i]) - lost(model[i], curve.points[i]);
    if (!(gain > greatest)) continue;
    greatest = gain;
    nearest = k;
  }
  return nearest;
}

void extend_to_sessions(const Scenario& scenario, std::size_t first,
                        std::vector<fit::LightModel> starts, const FitOptions& options,
                        LightReport& report) {
  const FitPlan& plan = require_fit(scenario);
  const std::string where = "while sessions were joined";
  fit::LightExtension how;
  how.curves = report.observed.curves;
  how.first = first;
  how.starts = std::move(starts);
  if (report.shape == LightPlan::Shape::convex) {
    const fit::SurfaceSearch surface = surface_search(scenario, report.unknowns);
    for (fit::LightModel& start : how.starts) start = surface.convex_of(start);
    how.regularisation = surface.regularisation;
  }
  how.unknowns = report.unknowns;
  how.loss = plan.loss;
  how.within = plan.light.within_factor;
  how.most_iterations = plan.light.most_iterations.value_or(how.most_iterations);
  follow(scenario, options, where, how);
  if (options.begins)
    options.begins("sessions", polhode::detail::counted(how.curves.size(), "session", "sessions") +
                                   " one by one");
  fit::LightExtensionResult found = fit::extend_light(how);
  report.joined = std::move(found.joined);
  report.solutions = std::move(found.solutions);
  if (report.shape == LightPlan::Shape::convex) {
    for (fit::FoundLight& one : report.solutions) fit::detail::set_ellipsoid(one);
    fit::describe_solutions(report.solutions, how.curves);
  }
  report.failure = std::move(found.failure);
  report.notes.insert(report.notes.end(), found.notes.begin(), found.notes.end());
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
