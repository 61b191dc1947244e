// SPDX-License-Identifier: MIT
// Tumblers drawn at random, from a cold start: is the true reading of the periods high in the list
// of labels, and the truth among what is reported, within its errors?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "drawn_seeds.hpp"
#include "fit/detail/distinct_solutions.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;

// Of 3 to 34 turns in the night: from below f_psi of most to above 2 f_phi of all.
std::vector<fit::ScanMinimum> minima_of(const DrawnTumbler& t) {
  const std::vector<light::LightCurve> curves{t.curve};
  const fit::ScanPoints points(curves);
  const auto grid = fit::FrequencyGrid::between(3.0 / t.time_base, 34.0 / t.time_base,
                                                fit::scan_advice(curves, 2).step);
  const fit::Landscape landscape = fit::scan_pairs(points, grid, grid, {.order = 2, .threads = 2});
  return fit::scan_minima(points, landscape, {.most = 20, .threads = 2});
}

// Whether the true reading is among the first twenty of the best pair.
bool is_high(const DrawnTumbler& t, const std::vector<fit::ScanMinimum>& minima) {
  const auto best = std::ranges::find_if(minima, [](const fit::ScanMinimum& m) {
    return m.resolved && m.refined.converged && !m.at_edge;
  });
  if (best == minima.end()) return false;
  const std::vector<fit::LikelyPeriods> all = fit::likely_periods(best->refined.fit);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GE(all[i - 1].score, all[i].score);
  const auto place =
      std::ranges::find_if(all, [&](const fit::LikelyPeriods& l) { return t.has(l.periods); });
  return place != all.end() && place - all.begin() < 20;
}

fit::LightSearch search_of(const DrawnTumbler& t, const std::vector<fit::ScanMinimum>& minima,
                           std::size_t labels) {
  fit::LightSearch search;
  search.curves = {t.curve};
  search.periods = fit::labelled_periods(minima, {.pairs = 3, .labels = labels});
  search.starts = 8 * search.periods.size();
  search.finalists = 2;
  search.threads = 2;
  return search;
}

struct Found {
  // whether the true periods are among the labels of the best pairs, and high among those of the
  // best one
  bool has_label = false, is_high = false, is_reported = false, is_first = false;
  double distance = 1e300;  // Mahalanobis' squared, of the truth from the nearest solution
  double rise = 0.0;        // of chi-square, from there to the truth
};

Found found_of(const DrawnTumbler& t) {
  Found f;
  const std::vector<fit::ScanMinimum> minima = minima_of(t);
  f.is_high = is_high(t, minima);
  const fit::LightSearch search = search_of(t, minima, is_full() ? 25 : 12);
  f.has_label =
      std::ranges::any_of(search.periods, [&](const fit::TumblerPeriods& p) { return t.has(p); });
  const fit::LightSearchResult result = fit::search_light(search);
  for (const fit::FoundLight& s : result.solutions) {
    const fit::LightModel& b = s.solution.body;
    const bool is_true = t.has(s.solution.periods);
    f.is_first = f.is_first || (is_true && &s == &result.solutions.front());
    f.is_reported = f.is_reported || is_true;
    const fit::LightModel near = fit::nearest_of_same(b, at_time(t.body, b.spin.t0));
    const double distance =
        fit::mahalanobis(s.solution.covariance, fit::light_unknowns_at({}, b, b),
                         fit::light_unknowns_at({}, b, near));
    if (std::isnan(f.distance) || distance > f.distance) continue;
    f.distance = distance;
    f.rise = chi_square(near, {&t.curve, 1}) - s.solution.result.cost;
  }
  return f;
}

TEST(LightCoverage, TheTruthIsAmongWhatIsReported) {
  const std::size_t count = is_full() ? 100 : 5, points = is_full() ? 350 : 140;
  for (const std::uint64_t seed : drawn_seeds()) {
    std::size_t labelled = 0, high = 0, reported = 0, first = 0, within = 0;
    PooledDistance distance, rise;  // rises are so distributed even where residuals bend
    for (std::size_t k = 0; k < count; ++k) {
      const DrawnTumbler t = drawn_tumbler(k, points, 0.02, seed);
      const Found f = found_of(t);
      labelled += f.has_label ? 1 : 0;
      high += f.is_high ? 1 : 0;
      reported += f.is_reported ? 1 : 0;
      first += f.is_first ? 1 : 0;
      const bool is_found = f.distance < budget::light_missed;
      if (is_found) distance.add(f.distance);
      if (is_found) rise.add(f.rise);
      within += is_found ? 1 : 0;
      if (!is_found)
        std::cout << "seed " << seed << ", tumbler " << k << ": label " << f.has_label
                  << ", reported " << f.is_reported << ", distance " << f.distance << std::endl;
    }
    std::cout << "seed " << seed << ", of " << count << ": true periods among the labels "
              << labelled << ", high " << high << ", reported " << reported << ", ranked first "
              << first << ", the truth among the solutions " << within << ", sum of distances "
              << distance.text() << ", of rises " << rise.text() << std::endl;
    const auto all = static_cast<double>(count);
    EXPECT_GE(static_cast<double>(reported), budget::light_reported * all);
    EXPECT_GE(static_cast<double>(within), budget::light_within * all);
    EXPECT_GE(static_cast<double>(high), budget::light_labelled * all);
    distance.expect_probable();
    rise.expect_probable();
  }
}

// A search with ten times the starts finds no solution that the first one missed.
TEST(LightCoverage, TenTimesTheStartsFindNoMore) {
  const std::size_t count = is_full() ? 6 : 1;
  for (const std::uint64_t seed : drawn_seeds()) {
    for (std::size_t k = 0; k < count; ++k) {
      const DrawnTumbler t = drawn_tumbler(20 + k, is_full() ? 350 : 120, 0.02, seed);
      fit::LightSearch search = search_of(t, minima_of(t), is_full() ? 25 : 3);
      const fit::LightSearchResult few = fit::search_light(search);
      search.starts *= 10;
      search.seed = 1;  // none of the starts of the first
      const fit::LightSearchResult many = fit::search_light(search);
      std::size_t missed = 0;
      for (const fit::FoundLight& m : many.solutions) {
        const bool is_known = std::ranges::any_of(few.solutions, [&](const fit::FoundLight& f) {
          return fit::detail::are_same(m, f, search.unknowns, t.time_base);
        });
        if (is_known) continue;
        ++missed;
        ADD_FAILURE() << "seed " << seed << ", tumbler " << k << ": " << m.sentence
                      << ", chi-square over the least "
                      << m.solution.result.cost / many.solutions.front().solution.result.cost;
      }
      std::cout << "seed " << seed << ", tumbler " << k << ": " << search.starts / 10
                << " starts find " << few.solutions.size() << " solutions, " << search.starts
                << " find " << many.solutions.size() << ", missed " << missed << std::endl;
      EXPECT_FALSE(few.solutions.empty());
    }
  }
}

// Amplitudes of 0 are no lines, be they among the three first.
TEST(LikelyPeriods, FindsNothingWithoutTwoLines) {
  fit::FourierFit fit{};
  fit.f1 = 0.3;
  fit.f2 = 0.2;
  fit.terms = {{1, 0, 0.0, 0.0}, {0, 1, 0.0, 0.0}, {1, 1, 0.0, 0.0}};
  EXPECT_TRUE(fit::likely_periods(fit).empty());
  fit.terms[1].sine = 0.4;
  EXPECT_TRUE(fit::likely_periods(fit).empty());
  fit.terms[2].cosine = 0.1;
  const std::vector<fit::LikelyPeriods> found = fit::likely_periods(fit);
  ASSERT_FALSE(found.empty());
  for (const fit::LikelyPeriods& one : found) EXPECT_LT(one.score, 0.0);
}

}  // namespace
