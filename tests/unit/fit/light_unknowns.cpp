// SPDX-License-Identifier: MIT
// Light curves: moments of their own and fixed ones, the weight of Lambert's law, sessions that are
// calibrated or not, robust losses, images.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "fit/detail/light_residuals.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "message_of.hpp"
#include "polhode/fit/light_search.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

// A body whose moments are not those of its shape, and which scatters by both laws.
fit::LightModel uneven() {
  fit::LightModel b = in_short_axis_mode;
  b.law = light::Scattering::mixed(0.3);
  b.spin.inertia_F(0, 0) = 0.6;
  b.spin.inertia_F(1, 1) = 0.8;
  return b;
}

// Sessions of 2 and 3 turns, the first relative, the others calibrated, with the light of a body.
std::vector<light::LightCurve> sessions_of(const fit::LightModel& b, double noise) {
  std::vector<light::LightCurve> curves;
  std::size_t seed = 3;
  for (const double shift : {0.0, 13.0, 31.0}) {
    light::LightCurve curve = night(in_short_axis_mode, 2.5, 40, 0.02, seed++);
    for (light::LightPoint& p : curve.points) p.t += shift;
    curve.name = std::to_string(seed);
    curve.is_calibrated = shift > 0.0;
    curves.push_back(curve);
  }
  const auto flux = fit::model_fluxes(b, curves);
  const ensemble::CounterRandom random(9, ensemble::key_of("sessions"));
  // one factor for those that are calibrated
  const double unit = flux[1][0];
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t i = 0; i < curves[c].points.size(); ++i) {
      light::LightPoint& p = curves[c].points[i];
      p.flux = flux[c][i] / unit * (1.0 + noise * random.normal(100 * c + i, 0));
      p.sigma = 0.01 * p.flux;
    }
  return curves;
}

TEST(LightUnknowns, DerivativesOfEveryUnknownAreThoseOfDifferences) {
  const fit::LightModel b = uneven();
  const fit::LightUnknowns unknowns{
      .shape = true, .moments = fit::MomentSource::fit, .multiple = true};
  const std::vector<light::LightCurve> curves = sessions_of(b, 0.02);
  const auto residuals = ellipsoid_residuals(curves, unknowns, b);
  EXPECT_EQ(residuals.curves().groups(), 2u);
  std::vector<double> x = fit::light_unknowns_at(unknowns, b, b);
  x[0] = 0.2;  // away from no turn
  const std::size_t n = x.size(), count = residuals.curves().size();
  ASSERT_EQ(n, 11u);
  std::vector<double> numbers(count), jacobian(count * n);
  ASSERT_TRUE(residuals.at(x, numbers, jacobian));
  for (std::size_t k = 0; k < n; ++k) {
    const auto moved = [&](double by) {
      std::vector<double> at = x, found(count);
      at[k] += by;
      EXPECT_TRUE(residuals.at(at, found, {}));
      return found;
    };
    const double h = 1e-4;
    const auto a = moved(h), c = moved(-h), d = moved(2.0 * h), e = moved(-2.0 * h);
    double largest = 0.0;
    Worst<> worst;
    for (std::size_t i = 0; i < count; ++i) {
      const double slope = (8.0 * (a[i] - c[i]) - (d[i] - e[i])) / (12.0 * h);
      largest = larger(largest, std::abs(slope));
      worst.add(std::abs(jacobian[i * n + k] - slope));
    }
    EXPECT_LE(worst.value(), budget::lambert_difference * largest) << k;
  }
}

// From a start beside it, exact light has its state, with all unknowns there are.
TEST(LightUnknowns, AreFoundFromExactLight) {
  const fit::LightModel truth = uneven();
  fit::LightFit fit{sessions_of(truth, 0.0), truth, {}, {}, 200};
  fit.unknowns = {.shape = true, .moments = fit::MomentSource::fit, .multiple = true};
  fit.start.spin.q = truth.spin.q * fit::detail::turn_by({0.03, -0.02, 0.04});
  fit.start.spin.inertia_F(0, 0) = 0.61;
  fit.start.spin.inertia_F(1, 1) = 0.79;
  fit.start.shape = light::Ellipsoid{1.0, 0.83, 0.52};
  fit.start.law = light::Scattering::mixed(0.25);
  const fit::LightSolution found = fit::fit_light(fit);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  EXPECT_LE(norm(fit::attitude_residual(truth.spin.q, found.body.spin.q)), budget::light_exact);
  EXPECT_NEAR(found.body.spin.inertia_F(0, 0), 0.6, budget::light_exact);
  EXPECT_NEAR(found.body.spin.inertia_F(1, 1), 0.8, budget::light_exact);
  EXPECT_NEAR(found.body.ellipsoid().b, 0.85, budget::light_exact);
  EXPECT_NEAR(found.body.law.multiple, 0.3, budget::light_exact);
  // sessions that are calibrated share a factor
  ASSERT_EQ(found.factors.size(), 3u);
  EXPECT_EQ(found.factors[1], found.factors[2]);
  EXPECT_NE(found.factors[0], found.factors[1]);
  // moments that stay: the others are found with them
  fit.unknowns.moments = fit::MomentSource::start;
  fit.start.spin.inertia_F = truth.spin.inertia_F;
  const fit::LightSolution held = fit::fit_light(fit);
  ASSERT_TRUE(held.is_found()) << held.result.sentence;
  EXPECT_EQ(held.body.spin.inertia_F(0, 0), 0.6);
  EXPECT_LE(norm(fit::attitude_residual(truth.spin.q, held.body.spin.q)), budget::light_exact);
}

TEST(LightUnknowns, RobustLossesLeaveBadPointsOut) {
  fit::LightModel truth = in_short_axis_mode;
  fit::LightFit fit{sessions_of(truth, 0.01), truth, {}, {}, 200};
  for (const std::size_t k : {5u, 17u, 30u}) fit.curves[0].points[k].flux *= 1.5;
  // Mahalanobis' distance squared of the truth
  const auto off = [&](const fit::LightSolution& s) {
    const fit::LightModel& b = s.body;
    return fit::mahalanobis(s.covariance, fit::light_unknowns_at({}, b, b),
                            fit::light_unknowns_at({}, b, fit::nearest_of_same(b, truth)));
  };
  const fit::LightSolution squared = fit::fit_light(fit);
  fit.loss = {fit::Loss::Kind::cauchy, 5.0};
  const fit::LightSolution robust = fit::fit_light(fit);
  ASSERT_TRUE(robust.is_found()) << robust.result.sentence;
  EXPECT_GT(off(squared), budget::light_distance);
  EXPECT_LT(off(robust), budget::light_distance);
}

// Images have the same residuals, to rounding.
TEST(LightImages, LookTheSame) {
  const light::LightCurve curve = night(in_long_axis_mode, 2.0, 20, 0.02, 3);
  const std::vector<light::LightCurve> curves{curve};
  const auto here = fit::model_fluxes(in_long_axis_mode, curves).front();
  for (const fit::LightImage i :
       {fit::LightImage::normal, fit::LightImage::bisector, fit::LightImage::difference}) {
    const fit::LightModel image =
        fit::image_of(in_long_axis_mode, i, curve.points[0].to_sun, curve.points[0].to_observer);
    const auto there = fit::model_fluxes(image, curves).front();
    for (std::size_t k = 0; k < here.size(); ++k)
      EXPECT_NEAR(there[k] / here[k], 1.0, budget::fit_exact);
  }
}

TEST(LightUnknowns, SayWhatIsWrong) {
  fit::LightFit fit{{night(in_long_axis_mode, 2.0, 20, 0.02, 1)}, in_long_axis_mode, {}, {}, 0};
  const auto message = [&] { return message_of([&] { static_cast<void>(fit::fit_light(fit)); }); };
  EXPECT_EQ(message(), "fit_light: most_iterations = 0 must be 1 or more");
  fit.most_iterations = 5;
  fit.unknowns.multiple = true;
  fit.start.law = light::Scattering::lambert();
  EXPECT_THAT(message(), HasSubstr("needs that of Lommel and Seeliger to be above 0"));
  fit.unknowns = {.moments = fit::MomentSource::start};
  fit.start.spin.inertia_F(0, 1) = 0.1;
  EXPECT_THAT(message(), HasSubstr("the axes of the ellipsoid must be principal"));
}

}  // namespace
