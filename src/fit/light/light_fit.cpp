// SPDX-License-Identifier: MIT
// Fits of light curves: checks of a start, and the solution, whatever the shape.
#include "polhode/fit/light_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <type_traits>

#include "fit/detail/light_outcome.hpp"
#include "fit/detail/light_residuals.hpp"
#include "fit/detail/light_surfaces.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace {

using detail::ConvexSurface;
using detail::EllipsoidSurface;
using detail::FollowedMoments;
using detail::LightResiduals;
using detail::MeshSurface;
using detail::Rows;
using polhode::detail::number_text;
using polhode::detail::tuple_text;

const std::string who = "fit_light: ";
// A mesh has converged within this many standard errors: a facet that passes a terminator or the
// edge of a shadow bends the light, and a fit comes to rest between bends, a few tenths of an error
// from the minimum.
constexpr double mesh_nearness = 1.0;
// Rounds of moments that follow facets, linear in each, of so many iterations, and when they have
// come to rest.
constexpr int most_rounds = 40, round_iterations = 10;
constexpr double same_moments = 1e-5;
// Least part of the way to the body of a round at which moments are taken anew.
constexpr double least_part = 0.125;

void require_axes(const light::Ellipsoid& s) {
  for (const double axis : {s.a, s.b, s.c})
    if (!(axis > 0.0) || !std::isfinite(axis))
      throw DomainError(who + "semi-axes " + tuple_text({s.a, s.b, s.c}) + " must be above 0");
}

void require_coefficients(const ConvexShape& shape) {
  if (shape.coefficients.size() != shape.image.coefficient_count())
    throw DomainError(who + std::to_string(shape.coefficients.size()) +
                      " coefficients of a convex body; expected " +
                      std::to_string(shape.image.coefficient_count()));
}

void require_shape(const LightShape& shape) {
  if (const auto* e = std::get_if<light::Ellipsoid>(&shape)) require_axes(*e);
  if (const auto* c = std::get_if<ConvexShape>(&shape)) require_coefficients(*c);
}

void require_regularisation(const LightFit& fit) {
  const Regularisation& r = fit.regularisation;
  const auto require_error = [](const char* name, double value) {
    if (!(value > 0.0))
      throw DomainError(who + name + " = " + number_text(value) + " must be above 0");
  };
  require_error("closure_error", r.closure_error);
  require_error("axes_error", r.axes_error);
  require_error("roughness_error", r.roughness_error);
  require_error("moments_error", r.moments_error);
  if (!r.about) return;
  require_shape(r.about->shape);
  const std::size_t count = fit.start.convex().coefficients.size();
  if (r.about->is_mesh() ||
      (r.about->is_convex() && r.about->convex().coefficients.size() != count))
    throw DomainError(who +
                      "the usual body must be an ellipsoid, or a convex body of the degree of the "
                      "start");
  detail::require_diagonal(who, r.about->spin, "the axes of the body that is the usual one");
}

void require_start(const LightFit& fit) {
  const LightModel& start = fit.start;
  detail::require_spin(who, start.spin, fit.most_iterations);
  require_shape(start.shape);
  detail::require_law(who, start.law, fit.unknowns.multiple);
  const MomentSource moments = fit.unknowns.moments;
  if (start.is_mesh()) {
    if (moments == MomentSource::shape)
      throw DomainError(who +
                        "moments cannot follow a shape that stays; give those of an even filling "
                        "as the start's (homogeneous_inertia), or fit them");
    if (moments == MomentSource::fit)
      detail::require_diagonal(who, start.spin, "the axes of the mesh");
    else
      static_cast<void>(Body::from_tensor(start.spin.inertia_F));  // says what is wrong with it
    return;
  }
  if (start.is_convex()) {
    detail::require_diagonal(who, start.spin, "the axes of the start");
    return require_regularisation(fit);
  }
  if (moments != MomentSource::shape)
    return detail::require_diagonal(who, start.spin, "the axes of the ellipsoid");
  const light::Ellipsoid& e = start.ellipsoid();
  if (!(e.a >= e.b) || !(e.b >= e.c))
    throw DomainError(who + "semi-axes " + tuple_text({e.a, e.b, e.c}) +
                      " must not rise where moments follow from them");
}

// Moments in units of Izz.
SpinState normalized_spin(SpinState s) {
  const double unit = s.inertia_F(2, 2);
  for (Vec3& row : s.inertia_F.row) row = (1.0 / unit) * row;
  return s;
}

// The usual body of a convex one.
const LightModel& usual_body(const LightFit& fit) {
  const std::optional<LightModel>& about = fit.regularisation.about;
  return about ? *about : fit.start;
}

// Moments of a convex body that follow its facets, from round to round.
class FacetMoments {
 public:
  explicit FacetMoments(const ConvexShape& shape) : image_(shape.image) {
    follow(shape.coefficients, at(shape.coefficients));
  }

  const FollowedMoments& followed() const { return followed_; }

  // True if another round is needed: the body that was found has other moments than it was fitted
  // with, or is not yet at the minimum.
  bool goes_on(LightSolution& found, int round, int left) {
    using End = LeastSquaresResult::End;
    LeastSquaresResult& result = found.result;
    if (!found.is_found() && (result.end != End::iteration_limit || left <= 0)) return false;
    const std::vector<double>& coefficients = found.body.convex().coefficients;
    try {
      const light::ConvexMoments now = at(coefficients);
      const Mat3& T = found.body.spin.inertia_F;
      const double change = std::max(std::abs(now.Ixx - T(0, 0)), std::abs(now.Iyy - T(1, 1)));
      if (change <= same_moments && found.is_found()) return false;
      if (round == most_rounds || left <= 0) {
        result.end = End::iteration_limit;
        result.sentence = "not converged: the moments of the shape did not come to rest in " +
                          std::to_string(round) + (round == 1 ? " round" : " rounds") +
                          (left <= 0 ? "; allow more iterations" : "; take smaller facets");
        return false;
      }
      take_anew(coefficients, now, change);
    } catch (const DomainError& error) {  // facets that close no body
      result.end = End::no_descent;
      result.sentence =
          std::string("not converged: no moments follow from the shape: ") + error.what();
      return false;
    }
    return true;
  }

 private:
  light::ConvexMoments at(const std::vector<double>& coefficients) {
    light::ConvexMoments m =
        light::convex_moments(image_.normals(), image_.areas(coefficients), distances_);
    distances_ = m.distances;
    return m;
  }

  void follow(const std::vector<double>& coefficients, const light::ConvexMoments& m) {
    followed_ = FollowedMoments::at(image_, coefficients, m);
  }

  // At the body that was found; where that did not bring what is linear near to what is true, the
  // rounds go back and forth, and they are taken part of the way.
  void take_anew(std::vector<double> coefficients, const light::ConvexMoments& now, double change) {
    part_ = change > 0.5 * change_ ? std::max(0.5 * part_, least_part) : std::min(2.0 * part_, 1.0);
    change_ = change;
    if (part_ == 1.0) return follow(coefficients, now);
    for (std::size_t k = 1; k < coefficients.size(); ++k)
      coefficients[k] = followed_.own[k - 1] + part_ * (coefficients[k] - followed_.own[k - 1]);
    follow(coefficients, at(coefficients));
  }

  light::GaussianImage image_;
  FollowedMoments followed_;
  std::vector<double> distances_;  // of the facets, as they were last
  // Difference of the moments of the last round between the linear and the exact ones.
  double change_ = std::numeric_limits<double>::infinity();
  double part_ = 1.0;
};

// Residuals of a convex body with moments that are those of the body at every x.
class OfFacets {
 public:
  OfFacets(std::shared_ptr<const LightResiduals<ConvexSurface>> residuals, const ConvexShape& first)
      : residuals_(std::move(residuals)), image_(first.image) {
    // of a start that is the same at every x, so that the numbers are, too
    distances_ =
        light::convex_moments(image_.normals(), image_.areas(first.coefficients)).distances;
  }

  LightResiduals<ConvexSurface> about(std::span<const double> x) const {
    const std::vector<double> c = residuals_->surface().coefficients(residuals_->own_of(x));
    return residuals_->with(residuals_->surface().with(FollowedMoments::at(
        image_, c, light::convex_moments(image_.normals(), image_.areas(c), distances_))));
  }

  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const {
    try {
      return about(x).at(x, numbers, jacobian);
    } catch (const DomainError&) {  // areas that close no body
      return false;
    }
  }

 private:
  std::shared_ptr<const LightResiduals<ConvexSurface>> residuals_;
  light::GaussianImage image_;
  std::vector<double> distances_;
};

// A fit about a body that it keeps.
template <class Surface>
class Fitter {
  static constexpr bool has_facets = std::is_same_v<Surface, ConvexSurface>;

 public:
  Fitter(const LightFit& fit, Rows rows)
      : fit_(fit),
        rows_(rows),
        curves_(std::make_shared<const detail::WeighedCurves>(fit.curves, fit.loss)),
        surface_(fit, fit.start) {
    found_.body = fit.start;
    if constexpr (has_facets) {
      SpinState& spin = found_.body.spin;
      spin = normalized_spin(spin);
      if (fit.unknowns.moments == MomentSource::start)
        spin.inertia_F = normalized_spin(usual_body(fit).spin).inertia_F;
      convex().coefficients.front() = surface_.usual().front();  // part of the factors
    }
  }

  LightSolution solution() {
    require_points();
    const detail::TurningFit turning{
        [this](int most_iterations) { return problem(most_iterations); },
        [this](const std::vector<double>& x) { found_.body = residuals()->body_at(x); }};
    const std::size_t groups = curves_->groups();
    if constexpr (has_facets) {
      settle_rounds(turning);
    } else {
      detail::settle(turning, fit_.most_iterations, groups, found_);
    }
    if (found_.result.end == LeastSquaresResult::End::no_value) return std::move(found_);
    if constexpr (has_facets)
      if (surface_.own() > 0) add_terms();
    found_.factors = curves_->session_factors(brightness());
    detail::describe_motion(found_.body.spin, found_);
    return std::move(found_);
  }

  // About the body that it begins with.
  LeastSquares problem() const {
    require_points();
    LeastSquares p = problem(fit_.most_iterations);
    if constexpr (has_facets) {
      if (!facets_follow()) return p;
      const auto of_facets = std::make_shared<const OfFacets>(residuals(), convex());
      p.residuals.at = [of_facets](std::span<const double> x, std::span<double> numbers,
                                   std::span<double> jacobian) {
        return of_facets->at(x, numbers, jacobian);
      };
    }
    return p;
  }

  LightModel body_at(std::span<const double> x) const {
    const auto shared = residuals();
    if (x.size() != shared->places().count)
      throw DomainError("body_at: got " + std::to_string(x.size()) + " unknowns; expected " +
                        std::to_string(shared->places().count));
    if constexpr (has_facets)
      if (facets_follow()) return OfFacets(shared, convex()).about(x).body_at(x);
    return shared->body_at(x);
  }

  // About the present body.
  std::vector<Unknown> unknowns() const {
    const LightModel& body = found_.body;
    std::vector<Unknown> found;
    for (const char* name : {"turn_x", "turn_y", "turn_z"}) found.push_back({.name = name});
    const Vec3& w = body.spin.w_F;
    found.push_back({.name = "w_x", .start = w.x});
    found.push_back({.name = "w_y", .start = w.y});
    found.push_back({.name = "w_z", .start = w.z});
    const std::vector<Unknown> own = surface_.own_unknowns(body.shape);
    if (Surface::own_first) found.insert(found.end(), own.begin(), own.end());
    if (fit_.unknowns.moments == MomentSource::fit) {
      const Mat3& T = body.spin.inertia_F;
      found.push_back({.name = "Ixx/Izz", .start = T(0, 0) / T(2, 2)});
      found.push_back({.name = "Iyy/Izz", .start = T(1, 1) / T(2, 2)});
    }
    if (fit_.unknowns.multiple) {
      const double given = body.law.multiple / body.law.single;
      found.push_back({.name = "multiple",
                       .start = given > detail::least_multiple ? given : detail::usual_multiple,
                       .low = detail::least_multiple});
    }
    if (!Surface::own_first) found.insert(found.end(), own.begin(), own.end());
    return found;
  }

  std::optional<detail::LightTrial> shortly() const {
    const LeastSquaresResult result = solve(problem(fit_.most_iterations));
    if (result.end == LeastSquaresResult::End::no_value) return std::nullopt;
    return detail::LightTrial{residuals()->body_at(result.x), result.cost};
  }

  std::vector<double> brightness() const {
    std::vector<double> B(curves_->size());
    std::vector<detail::MotionPoint> motion;
    if (!detail::free_motion(found_.body.spin, curves_->times(), {}, motion) ||
        !brightness_along({}, motion, B))
      throw DomainError("model_fluxes: the body has no brightness at these times");
    return B;
  }
  bool brightness_along(const Quaternion& q, std::span<const detail::MotionPoint> motion,
                        std::span<double> B) const {
    const auto shape = Surface::shape_of(found_.body.shape);
    return detail::brightness_along(
        [&](const Vec3& s, const Vec3& o) {
          return surface_.brightness(shape, found_.body.law, s, o);
        },
        q, motion, *curves_, B);
  }
  const detail::WeighedCurves& curves() const { return *curves_; }

 private:
  ConvexShape& convex() { return std::get<ConvexShape>(found_.body.shape); }
  const ConvexShape& convex() const { return found_.body.convex(); }
  bool facets_follow() const { return fit_.unknowns.moments == MomentSource::shape; }

  void require_points() const {
    const auto r = residuals();
    detail::require_points(who, r->curves().size() + r->priors(), r->places().count,
                           r->curves().groups());
  }

  std::shared_ptr<const LightResiduals<Surface>> residuals() const {
    return std::make_shared<const LightResiduals<Surface>>(curves_, fit_.unknowns, found_.body,
                                                           surface_, rows_);
  }

  // About the present body.
  LeastSquares problem(int most_iterations) const {
    const auto shared = residuals();
    const LightModel& body = found_.body;
    const detail::LightPlaces& places = shared->places();
    LeastSquares p;
    p.unknowns = unknowns();
    if (places.has_moments) p.triangle = {places.moments, places.moments + 1};
    p.residuals.data = curves_->size();
    p.residuals.prior = surface_.priors();
    p.residuals.at = [shared](std::span<const double> x, std::span<double> numbers,
                              std::span<double> jacobian) {
      return shared->at(x, numbers, jacobian);
    };
    p.loss = fit_.loss;
    p.most_iterations = most_iterations;
    p.first_step = fit_.first_step;
    if (body.is_mesh()) p.nearness = mesh_nearness;
    if constexpr (has_facets) add_priors(p);
    return p;
  }

  double moments_variance() const {
    return fit_.regularisation.moments_error * fit_.regularisation.moments_error;
  }
  bool has_moments_prior() const {
    return fit_.unknowns.moments == MomentSource::fit && std::isfinite(moments_variance());
  }

  void add_priors(LeastSquares& p) const {
    if (!has_moments_prior()) return;
    const double variance = moments_variance();
    const Mat3& T = usual_body(fit_).spin.inertia_F;
    p.priors = {{{"Ixx/Izz"}, {T(0, 0) / T(2, 2)}, {variance}},
                {{"Iyy/Izz"}, {T(1, 1) / T(2, 2)}, {variance}}};
  }

  void settle_rounds(const detail::TurningFit& turning) {
    const bool follows = facets_follow();
    std::optional<FacetMoments> moments;
    const auto follow = [&] { surface_ = surface_.with(moments->followed()); };
    if (follows) {
      moments.emplace(convex());
      follow();
    }
    int left = fit_.most_iterations;
    for (int round = 1;; ++round) {
      found_.notes.clear();
      const int most = follows ? std::min(left, round_iterations) : left;
      detail::settle(turning, most, curves_->groups(), found_);
      left -= found_.result.iterations;
      if (!follows || !moments->goes_on(found_, round, left)) break;
      follow();
    }
    found_.result.iterations = fit_.most_iterations - left;
  }

  // The parts of the cost that come from the regularisation.
  void add_terms() {
    const LeastSquaresResult& r = found_.result;
    const std::span<const double> priors = std::span(r.numbers).subspan(found_.points);
    const auto sum = [&](std::size_t first, std::size_t last) {
      return std::accumulate(priors.begin() + static_cast<std::ptrdiff_t>(first),
                             priors.begin() + static_cast<std::ptrdiff_t>(last), 0.0,
                             [](double all, double x) { return all + x * x; });
    };
    std::vector<CostTerm>& terms = found_.terms;
    terms.push_back({"roughness", sum(6, priors.size())});
    terms.push_back({"closure", sum(0, 3)});
    terms.push_back({"axes", sum(3, 6)});
    if (has_moments_prior()) {
      const Mat3 &T = found_.body.spin.inertia_F, &usual = usual_body(fit_).spin.inertia_F;
      double moved = 0.0;
      for (int i = 0; i < 2; ++i) {
        const double d = T(i, i) / T(2, 2) - usual(i, i) / usual(2, 2);
        moved += d * d;
      }
      terms.push_back({"moments", moved / moments_variance()});
    }
    for (std::size_t k = 1; k < terms.size(); ++k) terms[0].value -= terms[k].value;
  }

  const LightFit& fit_;
  Rows rows_;
  std::shared_ptr<const detail::WeighedCurves> curves_;
  Surface surface_;
  LightSolution found_;  // with the present body
};

// use(fitter) for the shape of the start.
template <class Use>
auto with_fitter(const LightFit& fit, Rows rows, const Use& use) {
  if (fit.start.is_mesh()) return use(Fitter<MeshSurface>(fit, rows));
  if (fit.start.is_convex()) return use(Fitter<ConvexSurface>(fit, rows));
  return use(Fitter<EllipsoidSurface>(fit, rows));
}

}  // namespace

namespace detail {

std::vector<Unknown> light_unknowns(const LightFit& fit) {
  return with_fitter(fit, Rows::exact, [](const auto& fitter) { return fitter.unknowns(); });
}

std::optional<LightTrial> fit_shortly(const LightFit& fit) {
  return with_fitter(fit, Rows::held, [](const auto& fitter) { return fitter.shortly(); });
}

std::optional<std::pair<Quaternion, double>> best_attitude(
    const LightFit& fit, std::size_t tries, const std::function<Quaternion()>& next) {
  return with_fitter(fit, Rows::held,
                     [&](const auto& fitter) -> std::optional<std::pair<Quaternion, double>> {
                       const WeighedCurves& curves = fitter.curves();
                       std::vector<MotionPoint> motion;
                       if (!free_motion(fit.start.spin, curves.times(), {}, motion))
                         return std::nullopt;
                       std::vector<double> B(curves.size());
                       std::pair<Quaternion, double> best{fit.start.spin.q,
                                                          std::numeric_limits<double>::infinity()};
                       for (std::size_t k = 0; k < tries; ++k) {
                         const Quaternion q = next();
                         if (!fitter.brightness_along(q, motion, B)) continue;
                         const double cost = curves.cost(B);
                         if (cost < best.second) best = {q, cost};
                       }
                       return best;
                     });
}

}  // namespace detail

LightSolution fit_light(const LightFit& fit) {
  light::require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  return with_fitter(fit, Rows::held, [](auto fitter) { return fitter.solution(); });
}

LeastSquares least_squares_of(const LightFit& fit) {
  light::require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  return with_fitter(fit, Rows::exact, [](const auto& fitter) { return fitter.problem(); });
}

LightModel body_at(const LightFit& fit, std::span<const double> x) {
  require_start(fit);
  return with_fitter(fit, Rows::exact, [&](const auto& fitter) { return fitter.body_at(x); });
}

std::vector<double> light_unknowns_at(const LightUnknowns& unknowns, const LightModel& about,
                                      const LightModel& body) {
  const Vec3 turn = attitude_residual(about.spin.q, body.spin.q);
  const Vec3& w = body.spin.w_F;
  std::vector<double> x{turn.x, turn.y, turn.z, w.x, w.y, w.z};
  if (body.is_ellipsoid() && unknowns.shape) {
    const light::Ellipsoid& s = body.ellipsoid();
    x.insert(x.end(), {s.b / s.a, s.c / s.b});
  }
  const Mat3& T = body.spin.inertia_F;
  if (unknowns.moments == MomentSource::fit)
    x.insert(x.end(), {T(0, 0) / T(2, 2), T(1, 1) / T(2, 2)});
  if (unknowns.multiple) x.push_back(body.law.multiple / body.law.single);
  if (body.is_convex() && unknowns.shape) {
    const std::vector<double>& c = body.convex().coefficients;
    x.insert(x.end(), c.begin() + 1, c.end());
  }
  return x;
}

std::vector<std::vector<double>> model_fluxes(const LightModel& body,
                                              std::span<const light::LightCurve> curves,
                                              const Loss& loss) {
  light::require_sound(curves, {.vectors = true});
  require_shape(body.shape);
  detail::require_law(who, body.law, false);
  const LightFit fit{.curves = {curves.begin(), curves.end()},
                     .start = body,
                     .unknowns = {.shape = false, .moments = MomentSource::start},
                     .loss = loss};
  return with_fitter(fit, Rows::exact, [](const auto& fitter) {
    return fitter.curves().fluxes(fitter.brightness());
  });
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
