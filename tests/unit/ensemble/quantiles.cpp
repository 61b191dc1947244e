// SPDX-License-Identifier: MIT
// Quantiles: exact while few, between their bounds beyond, the same in any order; those of known
// distributions and the coverage of intervals, pooled over seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "ensemble/first_events.hpp"
#include "ensemble/fractions.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/ensemble/bins.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> parts{0.0, 0.001, 0.05, 0.25, 0.5, 0.9, 0.99, 0.9999, 1.0};

ensemble::Quantiles quantiles(const ensemble::Bins& bins, std::int64_t exact,
                              const std::vector<double>& all) {
  ensemble::Quantiles found(bins, exact);
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
  const ensemble::Quantiles found =
      quantiles(ensemble::Bins::linear(0.0, 10.0, 2), 8, {3, 1, 4, 1, 5, 9, 2, 6});
  ASSERT_TRUE(found.is_exact());
  const auto value = [&](double p) {
    const ensemble::Bounded q = found.quantile(p);
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
  const ensemble::Quantiles found = quantiles(ensemble::Bins::linear(-3.0, 3.5, 130), 100, all);
  constexpr double width = 0.05;
  ASSERT_FALSE(found.is_exact());
  for (const double p : parts) {
    const double exact = exact_quantile(all, p);
    const ensemble::Bounded q = found.quantile(p);
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
    const ensemble::Bounded f = found.part_up_to(x);
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
  const ensemble::Quantiles found =
      quantiles(ensemble::Bins::signed_logarithmic(error, 1e-8, 1e5), 0, all);
  EXPECT_LT(found.bins().count(), 3100u);
  for (double p = 0.0; p <= 1.0; p += 0.01) {
    const double exact = exact_quantile(all, p);
    const ensemble::Bounded q = found.quantile(p);
    EXPECT_LE(q.lowest, exact) << p;
    EXPECT_GE(q.highest, exact) << p;
    if (std::abs(exact) > 1.1e-8 && std::abs(exact) < 0.9e5) {
      EXPECT_LE(std::abs(q.value - exact), (error + budget::bin_rounding) * std::abs(exact)) << p;
    }
  }
}

TEST(Quantiles, AreTheSameInAnyOrderAndChunks) {
  std::vector<double> all = normals(2, 5000);
  const ensemble::Bins bins = ensemble::Bins::linear(-4.0, 4.0, 50);
  for (const std::int64_t exact : {0, 37, 4999, 5000, 9000}) {
    const ensemble::Quantiles straight = quantiles(bins, exact, all);
    EXPECT_EQ(straight.is_exact(), exact >= 5000);
    for (const std::size_t chunk : {1u, 36u, 37u, 38u, 1250u}) {
      ensemble::Quantiles total(bins, exact);
      for (std::size_t begin = 0; begin < all.size(); begin += chunk) {
        ensemble::Quantiles part(bins, exact);
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
  const ensemble::Bins fine = ensemble::Bins::linear(-6.0, 6.0, 6000);
  for (const double p : {0.1, 0.5, 0.95}) {
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const ensemble::Quantiles found = quantiles(fine, 100, normals(100 + seed, n));
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
      const ensemble::Quantiles found =
          quantiles(ensemble::Bins::linear(-4.0, 4.0, 10), n, normals(9000 + seed, n));
      const ensemble::Bounds within = found.interval(p, z);
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
  const ensemble::Quantiles few =
      quantiles(ensemble::Bins::linear(0.0, 1.0, 2), 100, {1.0, 2.0, 3.0});
  EXPECT_EQ(few.interval(0.5, 1.96).lowest, -infinity);
  EXPECT_EQ(few.interval(0.5, 1.96).highest, infinity);
}

TEST(Quantiles, LeaveOutAndNameWhatIsNotFinite) {
  const ensemble::Quantiles found =
      quantiles(ensemble::Bins::linear(0.0, 1.0, 4), 1, {0.1, nan, infinity, 0.7, -infinity});
  EXPECT_EQ(found.count(), 2);
  EXPECT_EQ(found.left_out().count(), 3);
  EXPECT_EQ(found.left_out().first()[2], 4);
  const ensemble::Quantiles none(ensemble::Bins::linear(0.0, 1.0, 4), 10);
  EXPECT_TRUE(std::isnan(none.quantile(0.5).value));
  EXPECT_TRUE(std::isnan(none.part_up_to(0.5).value));
  EXPECT_EQ(none.interval(0.5, 1.0).highest, infinity);
}

TEST(Quantiles, SayWhatTheyRefuse) {
  const ensemble::Bins bins = ensemble::Bins::linear(0.0, 1.0, 4);
  EXPECT_MESSAGE(ensemble::Quantiles(bins, -1),
                 "Quantiles: got -1 numbers to be exact with; expected 0 to 2^31");
  ensemble::Quantiles some(bins, 10);
  EXPECT_MESSAGE(some.quantile(1.5), "Quantiles::quantile: got p = 1.5; expected 0 to 1");
  EXPECT_MESSAGE(
      some.interval(0.5, nan),
      "Quantiles::interval: got z = nan; expected a finite number of deviations, 0 or more");
  EXPECT_MESSAGE(some.ranked(0), "Quantiles::ranked: got rank 0 of 0 numbers; expected 0 to -1");
  EXPECT_MESSAGE(some.merge(ensemble::Quantiles(bins, 11)),
                 "Quantiles::merge: got other bins, or other than 10 numbers to be exact with "
                 "(11); expected the same");
  EXPECT_NE(
      message_of([&] { some.merge(ensemble::Quantiles(ensemble::Bins::linear(0.0, 1.0, 5), 10)); }),
      "");
}

// Fractions in classes and regimes, and first events: closed forms, intervals, bounds.

// Momenta in all directions: short-axis modes are those with |z| > |x| tan c, tan^2 c =
// I3 (I2 - I1)/(I1 (I3 - I2)): a part 1 - 2 c/pi of the sphere.
TEST(Fractions, OfRegimesAreThoseOfTheSphere) {
  const Body body(1.0, 1.7, 2.1);
  constexpr int n = 3000;
  oracle::Draw draw(3916, 0);
  ensemble::Fractions found = ensemble::Fractions::of_regimes();
  for (int k = 0; k < n; ++k)
    found.add(k, FreeRotation::short_arc(body, {{}, {draw.normal(), draw.normal(), draw.normal()}})
                     .regime());
  const double c = std::atan(std::sqrt(2.1 * 0.7 / (1.0 * 0.4)));
  const double expected = 1.0 - 2.0 * c / pi<double>();
  const boost::math::binomial hits(n, expected);
  const auto short_axis = static_cast<double>(found.count(static_cast<int>(Regime::short_axis)));
  EXPECT_GT(boost::math::cdf(hits, short_axis), budget::least_chance);
  EXPECT_LT(boost::math::cdf(hits, short_axis), 1.0 - budget::least_chance);
  EXPECT_EQ(found.fraction(Regime::short_axis), short_axis / n);
  EXPECT_EQ(found.fraction(Regime::long_axis), (n - short_axis) / n);
  EXPECT_EQ(found.fraction(Regime::rest), 0.0);
  const ensemble::Bounds within = found.interval(static_cast<int>(Regime::short_axis), 3.3);
  EXPECT_LT(within.lowest, expected);
  EXPECT_GT(within.highest, expected);
}

// Wilson's interval solves |p - k/n| = z sqrt(p (1 - p)/n).
TEST(Fractions, IntervalsAreWilsons) {
  for (const int k : {0, 1, 7, 19, 20}) {
    ensemble::Fractions yes(2);
    for (int m = 0; m < 20; ++m) yes.add(m, m < k ? 1 : 0);
    const double part = yes.fraction(1), z = 1.96;
    const ensemble::Bounds within = yes.interval(1, z);
    for (const double p : {within.lowest, within.highest})
      if (p > 0.0 && p < 1.0) {
        EXPECT_NEAR(std::abs(p - part), z * std::sqrt(p * (1.0 - p) / 20.0),
                    budget::attitude_values);
      }
    EXPECT_EQ(within.lowest == 0.0, k == 0);
    EXPECT_EQ(within.highest == 1.0, k == 20);
  }
  EXPECT_TRUE(std::isnan(ensemble::Fractions(3).fraction(0)));
  EXPECT_TRUE(std::isnan(ensemble::Fractions(3).interval(0, 1.0).highest));
}

TEST(Fractions, SayWhatTheyRefuse) {
  ensemble::Fractions two(2);
  two.leave_out(9);
  EXPECT_EQ(two.left_out().first()[0], 9);
  EXPECT_MESSAGE(two.add(4, 2), "Fractions::add: got class 2 of member 4; expected 0 to 1");
  EXPECT_MESSAGE(two.fraction(-1), "Fractions::fraction: got class -1; expected 0 to 1");
  EXPECT_MESSAGE(ensemble::Fractions(0), "Fractions: got 0 classes; expected 1 to 1000000");
  EXPECT_MESSAGE(two.merge(ensemble::Fractions(3)), "Fractions::merge: got 3 classes; expected 2");
  EXPECT_NE(message_of([&] { (void)two.interval(0, -1.0); }), "");
}

TEST(FirstEvents, OfFewAreByHand) {
  ensemble::FirstEvents found(ensemble::Bins::linear(0.0, 10.0, 5), 100);
  for (const double t : {4.0, 1.0, 2.5}) found.add(0, t);
  for (int k = 0; k < 5; ++k) found.add_without();
  found.leave_out(77);
  EXPECT_EQ(found.count(), 8);
  EXPECT_EQ(found.without(), 5);
  EXPECT_EQ(found.left_out().first()[0], 77);
  EXPECT_EQ(found.survival(0.5).value, 1.0);
  EXPECT_EQ(found.survival(1.0).value, 0.875);
  EXPECT_EQ(found.survival(3.0).highest, 0.75);
  EXPECT_EQ(found.survival(99.0).lowest, 0.625);
  EXPECT_EQ(found.time_of(0.125)->value, 1.0);
  EXPECT_EQ(found.time_of(0.3)->value, 4.0);
  EXPECT_EQ(found.time_of(0.375)->value, 4.0);
  EXPECT_FALSE(found.time_of(0.376));
  EXPECT_MESSAGE(found.time_of(2.0), "FirstEvents::time_of: got p = 2; expected 0 to 1");
  const ensemble::FirstEvents none(ensemble::Bins::linear(0.0, 1.0, 1), 0);
  EXPECT_TRUE(std::isnan(none.survival(0.0).value));
  EXPECT_FALSE(none.time_of(0.5));
}

// Times of rate 1, seen up to t = 2: survival exp(-t), within its bounds and chance.
TEST(FirstEvents, OfARateSurviveExponentially) {
  constexpr int n = 20'000;
  oracle::Draw draw(3917, 0);
  ensemble::FirstEvents found(ensemble::Bins::linear(0.0, 2.0, 200), 50);
  std::vector<double> times;
  for (int k = 0; k < n; ++k) {
    const double t = -std::log1p(-draw.uniform(0.0, 1.0));
    times.push_back(t);
    if (t <= 2.0)
      found.add(k, t);
    else
      found.add_without();
  }
  for (const double t : {0.1, 0.5, 1.0, 1.5, 1.9}) {
    int left = 0;
    for (const double x : times) left += x > t ? 1 : 0;
    const ensemble::Bounded s = found.survival(t);
    EXPECT_LE(s.lowest, static_cast<double>(left) / n) << t;
    EXPECT_GE(s.highest, static_cast<double>(left) / n) << t;
    EXPECT_LE(s.highest - s.lowest, budget::survival_bounds) << t;
    const boost::math::binomial survivors(n, std::exp(-t));
    EXPECT_GT(boost::math::cdf(survivors, left), budget::least_chance) << t;
    EXPECT_LT(boost::math::cdf(survivors, left), 1.0 - budget::least_chance) << t;
  }
  EXPECT_NEAR(found.time_of(0.5)->value, std::log(2.0), 4.0 / std::sqrt(1.0 * n));
  EXPECT_FALSE(found.time_of(0.9));
}

}  // namespace
