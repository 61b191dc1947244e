// SPDX-License-Identifier: MIT
// Light curves of tumbling ellipsoids: derivatives of residuals against differences in
// double-double, and solutions from a cold start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "fit/detail/light_residuals.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/math/double_double.hpp"
#include "wide_light.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using DD = DoubleDouble;

// The residuals of one session in double-double, at x + h e_k: of attitude to second order in h.
std::vector<DD> wide_residuals(const fit::LightModel& b, const light::LightCurve& curve,
                               std::size_t k, const DD& h) {
  const std::vector<DD> B = wide_brightness(b, curve, k, h);
  std::vector<DD> r;
  DD up(0.0), down(0.0);
  for (std::size_t i = 0; i < B.size(); ++i) {
    const light::LightPoint& p = curve.points[i];
    const DD w = DD(1.0) / (DD(p.sigma) * DD(p.sigma));
    up += w * DD(p.flux) * B[i];
    down += w * B[i] * B[i];
  }
  for (std::size_t i = 0; i < B.size(); ++i) {
    const light::LightPoint& p = curve.points[i];
    r.push_back((DD(p.flux) - up / down * B[i]) / DD(p.sigma));
  }
  return r;
}

TEST(LightFit, DerivativesAreThoseOfDifferencesInDoubleDouble) {
  for (const fit::LightModel& b : {in_long_axis_mode, in_short_axis_mode}) {
    const light::LightCurve curve = night(b, 3.0, 12, 0.02, 3);
    const auto residuals = ellipsoid_residuals({curve}, {}, b);
    const std::vector<double> x = fit::light_unknowns_at({}, b, b);
    const std::size_t n = x.size(), count = curve.points.size();
    std::vector<double> numbers(count), jacobian(count * n);
    ASSERT_TRUE(residuals.at(x, numbers, jacobian));
    const DD h(0x1p-30);
    for (std::size_t k = 0; k < n; ++k) {
      const auto above = wide_residuals(b, curve, k, h), below = wide_residuals(b, curve, k, -h);
      double largest = 0.0;
      test::Worst<> worst;
      for (std::size_t i = 0; i < count; ++i) {
        const double slope = static_cast<double>((above[i] - below[i]) / (DD(2.0) * h));
        largest = test::larger(largest, std::abs(slope));
        worst.add(std::abs(jacobian[i * n + k] - slope));
      }
      EXPECT_LE(worst.value(), budget::light_derivatives * largest) << k;
    }
  }
}

fit::LightSearch cold_search(const std::vector<light::LightCurve>& curves, double f,
                             std::size_t labels, std::size_t of_each) {
  const fit::ScanPoints points(curves);
  const auto grid =
      fit::FrequencyGrid::between(0.45 * f, 3.1 * f, fit::scan_advice(curves, 2).step);
  const fit::Landscape landscape = fit::scan_pairs(points, grid, grid, {.order = 2, .threads = 2});
  fit::LightSearch search;
  search.curves = curves;
  search.periods =
      fit::labelled_periods(fit::scan_minima(points, landscape, {.most = 20, .threads = 2}),
                            {.pairs = 1, .labels = labels});
  search.starts = of_each * search.periods.size();
  search.finalists = 1;
  search.threads = 2;
  return search;
}

// Whether the truth is within the errors of one of the solutions.
bool is_among(const fit::LightSearchResult& found, const fit::LightModel& truth) {
  return std::ranges::any_of(found.solutions, [&](const fit::FoundLight& f) {
    const fit::LightModel& b = f.solution.body;
    const fit::LightModel near = fit::nearest_of_same(b, at_time(truth, b.spin.t0));
    return fit::mahalanobis(f.solution.covariance, fit::light_unknowns_at({}, b, b),
                            fit::light_unknowns_at({}, b, near)) < budget::light_distance;
  });
}

class ColdStart : public testing::TestWithParam<fit::LightModel> {};

TEST_P(ColdStart, FindsTheTruthAmongItsImages) {
  const fit::LightModel& truth = GetParam();
  const bool is_full = std::getenv("POLHODE_TEST_FULL") != nullptr;
  const std::vector<light::LightCurve> curves{
      night(truth, is_full ? 11.0 : 7.0, is_full ? 350 : 90, 0.02, 7)};
  const double f = motion_of(truth).precession_rate_long() / (2.0 * pi<double>());
  const fit::LightSearchResult found =
      fit::search_light(cold_search(curves, f, 15, is_full ? 20 : 8));
  ASSERT_FALSE(found.solutions.empty());
  const fit::FoundLight& best = found.solutions.front();
  EXPECT_EQ(best.solution.periods.mode, motion_of(truth).regime());
  EXPECT_TRUE(is_among(found, truth));
  // mirror poles and their like, from fixed directions to Sun and observer
  std::size_t images = 0;
  for (const fit::FoundLight& s : found.solutions) {
    EXPECT_TRUE(s.solution.is_found());
    EXPECT_FALSE(s.sentence.empty());
    if (s.of == 0 && s.beside == fit::FoundLight::Beside::image) ++images;
  }
  EXPECT_EQ(images, 3u);
}

INSTANTIATE_TEST_SUITE_P(Modes, ColdStart, testing::Values(in_long_axis_mode, in_short_axis_mode));

TEST(LightSearch, HasTheBitsOfOneThreadWithMore) {
  const FreeRotation motion = motion_of(in_short_axis_mode);
  fit::LightSearch search;
  search.curves = {night(in_short_axis_mode, 3.0, 40, 0.02, 5)};
  search.periods = {{motion.regime(), 2.0 * pi<double>() / motion.precession_rate_long(),
                     motion.polhode_period()}};
  search.starts = 12;
  search.finalists = 2;
  search.within = 5.0;
  const fit::LightSearchResult one = fit::search_light(search);
  ASSERT_FALSE(one.solutions.empty());
  for (const int threads : {2, 3}) {
    search.threads = threads;
    const fit::LightSearchResult many = fit::search_light(search);
    ASSERT_EQ(many.solutions.size(), one.solutions.size());
    for (std::size_t i = 0; i < one.solutions.size(); ++i) {
      EXPECT_EQ(many.solutions[i].solution.result.x, one.solutions[i].solution.result.x);
      EXPECT_EQ(many.solutions[i].solution.body.spin.q, one.solutions[i].solution.body.spin.q);
      EXPECT_EQ(many.solutions[i].sentence, one.solutions[i].sentence);
    }
  }
}

TEST(LightFit, SaysWhatIsWrong) {
  fit::LightFit fit{{night(in_long_axis_mode, 2.0, 9, 0.02, 1)}, in_long_axis_mode, {}, {}, 10};
  const auto message = [](const fit::LightFit& bad) {
    return test::message_of([&] { static_cast<void>(fit::fit_light(bad)); });
  };
  fit::LightFit few = fit;
  few.curves[0].points.resize(8);
  EXPECT_EQ(message(few),
            "fit_light: 8 points for 8 unknowns and 1 factor; expected as many at least");
  fit::LightFit bad = fit;
  bad.start.shape = light::Ellipsoid{1.0, 0.6, -1.0};
  EXPECT_EQ(message(bad), "fit_light: semi-axes (1, 0.6, -1) must be above 0");
  bad = fit;
  bad.start.shape = light::Ellipsoid{1.0, 0.5, 0.8};
  EXPECT_EQ(message(bad),
            "fit_light: semi-axes (1, 0.5, 0.8) must not rise where moments follow from them");
  bad = fit;
  bad.start.spin.w_F = {};
  EXPECT_EQ(message(bad), "fit_light: the rate at the start, (0, 0, 0), must be finite and not 0");
  bad = fit;
  bad.curves[0].points[2].to_sun = {};
  EXPECT_THROW(static_cast<void>(fit::fit_light(bad)), DomainError);
  fit::LightSearch search;
  search.curves = fit.curves;
  EXPECT_MESSAGE(fit::search_light(search),
                 "search_light: no periods to start from; expected one pair");
}

}  // namespace
