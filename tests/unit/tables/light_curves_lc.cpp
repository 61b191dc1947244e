// SPDX-License-Identifier: MIT
// Light curves in DAMIT's lc: read, written, and what is said of what is wrong.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/output/light_curves.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "temp_folder.hpp"
#include "unit/tables/changed_text.hpp"

namespace polhode {
namespace {

using test::changed_text;
using test::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LcFiles : public test::InTempFolder {};

// Two nights, the second calibrated, as DAMIT writes them.
const std::string two_nights =
    "2\n"
    "3 0\n"
    "2443846.030926  0.981  1.2500E+00 -2.0e-01 0.01  3.5e-01 -1.5e-01 0.02\n"
    "2443846.042    1.021  1.25 -0.2 0.01  0.35 -0.15 0.02\n"
    "2443846.053   +0.998  1.25 -0.2 0.01  0.35 -0.15 0.02\n"
    "\n"
    "1 1\r\n"
    "2443850.5  0.5  1.24 -0.21 0.01  0.34 -0.16 0.02\r\n";

std::string lc_refusal(const std::string& text) {
  return message_of([&] { io::lc_from_text(text, "x.lc", ephemeris::TimeScale::TDB); });
}
std::string lc_refusal(const std::string& old, const std::string& by) {
  return lc_refusal(changed_text(two_nights, old, by));
}

TEST(LightCurvesOfDamit, AreReadWithWhatTheFormatDeclares) {
  const io::LightCurveFile file = io::lc_from_text(two_nights, "x.lc", ephemeris::TimeScale::TT);
  ASSERT_EQ(file.sessions.size(), 2U);
  EXPECT_EQ(file.epoch, (ephemeris::Date{ephemeris::TimeScale::TT, 2443845.5, 0.0}));
  EXPECT_EQ(file.axes, "ecliptic-J2000");
  EXPECT_EQ(file.length, "au");
  const io::LightSession &first = file.sessions[0], &second = file.sessions[1];
  EXPECT_FALSE(first.curve.is_calibrated);
  EXPECT_TRUE(second.curve.is_calibrated);
  EXPECT_EQ(first.times, light::LightTime::at_body);
  EXPECT_EQ(first.distances, io::Distances::unknown);
  EXPECT_EQ(second.distances, io::Distances::unit);
  EXPECT_EQ(first.zero_magnitude, std::nullopt);
  EXPECT_EQ(first.line, 2U);
  EXPECT_THAT(first.lines, ElementsAre(3U, 4U, 5U));
  const light::LightPoint& p = first.curve.points[0];
  EXPECT_NEAR(p.t, 0.530926 * 86400.0, budget::light_date_s);
  EXPECT_EQ(p.flux, 0.981);
  EXPECT_EQ(p.sigma, 0.0);
  EXPECT_EQ(p.to_sun, (Vec3{1.25, -0.2, 0.01}));
  EXPECT_EQ(p.to_observer, (Vec3{0.35, -0.15, 0.02}));
  EXPECT_EQ(second.curve.points[0].t, 5.0 * 86400.0);
  EXPECT_REJECTED(require_sound(file), "x.lc:2: light curve 1 has no errors");
}

TEST(LightCurvesOfDamit, LinesThatAreLeftOutAreNotChecked) {
  const std::string bad = changed_text(changed_text(two_nights, "1.021 ", "nan "), "  0.5  ", " ");
  EXPECT_THAT(lc_refusal(bad), HasSubstr("x.lc:4: "));
  const std::vector<std::size_t> leave_out = {4, 8};
  const io::LightCurveFile file =
      io::lc_from_text(bad, "x.lc", ephemeris::TimeScale::TT, std::nullopt, leave_out);
  ASSERT_EQ(file.sessions.size(), 2U);
  EXPECT_THAT(file.sessions[0].lines, ElementsAre(3U, 5U));
  EXPECT_THAT(file.sessions[0].left_out, ElementsAre(4U));
  EXPECT_TRUE(file.sessions[1].curve.points.empty());
  EXPECT_THAT(file.sessions[1].left_out, ElementsAre(8U));
}

TEST(LightCurvesOfDamit, CountLeapSecondsFromTheEpochThatIsAskedFor) {
  const std::string text =
      "1\n2 0\n2457754.25 1 1 0 0 0 1 0\n2457754.75 1 1 0 0 0 1 0\n";  // 2016-12-31T18, 06
  const io::LightCurveFile file = io::lc_from_text(text, "x", ephemeris::TimeScale::UTC);
  const std::vector<light::LightPoint>& p = file.sessions[0].curve.points;
  // a quarter of the day that ends in a leap second, and a quarter of the next
  EXPECT_NEAR(p[1].t - p[0].t, 21600.25 + 21600.0, budget::light_date_s);
  const ephemeris::Date epoch{ephemeris::TimeScale::TDB, 2457754.5, 0.0};
  const io::LightCurveFile from = io::lc_from_text(text, "x", ephemeris::TimeScale::TDB, epoch);
  EXPECT_EQ(from.epoch, epoch);
  EXPECT_NEAR(from.sessions[0].curve.points[0].t, -21600.0, budget::light_tdb_s);
}

TEST(LightCurvesOfDamit, DatesKeepTheirDigits) {
  // a double of the whole keeps 40 us
  const std::string text =
      "1\n2 0\n2457754.250000000001 1 1 0 0 0 1 0\n2457754.250000000003 1 1 0 0 0 1 0\n";
  const io::LightCurveFile file = io::lc_from_text(text, "x", ephemeris::TimeScale::TT);
  const std::vector<light::LightPoint>& p = file.sessions[0].curve.points;
  EXPECT_NEAR(p[1].t - p[0].t, 2e-12 * 86400.0, budget::light_date_s);
  EXPECT_GT(p[1].t, p[0].t);
}

TEST(LightCurvesOfDamit, OneLineSaysWhatIsWrongAndWhere) {
  EXPECT_EQ(lc_refusal(""), "x.lc:1: the file ends before the number of light curves");
  EXPECT_EQ(lc_refusal("2\n", "2 0\n"),
            "x.lc:1: got 2 fields; expected the number of light curves alone in the first line");
  EXPECT_EQ(lc_refusal("2\n", "two\n"),
            "x.lc:1: got \"two\"; expected the number of light curves, 1 or more");
  EXPECT_EQ(lc_refusal("0\n"), "x.lc:1: got \"0\"; expected the number of light curves, 1 or more");
  EXPECT_EQ(lc_refusal("2\n", "3\n"), "x.lc:8: the file ends before light curve 3 of 3");
  EXPECT_EQ(lc_refusal("2\n", "99999999999\n"),
            "x.lc:8: the file ends before light curve 3 of 99999999999");
  EXPECT_EQ(lc_refusal("2\n", "1\n"),
            "x.lc:7: there is more after the last of 1 light curves; expected as many as the first "
            "line says");
  EXPECT_EQ(lc_refusal("3 0", "4 0"),
            "x.lc:7: got 2 fields; expected 8 in point 4 of 4 of light curve 1 of 2: Julian date, "
            "flux, x y z from the body to the Sun, x y z to the Earth");
  EXPECT_EQ(lc_refusal("3 0", "2 0"),
            "x.lc:5: got 8 fields; expected two to begin light curve 2 of 2: how many points, and "
            "0 (relative) or 1 (calibrated)");
  EXPECT_EQ(lc_refusal("3 0", "0 0"),
            "x.lc:2: got \"0\"; expected the number of points of light curve 1 of 2, 1 or more");
  EXPECT_EQ(
      lc_refusal("3 0", "3 2"),
      "x.lc:2: got \"2\"; expected 0 (relative) or 1 (calibrated) behind the number of points");
  EXPECT_EQ(lc_refusal("1.021", "bright"),
            "x.lc:4: flux: got \"bright\"; expected a finite number");
  EXPECT_EQ(lc_refusal("1.021", "nan"), "x.lc:4: flux: got \"nan\"; expected a finite number");
  EXPECT_EQ(lc_refusal("2443846.042", "1979-01-01"),
            "x.lc:4: \"1979-01-01\" is not a number of days");
  EXPECT_EQ(lc_refusal("2443846.042", "1e9"),
            "x.lc:4: \"1e9\" is no Julian date from 0 to 5373484.5");
  EXPECT_EQ(lc_refusal("0.35 -0.15 0.02\n", "0.35 -0.15 inf\n"),
            "x.lc:4: vector to the Earth: got \"inf\"; expected a finite number");
  EXPECT_EQ(lc_refusal("1.25 -0.2 0.01", "0 0 0"),
            "x.lc:4: the vector to the Sun is 0; expected one in au");
  EXPECT_EQ(lc_refusal("1 1\r\n", "COMMENT\n"),
            "x.lc:7: got \"COMMENT\"; expected light curve 2 of 2");
  EXPECT_MESSAGE(
      io::lc_from_text(two_nights, "x.lc", ephemeris::TimeScale::UT1),
      "x.lc: times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC is observed");
  EXPECT_MESSAGE(io::read_lc("/nonexistent/a.lc", ephemeris::TimeScale::TDB),
                 "/nonexistent/a.lc: cannot be read: No such file or directory");
}

TEST(LightCurvesOfDamit, PointsOutOfOrderAreNamedByTheirLines) {
  const auto said = [](const std::string& old, const std::string& by) {
    io::LightCurveFile file =
        io::lc_from_text(changed_text(two_nights, old, by), "x.lc", ephemeris::TimeScale::TT);
    for (io::LightSession& session : file.sessions)
      session.curve = light::with_relative_sigma(session.curve, 0.02);
    return message_of([&] { io::require_sound(file, {.vectors = true}); });
  };
  EXPECT_EQ(said("2443846.053", "2443846.053"), "");
  EXPECT_THAT(said("2443846.053", "2443846.032"),
              HasSubstr("x.lc:5: light curve 1, point 3 (JD 2443846.032000): time "));
  EXPECT_EQ(said("2443846.053", "2443846.042"), "");  // two telescopes
  EXPECT_THAT(said("2443846.053", "2443846.032"), HasSubstr(", point 3 (JD 2443846.032000): "));
}

TEST_F(LcFiles, OfDamitAreWrittenAsTheyWereRead) {
  const std::string text =
      "2\n"
      "3 0\n"
      "2443846.030926 0.981 1.25 -0.2 0.01 0.35 -0.15 0.02\n"
      "2443846.042000000001 1.021 1.25 -0.2 0.01 0.35 -0.15 0.02\n"
      "2443846.5 0.998 1.25 -0.2 0.01 0.35 -0.15 1e-17\n"
      "1 1\n"
      "2443851.0 0.5 1.24 -0.21 0.01 0.34 -0.16 0.02\n";
  for (const ephemeris::TimeScale scale :
       {ephemeris::TimeScale::UTC, ephemeris::TimeScale::TT, ephemeris::TimeScale::TDB}) {
    const io::LightCurveFile file = io::lc_from_text(text, "x", scale);
    io::write_lc(path("again.lc"), io::light_curves(file), *file.epoch);
    EXPECT_EQ(this->text("again.lc"), text) << ephemeris::name(scale);
    const io::LightCurveFile again = io::read_lc(path("again.lc"), scale);
    EXPECT_EQ(io::light_curves(again), io::light_curves(file));
  }
  EXPECT_FALSE(std::filesystem::exists(path("again.lc.part")));
}

TEST_F(LcFiles, OfDamitHoldVectorsAndFiniteNumbers) {
  std::vector<light::LightCurve> curves{{"a", false, {{0.0, 1.0, 0.1, {1.0, 0.0, 0.0}, {}}}}};
  const ephemeris::Date epoch{};
  EXPECT_MESSAGE(io::write_lc(path("a.lc"), curves, epoch),
                 "lc_text: light curve 1: point 1: expected its vectors to the Sun and to the "
                 "observer, in au");
  curves[0].points[0].t = std::nan("");
  EXPECT_MESSAGE(io::write_lc(path("a.lc"), curves, epoch),
                 "lc_text: light curve 1: point 1: its time or flux is not finite");
  EXPECT_FALSE(std::filesystem::exists(path("a.lc")));
  EXPECT_MESSAGE(io::lc_text({}, epoch),
                 "lc_text: there are no light curves; expected one or more");
  EXPECT_MESSAGE(io::lc_text(std::vector<light::LightCurve>(1), epoch),
                 "lc_text: light curve 1 has no points; expected one or more");
  curves[0].points[0] = {-1e-9, 1.0, 0.1, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(io::lc_text(curves, epoch), "1\n1 0\n2451545.0 1 1 0 0 1 0 0\n");  // rounded up
}

}  // namespace
}  // namespace polhode
