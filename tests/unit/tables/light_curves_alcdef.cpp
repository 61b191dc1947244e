// SPDX-License-Identifier: MIT
// Light curves in ALCDEF: what the file declares, and what is said of what is wrong.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "unit/tables/changed_text.hpp"

namespace polhode {
namespace {

using test::changed_text;
using test::message_of;
using ::testing::ElementsAre;

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
  return message_of([&] { io::alcdef_from_text(changed_text(two_sessions, old, by), "x.txt"); });
}

TEST(LightCurvesOfAlcdef, AreReadWithWhatTheFileDeclares) {
  const io::LightCurveFile file = io::alcdef_from_text(two_sessions, "x.txt");
  EXPECT_EQ(file.object, "999 Zachia");
  EXPECT_EQ(file.epoch, (ephemeris::Date{ephemeris::TimeScale::UTC, 2451425.5, 0.0}));
  EXPECT_EQ(file.axes, "");
  ASSERT_EQ(file.sessions.size(), 2U);
  const io::LightSession &first = file.sessions[0], &second = file.sessions[1];
  EXPECT_EQ(first.curve.name, "1999-09-04 06:00:00 C");
  EXPECT_FALSE(first.curve.is_calibrated);
  EXPECT_EQ(first.times, light::LightTime::at_observer);
  EXPECT_NEAR(*first.light_time, 0.006465 * 86400.0, budget::light_date_s);
  EXPECT_EQ(first.distances, io::Distances::of_the_time);
  EXPECT_EQ(first.band, "R");
  EXPECT_EQ(first.line, 1U);
  EXPECT_THAT(first.lines, ElementsAre(33U, 34U, 35U, 36U));
  EXPECT_THAT(first.notes, ::testing::Contains(std::pair<std::string, std::string>(
                               "COMMENT", "and a second, with a = b")));
  EXPECT_THAT(first.notes,
              ::testing::Contains(std::pair<std::string, std::string>("UCORMAG", "-1.8189")));
  EXPECT_TRUE(second.curve.is_calibrated);
  EXPECT_EQ(second.times, light::LightTime::at_body);
  EXPECT_EQ(second.light_time, std::nullopt);
  EXPECT_EQ(second.distances, io::Distances::unit);
  EXPECT_EQ(second.band, "V");
  EXPECT_THAT(second.lines, ElementsAre(51U, 52U));
}

TEST(LightCurvesOfAlcdef, LinesThatAreLeftOutAreNotChecked) {
  const std::string bad = changed_text(two_sessions, "2451425.653700|-0.125", "|faint");
  EXPECT_EQ(message_of([&] { io::alcdef_from_text(bad, "x.txt"); }).substr(0, 9), "x.txt:34:");
  const std::vector<std::size_t> leave_out = {34, 51, 52};
  const io::LightCurveFile file = io::alcdef_from_text(bad, "x.txt", std::nullopt, leave_out);
  ASSERT_EQ(file.sessions.size(), 2U);
  EXPECT_THAT(file.sessions[0].lines, ElementsAre(33U, 35U, 36U));
  EXPECT_THAT(file.sessions[0].left_out, ElementsAre(34U));
  EXPECT_TRUE(file.sessions[1].curve.points.empty());
  EXPECT_THAT(file.sessions[1].left_out, ElementsAre(51U, 52U));
}

TEST(LightCurvesOfAlcdef, MagnitudesBecomeFluxes) {
  const io::LightCurveFile file = io::alcdef_from_text(two_sessions, "x.txt");
  const std::vector<light::LightPoint>& relative = file.sessions[0].curve.points;
  EXPECT_NEAR(relative[0].t, 0.150521 * 86400.0, budget::light_date_s);
  EXPECT_NEAR(light::mean_flux(file.sessions[0].curve), 1.0, budget::light_flux);
  EXPECT_NEAR(-2.5 * std::log10(relative[0].flux / relative[2].flux), -0.147,
              budget::light_magnitude);
  EXPECT_NEAR(relative[0].sigma / relative[0].flux, 0.009 * 0.4 * std::log(10.0),
              budget::light_flux);
  EXPECT_EQ(relative[3].sigma, 0.0);
  EXPECT_EQ(relative[0].to_sun, Vec3{});
  const light::Magnitude back =
      light::magnitude_of({relative[1].flux, relative[1].sigma}, *file.sessions[0].zero_magnitude);
  EXPECT_NEAR(back.value, -0.125, budget::light_magnitude);
  EXPECT_NEAR(back.sigma, 0.010, budget::light_flux);
  const light::LightPoint& calibrated = file.sessions[1].curve.points[1];
  EXPECT_NEAR(calibrated.flux / std::pow(10.0, -5.44), 1.0, budget::light_flux);
  EXPECT_EQ(file.sessions[1].zero_magnitude, 0.0);
  EXPECT_MESSAGE(
      require_sound(file),
      "x.txt:36: light curve 1, point 4 (JD 2451425.657000): error 0; expected one above 0");
}

TEST(LightCurvesOfAlcdef, WhatIsNotDeclaredIsNotGuessed) {
  const auto session = [](const std::string& old, const std::string& by) {
    return io::alcdef_from_text(changed_text(two_sessions, old, by), "x").sessions[1];
  };
  EXPECT_EQ(session("LTCAPP=AVERAGE\n", "").times, std::nullopt);
  EXPECT_EQ(session("LTCAPP=AVERAGE\n", "LTCAPP=HELIOCENTRIC\n").times, std::nullopt);
  EXPECT_EQ(session("LTCAPP=AVERAGE\n", "LTCAPP=POINT\n").times, light::LightTime::at_body);
  EXPECT_EQ(session("REDUCEDMAGS=POINT\n", "").distances, io::Distances::unknown);
  for (const char* standard : {"", "STANDARD=NONE\n", "STANDARD=INTERNAL\n"})
    EXPECT_FALSE(session("STANDARD=APASS\n", standard).curve.is_calibrated);
  EXPECT_FALSE(session("DIFFERMAGS=FALSE\n", "").curve.is_calibrated);
  EXPECT_EQ(session("FILTER=V\n", "filter=v\n").band, "v");
}

TEST(LightCurvesOfAlcdef, ASessionMayEndWithoutSayingSo) {
  for (const std::string& end : {changed_text(two_sessions, "ENDDATA\n\n", ""),
                                 two_sessions.substr(0, two_sessions.rfind("ENDDATA"))})
    EXPECT_EQ(io::alcdef_from_text(end, "x").sessions.size(), 2U);
}

TEST(LightCurvesOfAlcdef, OneLineSaysWhatIsWrongAndWhere) {
  EXPECT_MESSAGE(io::alcdef_from_text("\n", "x.txt"),
                 "x.txt:1: has no session; expected STARTMETADATA");
  EXPECT_MESSAGE(io::alcdef_from_text(two_sessions, "x.txt",
                                      ephemeris::Date{ephemeris::TimeScale::UT1, 2451425.5, 0.0}),
                 "x.txt: times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC "
                 "is observed");
  EXPECT_EQ(alcdef_refusal("STARTMETADATA\n", "JD,MAG\n"),
            "x.txt:1: got \"JD,MAG\"; expected STARTMETADATA");
  EXPECT_EQ(alcdef_refusal("STARTMETADATA\n", ""),
            "x.txt:1: got \"REVISEDDATA\"; expected STARTMETADATA");
  EXPECT_EQ(alcdef_refusal("PABB=+12.9", "12.9"),
            "x.txt:15: got \"12.9\"; expected KEYWORD=VALUE or ENDMETADATA");
  EXPECT_EQ(alcdef_refusal("MAGBAND=R", "FILTER=R"),
            "x.txt:17: FILTER is there twice, \"C\" and \"R\"");
  EXPECT_EQ(alcdef_refusal("MAGBAND=R", "COMPNAME1=a\nEPOCH=J2000\nEPOCH=J2000.0"), "");
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
      "x.txt:49: OBJECTNUMBER: got \"5\"; expected 999, as in the session of line 1: one object a "
      "file");
  EXPECT_EQ(alcdef_refusal("ENDDATA\n\n", "ENDDATA\nmore\n"),
            "x.txt:38: got \"more\"; expected STARTMETADATA");
  const std::size_t rows = two_sessions.find("DATA=2451426.65");
  EXPECT_MESSAGE(io::alcdef_from_text(two_sessions.substr(0, rows), "x.txt"),
                 "x.txt:50: the session of line 39 has no points; expected DATA=...");
  EXPECT_MESSAGE(io::alcdef_from_text(two_sessions.substr(0, 100), "x.txt"),
                 "x.txt:6: the file ends before ENDMETADATA");
}

TEST(LightCurvesOfAlcdef, CalibratedSessionsNeedOneScale) {
  std::string both = changed_text(two_sessions, "DIFFERMAGS=TRUE", "DIFFERMAGS=FALSE");
  both = changed_text(both, "STANDARD=INTERNAL", "STANDARD=APASS");
  both = changed_text(both, "DATA=2451425.657000|0.021\n", "");
  const auto said = [](const std::string& text) {
    return message_of([&] { io::require_sound(io::alcdef_from_text(text, "x.txt")); });
  };
  EXPECT_EQ(said(both),
            "x.txt:38: calibrated fluxes in the band \"V\" have no scale in common with \"R\" of "
            "the session of line 1; expected one band, or relative sessions");
  both = changed_text(both, "MAGBAND=R", "MAGBAND=V");
  EXPECT_EQ(said(both),
            "x.txt:38: calibrated fluxes at unit distances, those of the session of line 1 are at "
            "the distances of the time; expected the same");
  EXPECT_EQ(said(changed_text(both, "REDUCEDMAGS=POINT", "REDUCEDMAGS=NONE")), "");
}

TEST(LightCurvesOfAlcdef, AreOfOneObjectHoweverItIsNamed) {
  const auto session = [](const std::string& names) {
    return "STARTMETADATA\n" + names + "DELIMITER=PIPE\nENDMETADATA\nDATA=2451426.65|13.5\n";
  };
  const auto said = [](const std::string& text) {
    return message_of([&] { io::alcdef_from_text(text, "x.txt"); });
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
            "");
  const io::LightCurveFile file = io::alcdef_from_text(
      session(unnamed) + session("OBJECTNUMBER=999\nMPCDESIG=2005 AB\n"), "x.txt");
  EXPECT_EQ(file.object, "999 2005 AB");
}

// A first session that does not say its distances hides nothing of the others.
TEST(LightCurvesOfAlcdef, DistancesThatAreKnownMustBeTheSame) {
  const auto session = [](std::size_t line, io::Distances distances, double t) {
    io::LightSession made;
    made.curve = {"", true, {{t, 1.0, 0.1, {}, {}}}};
    made.distances = distances;
    made.line = line;
    made.lines = {line + 1};
    return made;
  };
  io::LightCurveFile file;
  file.file = "x.txt";
  file.sessions = {session(1, io::Distances::unknown, 1.0), session(11, io::Distances::unit, 2.0),
                   session(21, io::Distances::unknown, 3.0),
                   session(31, io::Distances::of_the_time, 4.0)};
  EXPECT_MESSAGE(require_sound(file),
                 "x.txt:31: calibrated fluxes at the distances of the time, those of the session "
                 "of line 11 are at unit distances; expected the same");
  file.sessions.pop_back();
  EXPECT_EQ(message_of([&] { require_sound(file); }), "");
}

TEST(LightCurvesOfAlcdef, WhatIsWrittenIsReadBack) {
  const ephemeris::Date epoch =
      ephemeris::calendar_date(ephemeris::TimeScale::UTC, {2016, 12, 31, 23, 0, 0.0});
  std::vector<light::LightCurve> curves{
      {"a", false, {{0.0, 0.5, 0.01}, {3599.5, 0.25, 0.02}, {3602.0, 2.25, 0.0}}},  // leap second
      {"b", true, {{86400.0, 2.0, 0.01}}}};
  for (const bool is_of_the_time : {false, true})
    for (const light::LightTime times :
         {light::LightTime::at_body, light::LightTime::at_observer}) {
      const std::string text = io::alcdef_text(curves, epoch,
                                               {.object = "Two\nLines",
                                                .times = times,
                                                .is_of_the_time = is_of_the_time,
                                                .notes = {"x"}});
      const io::LightCurveFile file = io::alcdef_from_text(text, "x.alcdef", epoch);
      EXPECT_EQ(file.object, "Two\\x0aLines");
      ASSERT_EQ(file.sessions.size(), 2U);
      for (std::size_t c = 0; c < 2; ++c) {
        const io::LightSession& session = file.sessions[c];
        EXPECT_EQ(session.times, times);
        EXPECT_EQ(session.distances,
                  is_of_the_time ? io::Distances::of_the_time : io::Distances::unit);
        EXPECT_EQ(session.curve.is_calibrated, curves[c].is_calibrated);
        ASSERT_EQ(session.curve.points.size(), curves[c].points.size());
        for (std::size_t k = 0; k < curves[c].points.size(); ++k) {
          const light::LightPoint &got = session.curve.points[k], &expected = curves[c].points[k];
          EXPECT_NEAR(got.t, expected.t, budget::light_julian_s);
          EXPECT_NEAR(got.flux, expected.flux, budget::light_flux * expected.flux);
          EXPECT_NEAR(got.sigma, expected.sigma, budget::light_flux * expected.sigma);
        }
      }
      EXPECT_EQ(file.sessions[0].curve.name, "2016-12-31 23:00:00");
    }
  curves[0].points[1].flux = 0.0;
  EXPECT_MESSAGE(io::alcdef_text(curves, epoch, {}),
                 "alcdef_text: light curve 1: point 2: expected a finite time and a flux above 0, "
                 "which has a magnitude");
  EXPECT_MESSAGE(io::alcdef_text({}, epoch, {}),
                 "alcdef_text: there are no light curves; expected one or more");
  EXPECT_MESSAGE(io::alcdef_text(std::vector<light::LightCurve>(1), epoch, {}),
                 "alcdef_text: light curve 1 has no points; expected one or more");
}

}  // namespace
}  // namespace polhode
