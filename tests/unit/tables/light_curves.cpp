// SPDX-License-Identifier: MIT
// Light curves in files: DAMIT's lc, ALCDEF and plain columns, and what is said of each that is
// wrong.
#include "polhode/output/light_curves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/error.hpp"
#include "polhode/light/aspect.hpp"
#include "polhode/light/magnitudes.hpp"
#include "polhode/tables/alcdef.hpp"
#include "polhode/tables/lc.hpp"
#include "polhode/tables/light_columns.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const DomainError& error) {
    return error.what();
  }
  return "no error";
}

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
  return message_of([&] { lc_from_text(text, "x.lc", TimeScale::TDB); });
}
// The same with one part of it changed.
std::string changed(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) return "the test changes nothing";
  return text.replace(at, old.size(), by);
}
std::string lc_refusal(const std::string& old, const std::string& by) {
  return lc_refusal(changed(two_nights, old, by));
}

TEST(LightCurvesOfDamit, AreReadWithWhatTheFormatDeclares) {
  const LightCurveFile file = lc_from_text(two_nights, "x.lc", TimeScale::TT);
  ASSERT_EQ(file.sessions.size(), 2U);
  EXPECT_EQ(file.epoch, (Date{TimeScale::TT, 2443845.5, 0.0}));
  EXPECT_EQ(file.axes, "ecliptic-J2000");
  EXPECT_EQ(file.length, "au");
  const LightSession &first = file.sessions[0], &second = file.sessions[1];
  EXPECT_FALSE(first.curve.is_calibrated);
  EXPECT_TRUE(second.curve.is_calibrated);
  EXPECT_EQ(first.times, LightTime::at_body);
  EXPECT_EQ(first.distances, Distances::unknown);
  EXPECT_EQ(second.distances, Distances::unit);
  EXPECT_EQ(first.zero_magnitude, std::nullopt);
  EXPECT_EQ(first.line, 2U);
  EXPECT_THAT(first.lines, ElementsAre(3U, 4U, 5U));
  const LightPoint& p = first.curve.points[0];
  EXPECT_NEAR(p.t, 0.530926 * 86400.0, budget::light_date_s);
  EXPECT_EQ(p.flux, 0.981);
  EXPECT_EQ(p.sigma, 0.0);
  EXPECT_EQ(p.to_sun, (Vec3{1.25, -0.2, 0.01}));
  EXPECT_EQ(p.to_observer, (Vec3{0.35, -0.15, 0.02}));
  EXPECT_EQ(second.curve.points[0].t, 5.0 * 86400.0);
  EXPECT_THAT(message_of([&] { require_sound(file); }),
              HasSubstr("x.lc:2: light curve 1 has no errors"));
}

TEST(LightCurvesOfDamit, CountLeapSecondsFromTheEpochThatIsAskedFor) {
  const std::string text =
      "1\n2 0\n2457754.25 1 1 0 0 0 1 0\n2457754.75 1 1 0 0 0 1 0\n";  // 2016-12-31T18, 06
  const LightCurveFile file = lc_from_text(text, "x", TimeScale::UTC);
  const std::vector<LightPoint>& p = file.sessions[0].curve.points;
  // a quarter of the day that ends in a leap second, and a quarter of the next
  EXPECT_NEAR(p[1].t - p[0].t, 21600.25 + 21600.0, budget::light_date_s);
  const Date epoch{TimeScale::TDB, 2457754.5, 0.0};
  const LightCurveFile from = lc_from_text(text, "x", TimeScale::TDB, epoch);
  EXPECT_EQ(from.epoch, epoch);
  EXPECT_NEAR(from.sessions[0].curve.points[0].t, -21600.0, budget::light_tdb_s);
}

TEST(LightCurvesOfDamit, DatesKeepTheirDigits) {
  // a double of the whole keeps 40 us
  const std::string text =
      "1\n2 0\n2457754.250000000001 1 1 0 0 0 1 0\n2457754.250000000003 1 1 0 0 0 1 0\n";
  const LightCurveFile file = lc_from_text(text, "x", TimeScale::TT);
  const std::vector<LightPoint>& p = file.sessions[0].curve.points;
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
  EXPECT_EQ(
      lc_refusal("3 0", "2 0"),
      "x.lc:5: got 8 fields; expected two to begin light curve 2 of 2: how many points, and 0 "
      "(relative) or 1 (calibrated)");
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
  EXPECT_EQ(message_of([] { lc_from_text(two_nights, "x.lc", TimeScale::UT1); }),
            "x.lc: times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC is "
            "observed");
  EXPECT_EQ(message_of([] { read_lc("/nonexistent/a.lc", TimeScale::TDB); }),
            "/nonexistent/a.lc: cannot be read: No such file or directory");
}

TEST(LightCurvesOfDamit, PointsOutOfOrderAreNamedByTheirLines) {
  const auto said = [](const std::string& old, const std::string& by) {
    LightCurveFile file = lc_from_text(changed(two_nights, old, by), "x.lc", TimeScale::TT);
    for (LightSession& session : file.sessions)
      session.curve = with_relative_sigma(session.curve, 0.02);
    return message_of([&] { require_sound(file, {.vectors = true}); });
  };
  EXPECT_EQ(said("2443846.053", "2443846.053"), "no error");
  EXPECT_THAT(said("2443846.053", "2443846.032"),
              HasSubstr("x.lc:5: light curve 1, point 3: time "));
  EXPECT_THAT(said("2443846.053", "2443846.042"), HasSubstr(" stands twice, here and in point 2"));
}

class LightCurveFiles : public test::InTempFolder {};

TEST_F(LightCurveFiles, OfDamitAreWrittenAsTheyWereRead) {
  const std::string text =
      "2\n"
      "3 0\n"
      "2443846.030926 0.981 1.25 -0.2 0.01 0.35 -0.15 0.02\n"
      "2443846.042000000001 1.021 1.25 -0.2 0.01 0.35 -0.15 0.02\n"
      "2443846.5 0.998 1.25 -0.2 0.01 0.35 -0.15 1e-17\n"
      "1 1\n"
      "2443851.0 0.5 1.24 -0.21 0.01 0.34 -0.16 0.02\n";
  for (const TimeScale scale : {TimeScale::UTC, TimeScale::TT, TimeScale::TDB}) {
    const LightCurveFile file = lc_from_text(text, "x", scale);
    write_lc(path("again.lc"), light_curves(file), *file.epoch);
    EXPECT_EQ(this->text("again.lc"), text) << name(scale);
    const LightCurveFile again = read_lc(path("again.lc"), scale);
    EXPECT_EQ(light_curves(again), light_curves(file));
  }
  EXPECT_FALSE(std::filesystem::exists(path("again.lc.part")));
}

TEST_F(LightCurveFiles, OfDamitHoldVectorsAndFiniteNumbers) {
  std::vector<LightCurve> curves{{"a", false, {{0.0, 1.0, 0.1, {1.0, 0.0, 0.0}, {}}}}};
  const Date epoch{};
  EXPECT_EQ(message_of([&] { write_lc(path("a.lc"), curves, epoch); }),
            "lc_text: light curve 1: point 1: expected its vectors to the Sun and to the observer, "
            "in au");
  curves[0].points[0].t = std::nan("");
  EXPECT_EQ(message_of([&] { write_lc(path("a.lc"), curves, epoch); }),
            "lc_text: light curve 1: point 1: its time or flux is not finite");
  EXPECT_FALSE(std::filesystem::exists(path("a.lc")));
  EXPECT_EQ(message_of([&] { lc_text({}, epoch); }),
            "lc_text: there are no light curves; expected one or more");
  EXPECT_EQ(message_of([&] { lc_text(std::vector<LightCurve>(1), epoch); }),
            "lc_text: light curve 1 has no points; expected one or more");
  curves[0].points[0] = {-1e-9, 1.0, 0.1, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(lc_text(curves, epoch), "1\n1 0\n2451545.0 1 1 0 0 1 0 0\n");  // rounded up
}

// Two sessions after the standard, the first with what MPO Canopus writes.
const std::string two_sessions =
    "STARTMETADATA\n"
    "REVISEDDATA=FALSE\n"
    "OBJECTNUMBER=999\n"
    "OBJECTNAME=Zachia\n"
    "MPCDESIG=1923 NW\n"
    "SESSIONDATE=1999-09-04\n"
    "SESSIONTIME=06:00:00\n"
    "CONTACTNAME=A. N. Observer\n"
    "CONTACTINFO=[a.n@observer.example]\n"
    "OBSERVERS=Observer, A.N.; Other, B.\n"
    "OBSLONGITUDE=-104.7\n"
    "OBSLATITUDE=+39.1\n"
    "PHASE=+13.54\n"
    "PABL=+323.5\n"
    "PABB=+12.9\n"
    "FILTER=C\n"
    "MAGBAND=R\n"
    "CICORRECTION=FALSE\n"
    "DIFFERMAGS=TRUE\n"
    "MAGADJUST=+0.000\n"
    "STANDARD=INTERNAL\n"
    "LTCAPP=NONE\n"
    "LTCDAYS=-0.006465\n"
    "LTCTYPE=NONE\n"
    "REDUCEDMAGS=NONE\n"
    "UCORMAG=-1.8189\n"
    "PUBLICATION=\n"
    "COMPNAME1=210040.20 +001658.7\n"
    "COMMENT=a first line\n"
    "COMMENT=and a second, with a = b\n"
    "DELIMITER=PIPE\n"
    "ENDMETADATA\n"
    "DATA=2451425.650521|-0.134|0.009|1.23\n"
    "DATA=2451425.653700|-0.125|+0.010|1.22\n"
    "DATA=2451425.656000| 0.013 |0.011\n"
    "DATA=2451425.657000|0.021\n"
    "ENDDATA\n"
    "\n"
    "STARTMETADATA\n"
    "OBJECTNUMBER=999\n"
    "OBJECTNAME=Zachia\n"
    "SESSIONDATE=1999-09-05\n"
    "SESSIONTIME=05:00:00\n"
    "FILTER=V\n"
    "DIFFERMAGS=FALSE\n"
    "STANDARD=APASS\n"
    "LTCAPP=AVERAGE\n"
    "REDUCEDMAGS=POINT\n"
    "DELIMITER=TAB\n"
    "ENDMETADATA\n"
    "DATA=2451426.65\t13.5\t0.02\n"
    "DATA=2451426.66\t13.6\t0.03\t1.1\n"
    "ENDDATA\n";

std::string alcdef_refusal(const std::string& old, const std::string& by) {
  return message_of([&] { alcdef_from_text(changed(two_sessions, old, by), "x.txt"); });
}

TEST(LightCurvesOfAlcdef, AreReadWithWhatTheFileDeclares) {
  const LightCurveFile file = alcdef_from_text(two_sessions, "x.txt");
  EXPECT_EQ(file.object, "999 Zachia");
  EXPECT_EQ(file.epoch, (Date{TimeScale::UTC, 2451425.5, 0.0}));
  EXPECT_EQ(file.axes, "");
  ASSERT_EQ(file.sessions.size(), 2U);
  const LightSession &first = file.sessions[0], &second = file.sessions[1];
  EXPECT_EQ(first.curve.name, "1999-09-04 06:00:00 C");
  EXPECT_FALSE(first.curve.is_calibrated);
  EXPECT_EQ(first.times, LightTime::at_observer);
  EXPECT_NEAR(*first.light_time, 0.006465 * 86400.0, budget::light_date_s);
  EXPECT_EQ(first.distances, Distances::of_the_time);
  EXPECT_EQ(first.band, "R");
  EXPECT_EQ(first.line, 1U);
  EXPECT_THAT(first.lines, ElementsAre(33U, 34U, 35U, 36U));
  EXPECT_THAT(first.notes, ::testing::Contains(std::pair<std::string, std::string>(
                               "COMMENT", "and a second, with a = b")));
  EXPECT_THAT(first.notes,
              ::testing::Contains(std::pair<std::string, std::string>("UCORMAG", "-1.8189")));
  EXPECT_TRUE(second.curve.is_calibrated);
  EXPECT_EQ(second.times, LightTime::at_body);
  EXPECT_EQ(second.light_time, std::nullopt);
  EXPECT_EQ(second.distances, Distances::unit);
  EXPECT_EQ(second.band, "V");
  EXPECT_THAT(second.lines, ElementsAre(51U, 52U));
}

TEST(LightCurvesOfAlcdef, MagnitudesBecomeFluxes) {
  const LightCurveFile file = alcdef_from_text(two_sessions, "x.txt");
  const std::vector<LightPoint>& relative = file.sessions[0].curve.points;
  EXPECT_NEAR(relative[0].t, 0.150521 * 86400.0, budget::light_date_s);
  EXPECT_NEAR(mean_flux(file.sessions[0].curve), 1.0, budget::light_flux);
  EXPECT_NEAR(-2.5 * std::log10(relative[0].flux / relative[2].flux), -0.147,
              budget::light_magnitude);
  EXPECT_NEAR(relative[0].sigma / relative[0].flux, 0.009 * 0.4 * std::log(10.0),
              budget::light_flux);
  EXPECT_EQ(relative[3].sigma, 0.0);
  EXPECT_EQ(relative[0].to_sun, Vec3{});
  const Magnitude back =
      magnitude_of({relative[1].flux, relative[1].sigma}, *file.sessions[0].zero_magnitude);
  EXPECT_NEAR(back.value, -0.125, budget::light_magnitude);
  EXPECT_NEAR(back.sigma, 0.010, budget::light_flux);
  const LightPoint& calibrated = file.sessions[1].curve.points[1];
  EXPECT_NEAR(calibrated.flux / std::pow(10.0, -5.44), 1.0, budget::light_flux);
  EXPECT_EQ(file.sessions[1].zero_magnitude, 0.0);
  EXPECT_EQ(message_of([&] { require_sound(file); }),
            "x.txt:36: light curve 1, point 4: error 0; expected one above 0");
}

TEST(LightCurvesOfAlcdef, WhatIsNotDeclaredIsNotGuessed) {
  const auto session = [](const std::string& old, const std::string& by) {
    return alcdef_from_text(changed(two_sessions, old, by), "x").sessions[1];
  };
  EXPECT_EQ(session("LTCAPP=AVERAGE\n", "").times, std::nullopt);
  EXPECT_EQ(session("LTCAPP=AVERAGE\n", "LTCAPP=HELIOCENTRIC\n").times, std::nullopt);
  EXPECT_EQ(session("LTCAPP=AVERAGE\n", "LTCAPP=POINT\n").times, LightTime::at_body);
  EXPECT_EQ(session("REDUCEDMAGS=POINT\n", "").distances, Distances::unknown);
  for (const char* standard : {"", "STANDARD=NONE\n", "STANDARD=INTERNAL\n"})
    EXPECT_FALSE(session("STANDARD=APASS\n", standard).curve.is_calibrated);
  EXPECT_FALSE(session("DIFFERMAGS=FALSE\n", "").curve.is_calibrated);
  EXPECT_EQ(session("FILTER=V\n", "filter=v\n").band, "v");
}

TEST(LightCurvesOfAlcdef, ASessionMayEndWithoutSayingSo) {
  for (const std::string& end : {changed(two_sessions, "ENDDATA\n\n", ""),
                                 two_sessions.substr(0, two_sessions.rfind("ENDDATA"))})
    EXPECT_EQ(alcdef_from_text(end, "x").sessions.size(), 2U);
}

TEST(LightCurvesOfAlcdef, OneLineSaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message_of([] { alcdef_from_text("\n", "x.txt"); }),
            "x.txt:1: has no session; expected STARTMETADATA");
  EXPECT_EQ(message_of([] {
              alcdef_from_text(two_sessions, "x.txt", Date{TimeScale::UT1, 2451425.5, 0.0});
            }),
            "x.txt: times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC is "
            "observed");
  EXPECT_EQ(alcdef_refusal("STARTMETADATA\n", "JD,MAG\n"),
            "x.txt:1: got \"JD,MAG\"; expected STARTMETADATA");
  EXPECT_EQ(alcdef_refusal("STARTMETADATA\n", ""),
            "x.txt:1: got \"REVISEDDATA\"; expected STARTMETADATA");
  EXPECT_EQ(alcdef_refusal("PABB=+12.9", "12.9"),
            "x.txt:15: got \"12.9\"; expected KEYWORD=VALUE or ENDMETADATA");
  EXPECT_EQ(alcdef_refusal("MAGBAND=R", "FILTER=R"), "x.txt:17: FILTER is there twice");
  EXPECT_EQ(alcdef_refusal("DELIMITER=PIPE\n", ""),
            "x.txt:31: DELIMITER: got \"\"; expected PIPE or TAB");
  EXPECT_EQ(alcdef_refusal("DIFFERMAGS=TRUE", "DIFFERMAGS=PERHAPS"),
            "x.txt:32: DIFFERMAGS: got \"PERHAPS\"; expected TRUE or FALSE");
  EXPECT_EQ(alcdef_refusal("LTCDAYS=-0.006465", "LTCDAYS=none"),
            "x.txt:32: LTCDAYS: got \"none\"; expected a finite number");
  EXPECT_EQ(alcdef_refusal("LTCDAYS=-0.006465", "LTCDAYS=0.006465"),
            "x.txt:32: LTCDAYS: got \"0.006465\"; expected 0 or less, as it is added to the times "
            "at the observer");
  EXPECT_EQ(alcdef_refusal("2451425.653700|-0.125|+0.010|1.22", "2451425.653700"),
            "x.txt:34: got 1 fields; expected DATA=JD, magnitude, its error and airmass, of which "
            "the last two may be missing");
  EXPECT_EQ(alcdef_refusal("2451425.653700", "51425.O"),
            "x.txt:34: \"51425.O\" is not a number of days");
  EXPECT_EQ(alcdef_refusal("-0.125", "bright"),
            "x.txt:34: magnitude: got \"bright\"; expected a finite number");
  EXPECT_EQ(alcdef_refusal("-0.125", "999.9"),
            "x.txt:34: magnitude 999.9; expected one from -100 to 100");
  EXPECT_EQ(alcdef_refusal("+0.010", "?"),
            "x.txt:34: error of the magnitude: got \"?\"; expected a finite number");
  EXPECT_EQ(alcdef_refusal("DATA=2451425.653700", "JD=2451425.653700"),
            "x.txt:34: got \"JD\"; expected DATA=..., ENDDATA or STARTMETADATA");
  EXPECT_EQ(
      alcdef_refusal("\n\nSTARTMETADATA\nOBJECTNUMBER=999", "\nSTARTMETADATA\nOBJECTNUMBER=5"),
      "x.txt:49: OBJECTNUMBER: got \"5\"; expected 999, as in the session of line 1: one "
      "object a file");
  EXPECT_EQ(alcdef_refusal("ENDDATA\n\n", "ENDDATA\nmore\n"),
            "x.txt:38: got \"more\"; expected STARTMETADATA");
  const std::size_t rows = two_sessions.find("DATA=2451426.65");
  EXPECT_EQ(message_of([&] { alcdef_from_text(two_sessions.substr(0, rows), "x.txt"); }),
            "x.txt:50: the session of line 39 has no points; expected DATA=...");
  EXPECT_EQ(message_of([&] { alcdef_from_text(two_sessions.substr(0, 100), "x.txt"); }),
            "x.txt:6: the file ends before ENDMETADATA");
}

TEST(LightCurvesOfAlcdef, CalibratedSessionsNeedOneScale) {
  std::string both = changed(two_sessions, "DIFFERMAGS=TRUE", "DIFFERMAGS=FALSE");
  both = changed(both, "STANDARD=INTERNAL", "STANDARD=APASS");
  both = changed(both, "DATA=2451425.657000|0.021\n", "");
  const auto said = [](const std::string& text) {
    return message_of([&] { require_sound(alcdef_from_text(text, "x.txt")); });
  };
  EXPECT_EQ(
      said(both),
      "x.txt:38: calibrated fluxes in the band \"V\" have no scale in common with \"R\" of the "
      "session of line 1; expected one band, or relative sessions");
  both = changed(both, "MAGBAND=R", "MAGBAND=V");
  EXPECT_EQ(said(both),
            "x.txt:38: calibrated fluxes at unit distances, those of the session of line 1 are at "
            "the distances of the time; expected the same");
  EXPECT_EQ(said(changed(both, "REDUCEDMAGS=POINT", "REDUCEDMAGS=NONE")), "no error");
}

TEST(LightCurvesOfAlcdef, AreOfOneObjectHoweverItIsNamed) {
  const auto session = [](const std::string& names) {
    return "STARTMETADATA\n" + names + "DELIMITER=PIPE\nENDMETADATA\nDATA=2451426.65|13.5\n";
  };
  const auto said = [](const std::string& text) {
    return message_of([&] { alcdef_from_text(text, "x.txt"); });
  };
  const std::string unnamed = "OBJECTNUMBER=0\nMPCDESIG=2005 AB\n";
  EXPECT_EQ(said(session(unnamed) + session("OBJECTNUMBER=0\nMPCDESIG=2006 CD\n")),
            "x.txt:11: MPCDESIG: got \"2006 CD\"; expected 2005 AB, as in the session of line 1: "
            "one object a file");
  EXPECT_EQ(said(session("") + session("OBJECTNAME=Zachia\n") + session("OBJECTNAME=Ceres\n")),
            "x.txt:13: OBJECTNAME: got \"Ceres\"; expected Zachia, as in the session of line 5: "
            "one object a file");
  // a number says more than a name, and a name more than a designation
  EXPECT_EQ(said(session("OBJECTNUMBER=999\nOBJECTNAME=Zachia\n") +
                 session("OBJECTNUMBER=999\nOBJECTNAME=ZACHIA\n")),
            "no error");
  const LightCurveFile file =
      alcdef_from_text(session(unnamed) + session("OBJECTNUMBER=999\nMPCDESIG=2005 AB\n"), "x.txt");
  EXPECT_EQ(file.object, "999 2005 AB");
}

// A first session that does not say its distances hides nothing of the others.
TEST(LightCurvesOfAlcdef, DistancesThatAreKnownMustBeTheSame) {
  const auto session = [](std::size_t line, Distances distances, double t) {
    LightSession made;
    made.curve = {"", true, {{t, 1.0, 0.1, {}, {}}}};
    made.distances = distances;
    made.line = line;
    made.lines = {line + 1};
    return made;
  };
  LightCurveFile file;
  file.file = "x.txt";
  file.sessions = {session(1, Distances::unknown, 1.0), session(11, Distances::unit, 2.0),
                   session(21, Distances::unknown, 3.0), session(31, Distances::of_the_time, 4.0)};
  EXPECT_EQ(message_of([&] { require_sound(file); }),
            "x.txt:31: calibrated fluxes at the distances of the time, those of the session of "
            "line 11 are at unit distances; expected the same");
  file.sessions.pop_back();
  EXPECT_EQ(message_of([&] { require_sound(file); }), "no error");
}

TEST_F(LightCurveFiles, InColumnsAreWhatTheCallerSays) {
  const std::string table =
      write("table.csv",
            "# of a tumbler\nnight,mjd,mag,err,sx,sy,sz\n1,51544.5,14.0,0.02,1,2,3\n"
            "2,51546.5,15.0,0.03,4,5,6\n1,51544.75,14.5,0.01,1,2,3\n2,51546.75,15.5,0.03,4,5,6\n");
  LightColumns columns;
  columns.time = "mjd";
  columns.form = LightColumns::Times::julian_dates;
  columns.julian_zero = 2400000.5;
  columns.scale = TimeScale::TT;
  columns.magnitude = "mag";
  columns.sigma = "err";
  columns.to_sun = {"sx", "sy", "sz"};
  columns.session = "night";
  columns.is_calibrated = true;
  columns.times = LightTime::at_body;
  columns.axes = "ecliptic-J2000";
  columns.length = "au";
  const LightCurveFile file = read_light_columns(table, columns);
  EXPECT_EQ(file.epoch, (Date{TimeScale::TT, 2451544.5, 0.0}));
  EXPECT_EQ(file.axes, "ecliptic-J2000");
  ASSERT_EQ(file.sessions.size(), 2U);
  const LightSession& first = file.sessions[0];
  EXPECT_EQ(first.curve.name, "1");
  EXPECT_EQ(first.times, LightTime::at_body);
  EXPECT_THAT(first.lines, ElementsAre(3U, 5U));
  EXPECT_EQ(first.curve.points[1].t, 64800.0);
  EXPECT_EQ(first.curve.points[1].to_sun, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(first.curve.points[1].flux, flux_of({14.5, 0.01}).value);
  EXPECT_EQ(first.curve.points[1].sigma, flux_of({14.5, 0.01}).sigma);
  EXPECT_EQ(message_of([&] { require_sound(file); }), "no error");
  EXPECT_EQ(message_of([&] { require_sound(file, {.vectors = true}); }),
            table +
                ":3: light curve 1, point 1: there is no vector to the observer; expected one, "
                "in the file or from an orbit");
  columns.is_calibrated = false;
  EXPECT_NEAR(mean_flux(read_light_columns(table, columns).sessions[1].curve), 1.0,
              budget::light_flux);
}

TEST_F(LightCurveFiles, InColumnsMayHaveDatesOrPlainTimesAndOneError) {
  const std::string table = write("t", "2013-01-05T00:00:30 1.5\n2013-01-05T00:01:00 1.25\n");
  LightColumns columns;
  columns.time = "1";
  columns.form = LightColumns::Times::dates;
  columns.flux = "2";
  columns.one_sigma = 0.125;
  const LightCurveFile dated = read_light_columns(table, columns);
  EXPECT_EQ(dated.epoch, (Date{TimeScale::UTC, 2456297.5, 0.0}));
  EXPECT_NEAR(dated.sessions[0].curve.points[1].t, 60.0, budget::light_date_s);
  EXPECT_EQ(dated.sessions[0].curve.points[1].sigma, 0.125);
  EXPECT_EQ(dated.sessions[0].curve.name, "");
  EXPECT_EQ(dated.sessions[0].times, std::nullopt);
  const std::string plain = write("p", "0 1.5\n12.25 1.25\n");
  columns.form = LightColumns::Times::numbers;
  const LightCurveFile numbers = read_light_columns(plain, columns);
  EXPECT_EQ(numbers.epoch, std::nullopt);
  EXPECT_EQ(numbers.sessions[0].curve.points[1].t, 12.25);
}

TEST_F(LightCurveFiles, InColumnsSayWhatIsWrong) {
  const std::string table = write("t", "t,m,e\n2451545.0,14,0.1\n2451545.1,140,0.1\n");
  const auto said = [&](const auto& change) {
    LightColumns columns;
    columns.magnitude = "m";
    columns.sigma = "e";
    change(columns);
    return message_of([&] { read_light_columns(table, columns); }).substr(table.size());
  };
  EXPECT_EQ(said([](LightColumns&) {}), ":3: magnitude 140; expected one from -100 to 100");
  EXPECT_EQ(said([](LightColumns& c) { c.flux = "m"; }),
            ": both a column of fluxes and one of magnitudes named; expected one of them");
  EXPECT_EQ(said([](LightColumns& c) { c.magnitude = ""; }),
            ": neither a column of fluxes and one of magnitudes named; expected one of them");
  EXPECT_EQ(said([](LightColumns& c) { c.time = ""; }),
            ": no column of times is named; expected one");
  EXPECT_EQ(said([](LightColumns& c) { c.one_sigma = 0.1; }),
            ": a column of errors and one error of all points; expected one of them");
  EXPECT_EQ(said([](LightColumns& c) { c.to_sun[1] = "e"; }),
            ": 1 columns of a vector to the Sun; expected three or none");
  EXPECT_EQ(said([](LightColumns& c) { c.session = "night"; }),
            ":2: there is no column night; expected one of t, m or e");
  EXPECT_EQ(said([](LightColumns& c) {
              c.form = LightColumns::Times::dates;
              c.magnitude = "e";
            }),
            ":2: column t: \"2451545.0\" it does not start with a date like 2013-01-05");
  EXPECT_EQ(
      said([](LightColumns& c) {
        c.form = LightColumns::Times::julian_dates;
        c.scale = TimeScale::UT1;
      }),
      ": times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC is observed");
  const std::string empty = write("e", "# nothing\n");
  LightColumns columns;
  columns.flux = "1";
  columns.time = "1";
  EXPECT_EQ(message_of([&] { read_light_columns(empty, columns); }),
            empty + ": has no rows; expected points of a light curve");
}

TEST_F(LightCurveFiles, OfColumnsComeBackBitForBit) {
  const std::vector<LightCurve> curves{
      {"a\nb",
       false,
       {{0.1, 1.0 / 3.0, 0.01, {1e8, 1.0, 0.0}, {0.1, 0.2, 0.3}},
        {1e9 / 7.0, 1.0, 0.02, {0.0, 1.0, 0.0}, {1e-300, 0.0, 0.3}}}},
      {"", false, {{-5.0, 2.0, 0.5, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}}};
  const std::vector<std::string> notes{"t in s"};
  write_light_csv(path("a.csv"), curves, notes);
  EXPECT_THAT(text("a.csv"), ::testing::StartsWith(
                                 "# t in s\n# session 1: a\\x0ab, relative\n# session 2: relative\n"
                                 "session,t,flux,sigma,sun_x,sun_y,sun_z,observer_x,observer_y,"
                                 "observer_z\n1,0.1,"));
  const LightCurveFile file = read_light_columns(path("a.csv"), light_csv_columns(true));
  ASSERT_EQ(file.sessions.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(file.sessions[k].curve.points, curves[k].points);
  EXPECT_EQ(file.sessions[0].curve.name, "1");
  const std::vector<LightCurve> plain{{"", true, {{1.0, 2.0, 3.0, {}, {}}}}};
  EXPECT_THAT(light_csv(plain),
              HasSubstr("# session 1: calibrated\nsession,t,flux,sigma\n1,1,2,3\n"));
  EXPECT_THAT(light_csv_columns(false).to_sun, ElementsAre("", "", ""));
}

TEST_F(LightCurveFiles, OfColumnsKeepWhatIsCalibrated) {
  const std::vector<LightCurve> curves{{"", true, {{1.0, 2.0, 3.0, {}, {}}}},
                                       {"", true, {{2.0, 2.0, 3.0, {}, {}}}}};
  write_light_csv(path("a.csv"), curves);
  const LightCurveFile file = read_light_columns(path("a.csv"), light_csv_columns(false, true));
  ASSERT_EQ(file.sessions.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(file.sessions[k].curve.is_calibrated);
    EXPECT_EQ(file.sessions[k].curve.points, curves[k].points);
  }
}

TEST(LightCurvesInColumns, AreNotWrittenAsWhatTheyAreNot) {
  const std::vector<LightCurve> sound{{"", true, {{1.0, 2.0, 3.0, {}, {}}}},
                                      {"", true, {{2.0, 2.0, 3.0, {}, {}}}}};
  const auto said = [&](const auto& change) {
    std::vector<LightCurve> curves = sound;
    change(curves);
    return message_of([&] { light_csv(curves); });
  };
  using Curves = std::vector<LightCurve>;
  EXPECT_EQ(said([](Curves&) {}), "no error");
  EXPECT_EQ(said([](Curves& c) { c.clear(); }),
            "light_csv: there are no light curves; expected one or more");
  EXPECT_EQ(said([](Curves& c) { c[1].points.clear(); }),
            "light_csv: light curve 2 has no points; expected one or more");
  EXPECT_EQ(said([](Curves& c) { c[1].is_calibrated = false; }),
            "light_csv: light curve 2 is relative, light curve 1 is not; expected the same of all "
            "in one table");
  EXPECT_EQ(said([](Curves& c) { c[1].points[0].sigma = std::nan(""); }),
            "light_csv: light curve 2: point 1: got nan; expected finite numbers");
  EXPECT_EQ(said([](Curves& c) { c[0].points[0].to_sun.z = std::nan(""); }),
            "light_csv: light curve 1: point 1: got nan; expected finite numbers");
}

// Mars was nearest to the Earth on 2018-07-31 at 07:50 UTC, 57.59 million km away (NASA/JPL).
TEST(LightCurvesFromOrbits, SeeMarsAsItWasMinutesAgo) {
  const Date noon{TimeScale::TDB, 2458330.5, 8.0 / 24.0};
  const auto at = [&](double t) { return Date{noon.scale, noon.day, noon.fraction + t / 86400.0}; };
  const auto mars = [&](double t) {
    return planetary_position(Planetary::mars, Planetary::sun, at(t));
  };
  const auto earth = [&](double t) {
    return planetary_position(Planetary::earth, Planetary::sun, at(t));
  };
  const auto sun = [](double) { return Vec3{}; };
  const LightCurve curve{"Mars", true, {{0.0, 1.0, 0.1, {}, {}}}};
  const LightCurve seen = with_vectors(curve, LightTime::at_observer, mars, earth, sun, 299792.458);
  const Aspect a = aspect(seen.points[0]);
  EXPECT_NEAR(a.observer_distance, 57.59e6, budget::light_mars_km);
  EXPECT_NEAR(seen.points[0].t, -a.observer_distance / 299792.458, budget::light_date_s);
  EXPECT_NEAR(a.sun_distance, norm(mars(seen.points[0].t)), budget::light_date_s);
}

}  // namespace
}  // namespace polhode
