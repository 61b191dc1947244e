// SPDX-License-Identifier: MIT
// Circular moments: closed forms, angles all around, and the phases of free tumblers, whose spread
// grows with the time as that of their rates says.
#include "ensemble/angle_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "ensemble/number_moments.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/free/sadov.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double turn = 6.283185307179586;

// n angles evenly, `step` apart about `middle`: R = sin(n step/2) / (n sin(step/2)).
TEST(AngleMoments, OfEvenlySpacedAnglesAreInClosedForm) {
  for (const double step : {1e-3, 0.01, 0.02}) {
    constexpr int n = 101;
    ensemble::AngleMoments found;
    const double middle = 3.0;
    for (int k = 0; k < n; ++k) found.add(k, middle + step * (k - 50));
    const double R = std::sin(0.5 * n * step) / (n * std::sin(0.5 * step));
    EXPECT_NEAR(found.resultant(), R, budget::angle_moments_eps * eps);
    ASSERT_TRUE(found.mean());
    EXPECT_NEAR(*found.mean(), middle, budget::angle_moments_eps * eps);
    EXPECT_NEAR(found.deviation(), std::sqrt(-2.0 * std::log(R)),
                budget::angle_moments_eps * eps / step);
  }
}

TEST(AngleMoments, DoNotKnowWholeTurns) {
  ensemble::AngleMoments plain, turned;
  for (int k = 0; k < 50; ++k) {
    const double a = 0.02 * k;
    plain.add(k, a);
    turned.add(k, a + turn * (k % 7 - 3));
  }
  EXPECT_NEAR(*plain.mean(), *turned.mean(), 20.0 * budget::angle_moments_eps * eps);
  EXPECT_NEAR(*plain.mean(), 0.49, budget::angle_moments_eps * eps);
}

TEST(AngleMoments, AllAroundHaveNoMean) {
  int with_mean = 0;
  constexpr int seeds = 300;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    oracle::Draw draw(3909, seed);
    ensemble::AngleMoments found;
    for (int k = 0; k < 500; ++k) found.add(k, draw.uniform(0.0, turn));
    with_mean += found.mean() ? 1 : 0;
  }
  EXPECT_LE(with_mean, 3);  // 1 in 1000 of them by chance
  EXPECT_FALSE(ensemble::AngleMoments().mean());
  // two say little: they agree, or not
  for (const double apart : {0.8, 1.6}) {
    ensemble::AngleMoments two;
    two.add(0, 1.0);
    two.add(1, 1.0 + apart);
    EXPECT_EQ(two.mean().has_value(), std::cos(0.5 * apart) >= 0.9) << apart;
  }
  ensemble::AngleMoments opposite;
  opposite.add(0, 0.3);
  opposite.add(1, 0.3 + 0.5 * turn);
  EXPECT_FALSE(opposite.mean());
  EXPECT_NEAR(opposite.resultant(), 0.0, budget::angle_moments_eps * eps);
  opposite.add(2, std::numeric_limits<double>::infinity());
  EXPECT_EQ(opposite.count(), 2);
  EXPECT_EQ(opposite.left_out().first()[0], 2);
}

// Free tumblers of one body with momenta at random: phi = phi_0 + n (t - t_0), so that
// cov(phi_l, phi_g)(t) = C_00 + t (C_01 + C_10) + t^2 C_11 of phases and rates at the start, and an
// ensemble with rates of deviation s has R = exp(-s^2 t^2 / 2) but for its size.
TEST(AngleMoments, PhasesOfFreeTumblersSpreadAsTheirRatesSay) {
  const Body body(1.0, 1.7, 2.1);
  constexpr int members = 400;
  oracle::Draw draw(3910, 0);
  // a phase as it is seen, unwrapped next to where it was predicted
  const auto unwrapped = [](double seen, double predicted) {
    return seen + turn * std::round((predicted - seen) / turn);
  };
  std::vector<FreeRotation> motions;
  std::vector<SadovState> start;
  std::vector<SadovFrequencies> rates;
  ensemble::NumberMoments at_start(4);
  for (int m = 0; m < members; ++m) {
    const RotorState s{
        {1.0, 0.05 * draw.normal(), 0.0, 0.05 * draw.normal()},
        {0.3 + 0.01 * draw.normal(), 0.02 * draw.normal(), 1.5 + 0.02 * draw.normal()}};
    motions.emplace_back(body, s);
    start.push_back(to_sadov(motions.back(), 0.0));
    start.back().phi_l = unwrapped(start.back().phi_l, start[0].phi_l);
    start.back().phi_g = unwrapped(start.back().phi_g, start[0].phi_g);
    rates.push_back(sadov_frequencies(motions.back()));
    at_start.add(
        m, std::vector{start.back().phi_l, start.back().phi_g, rates.back().n_l, rates.back().n_g});
  }
  for (const double t : {3.0, 40.0, 700.0}) {
    ensemble::NumberMoments found(2);
    ensemble::AngleMoments angles;
    for (int m = 0; m < members; ++m) {
      const auto i = static_cast<std::size_t>(m);
      const SadovState s = to_sadov(body, motions[i].at(t));
      found.add(m, std::vector{unwrapped(s.phi_l, start[i].phi_l + t * rates[i].n_l),
                               unwrapped(s.phi_g, start[i].phi_g + t * rates[i].n_g)});
      angles.add(m, s.phi_g);
    }
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const double expected =
            at_start.covariance(i, j) +
            t * (at_start.covariance(i, j + 2) + at_start.covariance(i + 2, j)) +
            t * t * at_start.covariance(i + 2, j + 2);
        const double scale = found.deviation(i) * found.deviation(j);
        EXPECT_NEAR(found.covariance(i, j), expected, budget::spreading_phases * scale)
            << t << ": " << i << ", " << j;
      }
    // chance: R of n angles is within 4/sqrt(2n) of that of a normal spread
    const double s = found.deviation(1);
    EXPECT_NEAR(angles.resultant(), std::exp(-0.5 * s * s), 4.0 / std::sqrt(2.0 * members)) << t;
    EXPECT_EQ(angles.mean().has_value(), s < 1.0) << t;
  }
}

}  // namespace
