// SPDX-License-Identifier: MIT
// Fractions in classes and regimes, and first events: closed forms, intervals, bounds.
#include "polhode/ensemble/fractions.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/ensemble/first_events.hpp"
#include "polhode/math/trigonometry.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;

// Momenta in all directions: short-axis modes are those with |z| > |x| tan c, tan^2 c =
// I3 (I2 - I1)/(I1 (I3 - I2)): a part 1 - 2 c/pi of the sphere.
TEST(Fractions, OfRegimesAreThoseOfTheSphere) {
  const Body body(1.0, 1.7, 2.1);
  constexpr int n = 3000;
  oracle::Draw draw(3916, 0);
  Fractions found = Fractions::of_regimes();
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
  const Bounds within = found.interval(static_cast<int>(Regime::short_axis), 3.3);
  EXPECT_LT(within.lowest, expected);
  EXPECT_GT(within.highest, expected);
}

// Wilson's interval solves |p - k/n| = z sqrt(p (1 - p)/n).
TEST(Fractions, IntervalsAreWilsons) {
  for (const int k : {0, 1, 7, 19, 20}) {
    Fractions yes(2);
    for (int m = 0; m < 20; ++m) yes.add(m, m < k ? 1 : 0);
    const double part = yes.fraction(1), z = 1.96;
    const Bounds within = yes.interval(1, z);
    for (const double p : {within.lowest, within.highest})
      if (p > 0.0 && p < 1.0) {
        EXPECT_NEAR(std::abs(p - part), z * std::sqrt(p * (1.0 - p) / 20.0),
                    budget::attitude_values);
      }
    EXPECT_EQ(within.lowest == 0.0, k == 0);
    EXPECT_EQ(within.highest == 1.0, k == 20);
  }
  EXPECT_TRUE(std::isnan(Fractions(3).fraction(0)));
  EXPECT_TRUE(std::isnan(Fractions(3).interval(0, 1.0).highest));
}

TEST(Fractions, SayWhatTheyRefuse) {
  Fractions two(2);
  two.leave_out(9);
  EXPECT_EQ(two.left_out().first()[0], 9);
  EXPECT_MESSAGE(two.add(4, 2), "Fractions::add: got class 2 of member 4; expected 0 to 1");
  EXPECT_MESSAGE(two.fraction(-1), "Fractions::fraction: got class -1; expected 0 to 1");
  EXPECT_MESSAGE(Fractions(0), "Fractions: got 0 classes; expected 1 to 1000000");
  EXPECT_MESSAGE(two.merge(Fractions(3)), "Fractions::merge: got 3 classes; expected 2");
  EXPECT_NE(message_of([&] { (void)two.interval(0, -1.0); }), "");
}

TEST(FirstEvents, OfFewAreByHand) {
  FirstEvents found(Bins::linear(0.0, 10.0, 5), 100);
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
  const FirstEvents none(Bins::linear(0.0, 1.0, 1), 0);
  EXPECT_TRUE(std::isnan(none.survival(0.0).value));
  EXPECT_FALSE(none.time_of(0.5));
}

// Times of rate 1, seen up to t = 2: survival exp(-t), within its bounds and chance.
TEST(FirstEvents, OfARateSurviveExponentially) {
  constexpr int n = 20'000;
  oracle::Draw draw(3917, 0);
  FirstEvents found(Bins::linear(0.0, 2.0, 200), 50);
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
    const Bounded s = found.survival(t);
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
