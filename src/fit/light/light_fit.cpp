// SPDX-License-Identifier: MIT
#include "polhode/fit/light_fit.hpp"

#include <cmath>

#include "fit/detail/light_outcome.hpp"
#include "fit/detail/light_residuals.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve_checks.hpp"

namespace polhode {
inline namespace v0 {
namespace {

const std::string fit_ellipsoid_name = "fit_light: ";

void require_shape(const BrightEllipsoid& body) {
  const Ellipsoid& s = body.shape;
  const std::string axes = detail::tuple_text({s.a, s.b, s.c});
  for (const double axis : {s.a, s.b, s.c})
    if (!(axis > 0.0) || !std::isfinite(axis))
      throw DomainError(fit_ellipsoid_name + "semi-axes " + axes + " must be above 0");
}

void require_start(const LightFit& fit) {
  detail::require_spin(fit_ellipsoid_name, fit.start.spin, fit.most_iterations);
  require_shape(fit.start);
  detail::require_law(fit_ellipsoid_name, fit.start.law, fit.unknowns.multiple);
  if (fit.unknowns.moments != MomentSource::shape) {
    detail::require_diagonal(fit_ellipsoid_name, fit.start.spin, "the axes of the ellipsoid");
    return;
  }
  const Ellipsoid& e = fit.start.shape;
  if (!(e.a >= e.b) || !(e.b >= e.c))
    throw DomainError(fit_ellipsoid_name + "semi-axes " + detail::tuple_text({e.a, e.b, e.c}) +
                      " must not rise where moments follow from them");
}

std::vector<double> brightness_at(const detail::LightResiduals& r, const BrightEllipsoid& body) {
  std::vector<detail::MotionPoint> motion;
  std::vector<double> B(r.points());
  if (!detail::free_motion(body.spin, r.curves().times(), {}, motion) ||
      !r.brightness_of(body, motion, B))
    throw DomainError("model_fluxes: the body has no brightness at these times");
  return B;
}

LeastSquares problem_of(const LightFit& fit, const detail::LightResiduals& residuals,
                        const BrightEllipsoid& about, int most_iterations) {
  LeastSquares problem = detail::light_problem(residuals, fit.unknowns, about, most_iterations);
  problem.first_step = fit.first_step;
  return problem;
}

}  // namespace

LightSolution fit_light(const LightFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  LightSolution found;
  found.body = fit.start;
  const auto residuals_about = [&](const BrightEllipsoid& body) {
    return detail::LightResiduals(fit.curves, fit.unknowns, body, fit.loss, detail::Rows::held);
  };
  const detail::LightResiduals first = residuals_about(fit.start);
  detail::require_points(fit_ellipsoid_name, first.points(), first.places().count, first.groups());
  const detail::TurningFit turning{
      [&](int most_iterations) {
        return problem_of(fit, residuals_about(found.body), found.body, most_iterations);
      },
      [&](const std::vector<double>& x) { found.body = residuals_about(found.body).body_at(x); }};
  detail::settle(turning, fit.most_iterations, first.groups(), found);
  if (found.result.end == LeastSquaresResult::End::no_value) return found;
  found.factors = first.curves().session_factors(brightness_at(first, found.body));
  detail::describe_motion(found.body.spin, found);
  return found;
}

LeastSquares least_squares_of(const LightFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  const detail::LightResiduals residuals(fit.curves, fit.unknowns, fit.start, fit.loss);
  detail::require_points(fit_ellipsoid_name, residuals.points(), residuals.places().count,
                         residuals.groups());
  return problem_of(fit, residuals, fit.start, fit.most_iterations);
}

BrightEllipsoid body_at(const LightFit& fit, std::span<const double> x) {
  const detail::LightPlaces places(fit.unknowns);
  if (x.size() != places.count)
    throw DomainError("body_at: got " + std::to_string(x.size()) + " unknowns; expected " +
                      std::to_string(places.count));
  return detail::LightResiduals({}, fit.unknowns, fit.start).body_at(x);
}

std::vector<double> light_unknowns_at(const LightUnknowns& unknowns, const BrightEllipsoid& about,
                                      const BrightEllipsoid& body) {
  const Vec3 turn = attitude_residual(about.spin.q, body.spin.q);
  const Vec3& w = body.spin.w_F;
  std::vector<double> x{turn.x, turn.y, turn.z, w.x, w.y, w.z};
  const Ellipsoid& s = body.shape;
  if (unknowns.shape) x.insert(x.end(), {s.b / s.a, s.c / s.b});
  const Mat3& T = body.spin.inertia_F;
  if (unknowns.moments == MomentSource::fit)
    x.insert(x.end(), {T(0, 0) / T(2, 2), T(1, 1) / T(2, 2)});
  if (unknowns.multiple) x.push_back(body.law.multiple / body.law.single);
  return x;
}

std::vector<std::vector<double>> model_fluxes(const BrightEllipsoid& body,
                                              std::span<const LightCurve> curves,
                                              const Loss& loss) {
  require_sound(curves, {.vectors = true});
  require_shape(body);
  detail::require_law(fit_ellipsoid_name, body.law, false);
  const detail::LightResiduals residuals(curves, {.shape = false, .moments = MomentSource::start},
                                         body, loss);
  return residuals.curves().fluxes(brightness_at(residuals, body));
}

}  // namespace v0
}  // namespace polhode
