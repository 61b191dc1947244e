// SPDX-License-Identifier: MIT
#include "polhode/fit/light_fit.hpp"

#include <algorithm>
#include <cmath>

#include "fit/detail/light_residuals.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/light/light_curve_checks.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Beyond this the vector of a turn is taken about the attitude that was found, and the fit goes on.
constexpr double far_turn = 1.0;
const char* const who = "fit_light: ";

void require_shape(const BrightEllipsoid& body) {
  const Ellipsoid& s = body.shape;
  const std::string axes = detail::tuple_text({s.a, s.b, s.c});
  for (const double axis : {s.a, s.b, s.c})
    if (!(axis > 0.0) || !std::isfinite(axis))
      throw DomainError(who + ("semi-axes " + axes) + " must be above 0");
  const Scattering& law = body.law;
  if (!(law.single >= 0.0) || !(law.multiple >= 0.0) || !(law.single + law.multiple > 0.0))
    throw DomainError(who +
                      ("weights of scattering " + detail::tuple_text({law.single, law.multiple})) +
                      " must not be below 0, and one above");
}

void require_start(const LightFit& fit) {
  if (fit.most_iterations < 1)
    throw DomainError(who + ("most_iterations = " + std::to_string(fit.most_iterations)) +
                      " must be 1 or more");
  const SpinState& s = fit.start.spin;
  const double size = s.q.w * s.q.w + s.q.x * s.q.x + s.q.y * s.q.y + s.q.z * s.q.z;
  if (!std::isfinite(s.t0) || !std::isfinite(size) || !(size > 0.0))
    throw DomainError(who + ("the start, t0 = " + detail::number_text(s.t0)) +
                      " and its quaternion, must be finite, the quaternion not 0");
  const double rate = norm(s.w_F);
  if (!std::isfinite(rate) || !(rate > 0.0))
    throw DomainError(
        who + ("the rate at the start, " + detail::tuple_text({s.w_F.x, s.w_F.y, s.w_F.z})) +
        ", must be finite and not 0");
  require_shape(fit.start);
  const Ellipsoid& e = fit.start.shape;
  if (fit.unknowns.moments == MomentSource::shape) {
    if (!(e.a >= e.b) || !(e.b >= e.c))
      throw DomainError(who + ("semi-axes " + detail::tuple_text({e.a, e.b, e.c})) +
                        " must not rise where moments follow from them");
    return;
  }
  const Mat3& T = s.inertia_F;
  if (T(0, 1) != 0.0 || T(1, 2) != 0.0 || T(0, 2) != 0.0)
    throw DomainError(
        who + std::string("the axes of the ellipsoid must be principal: products of inertia are ") +
        detail::tuple_text({T(0, 1), T(1, 2), T(0, 2)}));
  static_cast<void>(Body(T(0, 0), T(1, 1), T(2, 2)));  // says what is wrong with them
  if (fit.unknowns.multiple && !(fit.start.law.single > 0.0))
    throw DomainError(who +
                      std::string("an unknown weight of Lambert's law needs that of Lommel and "
                                  "Seeliger to be above 0"));
}

void require_enough(const detail::LightResiduals& r) {
  if (r.points() >= r.places().count + r.groups()) return;
  throw DomainError(who + std::to_string(r.points()) + " points for " +
                    std::to_string(r.places().count) + " unknowns and " +
                    std::to_string(r.groups()) + (r.groups() == 1 ? " factor" : " factors") +
                    "; expected as many at least");
}

FreeRotation motion_of(const SpinState& s) {
  const double unit = s.inertia_F(2, 2);
  const Vec3 I{s.inertia_F(0, 0) / unit, s.inertia_F(1, 1) / unit, 1.0};
  return FreeRotation(Body(I.x, I.y, I.z),
                      {normalized(s.q), {I.x * s.w_F.x, I.y * s.w_F.y, s.w_F.z}}, s.t0);
}

void describe_motion(LightSolution& found) {
  const FreeRotation motion = motion_of(found.body.spin);
  const Vec3 L = inertial_momentum(motion.initial_state());
  found.pole = (1.0 / norm(L)) * L;
  found.periods.mode = motion.regime();
  if (motion.regime() != Regime::short_axis && motion.regime() != Regime::long_axis) return;
  found.periods.precession_period = 2.0 * pi<double>() / motion.precession_rate_long();
  found.periods.rotation_period = motion.polhode_period();
}

std::vector<double> brightness_at(const detail::LightResiduals& r, const BrightEllipsoid& body) {
  std::vector<detail::MotionPoint> motion;
  std::vector<double> B(r.points());
  if (!detail::free_motion(body.spin, r.times(), {}, motion) || !r.brightness_of(body, motion, B))
    throw DomainError("model_fluxes: the body has no brightness at these times");
  return B;
}

}  // namespace

double LightSolution::error_factor() const {
  return std::sqrt(result.chi_square / degrees_of_freedom);
}

LightSolution fit_light(const LightFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  LightSolution found;
  found.body = fit.start;
  int iterations = 0, evaluations = 0;
  // each round has one iteration at least
  while (iterations < fit.most_iterations) {
    const detail::LightResiduals residuals(fit.curves, fit.unknowns, found.body);
    require_enough(residuals);
    found.result = solve(detail::light_problem(residuals, fit.unknowns, found.body, fit.loss,
                                               fit.most_iterations - iterations));
    iterations += found.result.iterations;
    evaluations += found.result.evaluations;
    found.body = residuals.body_at(found.result.x);
    const std::vector<double>& x = found.result.x;
    if (norm(Vec3{x[0], x[1], x[2]}) <= far_turn || !found.result.bound.empty() ||
        found.result.iterations == 0 || found.result.end == LeastSquaresResult::End::no_value)
      break;
  }
  found.result.iterations = iterations;
  found.result.evaluations = evaluations;
  // The same numbers with turns about what was found.
  std::fill_n(found.result.x.begin(), 3, 0.0);
  const detail::LightResiduals residuals(fit.curves, fit.unknowns, found.body);
  const LeastSquares problem =
      detail::light_problem(residuals, fit.unknowns, found.body, fit.loss, fit.most_iterations);
  found.covariance = covariance(problem, found.result);
  found.degrees_of_freedom =
      degrees_of_freedom(problem, found.result) - static_cast<double>(residuals.groups());
  if (found.result.end == LeastSquaresResult::End::no_value) return found;
  const std::vector<double> of_groups = residuals.factors(brightness_at(residuals, found.body));
  std::size_t first = 0;
  for (const LightCurve& curve : fit.curves) {
    found.factors.push_back(of_groups[residuals.weighed()[first].group]);
    first += curve.points.size();
  }
  describe_motion(found);
  for (const auto& weak : found.covariance.weak) found.notes.push_back(weak.sentence);
  return found;
}

LeastSquares least_squares_of(const LightFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  const detail::LightResiduals residuals(fit.curves, fit.unknowns, fit.start);
  require_enough(residuals);
  return detail::light_problem(residuals, fit.unknowns, fit.start, fit.loss, fit.most_iterations);
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
                                              std::span<const LightCurve> curves) {
  require_sound(curves, {.vectors = true});
  require_shape(body);
  const detail::LightResiduals residuals(curves, {.shape = false, .moments = MomentSource::start},
                                         body);
  const std::vector<double> B = brightness_at(residuals, body), f = residuals.factors(B);
  std::vector<std::vector<double>> found;
  std::size_t i = 0;
  for (const LightCurve& curve : curves) {
    found.emplace_back();
    for (std::size_t k = 0; k < curve.points.size(); ++k, ++i)
      found.back().push_back(f[residuals.weighed()[i].group] * B[i]);
  }
  return found;
}

}  // namespace v0
}  // namespace polhode
