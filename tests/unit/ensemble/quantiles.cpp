// SPDX-License-Identifier: MIT
// Quantiles: exact while few, between their bounds beyond, the same in any order; those of known
// distributions and the coverage of intervals, pooled over seeds.
#include "polhode/ensemble/quantiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> parts{0.0, 0.001, 0.05, 0.25, 0.5, 0.9, 0.99, 0.9999, 1.0};

Quantiles quantiles(const Bins& bins, std::int64_t exact, const std::vector<double>& all) {
  Quantiles found(bins, exact);
  for (std::size_t i = 0; i < all.size(); ++i) found.add(static_cast<std::int64_t>(i), all[i]);
  return found;
}
// By its definition.
double exact_quantile(std::vector<double> all, double p) {
  std::sort(all.begin(), all.end());
  const double h = static_cast<double>(all.size() - 1) * p;
  const auto k = static_cast<std::size_t>(h);
  const double f = h - static_cast<double>(k);
  return f == 0.0 ? all[k] : all[k] * (1.0 - f) + all[k + 1] * f;
}
std::vector<double> normals(std::uint64_t seed, int count) {
  oracle::Draw draw(3911, seed);
  std::vector<double> all;
  for (int k = 0; k < count; ++k) all.push_back(draw.normal());
  return all;
}

// As of numpy.quantile([3, 1, 4, 1, 5, 9, 2, 6], p), by hand.
TEST(Quantiles, OfAFewNumbersAreExact) {
  const Quantiles found = quantiles(Bins::linear(0.0, 10.0, 2), 8, {3, 1, 4, 1, 5, 9, 2, 6});
  ASSERT_TRUE(found.is_exact());
  const auto value = [&](double p) {
    const Bounded q = found.quantile(p);
    EXPECT_EQ(q.lowest, q.value);
    EXPECT_EQ(q.highest, q.value);
    return q.value;
  };
  EXPECT_EQ(value(0.0), 1.0);
  EXPECT_EQ(value(0.25), 1.75);
  EXPECT_EQ(value(0.5), 3.5);
  EXPECT_EQ(value(0.75), 5.25);
  EXPECT_EQ(value(1.0), 9.0);
  EXPECT_EQ(found.ranked(6).value, 6.0);
  EXPECT_EQ(found.part_up_to(4.0).value, 0.625);
  EXPECT_EQ(found.part_up_to(0.9).value, 0.0);
  EXPECT_EQ(found.part_up_to(9.0).value, 1.0);
}

TEST(Quantiles, FromBinsLieBetweenTheirBoundsAndWithinHalfABin) {
  const std::vector<double> all = normals(1, 20'000);
  const Quantiles found = quantiles(Bins::linear(-3.0, 3.5, 130), 100, all);
  constexpr double width = 0.05;
  ASSERT_FALSE(found.is_exact());
  for (const double p : parts) {
    const double exact = exact_quantile(all, p);
    const Bounded q = found.quantile(p);
    EXPECT_LE(q.lowest, exact) << p;
    EXPECT_GE(q.highest, exact) << p;
    EXPECT_LE(q.lowest, q.value) << p;
    EXPECT_GE(q.highest, q.value) << p;
    if (p > 0.002 && p < 0.999) {
      EXPECT_LE(std::abs(q.value - exact), 0.5 * width + budget::bin_rounding) << p;
      EXPECT_LE(q.highest - q.lowest, width + budget::bin_rounding) << p;
    }
  }
  EXPECT_EQ(found.quantile(0.0).highest, exact_quantile(all, 0.0));
  EXPECT_EQ(found.quantile(1.0).lowest, exact_quantile(all, 1.0));
  for (const double x : {-9.0, -3.2, -1.0, 0.013, 2.0, 3.6, 9.0}) {
    const auto up_to = std::count_if(all.begin(), all.end(), [&](double v) { return v <= x; });
    const double part = static_cast<double>(up_to) / static_cast<double>(all.size());
    const Bounded f = found.part_up_to(x);
    EXPECT_LE(f.lowest, part) << x;
    EXPECT_GE(f.highest, part) << x;
    EXPECT_LE(std::abs(f.value - part), 0.5 * (f.highest - f.lowest) + budget::bin_rounding) << x;
  }
}

TEST(Quantiles, FromLogarithmicBinsHaveTheirRelativeError) {
  std::vector<double> all;
  oracle::Draw draw(3912, 0);
  for (int k = 0; k < 30'000; ++k) all.push_back(draw.sign() * draw.power_of_ten(-9.0, 6.0));
  constexpr double error = 0.01;
  const Quantiles found = quantiles(Bins::signed_logarithmic(error, 1e-8, 1e5), 0, all);
  EXPECT_LT(found.bins().count(), 3100u);
  for (double p = 0.0; p <= 1.0; p += 0.01) {
    const double exact = exact_quantile(all, p);
    const Bounded q = found.quantile(p);
    EXPECT_LE(q.lowest, exact) << p;
    EXPECT_GE(q.highest, exact) << p;
    if (std::abs(exact) > 1.1e-8 && std::abs(exact) < 0.9e5) {
      EXPECT_LE(std::abs(q.value - exact), (error + budget::bin_rounding) * std::abs(exact)) << p;
    }
  }
}

TEST(Quantiles, AreTheSameInAnyOrderAndChunks) {
  std::vector<double> all = normals(2, 5000);
  const Bins bins = Bins::linear(-4.0, 4.0, 50);
  for (const std::int64_t exact : {0, 37, 4999, 5000, 9000}) {
    const Quantiles straight = quantiles(bins, exact, all);
    EXPECT_EQ(straight.is_exact(), exact >= 5000);
    for (const std::size_t chunk : {1u, 36u, 37u, 38u, 1250u}) {
      Quantiles total(bins, exact);
      for (std::size_t begin = 0; begin < all.size(); begin += chunk) {
        Quantiles part(bins, exact);
        for (std::size_t i = begin; i < all.size() && i < begin + chunk; ++i)
          part.add(static_cast<std::int64_t>(i), all[i]);
        total.merge(part);
      }
      EXPECT_EQ(total.numbers(), straight.numbers()) << exact << ", chunks of " << chunk;
    }
  }
  std::vector<double> turned(all.rbegin(), all.rend());
  EXPECT_EQ(quantiles(bins, 100, turned).numbers(), quantiles(bins, 100, all).numbers());
  EXPECT_EQ(quantiles(bins, 9000, turned).quantile(0.3).value,
            quantiles(bins, 9000, all).quantile(0.3).value);
}

// F(quantile of n draws) has mean p and variance p (1 - p)/n: the squares of its deviations, pooled
// over seeds and parts far enough apart, against chi^2.
TEST(Quantiles, OfANormalDistributionArePooledOverSeeds) {
  constexpr int seeds = 300, n = 2000;
  const Bins fine = Bins::linear(-6.0, 6.0, 6000);
  for (const double p : {0.1, 0.5, 0.95}) {
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const Quantiles found = quantiles(fine, 100, normals(100 + seed, n));
      const double part = boost::math::cdf(boost::math::normal(), found.quantile(p).value);
      sum += (part - p) * (part - p) * n / (p * (1.0 - p));
    }
    const double chance = boost::math::cdf(boost::math::chi_squared(seeds), sum);
    EXPECT_GT(chance, budget::least_chance) << p << ": " << sum;
    EXPECT_LT(chance, 1.0 - budget::least_chance) << p << ": " << sum;
  }
}

// How often an interval holds the quantile of the distribution, against the binomial chance of it.
TEST(Quantiles, IntervalsCoverAsOftenAsTheySay) {
  constexpr int seeds = 1500, n = 200;
  constexpr double z = 1.6448536269514722;  // 90 %
  for (const double p : {0.1, 0.5, 0.8}) {
    const double true_quantile = boost::math::quantile(boost::math::normal(), p);
    int covered = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const Quantiles found = quantiles(Bins::linear(-4.0, 4.0, 10), n, normals(9000 + seed, n));
      const Bounds within = found.interval(p, z);
      covered += within.lowest <= true_quantile && true_quantile <= within.highest ? 1 : 0;
    }
    const double reach = z * std::sqrt(n * p * (1.0 - p));
    const boost::math::binomial below(n, p);
    const double chance = boost::math::cdf(below, std::ceil(n * p + reach)) -
                          boost::math::cdf(below, std::floor(n * p - reach) - 1.0);
    EXPECT_GE(chance, 0.9);
    const boost::math::binomial hits(seeds, chance);
    EXPECT_GT(boost::math::cdf(hits, covered), budget::least_chance) << p << ": " << covered;
    EXPECT_LT(boost::math::cdf(hits, covered - 1), 1.0 - budget::least_chance)
        << p << ": " << covered;
  }
  const Quantiles few = quantiles(Bins::linear(0.0, 1.0, 2), 100, {1.0, 2.0, 3.0});
  EXPECT_EQ(few.interval(0.5, 1.96).lowest, -infinity);
  EXPECT_EQ(few.interval(0.5, 1.96).highest, infinity);
}

TEST(Quantiles, LeaveOutAndNameWhatIsNotFinite) {
  const Quantiles found =
      quantiles(Bins::linear(0.0, 1.0, 4), 1, {0.1, nan, infinity, 0.7, -infinity});
  EXPECT_EQ(found.count(), 2);
  EXPECT_EQ(found.left_out().count(), 3);
  EXPECT_EQ(found.left_out().first()[2], 4);
  const Quantiles none(Bins::linear(0.0, 1.0, 4), 10);
  EXPECT_TRUE(std::isnan(none.quantile(0.5).value));
  EXPECT_TRUE(std::isnan(none.part_up_to(0.5).value));
  EXPECT_EQ(none.interval(0.5, 1.0).highest, infinity);
}

TEST(Quantiles, SayWhatTheyRefuse) {
  const Bins bins = Bins::linear(0.0, 1.0, 4);
  EXPECT_MESSAGE(Quantiles(bins, -1),
                 "Quantiles: got -1 numbers to be exact with; expected 0 to 2^31");
  Quantiles some(bins, 10);
  EXPECT_MESSAGE(some.quantile(1.5), "Quantiles::quantile: got p = 1.5; expected 0 to 1");
  EXPECT_MESSAGE(
      some.interval(0.5, nan),
      "Quantiles::interval: got z = nan; expected a finite number of deviations, 0 or more");
  EXPECT_MESSAGE(some.ranked(0), "Quantiles::ranked: got rank 0 of 0 numbers; expected 0 to -1");
  EXPECT_MESSAGE(some.merge(Quantiles(bins, 11)),
                 "Quantiles::merge: got other bins, or other than 10 numbers to be exact with "
                 "(11); expected the same");
  EXPECT_NE(message_of([&] { some.merge(Quantiles(Bins::linear(0.0, 1.0, 5), 10)); }), "");
}

}  // namespace
