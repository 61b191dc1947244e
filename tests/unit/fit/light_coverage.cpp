// SPDX-License-Identifier: MIT
// Tumblers drawn at random, from a cold start: is the true reading of the periods high in the list
// of labels, and the truth among what is reported, within its errors?
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "polhode/fit/fourier_scan.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/fit/likely_periods.hpp"
#include "polhode/fit/scan_advice.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;

bool is_full() { return std::getenv("POLHODE_TEST_FULL") != nullptr; }

// Of 3 to 34 turns in the night: from below f_psi of most to above 2 f_phi of all.
std::vector<ScanMinimum> minima_of(const DrawnTumbler& t) {
  const std::vector<LightCurve> curves{t.curve};
  const ScanPoints points(curves);
  const auto grid =
      FrequencyGrid::between(3.0 / t.time_base, 34.0 / t.time_base, scan_advice(curves, 2).step);
  const Landscape landscape = scan_pairs(points, grid, grid, {.order = 2, .threads = 2});
  return scan_minima(points, landscape, {.most = 20, .threads = 2});
}

struct Found {
  // whether the true periods are among the labels of the best pairs
  bool has_label = false, is_reported = false, is_first = false;
  double distance = 1e300;  // Mahalanobis' squared, of the truth from the nearest solution
};

Found found_of(const DrawnTumbler& t) {
  Found f;
  LightSearch search;
  search.curves = {t.curve};
  search.periods = labelled_periods(
      minima_of(t), {.pairs = 3, .labels = is_full() ? std::size_t{25} : std::size_t{12}});
  f.has_label =
      std::ranges::any_of(search.periods, [&](const TumblerPeriods& p) { return t.has(p); });
  search.starts = 8 * search.periods.size();
  search.finalists = 2;
  search.threads = 2;
  const LightSearchResult result = search_light(search);
  for (const FoundLight& s : result.solutions) {
    const BrightEllipsoid& b = s.solution.body;
    const bool is_true = t.has(s.solution.periods);
    f.is_first = f.is_first || (is_true && &s == &result.solutions.front());
    f.is_reported = f.is_reported || is_true;
    const BrightEllipsoid near = nearest_of_same(b, at_time(t.body, b.spin.t0));
    f.distance = smaller(f.distance, mahalanobis(s.solution.covariance, light_unknowns_at({}, b, b),
                                                 light_unknowns_at({}, b, near)));
  }
  return f;
}

TEST(LightCoverage, TheTruthIsAmongWhatIsReported) {
  const std::size_t count = is_full() ? 100 : 5;
  std::size_t labelled = 0, reported = 0, first = 0, within = 0;
  double distance = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const DrawnTumbler t = drawn_tumbler(k, 350, 0.02);
    const Found f = found_of(t);
    labelled += f.has_label ? 1 : 0;
    reported += f.is_reported ? 1 : 0;
    first += f.is_first ? 1 : 0;
    if (!(f.distance < budget::light_distance)) continue;
    ++within;
    distance += f.distance;
  }
  std::cout << "of " << count << ": true periods among the labels " << labelled << ", reported "
            << reported << ", ranked first " << first << ", the truth within errors " << within
            << ", sum of distances " << distance << " on " << 8 * within << '\n';
  EXPECT_GE(static_cast<double>(reported), budget::light_reported * static_cast<double>(count));
  const double above = boost::math::gamma_q(4.0 * static_cast<double>(within), 0.5 * distance);
  EXPECT_GT(above, budget::fit_improbable);
}

// The true reading is among the first twenty of the best pair.
TEST(LikelyPeriods, TheTruthStandsHigh) {
  const std::size_t count = is_full() ? 100 : 4;
  std::size_t high = 0;
  for (std::size_t k = 10; k < 10 + count; ++k) {
    const DrawnTumbler t = drawn_tumbler(k, 350, 0.02);
    for (const ScanMinimum& m : minima_of(t)) {
      if (!m.resolved || !m.refined.converged || m.at_edge) continue;
      const std::vector<LikelyPeriods> all = likely_periods(m.refined.fit);
      const auto place =
          std::ranges::find_if(all, [&](const LikelyPeriods& l) { return t.has(l.periods); });
      if (place != all.end() && place - all.begin() < 20) ++high;
      for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GE(all[i - 1].score, all[i].score);
      break;
    }
  }
  EXPECT_GE(static_cast<double>(high), budget::light_labelled * static_cast<double>(count));
}

// Amplitudes of 0 are no lines, be they among the three first.
TEST(LikelyPeriods, FindsNothingWithoutTwoLines) {
  FourierFit fit{};
  fit.f1 = 0.3;
  fit.f2 = 0.2;
  fit.terms = {{1, 0, 0.0, 0.0}, {0, 1, 0.0, 0.0}, {1, 1, 0.0, 0.0}};
  EXPECT_TRUE(likely_periods(fit).empty());
  fit.terms[1].sine = 0.4;
  EXPECT_TRUE(likely_periods(fit).empty());
  fit.terms[2].cosine = 0.1;
  const std::vector<LikelyPeriods> found = likely_periods(fit);
  ASSERT_FALSE(found.empty());
  for (const LikelyPeriods& one : found) EXPECT_LT(one.score, 0.0);
}

}  // namespace
