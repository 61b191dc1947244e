// SPDX-License-Identifier: MIT
// Nights that join one by one: the truth of bodies that are drawn by hand, other counts of turns,
// gaps that are too long, and bad input.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/fit/light_search.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

// A night of six turns of precession that begins at `begin`.
light::LightCurve night_from(const fit::LightModel& b, double begin, std::uint64_t seed) {
  fit::LightModel later = at_time(b, begin);
  later.spin.t0 = 0.0;
  light::LightCurve curve = night(later, 6.0, 60, 0.02, seed);
  for (light::LightPoint& p : curve.points) p.t += begin;
  return curve;
}

double precession_period(const fit::LightModel& b) {
  return 2.0 * pi<double>() / motion_of(b).precession_rate_long();
}

// Nights that begin so many turns of precession after t = 0.
fit::LightExtension nights(const fit::LightModel& b, const std::vector<double>& begins) {
  fit::LightExtension e;
  for (std::size_t k = 0; k < begins.size(); ++k)
    e.curves.push_back(night_from(b, begins[k] * precession_period(b), k));
  e.starts = {b};
  e.threads = 2;
  return e;
}

class NightsOf : public testing::TestWithParam<const fit::LightModel*> {};

TEST_P(NightsOf, JoinToTheTruth) {
  const fit::LightModel& truth = *GetParam();
  fit::LightExtension e = nights(truth, {1000.0, 0.0, 100.0});  // not in the order of time
  e.first = 1;
  const fit::LightExtensionResult r = fit::extend_light(e);
  ASSERT_TRUE(r.failure.empty()) << r.failure;
  ASSERT_EQ(r.joined.size(), 3U);
  EXPECT_EQ(r.joined[0].session, 1U);
  EXPECT_EQ(r.joined[1].session, 2U);
  EXPECT_EQ(r.joined[2].session, 0U);
  EXPECT_EQ(r.joined[0].distance, 0.0);
  EXPECT_NEAR(r.joined[1].distance, 100.0 * precession_period(truth), 0.05 * r.joined[1].distance);
  EXPECT_GT(r.joined[1].counts, 5U);
  EXPECT_EQ(r.joined[2].solutions, r.solutions.size());
  EXPECT_EQ(r.joined[2].cost, r.solutions.front().solution.result.cost);
  const double base = 1006.0 * precession_period(truth);
  const auto true_one = std::ranges::find_if(r.solutions, [&](const fit::FoundLight& f) {
    const fit::TumblerPeriods& p = f.solution.periods;
    const auto turns = [&](double period, double other) {
      return std::abs(1.0 / period - 1.0 / other) * base;
    };
    return turns(p.precession_period, precession_period(truth)) < 0.25 &&
           turns(p.rotation_period, motion_of(truth).polhode_period()) < 0.25;
  });
  ASSERT_NE(true_one, r.solutions.end());
  const fit::LightSolution& found = true_one->solution;
  EXPECT_EQ(found.factors.size(), 3U);
  // not Mahalanobis' distance: over a thousand turns residuals bend within the errors
  const double rise = chi_square(truth, e.curves) - found.result.cost;
  EXPECT_GT(rise, 0.0);
  EXPECT_LT(rise, budget::light_distance);
  EXPECT_LT(found.result.cost, budget::light_noise * found.degrees_of_freedom);
}

// A fit of both nights from the solution of the first comes to another count of turns, of which
// there are dozens.
TEST_P(NightsOf, HaveMoreCountsOfTurnsThanOneFitComesTo) {
  const fit::LightExtension e = nights(*GetParam(), {0.0, 300.0});
  const fit::LightExtensionResult r = fit::extend_light(e);
  ASSERT_FALSE(r.solutions.empty()) << r.failure;
  EXPECT_GT(r.joined.back().counts, 20U);
  const fit::LightSolution one = fit::fit_light({{e.curves[0]}, *GetParam(), {}, {}});
  const fit::LightSolution both = fit::fit_light({e.curves, one.body, {}, {}});
  EXPECT_GT(both.result.cost, budget::light_misfit * r.solutions.front().solution.result.cost);
}

INSTANTIATE_TEST_SUITE_P(Modes, NightsOf, testing::Values(&in_long_axis_mode, &in_short_axis_mode));

TEST(LightExtension, HasTheBitsOfOneThreadWithMore) {
  fit::LightExtension e = nights(in_long_axis_mode, {0.0, 20.0});
  const fit::LightExtensionResult two = fit::extend_light(e);
  e.threads = 1;
  const fit::LightExtensionResult one = fit::extend_light(e);
  ASSERT_FALSE(one.solutions.empty());
  ASSERT_GT(one.joined.back().counts, 1U);
  ASSERT_EQ(one.solutions.size(), two.solutions.size());
  for (std::size_t k = 0; k < one.solutions.size(); ++k)
    EXPECT_EQ(one.solutions[k].solution.result.x, two.solutions[k].solution.result.x);
  EXPECT_EQ(one.joined.back().counts, two.joined.back().counts);
}

// A turn about the one line of sight changes nothing that is seen, and no period: the two are
// known.
TEST(LightExtension, CountsTurnsWhereTheLineOfSightIsTheSuns) {
  fit::LightExtension e = nights(in_long_axis_mode, {0.0, 100.0});
  for (light::LightCurve& curve : e.curves) {
    const FreeRotation motion = motion_of(in_long_axis_mode);
    for (light::LightPoint& p : curve.points) {
      p.to_observer = p.to_sun;
      const Vec3 seen = rotate(conj(motion.at(p.t).q), p.to_sun);
      p.flux = light::lommel_seeliger_brightness(in_long_axis_mode.ellipsoid(), seen, seen);
      p.sigma = 0.02 * p.flux;
    }
  }
  const fit::LightExtensionResult r = fit::extend_light(e);
  ASSERT_TRUE(r.failure.empty()) << r.failure;
  EXPECT_GT(r.joined.back().counts, r.joined.front().solutions);
  EXPECT_TRUE(r.notes.empty()) << r.notes.front();
}

TEST(LightExtension, TakesUnknownMomentsALawAndALoss) {
  fit::LightExtension e = nights(in_long_axis_mode, {0.0, 100.0});
  e.unknowns = {.shape = true, .moments = fit::MomentSource::fit, .multiple = true};
  e.loss = {fit::Loss::Kind::huber, 2.0};
  for (light::LightCurve& curve : e.curves) curve.is_calibrated = true;  // one factor
  const fit::LightExtensionResult r = fit::extend_light(e);
  ASSERT_FALSE(r.solutions.empty()) << r.failure;
  const fit::LightSolution& s = r.solutions.front().solution;
  EXPECT_EQ(s.factors[0], s.factors[1]);
  EXPECT_LT(s.result.cost, budget::light_noise * s.degrees_of_freedom);
}

// One night in two tables: as if in one, with few counts of turns.
TEST(LightExtension, JoinsSessionsAtTheSameTime) {
  fit::LightExtension e = nights(in_short_axis_mode, {0.0});
  light::LightCurve other = e.curves[0];
  for (std::size_t i = 0; i < other.points.size(); ++i) other.points[i].flux *= 2.0;
  for (light::LightPoint& p : other.points) p.sigma *= 2.0;
  e.curves.push_back(other);
  const fit::LightExtensionResult r = fit::extend_light(e);
  ASSERT_FALSE(r.solutions.empty()) << r.failure;
  EXPECT_EQ(r.joined.back().counts, 1U);
  EXPECT_EQ(r.joined.back().distance, 0.0);
}

TEST(LightExtension, SaysWhatIsTooFar) {
  fit::LightExtension e = nights(in_long_axis_mode, {0.0, 3000.0});
  e.most_counts = 50;
  const fit::LightExtensionResult r = fit::extend_light(e);
  EXPECT_TRUE(r.solutions.empty());
  EXPECT_EQ(r.joined.size(), 1U);
  EXPECT_EQ(r.failure,
            "session 2 is too far from those before it: the errors of the periods leave more than "
            "50 counts of turns; add a session between them");
  e.most_iterations = 1;
  e.starts.front().spin.w_F = 1.3 * e.starts.front().spin.w_F;
  EXPECT_THAT(fit::extend_light(e).failure, HasSubstr("none of 1 fit of session 1 converged"));
}

TEST(LightExtension, RefusesWhatMakesNoSense) {
  const fit::LightExtension good = nights(in_long_axis_mode, {0.0, 20.0});
  const auto said = [&](const auto& change) {
    fit::LightExtension bad = good;
    change(bad);
    return message_of([&] { fit::extend_light(bad); });
  };
  EXPECT_THAT(said([](auto& e) { e.starts.clear(); }), HasSubstr("no starts"));
  EXPECT_THAT(said([](auto& e) {
                e.starts.push_back(e.starts.front());
                e.starts.back().shape = fit::ConvexShape::of({1.0, 0.8, 0.6}, 2, 3);
              }),
              HasSubstr("starts of several shapes"));
  EXPECT_THAT(said([](auto& e) { e.first = 2; }),
              HasSubstr("first = 2 must be below 2, the number of sessions"));
  EXPECT_THAT(said([](auto& e) { e.within = 0.5; }), HasSubstr("within = 0.5 must be 1 or more"));
  EXPECT_THAT(said([](auto& e) { e.threads = 0; }), HasSubstr("threads = 0 must be 1 or more"));
  EXPECT_THAT(said([](auto& e) { e.most_counts = 0; }), HasSubstr("most_counts = 0"));
  EXPECT_THAT(said([](auto& e) { e.curves[1].points[3].sigma = 0.0; }),
              HasSubstr("light curve 2 (night): point 4: error 0"));
}

}  // namespace
