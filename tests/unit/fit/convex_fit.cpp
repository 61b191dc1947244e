// SPDX-License-Identifier: MIT
// Convex bodies and given shapes: derivatives, recovery of bodies that are no ellipsoids, bad
// input.

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "fit/detail/light_residuals.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/light_search.hpp"
#include "unit/light/meshes.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

// A body in short-axis mode, one end of it thicker and its sides flattened.
fit::LightModel egg() {
  const light::GaussianImage image(4, 5);
  std::vector<double> c = image.coefficients(light::Ellipsoid{1.2, 1.0, 0.6});
  c[16] += 0.15;  // l = 4
  c[20] += 0.3;
  c[24] -= 0.2;
  return {in_short_axis_mode.spin, fit::ConvexShape{image, c}, {}};
}

// Its light, with noise relative to the flux.
std::vector<light::LightCurve> light_of(const fit::LightModel& body, std::size_t count,
                                        double noise) {
  light::LightCurve curve = night(in_short_axis_mode, 6.0, count, 0.02, 3);
  std::vector<light::LightCurve> curves{curve};
  const std::vector<double> flux = fit::model_fluxes(body, curves).front();
  const ensemble::CounterRandom random(5, ensemble::key_of("egg"));
  for (std::size_t i = 0; i < count; ++i) {
    light::LightPoint& p = curves[0].points[i];
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
  const fit::LightModel body = egg();
  const std::vector<double>& coefficients = body.convex().coefficients;
  const auto curves =
      std::make_shared<const fit::detail::WeighedCurves>(light_of(body, 25, 0.02), fit::Loss{});
  fit::LightFit fit{{}, body, {.moments = fit::MomentSource::fit, .multiple = true}, {}};
  const fit::detail::ConvexSurface surface(fit, body);
  const fit::detail::LightResiduals<fit::detail::ConvexSurface> residuals(curves, fit.unknowns,
                                                                          body, surface);
  std::vector<double> x = fit::light_unknowns_at(fit.unknowns, body, body);
  x[0] = 0.2;
  x[1] = -0.1;
  x[2] = 0.05;
  x[residuals.places().multiple] = fit::detail::usual_multiple;
  ASSERT_EQ(x.size(), residuals.places().count);
  for (std::size_t k = 1; k < coefficients.size(); ++k)
    x[residuals.places().own + k - 1] += 0.02 * std::cos(static_cast<double>(k));
  EXPECT_LE(worst_derivative(residuals, x), budget::surface_bend);
  // moments that follow the coefficients
  fit::detail::FollowedMoments followed{
      0.6, 0.8, {coefficients.begin() + 1, coefficients.end()}, {}, {}};
  for (std::size_t k = 1; k < coefficients.size(); ++k) {
    followed.Ixx_by_own.push_back(0.1 * std::sin(static_cast<double>(k)));
    followed.Iyy_by_own.push_back(0.1 * std::cos(2.0 * static_cast<double>(k)));
  }
  fit.unknowns.moments = fit::MomentSource::shape;
  const fit::detail::LightResiduals<fit::detail::ConvexSurface> tied(curves, fit.unknowns, body,
                                                                     surface.with(followed));
  x.erase(x.begin() + 6, x.begin() + 8);
  EXPECT_LE(worst_derivative(tied, x), budget::surface_bend);
}

// With moments that are unknown.
fit::LightFit convex_from(const fit::LightModel& ellipsoid,
                          const std::vector<light::LightCurve>& curves, int degree, int rows) {
  fit::LightFit fit{curves, ellipsoid, {.moments = fit::MomentSource::fit}, {}, 100};
  fit.start.shape = fit::ConvexShape::of(ellipsoid.ellipsoid(), degree, rows);
  return fit;
}

TEST(ConvexFit, FindsABodyThatIsNoEllipsoid) {
  const fit::LightModel truth = egg();
  const std::vector<light::LightCurve> curves = light_of(truth, 150, 0.005);
  fit::LightFit ellipsoid{curves, in_short_axis_mode, {}, {}, 100};
  ellipsoid.start.shape = light::Ellipsoid{1.0, 0.85, 0.5};
  const fit::LightSolution first = fit::fit_light(ellipsoid);
  const fit::LightSolution found = fit::fit_light(convex_from(first.body, curves, 4, 5));
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  const auto reduced = [](const fit::LightSolution& s) {
    return s.result.chi_square / s.degrees_of_freedom;
  };
  EXPECT_GT(reduced(first), budget::light_misfit);
  EXPECT_LT(reduced(found), budget::light_noise);
  EXPECT_EQ(found.periods.mode, Regime::short_axis);
  EXPECT_EQ(found.factors.size(), 1u);
  double cost = 0.0;
  for (const fit::CostTerm& term : found.terms) cost += term.value;
  EXPECT_EQ(found.terms.size(), 5u);
  EXPECT_NEAR(cost, found.result.cost, budget::fit_exact * cost);
  EXPECT_NEAR(found.terms[0].value, found.result.chi_square, budget::fit_exact * cost);
  // the body itself: closed, its axes near those of the spin
  const shape::FacetShape mesh = found.body.convex().mesh();
  EXPECT_TRUE(mesh.is_closed());
  const fit::ShapeInertia inertia = fit::shape_inertia(found.body.convex());
  EXPECT_LT(inertia.axes_off, budget::convex_axes);
  EXPECT_NEAR(inertia.Ixx, found.body.spin.inertia_F(0, 0), budget::convex_ratio);
}

fit::LightFit small_fit() {
  return convex_from(in_short_axis_mode, light_of(egg(), 60, 0.01), 3, 4);
}

// Moments that follow the shape are those of the body that is found, and the errors know of it.
TEST(ConvexFit, MomentsFollowTheShape) {
  fit::LightFit fit = small_fit();
  fit.curves = light_of(egg(), 120, 0.01);
  fit.unknowns.moments = fit::MomentSource::shape;
  const fit::LightSolution found = fit::fit_light(fit);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  const fit::ShapeInertia own = fit::shape_inertia(found.body.convex());
  EXPECT_NEAR(own.Ixx, found.body.spin.inertia_F(0, 0), budget::convex_moments);
  EXPECT_NEAR(own.Iyy, found.body.spin.inertia_F(1, 1), budget::convex_moments);
  fit.unknowns.moments = fit::MomentSource::fit;
  const fit::LightSolution free = fit::fit_light(fit);
  ASSERT_TRUE(free.is_found()) << free.result.sentence;
  EXPECT_GT(found.result.cost, free.result.cost);
}

// With iterations for one round alone the body keeps those that it was fitted with, and is no
// solution.
TEST(ConvexFit, SaysThatMomentsDidNotRest) {
  fit::LightFit fit = small_fit();
  fit.unknowns.moments = fit::MomentSource::shape;
  fit.most_iterations = 10;
  const fit::LightSolution found = fit::fit_light(fit);
  EXPECT_FALSE(found.is_found());
  EXPECT_EQ(found.result.end, fit::LeastSquaresResult::End::iteration_limit);
  EXPECT_THAT(found.result.sentence, HasSubstr("not converged"));
  EXPECT_THAT(found.result.sentence, HasSubstr("allow more"));
  const fit::ShapeInertia own = fit::shape_inertia(found.body.convex());
  EXPECT_GT(std::abs(own.Ixx - found.body.spin.inertia_F(0, 0)), budget::convex_moments);
}

// Areas that are far from closed have no body and no moments: said of the fit, not thrown.
TEST(ConvexFit, SaysWhereTheShapeHasNoMoments) {
  fit::LightModel open = egg();
  std::get<fit::ConvexShape>(open.shape).coefficients[2] += 2.5;  // l = 1
  EXPECT_REJECTED(open.convex().mesh(), "too far from 0");
  fit::LightFit fit = convex_from(in_short_axis_mode, light_of(open, 150, 0.005), 4, 5);
  fit::Regularisation& r = fit.regularisation;
  r.closure_error = r.axes_error = r.roughness_error = 1e3;
  fit.unknowns.moments = fit::MomentSource::shape;
  const fit::LightSolution found = fit::fit_light(fit);
  EXPECT_EQ(found.result.end, fit::LeastSquaresResult::End::no_descent) << found.result.sentence;
  EXPECT_THAT(found.result.sentence, HasSubstr("no moments follow from the shape: "));
}

TEST(MeshFit, FindsTheSpinOfAConvexMesh) {
  const shape::FacetShape mesh = globe(8, [](const Vec3& v) {
    return Vec3{1.2 * v.x, v.y, 0.6 * v.z};
  });
  const fit::LightModel truth{in_short_axis_mode.spin, light::ShadedMesh(mesh),
                              light::Scattering::mixed(0.2)};
  ASSERT_TRUE(truth.mesh().is_shadowless());
  fit::LightFit fit{light_of(truth, 60, 0.0), truth, {true, fit::MomentSource::fit, true}, {}, 100};
  fit.start.law = {};
  fit.start.spin.q = truth.spin.q * fit::detail::turn_by({0.1, -0.05, 0.08});
  fit.start.spin.w_F = 1.01 * truth.spin.w_F;
  fit.start.spin.inertia_F(0, 0) *= 1.02;
  const fit::LightSolution found = fit::fit_light(fit);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  EXPECT_LE(norm(fit::attitude_residual(truth.spin.q, found.body.spin.q)), budget::mesh_exact);
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
  const shape::FacetShape bulge = ball(0.0, 0.3).moved({0.0, -0.75, 0.1}, 1.0);
  const shape::FacetShape pair = joined(joined(ball(-0.6, 0.6), ball(0.45, 0.45)), bulge);
  fit::SpinState spin = in_short_axis_mode.spin;
  spin.inertia_F = fit::homogeneous_inertia(pair);
  const fit::LightModel truth{spin, light::ShadedMesh(pair), {}};
  ASSERT_FALSE(truth.mesh().is_shadowless());
  fit::LightFit fit{light_of(truth, 40, 0.0), truth, {.moments = fit::MomentSource::start}, {}, 12};
  for (light::LightPoint& p : fit.curves[0].points) p.sigma = 0.02 * p.flux;
  fit.start.spin.q = truth.spin.q * fit::detail::turn_by({0.05, -0.03, 0.04});
  fit.start.spin.w_F = 1.003 * truth.spin.w_F;
  const std::vector<double> before = fit::model_fluxes(fit.start, fit.curves).front();
  double chi_square = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const light::LightPoint& p = fit.curves[0].points[i];
    chi_square += (p.flux - before[i]) * (p.flux - before[i]) / (p.sigma * p.sigma);
  }
  const fit::LightSolution found = fit::fit_light(fit);
  EXPECT_LT(found.result.chi_square, budget::mesh_gain * chi_square);
}

// A convex body whose facets are known: its spin alone is unknown, as that of its mesh.
TEST(ConvexFit, TakesAShapeThatIsKnown) {
  const fit::LightModel truth = egg();
  fit::LightFit fit{
      light_of(truth, 60, 0.0), truth, {false, fit::MomentSource::start, false}, {}, 60};
  fit.start.spin.q = truth.spin.q * fit::detail::turn_by({0.05, -0.03, 0.04});
  const fit::LightSolution found = fit::fit_light(fit);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  EXPECT_EQ(found.covariance.names.size(), 6u);
  EXPECT_EQ(fit::light_unknowns_at(fit.unknowns, truth, found.body).size(), 6u);
  EXPECT_EQ(found.terms.size(), 1u);
  EXPECT_EQ(found.body.convex().coefficients, truth.convex().coefficients);
  EXPECT_LE(norm(fit::attitude_residual(truth.spin.q, found.body.spin.q)), budget::mesh_exact);
}

TEST(ConvexFit, SaysWhatIsWrong) {
  const fit::LightFit fit =
      convex_from(in_short_axis_mode, {night(in_short_axis_mode, 2.0, 9, 0.02, 1)}, 6, 8);
  const auto refusal = [&](const auto& change) {
    fit::LightFit bad = fit;
    change(bad);
    return message_of([&] { static_cast<void>(fit::fit_light(bad)); });
  };
  EXPECT_EQ(refusal([](fit::LightFit& f) { f.regularisation.closure_error = 0.0; }),
            "fit_light: closure_error = 0 must be above 0");
  EXPECT_EQ(refusal([](fit::LightFit& f) { f.regularisation.roughness_error = -1.0; }),
            "fit_light: roughness_error = -1 must be above 0");
  EXPECT_EQ(refusal([](fit::LightFit& f) { f.most_iterations = 0; }),
            "fit_light: most_iterations = 0 must be 1 or more");
  EXPECT_THAT(refusal([](fit::LightFit& f) { f.start.spin.inertia_F(0, 1) = 0.1; }),
              HasSubstr("the axes of the start must be principal"));
  EXPECT_REJECTED(fit::ConvexShape::of({1.0, 0.8, 0.6}, 50, 8), "degree 50");
  EXPECT_REJECTED(fit::ConvexShape::of({1.0, 0.0, 0.6}), "semi-axis 0 must be above 0");
  fit::LightFit mesh = fit;
  mesh.start.shape = light::ShadedMesh(egg().convex().mesh());
  mesh.unknowns.moments = fit::MomentSource::shape;
  EXPECT_REJECTED(fit::fit_light(mesh), "moments cannot follow a shape that stays");
  mesh.unknowns.moments = fit::MomentSource::start;
  mesh.curves[0].points.resize(6);
  EXPECT_MESSAGE(fit::fit_light(mesh),
                 "fit_light: 6 points for 6 unknowns and 1 factor; expected as many at least");
}

}  // namespace
