// SPDX-License-Identifier: MIT
// Light curves that a scan takes, and those it does not.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "fit/session_scan.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using ::testing::HasSubstr;
using namespace polhode::test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

light::LightCurve session(std::vector<light::LightPoint> points, bool is_calibrated = false) {
  return {.name = "night", .is_calibrated = is_calibrated, .points = std::move(points)};
}
auto refusal(const std::vector<light::LightCurve>& curves,
             fit::ScanQuantity quantity = fit::ScanQuantity::flux) {
  return message_of([&] { fit::ScanPoints(curves, quantity); });
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
                      fit::ScanQuantity::log_flux),
              HasSubstr("has no logarithm"));
  EXPECT_THAT(refusal({session({{1.0, 2.0, 0.1, {}, {}}, {2.0, 2.0, 0.1, {}, {}}})}),
              HasSubstr("do not vary"));
}

TEST(ScanPoints, GivesRelativeSessionsConstantsOfTheirOwn) {
  const std::vector<light::LightPoint> two{{3.0, 1.0, 0.1, {}, {}}, {2.0, 2.0, 0.1, {}, {}}};
  const fit::ScanPoints points(std::vector{session(two), session(two, true), session(two, true),
                                           session({{7.0, 1.0, 0.1, {}, {}}}, true), session(two)});
  EXPECT_EQ(points.size(), 9U);
  EXPECT_EQ(points.constants(), 3U);
  EXPECT_EQ(points.epoch(), 4.5);
  EXPECT_EQ(points.time_base(), 5.0);
}

TEST(ScanAdvice, KnowsTheDayOfOneSite) {
  std::vector<light::LightCurve> nights;
  for (int night = 0; night < 5; ++night) {
    std::vector<light::LightPoint> points;
    for (int i = 0; i < 60; ++i)
      points.push_back({night + 0.004 * i, 1.0 + 0.1 * (i % 3), 0.01, {}, {}});
    nights.push_back(session(points));
  }
  const fit::ScanAdvice advice = fit::scan_advice(nights, 3);
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

// Nights far apart: their scan night by night finds the periods to what the whole time base tells
// apart.

constexpr double first_night = 0.0, second_night = 27.3, third_night = 49.6;  // turns of precession

// Three nights of four turns and 60 points each, with errors of 2 %.
std::vector<light::LightCurve> nights(const fit::LightModel& b, double P) {
  const FreeRotation motion = motion_of(b);
  const ensemble::CounterRandom random(4, ensemble::key_of("nights"));
  std::vector<light::LightCurve> curves;
  for (const double start : {first_night, second_night, third_night}) {
    light::LightCurve curve{.name = "night", .is_calibrated = false, .points = {}};
    const std::uint64_t own = curves.size();
    for (std::size_t i = 0; i < 60; ++i) {
      const double t = P * (start + 4.0 * (static_cast<double>(i) + random.uniform(own, i)) / 60.0);
      const Vec3 sun{1.0, 0.2, 0.3}, observer{0.8, 0.6, 0.1};
      const Quaternion back = conj(motion.at(t).q);
      const double flux = light::lommel_seeliger_brightness(b.ellipsoid(), rotate(back, sun),
                                                            rotate(back, observer));
      curve.points.push_back(
          {t, flux * (1.0 + 0.02 * random.normal(own, 1000 + 4 * i)), 0.02 * flux, sun, observer});
    }
    curves.push_back(curve);
  }
  return curves;
}

// How far f is from the nearest line of a tumbler, halves included.
double off_lines(double f, double f_phi, double f_psi) {
  double least = f;
  for (int j = -4; j <= 4; ++j)
    for (int k = -4; k <= 4; ++k)
      least = smaller(least, std::abs(0.5 * (j * f_phi + k * f_psi) - f));
  return least;
}

TEST(SessionScan, FindsThePeriodsOfNightsFarApart) {
  const fit::LightModel& b = in_long_axis_mode;
  const FreeRotation motion = motion_of(b);
  const double f_phi = motion.precession_rate_long() / (2.0 * pi<double>());
  const double f_psi = 1.0 / motion.polhode_period();
  const std::vector<light::LightCurve> curves = nights(b, 1.0 / f_phi);
  fit::SessionScanOptions options{.scan = {.order = 2, .threads = 2}, .windows = 8, .most = 3};
  int calls = 0;
  std::vector<double> parts;
  options.scan.progress = [&](double part) { parts.push_back(part); };
  const fit::SessionScan scan = fit::scan_sessions(curves, 0.5 * f_phi, 2.2 * f_phi, options);
  EXPECT_TRUE(std::ranges::is_sorted(parts));
  EXPECT_GT(parts.front(), 0.0);
  EXPECT_NEAR(parts.back(), 1.0, budget::session_progress);
  const fit::SessionScanSize size = fit::session_scan_size(curves, 0.5 * f_phi, 2.2 * f_phi, 2);
  EXPECT_EQ(size.sessions, 3u);
  EXPECT_EQ(size.coarse, static_cast<double>(scan.coarse.chi_square.size()));
  EXPECT_NEAR(8.0 * size.fine / static_cast<double>(scan.pairs), 1.0, budget::session_progress);
  // f1 and f2 exchanged are no window of their own
  for (const fit::ScanMinimum& m : scan.minima) EXPECT_LE(m.row, m.column);
  EXPECT_EQ(scan.sessions, 3u);
  ASSERT_FALSE(scan.minima.empty());
  const double T = fit::scan_advice(curves, 2).time_base;
  const fit::FourierFit& best = scan.minima.front().refined.fit;
  EXPECT_LE(off_lines(best.f1, f_phi, f_psi) * T, budget::session_turns);
  EXPECT_LE(off_lines(best.f2, f_phi, f_psi) * T, budget::session_turns);
  EXPECT_LE(best.chi_square, budget::light_noise * static_cast<double>(best.degrees_of_freedom));
  for (std::size_t i = 1; i < scan.minima.size(); ++i)
    EXPECT_GE(scan.minima[i].refined.fit.chi_square, scan.minima[i - 1].refined.fit.chi_square);
  // far fewer pairs than the grid of the whole time base has
  const double all = (2.2 - 0.5) * f_phi / fit::scan_advice(curves, 2).step;
  EXPECT_LE(static_cast<double>(scan.pairs + 3 * scan.coarse.chi_square.size()), 0.3 * all * all);
  // the same with one thread, and it can be stopped
  options.scan.threads = 1;
  options.scan.between = [&] {
    if (++calls > 3) throw DomainError("stopped");
  };
  EXPECT_MESSAGE(fit::scan_sessions(curves, 0.5 * f_phi, 2.2 * f_phi, options), "stopped");
}

TEST(SessionScan, SaysWhatIsWrong) {
  std::vector<light::LightCurve> curves = nights(in_long_axis_mode, 1.0);
  fit::SessionScanOptions options{.scan = {.order = 2}, .windows = 0};
  const auto refusal = [&] {
    return message_of([&] { static_cast<void>(fit::scan_sessions(curves, 0.5, 2.0, options)); });
  };
  EXPECT_EQ(refusal(), "scan_sessions: windows = 0 must be 1 or more");
  options.windows = 1;
  for (light::LightCurve& one : curves) one.points.resize(25);
  EXPECT_EQ(refusal(),
            "scan_sessions: no session has more than 25 points, the unknowns of a series of order "
            "2");
}

TEST(ScanMinima, CanBeStopped) {
  const std::vector<light::LightCurve> curves{night(in_long_axis_mode, 4.0, 60, 0.02, 1)};
  const fit::ScanPoints points(curves);
  const double T = points.time_base();
  const auto grid = fit::FrequencyGrid::between(3.0 / T, 6.0 / T, 0.125 / T);
  const fit::Landscape landscape = fit::scan_pairs(points, grid, grid, {.order = 2});
  int calls = 0;
  EXPECT_EQ(message_of([&] {
              static_cast<void>(fit::scan_minima(points, landscape, {.between = [&] {
                                                   ++calls;
                                                   throw DomainError("stop");
                                                 }}));
            }),
            "stop");
  EXPECT_EQ(calls, 1);
}

}  // namespace
