// SPDX-License-Identifier: MIT
// Fits of a convex body to light curves: its Gaussian image as unknowns, and their solution.
#include "polhode/fit/convex_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string>

#include "fit/detail/convex_surface.hpp"
#include "fit/detail/light_outcome.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/ordered_parallel_for.hpp"
#include "polhode/error.hpp"
#include "polhode/light/convex_body.hpp"
#include "polhode/light/light_curve_checks.hpp"
#include "polhode/light/patch_brightness.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

ConvexSurface::ConvexSurface(const GaussianImage& image, std::vector<double> usual,
                             const ConvexFit& fit)
    : image_(image),
      usual_(std::move(usual)),
      rough_(image.roughness()),
      along_(6),
      closure_error_(fit.closure_error),
      axes_error_(fit.axes_error),
      roughness_error_(fit.roughness_error) {
  for (const Vec3& n : image.normals()) {
    const double values[6] = {n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.x * n.z};
    for (std::size_t k = 0; k < 6; ++k) along_[k].push_back(values[k]);
  }
}

std::vector<double> ConvexSurface::coefficients(std::span<const double> own) const {
  std::vector<double> c{usual_.front()};
  c.insert(c.end(), own.begin(), own.end());
  return c;
}

double ConvexSurface::brightness(const Shape& shape, const Scattering& law, const Vec3& s,
                                 const Vec3& o) const {
  return patch_brightness<double>(image_.normals(), image_.widths(), shape.areas, law, s, o);
}

BrightnessGradient ConvexSurface::gradient(const Shape& shape, const Scattering& law, const Vec3& s,
                                           const Vec3& o, std::span<double> own_row) const {
  const FacetGradient g = patch_gradient(image_.normals(), image_.widths(), shape.areas, law, s, o);
  const std::vector<double> by = image_.by_coefficients(g.by_areas, shape.areas);
  std::copy(by.begin() + 1, by.end(), own_row.begin());
  return static_cast<const BrightnessGradient&>(g);
}

double ConvexSurface::mean(const Shape& shape, std::span<const double> values, double error,
                           double* row) const {
  const std::vector<double>& A = shape.areas;
  const double total = std::accumulate(A.begin(), A.end(), 0.0);
  const double value = std::inner_product(A.begin(), A.end(), values.begin(), 0.0) / total;
  if (row != nullptr) {
    std::vector<double> by_areas;
    for (const double v : values) by_areas.push_back((v - value) / (total * error));
    const std::vector<double> by = image_.by_coefficients(by_areas, A);
    std::copy(by.begin() + 1, by.end(), row);
  }
  return value / error;
}

void ConvexSurface::prior_numbers(const Shape& shape, std::span<const double> own_numbers,
                                  std::span<double> numbers, double* rows) const {
  const auto row = [&](std::size_t k) { return rows == nullptr ? nullptr : rows + k * own(); };
  for (std::size_t k = 0; k < 6; ++k)
    numbers[k] = mean(shape, along_[k], k < 3 ? closure_error_ : axes_error_, row(k));
  for (std::size_t k = 0; k < own(); ++k) {
    const double slope = rough_[k + 1] / roughness_error_;
    numbers[6 + k] = slope * (own_numbers[k] - usual_[k + 1]);
    if (rows == nullptr) continue;
    std::fill_n(row(6 + k), own(), 0.0);
    row(6 + k)[k] = slope;
  }
}

std::vector<std::string> coefficient_names(int degree) {
  std::vector<std::string> names;
  for (int l = 0; l <= degree; ++l)
    for (int m = -l; m <= l; ++m)
      names.push_back("c_" + std::to_string(l) + "_" + std::to_string(m));
  return names;
}

}  // namespace detail

namespace {

using detail::ConvexResiduals;
using detail::ConvexSurface;

const std::string who = "fit_convex: ";
// Rounds of moments that follow the shape, linear in each, of so many iterations, and when they
// have come to rest.
constexpr int most_rounds = 40, round_iterations = 10;
constexpr double same_moments = 1e-5;
// Least part of the way to the body of a round at which moments are taken anew.
constexpr double least_part = 0.125;

void require_start(const ConvexFit& fit) {
  detail::require_spin(who, fit.start.spin, fit.most_iterations);
  detail::require_law(who, fit.start.law, fit.multiple);
  detail::require_diagonal(who, fit.start.spin, "the axes of the start");
  for (const double axis : {fit.start.shape.a, fit.start.shape.b, fit.start.shape.c})
    if (!(axis > 0.0) || !std::isfinite(axis))
      throw DomainError(who + "semi-axis " + detail::number_text(axis) + " must be above 0");
  const auto require_error = [](const char* name, double value) {
    if (!(value > 0.0))
      throw DomainError(who + name + " = " + detail::number_text(value) + " must be above 0");
  };
  require_error("closure_error", fit.closure_error);
  require_error("axes_error", fit.axes_error);
  require_error("roughness_error", fit.roughness_error);
  require_error("moments_error", fit.moments_error);
  if (!fit.from) return;
  const ConvexModel& from = *fit.from;
  detail::require_spin(who, from.spin, fit.most_iterations);
  detail::require_law(who, from.law, fit.multiple);
  detail::require_diagonal(who, from.spin, "the axes of the body that it begins with");
  if (from.coefficients.size() != from.image.coefficient_count())
    throw DomainError(who + std::to_string(from.coefficients.size()) +
                      " coefficients of the body that it begins with; expected " +
                      std::to_string(from.image.coefficient_count()));
}

// The start's ellipsoid with b = 1.
std::vector<double> coefficients_of(const GaussianImage& image, const Ellipsoid& e) {
  return image.coefficients(Ellipsoid{e.a / e.b, 1.0, e.c / e.b});
}

// Moments in units of Izz.
SpinState normalized_spin(SpinState s) {
  const double unit = s.inertia_F(2, 2);
  for (Vec3& row : s.inertia_F.row) row = (1.0 / unit) * row;
  return s;
}

// The body that a fit begins with.
ConvexModel first_body(const ConvexFit& fit) {
  const SpinState spin = normalized_spin(fit.start.spin);
  if (!fit.from) {
    const GaussianImage image(fit.degree, fit.rows);
    return {spin, fit.start.law, image, coefficients_of(image, fit.start.shape)};
  }
  ConvexModel body = *fit.from;
  body.spin = normalized_spin(body.spin);
  if (fit.moments == MomentSource::start) body.spin.inertia_F = spin.inertia_F;
  return body;
}

// From here on moments are linear about these coefficients.
detail::FollowedMoments followed_at(const GaussianImage& image,
                                    const std::vector<double>& coefficients,
                                    const ConvexMoments& m) {
  const std::vector<double> A = image.areas(coefficients);
  const auto own = [](std::vector<double> of_all) {
    of_all.erase(of_all.begin());
    return of_all;
  };
  return {m.Ixx, m.Iyy, own(coefficients), own(image.by_coefficients(m.Ixx_by_areas, A)),
          own(image.by_coefficients(m.Iyy_by_areas, A))};
}

// Residuals with moments that are those of the body at every x.
class OfShape {
 public:
  OfShape(std::shared_ptr<const ConvexResiduals> residuals, const ConvexModel& from)
      : residuals_(std::move(residuals)), image_(from.image), first_(from.coefficients) {
    // of a start that is the same at every x, so that the numbers are, too
    distances_ = convex_moments(image_.normals(), image_.areas(first_)).distances;
  }

  ConvexResiduals about(std::span<const double> x) const {
    std::vector<double> c{first_.front()};
    const std::span<const double> own = residuals_->own_of(x);
    c.insert(c.end(), own.begin(), own.end());
    return residuals_->with(
        followed_at(image_, c, convex_moments(image_.normals(), image_.areas(c), distances_)));
  }

  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const {
    try {
      return about(x).at(x, numbers, jacobian);
    } catch (const DomainError&) {  // areas that close no body
      return false;
    }
  }

 private:
  std::shared_ptr<const ConvexResiduals> residuals_;
  GaussianImage image_;
  std::vector<double> first_, distances_;
};

class ConvexFitter {
 public:
  ConvexFitter(const ConvexFit& fit, ConvexSolution& found, detail::Rows rows = detail::Rows::held)
      : fit_(fit),
        rows_(rows),
        unknowns_{fit.moments == MomentSource::fit, fit.multiple},
        usual_(coefficients_of(found.body.image, fit.start.shape)),
        found_(found) {
    found_.body.coefficients.front() = usual_.front();  // part of the factors
  }

  void run() {
    const auto first = checked_residuals();
    const detail::TurningFit turning{
        [this](int most_iterations) { return problem(most_iterations); },
        [this](const std::vector<double>& x) { move(x); }};
    int left = fit_.most_iterations;
    const bool follows = fit_.moments == MomentSource::shape;
    if (follows) follow(found_.body.coefficients, moments_of(found_.body.coefficients));
    for (int round = 1;; ++round) {
      found_.notes.clear();
      const int most = follows ? std::min(left, round_iterations) : left;
      detail::settle(turning, most, first->curves().groups(), found_);
      left -= found_.result.iterations;
      if (!follows || !goes_on(round, left)) break;
    }
    found_.result.iterations = fit_.most_iterations - left;
    if (found_.result.end == LeastSquaresResult::End::no_value) return;
    add_terms();
    found_.factors = first->curves().session_factors(residuals()->brightness_at(found_.result.x));
    detail::describe_motion(found_.body.spin, found_);
  }

  // Without rounds, for others.
  LeastSquares whole_problem() const {
    const auto shared = checked_residuals();
    LeastSquares p = problem(fit_.most_iterations);
    if (fit_.moments != MomentSource::shape) return p;
    const auto of_shape = std::make_shared<const OfShape>(shared, found_.body);
    p.residuals.at = [of_shape](std::span<const double> x, std::span<double> numbers,
                                std::span<double> jacobian) {
      return of_shape->at(x, numbers, jacobian);
    };
    return p;
  }

  ConvexModel body_at(std::span<const double> x) {
    const auto shared = residuals();
    if (x.size() != shared->unknowns())
      throw DomainError("body_at: got " + std::to_string(x.size()) + " unknowns; expected " +
                        std::to_string(shared->unknowns()));
    if (fit_.moments == MomentSource::shape)
      followed_ = OfShape(shared, found_.body).about(x).followed();
    move(x);
    return found_.body;
  }

 private:
  std::shared_ptr<const ConvexResiduals> checked_residuals() const {
    auto found = residuals();
    detail::require_points(who, found->curves().size() + found->priors(), found->unknowns(),
                           found->curves().groups());
    return found;
  }

  std::shared_ptr<const ConvexResiduals> residuals() const {
    const ConvexModel& b = found_.body;
    return std::make_shared<const ConvexResiduals>(fit_.curves, unknowns_, b.spin, b.law,
                                                   ConvexSurface(b.image, usual_, fit_), followed_,
                                                   fit_.loss, rows_);
  }

  ConvexMoments moments_of(const std::vector<double>& coefficients) {
    const GaussianImage& image = found_.body.image;
    ConvexMoments m = convex_moments(image.normals(), image.areas(coefficients), distances_);
    distances_ = m.distances;
    return m;
  }

  void follow(const std::vector<double>& coefficients, const ConvexMoments& m) {
    followed_ = followed_at(found_.body.image, coefficients, m);
  }

  LeastSquares problem(int most_iterations) const {
    const auto shared = residuals();
    const ConvexModel& b = found_.body;
    LeastSquares p;
    p.unknowns = detail::spin_unknowns(unknowns_, b.spin, b.law);
    const std::vector<std::string> names = detail::coefficient_names(b.image.degree());
    for (std::size_t k = 1; k < names.size(); ++k)
      p.unknowns.push_back({.name = names[k], .start = b.coefficients[k]});
    if (unknowns_.moments) {
      p.triangle = {unknowns_.moments_at(), unknowns_.moments_at() + 1};
      const double variance = fit_.moments_error * fit_.moments_error;
      const Mat3& T = fit_.start.spin.inertia_F;
      if (std::isfinite(variance))
        p.priors = {{{"Ixx/Izz"}, {T(0, 0) / T(2, 2)}, {variance}},
                    {{"Iyy/Izz"}, {T(1, 1) / T(2, 2)}, {variance}}};
    }
    p.residuals.data = shared->curves().size();
    p.residuals.prior = shared->priors();
    p.residuals.at = [shared](std::span<const double> x, std::span<double> numbers,
                              std::span<double> jacobian) {
      return shared->at(x, numbers, jacobian);
    };
    p.loss = fit_.loss;
    p.most_iterations = most_iterations;
    return p;
  }

  void move(std::span<const double> x) {
    const auto at = residuals();
    ConvexModel& b = found_.body;
    const std::span<const double> own = at->own_of(x);
    std::copy(own.begin(), own.end(), b.coefficients.begin() + 1);
    b.spin = at->spin_at(x);
    b.law = at->law_at(x);
  }

  // What regularises the body takes its part of the cost.
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
    if (unknowns_.moments && std::isfinite(fit_.moments_error)) {
      const Mat3 &T = found_.body.spin.inertia_F, &usual = fit_.start.spin.inertia_F;
      double moved = 0.0;
      for (int i = 0; i < 2; ++i) {
        const double d = T(i, i) / T(2, 2) - usual(i, i) / usual(2, 2);
        moved += d * d;
      }
      terms.push_back({"moments", moved / (fit_.moments_error * fit_.moments_error)});
    }
    for (std::size_t k = 1; k < terms.size(); ++k) terms[0].value -= terms[k].value;
  }

  // Whether another round is to come: the body that was found has other moments than it was fitted
  // with, or is not yet at the least.
  bool goes_on(int round, int left) {
    using End = LeastSquaresResult::End;
    LeastSquaresResult& result = found_.result;
    if (!found_.is_found() && (result.end != End::iteration_limit || left <= 0)) return false;
    try {
      const ConvexMoments now = moments_of(found_.body.coefficients);
      const Mat3& T = found_.body.spin.inertia_F;
      const double change = std::max(std::abs(now.Ixx - T(0, 0)), std::abs(now.Iyy - T(1, 1)));
      if (change <= same_moments && found_.is_found()) return false;
      if (round == most_rounds || left <= 0) {
        result.end = End::iteration_limit;
        result.sentence = "not converged: the moments of the shape did not come to rest in " +
                          std::to_string(round) + (round == 1 ? " round" : " rounds") +
                          (left <= 0 ? "; allow more iterations" : "; take smaller facets");
        return false;
      }
      take_anew(now, change);
    } catch (const DomainError& error) {  // facets that close no body
      result.end = End::no_descent;
      result.sentence =
          std::string("not converged: no moments follow from the shape: ") + error.what();
      return false;
    }
    return true;
  }

  // At the body that was found; where that did not bring what is linear near to what is true, the
  // rounds go back and forth, and they are taken part of the way.
  void take_anew(const ConvexMoments& now, double change) {
    part_ = change > 0.5 * change_ ? std::max(0.5 * part_, least_part) : std::min(2.0 * part_, 1.0);
    change_ = change;
    std::vector<double> at = found_.body.coefficients;
    if (part_ == 1.0) return follow(at, now);
    for (std::size_t k = 1; k < at.size(); ++k)
      at[k] = followed_.own[k - 1] + part_ * (at[k] - followed_.own[k - 1]);
    follow(at, moments_of(at));
  }

  const ConvexFit& fit_;
  detail::Rows rows_;
  detail::SurfaceUnknowns unknowns_;
  std::vector<double> usual_;
  ConvexSolution& found_;
  detail::FollowedMoments followed_;
  std::vector<double> distances_;  // of the facets, as they were last
  // Of the moments of the last round, from what is linear to what is true.
  double change_ = std::numeric_limits<double>::infinity();
  double part_ = 1.0;
};

}  // namespace

FacetShape ConvexModel::mesh() const { return convex_body(image.normals(), areas()); }

ConvexSolution fit_convex(const ConvexFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  ConvexSolution found{{}, first_body(fit)};
  ConvexFitter(fit, found).run();
  return found;
}

LeastSquares least_squares_of(const ConvexFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  ConvexSolution begun{{}, first_body(fit)};
  return ConvexFitter(fit, begun, detail::Rows::exact).whole_problem();
}

ConvexModel body_at(const ConvexFit& fit, std::span<const double> x) {
  require_start(fit);
  ConvexSolution begun{{}, first_body(fit)};
  return ConvexFitter(fit, begun).body_at(x);
}

std::vector<std::vector<double>> model_fluxes(const ConvexModel& body,
                                              std::span<const LightCurve> curves,
                                              const Loss& loss) {
  require_sound(curves, {.vectors = true});
  const ConvexResiduals residuals(curves, {}, body.spin, body.law,
                                  ConvexSurface(body.image, body.coefficients, {}), {}, loss);
  const Vec3& w = body.spin.w_F;
  std::vector<double> x{0.0, 0.0, 0.0, w.x, w.y, w.z};
  x.insert(x.end(), body.coefficients.begin() + 1, body.coefficients.end());
  const std::vector<double> B = residuals.brightness_at(x);
  if (B.empty()) throw DomainError("model_fluxes: the body has no motion");
  return residuals.curves().fluxes(B);
}

std::vector<FoundConvex> fit_convex_of_periods(const LightSearchResult& found, const ConvexFit& how,
                                               int threads, std::size_t most,
                                               const std::function<void()>& between) {
  std::vector<std::size_t> pairs;
  for (std::size_t p = 0; p < found.best_of_periods.size(); ++p)
    if (found.best_of_periods[p]) pairs.push_back(p);
  std::ranges::stable_sort(pairs, {},
                           [&](std::size_t p) { return found.best_of_periods[p]->result.cost; });
  pairs.resize(std::min(most, pairs.size()));
  struct Start {
    std::size_t periods;
    const EllipsoidModel* body;
  };
  std::vector<Start> starts;
  for (const std::size_t p : pairs) starts.push_back({p, &found.best_of_periods[p]->body});
  for (const FoundLight& f : found.solutions) {
    const bool is_known = std::ranges::any_of(starts, [&](const Start& s) {
      return s.body->spin.q == f.solution.body.spin.q &&
             s.body->spin.w_F == f.solution.body.spin.w_F;
    });
    if (!is_known) starts.push_back({f.periods, &f.solution.body});
  }
  std::vector<FoundConvex> all;
  ordered_parallel_for(
      0, std::ssize(starts), threads,
      [&](std::int64_t k) {
        if (between) between();
        const Start& start = starts[static_cast<std::size_t>(k)];
        ConvexFit fit = how;
        fit.start = *start.body;
        fit.from.reset();
        return FoundConvex{start.periods, fit_convex(fit)};
      },
      [&](std::int64_t, const FoundConvex& f) { all.push_back(f); });
  std::ranges::stable_sort(all, {}, [](const FoundConvex& f) {
    return std::pair(!f.solution.is_found(), f.solution.result.cost);
  });
  return all;
}

ShapeInertia shape_inertia(const ConvexModel& body) {
  const Mat3 T = mass_properties(body.mesh(), 1.0).inertia;
  const Quaternion q = Body::from_tensor(T).q_FB();
  return {T(0, 0) / T(2, 2), T(1, 1) / T(2, 2), norm(attitude_residual({}, normalized(q)))};
}

}  // namespace v0
}  // namespace polhode
