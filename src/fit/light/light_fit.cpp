// SPDX-License-Identifier: MIT
// Fits of an ellipsoid to light curves: residuals, and their solution.
#include "polhode/fit/light_fit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "fit/detail/light_outcome.hpp"
#include "fit/detail/light_residuals.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/surface_residuals.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/lambert.hpp"
#include "polhode/light/light_curve_checks.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {
namespace {

constexpr std::size_t first_turn = 0;
Mat3 diagonal(double x, double y) {
  Mat3 m = Mat3::identity();
  m(0, 0) = x;
  m(1, 1) = y;
  return m;
}

Mat3 homogeneous_tensor(const Ellipsoid& shape) {
  const Vec3 I = homogeneous_moments(shape, 1.0);
  return diagonal(I.x / I.z, I.y / I.z);
}

}  // namespace

LightPlaces::LightPlaces(const LightUnknowns& unknowns) {
  const auto take = [this](bool wanted, std::size_t& place, std::size_t numbers) {
    if (!wanted) return;
    place = count;
    count += numbers;
  };
  take(unknowns.shape, shape, 2);
  take(unknowns.moments == MomentSource::fit, moments, 2);
  take(unknowns.multiple, multiple, 1);
}

std::vector<Unknown> light_unknowns(const LightUnknowns& unknowns, const EllipsoidModel& start) {
  std::vector<Unknown> found;
  for (const char* name : {"turn_x", "turn_y", "turn_z"}) found.push_back({.name = name});
  const Vec3& w = start.spin.w_F;
  found.push_back({.name = "w_x", .start = w.x});
  found.push_back({.name = "w_y", .start = w.y});
  found.push_back({.name = "w_z", .start = w.z});
  const auto ratio = [&](const char* name, double value) {
    const double high = unknowns.moments == MomentSource::shape ? 1.0 : 1.0 / least_axis_ratio;
    found.push_back({name, std::clamp(value, least_axis_ratio, high), least_axis_ratio, high});
  };
  if (unknowns.shape) {
    ratio("b/a", start.shape.b / start.shape.a);
    ratio("c/b", start.shape.c / start.shape.b);
  }
  if (unknowns.moments == MomentSource::fit) {
    const Mat3& T = start.spin.inertia_F;
    found.push_back({.name = "Ixx/Izz", .start = T(0, 0) / T(2, 2)});
    found.push_back({.name = "Iyy/Izz", .start = T(1, 1) / T(2, 2)});
  }
  if (unknowns.multiple) found.push_back(multiple_unknown(start.law));
  return found;
}

LightResiduals::LightResiduals(std::span<const LightCurve> curves, const LightUnknowns& unknowns,
                               const EllipsoidModel& start, const Loss& loss, Rows rows)
    : unknowns_(unknowns), start_(start), places_(unknowns), curves_(curves, loss), rows_(rows) {}

EllipsoidModel LightResiduals::body_at(std::span<const double> x) const {
  EllipsoidModel body = start_;
  body.spin.q = normalized(start_.spin.q) * turn_by({x[0], x[1], x[2]});
  body.spin.w_F = {x[3], x[4], x[5]};
  const Ellipsoid& s = start_.shape;
  body.shape = {1.0, s.b / s.a, s.c / s.a};
  if (places_.shape != LightPlaces::none) {
    const double b = x[places_.shape];
    body.shape = {1.0, b, b * x[places_.shape + 1]};
  }
  if (unknowns_.moments == MomentSource::shape) {
    body.spin.inertia_F = homogeneous_tensor(body.shape);
  } else if (places_.moments != LightPlaces::none) {
    body.spin.inertia_F = diagonal(x[places_.moments], x[places_.moments + 1]);
  }
  if (places_.multiple != LightPlaces::none) body.law = {1.0, x[places_.multiple]};
  return body;
}

bool LightResiduals::brightness_of(const EllipsoidModel& body, std::span<const MotionPoint> motion,
                                   std::span<double> found) const {
  bool is_sound = true;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const Quaternion back = conj(motion[i].q);
    found[i] = brightness(body.shape, body.law, rotate(back, curves_[i].to_sun),
                          rotate(back, curves_[i].to_observer));
    is_sound = is_sound && std::isfinite(found[i]);
  }
  return is_sound;
}

// A rotation d in body axes turns v into v + v x d: the brightness changes by d . (by_sun x s +
// by_observer x o).
void LightResiduals::row_at(const EllipsoidModel& body, const Mat3& turn, const MotionPoint& motion,
                            const WeighedPoint& p, double& value, double* row) const {
  const Quaternion back = conj(motion.q);
  const Vec3 s = rotate(back, p.to_sun), o = rotate(back, p.to_observer);
  const EllipsoidGradient g = brightness_gradient(body.shape, body.law, s, o);
  value = g.value;
  const Vec3 by_turn = cross(g.by_sun, s) + cross(g.by_observer, o);
  Vec3 at_epoch;
  for (std::size_t k = 0; k < 3; ++k) {
    at_epoch[static_cast<int>(k)] = dot(by_turn, motion.turn[first_turn + k]);
    row[first_rate + k] = dot(by_turn, motion.turn[first_rate + k]);
  }
  for (int k = 0; k < 3; ++k)
    row[k] = at_epoch.x * turn(0, k) + at_epoch.y * turn(1, k) + at_epoch.z * turn(2, k);
  const double by_Ixx = dot(by_turn, motion.turn[first_ratio]);
  const double by_Iyy = dot(by_turn, motion.turn[first_ratio + 1]);
  if (places_.shape != LightPlaces::none) {
    const double b = body.shape.b, c = body.shape.c;
    double by_b = g.by_axes.y, by_c = g.by_axes.z;
    if (unknowns_.moments == MomentSource::shape) {
      // Ixx/Izz = (b^2 + c^2) / (1 + b^2), Iyy/Izz = (1 + c^2) / (1 + b^2)
      const double inverse = 2.0 / (1.0 + b * b);
      const double X = body.spin.inertia_F(0, 0), Y = body.spin.inertia_F(1, 1);
      by_b += inverse * b * ((1.0 - X) * by_Ixx - Y * by_Iyy);
      by_c += inverse * c * (by_Ixx + by_Iyy);
    }
    row[places_.shape] = by_b + c / b * by_c;
    row[places_.shape + 1] = b * by_c;
  }
  if (places_.moments != LightPlaces::none) {
    row[places_.moments] = by_Ixx;
    row[places_.moments + 1] = by_Iyy;
  }
  if (places_.multiple != LightPlaces::none) row[places_.multiple] = g.by_multiple;
}

bool LightResiduals::at(std::span<const double> x, std::span<double> numbers,
                        std::span<double> jacobian) const {
  const EllipsoidModel body = body_at(x);
  const std::size_t n = places_.count, count = curves_.size();
  const bool derivatives = !jacobian.empty();
  std::vector<MotionPoint> motion;
  if (!free_motion(body.spin, curves_.times(), {derivatives, false}, motion)) return false;
  std::vector<double> B(count);
  if (derivatives) {
    const Mat3 turn = exp_derivative({x[0], x[1], x[2]});
    for (std::size_t i = 0; i < count; ++i)
      row_at(body, turn, motion[i], curves_[i], B[i], jacobian.data() + i * n);
  } else if (!brightness_of(body, motion, B)) {
    return false;
  }
  return curves_.residuals(B, n, numbers, jacobian, rows_);
}

LeastSquares light_problem(const LightResiduals& residuals, const LightUnknowns& unknowns,
                           const EllipsoidModel& start, int most_iterations) {
  LeastSquares p;
  p.unknowns = light_unknowns(unknowns, start);
  if (residuals.places().moments != LightPlaces::none)
    p.triangle = {residuals.places().moments, residuals.places().moments + 1};
  p.residuals.data = residuals.points();
  // one copy for all copies of the function
  const auto shared = std::make_shared<const LightResiduals>(residuals);
  p.residuals.at = [shared](std::span<const double> x, std::span<double> numbers,
                            std::span<double> jacobian) {
    return shared->at(x, numbers, jacobian);
  };
  p.loss = residuals.curves().loss();
  p.most_iterations = most_iterations;
  return p;
}

}  // namespace detail

EllipsoidModel EllipsoidModel::homogeneous(double t0, const Quaternion& q, const Vec3& w_F,
                                           const Ellipsoid& shape, const Scattering& law) {
  return {{t0, q, w_F, detail::homogeneous_tensor(shape)}, shape, law};
}

namespace {

const std::string fit_ellipsoid_name = "fit_light: ";

void require_shape(const EllipsoidModel& body) {
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

std::vector<double> brightness_at(const detail::LightResiduals& r, const EllipsoidModel& body) {
  std::vector<detail::MotionPoint> motion;
  std::vector<double> B(r.points());
  if (!detail::free_motion(body.spin, r.curves().times(), {}, motion) ||
      !r.brightness_of(body, motion, B))
    throw DomainError("model_fluxes: the body has no brightness at these times");
  return B;
}

LeastSquares problem_of(const LightFit& fit, const detail::LightResiduals& residuals,
                        const EllipsoidModel& about, int most_iterations) {
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
  const auto residuals_about = [&](const EllipsoidModel& body) {
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

EllipsoidModel body_at(const LightFit& fit, std::span<const double> x) {
  const detail::LightPlaces places(fit.unknowns);
  if (x.size() != places.count)
    throw DomainError("body_at: got " + std::to_string(x.size()) + " unknowns; expected " +
                      std::to_string(places.count));
  return detail::LightResiduals({}, fit.unknowns, fit.start).body_at(x);
}

std::vector<double> light_unknowns_at(const LightUnknowns& unknowns, const EllipsoidModel& about,
                                      const EllipsoidModel& body) {
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

std::vector<std::vector<double>> model_fluxes(const EllipsoidModel& body,
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
