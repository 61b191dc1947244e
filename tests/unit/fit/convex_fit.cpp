// SPDX-License-Identifier: MIT
// Convex bodies and given shapes: derivatives, recovery of bodies that are no ellipsoids, bad
// input.
#include "polhode/fit/convex_fit.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "fit/detail/convex_surface.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "message_of.hpp"
#include "polhode/fit/mesh_fit.hpp"
#include "unit/light/meshes.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

// A body in short-axis mode, one end of it thicker and its sides flattened.
ConvexModel egg() {
  const GaussianImage image(4, 5);
  std::vector<double> c = image.coefficients(Ellipsoid{1.2, 1.0, 0.6});
  c[16] += 0.15;  // l = 4
  c[20] += 0.3;
  c[24] -= 0.2;
  return {in_short_axis_mode.spin, {}, image, c};
}

// Its light, with noise relative to the flux.
template <class Body>
std::vector<LightCurve> light_of(const Body& body, std::size_t count, double noise) {
  LightCurve curve = night(in_short_axis_mode, 6.0, count, 0.02, 3);
  std::vector<LightCurve> curves{curve};
  const std::vector<double> flux = model_fluxes(body, curves).front();
  const CounterRandom random(5, key_of("egg"));
  for (std::size_t i = 0; i < count; ++i) {
    LightPoint& p = curves[0].points[i];
    p.flux = flux[i] * (1.0 + noise * random.normal(i, 0));
    p.sigma = (noise > 0.0 ? noise : 1e-3) * flux[i];
  }
  return curves;
}

// Central differences of fourth order of all numbers, priors included.
template <class R>
double worst_derivative(const R& residuals, const std::vector<double>& x) {
  const std::size_t n = x.size(), m = residuals.curves().size() + residuals.priors();
  std::vector<double> numbers(m), jacobian(m * n);
  EXPECT_TRUE(residuals.at(x, numbers, jacobian));
  Worst<> worst;
  for (std::size_t k = 0; k < n; ++k) {
    const auto moved = [&](double by) {
      std::vector<double> at = x, found(m);
      at[k] += by;
      EXPECT_TRUE(residuals.at(at, found, {}));
      return found;
    };
    const double h = 1e-6;
    const auto a = moved(h), b = moved(-h), c = moved(2.0 * h), d = moved(-2.0 * h);
    double largest = 0.0;
    std::vector<double> off;
    for (std::size_t i = 0; i < m; ++i) {
      const double slope = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
      largest = larger(largest, std::abs(slope));
      off.push_back(std::abs(jacobian[i * n + k] - slope));
    }
    for (const double o : off) worst.add(o / largest);
  }
  return worst.value();
}

TEST(ConvexFit, DerivativesAreThoseOfDifferences) {
  const ConvexModel body = egg();
  const std::vector<LightCurve> curves = light_of(body, 25, 0.02);
  const detail::SurfaceUnknowns unknowns{true, true};
  ConvexFit how;
  const detail::ConvexResiduals residuals(
      curves, unknowns, body.spin, body.law,
      detail::ConvexSurface(body.image, body.coefficients, how));
  std::vector<double> x{0.2, -0.1, 0.05};
  for (const Unknown& u : detail::spin_unknowns(unknowns, body.spin, body.law))
    if (!u.name.starts_with("turn")) x.push_back(u.start);
  ASSERT_EQ(x.size(), unknowns.own_at());
  for (std::size_t k = 1; k < body.coefficients.size(); ++k)
    x.push_back(body.coefficients[k] + 0.02 * std::cos(static_cast<double>(k)));
  EXPECT_LE(worst_derivative(residuals, x), budget::surface_bend);
  // moments that follow the coefficients
  detail::FollowedMoments followed{
      0.6, 0.8, {body.coefficients.begin() + 1, body.coefficients.end()}, {}, {}};
  for (std::size_t k = 1; k < body.coefficients.size(); ++k) {
    followed.Ixx_by_own.push_back(0.1 * std::sin(static_cast<double>(k)));
    followed.Iyy_by_own.push_back(0.1 * std::cos(2.0 * static_cast<double>(k)));
  }
  const detail::ConvexResiduals tied(curves, {false, true}, body.spin, body.law,
                                     detail::ConvexSurface(body.image, body.coefficients, how),
                                     followed);
  x.erase(x.begin() + 6, x.begin() + 8);
  EXPECT_LE(worst_derivative(tied, x), budget::surface_bend);
}

TEST(ConvexFit, FindsABodyThatIsNoEllipsoid) {
  const ConvexModel truth = egg();
  const std::vector<LightCurve> curves = light_of(truth, 150, 0.005);
  LightFit ellipsoid{curves, in_short_axis_mode, {}, {}, 100};
  ellipsoid.start.shape = {1.0, 0.85, 0.5};
  const LightSolution first = fit_light(ellipsoid);
  ConvexFit fit;
  fit.curves = curves;
  fit.start = first.body;
  fit.degree = 4;
  fit.rows = 5;
  const ConvexSolution found = fit_convex(fit);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  const auto reduced = [](const LightOutcome& s) {
    return s.result.chi_square / s.degrees_of_freedom;
  };
  EXPECT_GT(reduced(first), budget::light_misfit);
  EXPECT_LT(reduced(found), budget::light_noise);
  EXPECT_EQ(found.periods.mode, Regime::short_axis);
  EXPECT_EQ(found.factors.size(), 1u);
  double cost = 0.0;
  for (const CostTerm& term : found.terms) cost += term.value;
  EXPECT_EQ(found.terms.size(), 5u);
  EXPECT_NEAR(cost, found.result.cost, budget::fit_exact * cost);
  EXPECT_NEAR(found.terms[0].value, found.result.chi_square, budget::fit_exact * cost);
  // the body itself: closed, its axes near those of the spin
  const FacetShape mesh = found.body.mesh();
  EXPECT_TRUE(mesh.is_closed());
  const ShapeInertia inertia = shape_inertia(found.body);
  EXPECT_LT(inertia.axes_off, budget::convex_axes);
  EXPECT_NEAR(inertia.Ixx, found.body.spin.inertia_F(0, 0), budget::convex_ratio);
}

ConvexFit small_fit() {
  ConvexFit fit;
  fit.curves = light_of(egg(), 60, 0.01);
  fit.start = in_short_axis_mode;
  fit.degree = 3;
  fit.rows = 4;
  return fit;
}

// Moments that follow the shape are those of the body that is found, and the errors know of it.
TEST(ConvexFit, MomentsFollowTheShape) {
  ConvexFit fit = small_fit();
  fit.curves = light_of(egg(), 120, 0.01);
  fit.moments = MomentSource::shape;
  const ConvexSolution found = fit_convex(fit);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  const ShapeInertia own = shape_inertia(found.body);
  EXPECT_NEAR(own.Ixx, found.body.spin.inertia_F(0, 0), budget::convex_moments);
  EXPECT_NEAR(own.Iyy, found.body.spin.inertia_F(1, 1), budget::convex_moments);
  fit.moments = MomentSource::fit;
  const ConvexSolution free = fit_convex(fit);
  ASSERT_TRUE(free.is_found()) << free.result.sentence;
  EXPECT_GT(found.result.cost, free.result.cost);
}

// With iterations for one round alone the body keeps those that it was fitted with, and is no
// solution.
TEST(ConvexFit, SaysThatMomentsDidNotRest) {
  ConvexFit fit = small_fit();
  fit.moments = MomentSource::shape;
  fit.most_iterations = 10;
  const ConvexSolution found = fit_convex(fit);
  EXPECT_FALSE(found.is_found());
  EXPECT_EQ(found.result.end, LeastSquaresResult::End::iteration_limit);
  EXPECT_THAT(found.result.sentence, HasSubstr("not converged"));
  EXPECT_THAT(found.result.sentence, HasSubstr("allow more"));
  const ShapeInertia own = shape_inertia(found.body);
  EXPECT_GT(std::abs(own.Ixx - found.body.spin.inertia_F(0, 0)), budget::convex_moments);
}

TEST(ConvexFit, GoesOnFromEachPairOfPeriods) {
  const std::vector<LightCurve> curves = light_of(egg(), 60, 0.01);
  LightSearchResult search;
  search.best_of_periods.resize(3);
  LightFit ellipsoid{curves, in_short_axis_mode, {}, {}, 100};
  search.best_of_periods[2] = fit_light(ellipsoid);
  ellipsoid.start.spin.w_F = 1.15 * ellipsoid.start.spin.w_F;
  search.best_of_periods[0] = fit_light(ellipsoid);
  ConvexFit how;
  how.curves = curves;
  how.degree = 3;
  how.rows = 4;
  how.most_iterations = 40;
  const std::vector<FoundConvex> found = fit_convex_of_periods(search, how, 2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].periods, 2u);
  EXPECT_EQ(found[1].periods, 0u);
  EXPECT_EQ(fit_convex_of_periods(search, how, 1, 1).size(), 1u);
  // what the search reports besides: the best of a pair once, its mirror pole
  FoundLight best, mirror;
  best.solution = mirror.solution = *search.best_of_periods[2];
  best.periods = mirror.periods = 2;
  const LightPoint& p = curves[0].points[0];
  mirror.solution.body = image_of(best.solution.body, LightImage::normal, p.to_sun, p.to_observer);
  search.solutions = {best, mirror};
  int calls = 0;
  const std::vector<FoundConvex> both = fit_convex_of_periods(search, how, 1, 1, [&] { ++calls; });
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(calls, 2);
  EXPECT_NEAR(both[0].solution.result.cost / both[1].solution.result.cost, 1.0,
              budget::light_image_cost);
  EXPECT_GT(norm(both[0].solution.pole - both[1].solution.pole), budget::convex_axes);
}

// Areas that are far from closed have no body and no moments: said of the fit, not thrown.
TEST(ConvexFit, SaysWhereTheShapeHasNoMoments) {
  ConvexModel open = egg();
  open.coefficients[2] += 2.5;  // l = 1
  EXPECT_REJECTED(open.mesh(), "too far from 0");
  ConvexFit fit;
  fit.curves = light_of(open, 150, 0.005);
  fit.start = in_short_axis_mode;
  fit.degree = 4;
  fit.rows = 5;
  fit.closure_error = fit.axes_error = fit.roughness_error = 1e3;
  fit.moments = MomentSource::shape;
  const ConvexSolution found = fit_convex(fit);
  EXPECT_EQ(found.result.end, LeastSquaresResult::End::no_descent) << found.result.sentence;
  EXPECT_THAT(found.result.sentence, HasSubstr("no moments follow from the shape: "));
}

TEST(MeshFit, FindsTheSpinOfAConvexMesh) {
  const FacetShape mesh = globe(8, [](const Vec3& v) { return Vec3{1.2 * v.x, v.y, 0.6 * v.z}; });
  const MeshModel truth{in_short_axis_mode.spin, ShadedMesh(mesh), Scattering::mixed(0.2)};
  ASSERT_TRUE(truth.shape.is_shadowless());
  MeshFit fit{light_of(truth, 60, 0.0), truth, MomentSource::fit, true, {}, 100};
  fit.start.law = {};
  fit.start.spin.q = truth.spin.q * detail::turn_by({0.1, -0.05, 0.08});
  fit.start.spin.w_F = 1.01 * truth.spin.w_F;
  fit.start.spin.inertia_F(0, 0) *= 1.02;
  const MeshSolution found = fit_mesh(fit);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  EXPECT_LE(norm(attitude_residual(truth.spin.q, found.body.spin.q)), budget::mesh_exact);
  EXPECT_LE(norm(found.body.spin.w_F - truth.spin.w_F), budget::mesh_exact);
  EXPECT_NEAR(found.body.law.multiple, 0.2, budget::mesh_exact);
}

// Balls that touch shade each other; the light of their facets jumps at the edges of shadows.
TEST(MeshFit, TakesShadows) {
  const auto ball = [](double at, double radius) {
    return globe(6, [=](const Vec3& v) {
      return Vec3{at + radius * v.x, radius * v.y, radius * v.z};
    });
  };
  const FacetShape bulge = ball(0.0, 0.3).moved({0.0, -0.75, 0.1}, 1.0);
  const FacetShape pair = joined(joined(ball(-0.6, 0.6), ball(0.45, 0.45)), bulge);
  SpinState spin = in_short_axis_mode.spin;
  spin.inertia_F = homogeneous_inertia(pair);
  const MeshModel truth{spin, ShadedMesh(pair), {}};
  ASSERT_FALSE(truth.shape.is_shadowless());
  MeshFit fit{light_of(truth, 40, 0.0), truth, MomentSource::start, false, {}, 12};
  for (LightPoint& p : fit.curves[0].points) p.sigma = 0.02 * p.flux;
  fit.start.spin.q = truth.spin.q * detail::turn_by({0.05, -0.03, 0.04});
  fit.start.spin.w_F = 1.003 * truth.spin.w_F;
  const std::vector<double> before = model_fluxes(fit.start, fit.curves).front();
  double chi_square = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const LightPoint& p = fit.curves[0].points[i];
    chi_square += (p.flux - before[i]) * (p.flux - before[i]) / (p.sigma * p.sigma);
  }
  const MeshSolution found = fit_mesh(fit);
  EXPECT_LT(found.result.chi_square, budget::mesh_gain * chi_square);
}

TEST(ConvexFit, SaysWhatIsWrong) {
  ConvexFit fit;
  fit.curves = {night(in_short_axis_mode, 2.0, 9, 0.02, 1)};
  fit.start = in_short_axis_mode;
  const auto refusal = [&](const auto& change) {
    ConvexFit bad = fit;
    change(bad);
    return message_of([&] { static_cast<void>(fit_convex(bad)); });
  };
  EXPECT_EQ(refusal([](ConvexFit& f) { f.closure_error = 0.0; }),
            "fit_convex: closure_error = 0 must be above 0");
  EXPECT_EQ(refusal([](ConvexFit& f) { f.roughness_error = -1.0; }),
            "fit_convex: roughness_error = -1 must be above 0");
  EXPECT_EQ(refusal([](ConvexFit& f) { f.most_iterations = 0; }),
            "fit_convex: most_iterations = 0 must be 1 or more");
  EXPECT_THAT(refusal([](ConvexFit& f) { f.degree = 50; }), HasSubstr("degree 50"));
  EXPECT_THAT(refusal([](ConvexFit& f) { f.start.spin.inertia_F(0, 1) = 0.1; }),
              HasSubstr("the axes of the start must be principal"));
  MeshFit mesh{fit.curves, {in_short_axis_mode.spin, ShadedMesh(egg().mesh()), {}}, {}, false, {},
               10};
  mesh.moments = MomentSource::shape;
  EXPECT_REJECTED(fit_mesh(mesh), "moments cannot follow a shape that stays");
  mesh.moments = MomentSource::start;
  mesh.curves[0].points.resize(6);
  EXPECT_MESSAGE(fit_mesh(mesh),
                 "fit_mesh: 6 points for 6 unknowns and 1 factor; expected as many at least");
}

}  // namespace
