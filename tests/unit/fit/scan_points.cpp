// SPDX-License-Identifier: MIT
// Light curves that a scan takes, and those it does not.
#include "polhode/fit/scan_points.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/scan_advice.hpp"

namespace {
using namespace polhode;
using polhode::test::message_of;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

LightCurve session(std::vector<LightPoint> points, bool is_calibrated = false) {
  return {.name = "night", .is_calibrated = is_calibrated, .points = std::move(points)};
}
auto refusal(const std::vector<LightCurve>& curves, ScanQuantity quantity = ScanQuantity::flux) {
  return message_of([&] { ScanPoints(curves, quantity); });
}

TEST(ScanPoints, RefusesWithASentence) {
  EXPECT_THAT(refusal({}), HasSubstr("there are no points"));
  EXPECT_THAT(refusal({session({})}), HasSubstr("there are no points"));
  EXPECT_THAT(refusal({session({{1.0, 1.0, 0.1, {}, {}}})}),
              HasSubstr("session \"night\" has one point"));
  EXPECT_THAT(refusal({session({{1.0, 1.0, 0.1, {}, {}}, {1.0, 2.0, 0.1, {}, {}}})}),
              HasSubstr("all points have the same time"));
  EXPECT_THAT(refusal({session({{1.0, 1.0, 0.0, {}, {}}, {2.0, 2.0, 0.1, {}, {}}})}),
              HasSubstr("point 1 of session \"night\" has sigma 0"));
  EXPECT_THAT(refusal({session({{1.0, 1.0, 0.1, {}, {}}, {nan, 2.0, 0.1, {}, {}}})}),
              HasSubstr("point 2 of session \"night\" has time nan"));
  EXPECT_THAT(refusal({session({{1.0, nan, 0.1, {}, {}}, {2.0, 2.0, 0.1, {}, {}}})}),
              HasSubstr("has flux nan"));
  EXPECT_THAT(refusal({session({{1.0, -3.0, 0.1, {}, {}}, {2.0, 2.0, 0.1, {}, {}}})}),
              HasSubstr("mean flux of session \"night\" is -0.5"));
  EXPECT_THAT(refusal({session({{1.0, -3.0, 0.1, {}, {}}, {2.0, 2.0, 0.1, {}, {}}})},
                      ScanQuantity::log_flux),
              HasSubstr("has no logarithm"));
  EXPECT_THAT(refusal({session({{1.0, 2.0, 0.1, {}, {}}, {2.0, 2.0, 0.1, {}, {}}})}),
              HasSubstr("do not vary"));
}

TEST(ScanPoints, GivesRelativeSessionsConstantsOfTheirOwn) {
  const std::vector<LightPoint> two{{3.0, 1.0, 0.1, {}, {}}, {2.0, 2.0, 0.1, {}, {}}};
  const ScanPoints points(std::vector{session(two), session(two, true), session(two, true),
                                      session({{7.0, 1.0, 0.1, {}, {}}}, true), session(two)});
  EXPECT_EQ(points.size(), 9U);
  EXPECT_EQ(points.constants(), 3U);
  EXPECT_EQ(points.epoch(), 4.5);
  EXPECT_EQ(points.time_base(), 5.0);
}

TEST(ScanAdvice, KnowsTheDayOfOneSite) {
  std::vector<LightCurve> nights;
  for (int night = 0; night < 5; ++night) {
    std::vector<LightPoint> points;
    for (int i = 0; i < 60; ++i)
      points.push_back({night + 0.004 * i, 1.0 + 0.1 * (i % 3), 0.01, {}, {}});
    nights.push_back(session(points));
  }
  const ScanAdvice advice = scan_advice(nights, 3);
  EXPECT_DOUBLE_EQ(advice.time_base, 4.236);
  EXPECT_DOUBLE_EQ(advice.step, 1.0 / (12.0 * 4.236));
  EXPECT_NEAR(advice.most, 62.5, budget::scan_times);
  EXPECT_NEAR(advice.covered, 5.0 * 0.236 / 4.236, budget::scan_times);
  ASSERT_EQ(advice.sessions.size(), 5U);
  EXPECT_NEAR(advice.sessions[2].longest_gap, 0.004, budget::scan_times);
  ASSERT_FALSE(advice.aliases.empty());
  EXPECT_NEAR(advice.aliases[0].frequency, 1.0, budget::window_peak / 4.236);
  EXPECT_GT(advice.aliases[0].height, 0.7);
}

}  // namespace
