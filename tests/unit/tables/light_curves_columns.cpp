// SPDX-License-Identifier: MIT
// Light curves in plain columns: read, written, and vectors from orbits.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/light/aspect.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/light/light_time.hpp"
#include "polhode/output/light_curves.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using test::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LightColumnFiles : public test::InTempFolder {};

TEST_F(LightColumnFiles, InColumnsAreWhatTheCallerSays) {
  const std::string table =
      write("table.csv",
            "# of a tumbler\nnight,mjd,mag,err,sx,sy,sz\n1,51544.5,14.0,0.02,1,2,3\n"
            "2,51546.5,15.0,0.03,4,5,6\n1,51544.75,14.5,0.01,1,2,3\n2,51546.75,15.5,0.03,4,5,6\n");
  io::LightColumns columns;
  columns.time = "mjd";
  columns.form = io::LightColumns::Times::julian_dates;
  columns.julian_zero = 2400000.5;
  columns.scale = ephemeris::TimeScale::TT;
  columns.magnitude = "mag";
  columns.sigma = "err";
  columns.to_sun = {"sx", "sy", "sz"};
  columns.session = "night";
  columns.is_calibrated = true;
  columns.times = light::LightTime::at_body;
  columns.axes = "ecliptic-J2000";
  columns.length = "au";
  const io::LightCurveFile file = io::read_light_columns(table, columns);
  EXPECT_EQ(file.epoch, (ephemeris::Date{ephemeris::TimeScale::TT, 2451544.5, 0.0}));
  EXPECT_EQ(file.axes, "ecliptic-J2000");
  ASSERT_EQ(file.sessions.size(), 2U);
  const io::LightSession& first = file.sessions[0];
  EXPECT_EQ(first.curve.name, "1");
  EXPECT_EQ(first.times, light::LightTime::at_body);
  EXPECT_THAT(first.lines, ElementsAre(3U, 5U));
  EXPECT_EQ(first.curve.points[1].t, 64800.0);
  EXPECT_EQ(first.curve.points[1].to_sun, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(first.curve.points[1].flux, light::flux_of({14.5, 0.01}).value);
  EXPECT_EQ(first.curve.points[1].sigma, light::flux_of({14.5, 0.01}).sigma);
  EXPECT_EQ(message_of([&] { require_sound(file); }), "");
  EXPECT_MESSAGE(require_sound(file, {.vectors = true}),
                 table +
                     ":3: light curve 1, point 1 (JD 2451545.000000): there is no vector to the "
                     "observer; expected one, "
                     "in the file or from an orbit");
  columns.is_calibrated = false;
  EXPECT_NEAR(light::mean_flux(io::read_light_columns(table, columns).sessions[1].curve), 1.0,
              budget::light_flux);
}

TEST_F(LightColumnFiles, InColumnsMayHaveDatesOrPlainTimesAndOneError) {
  const std::string table = write("t", "2013-01-05T00:00:30 1.5\n2013-01-05T00:01:00 1.25\n");
  io::LightColumns columns;
  columns.time = "1";
  columns.form = io::LightColumns::Times::dates;
  columns.flux = "2";
  columns.one_sigma = 0.125;
  const io::LightCurveFile dated = io::read_light_columns(table, columns);
  EXPECT_EQ(dated.epoch, (ephemeris::Date{ephemeris::TimeScale::UTC, 2456297.5, 0.0}));
  EXPECT_NEAR(dated.sessions[0].curve.points[1].t, 60.0, budget::light_date_s);
  EXPECT_EQ(dated.sessions[0].curve.points[1].sigma, 0.125);
  EXPECT_EQ(dated.sessions[0].curve.name, "");
  EXPECT_EQ(dated.sessions[0].times, std::nullopt);
  const std::string plain = write("p", "0 1.5\n12.25 1.25\n");
  columns.form = io::LightColumns::Times::numbers;
  const io::LightCurveFile numbers = io::read_light_columns(plain, columns);
  EXPECT_EQ(numbers.epoch, std::nullopt);
  EXPECT_EQ(numbers.sessions[0].curve.points[1].t, 12.25);
}

TEST_F(LightColumnFiles, InColumnsSayWhatIsWrong) {
  const std::string table = write("t", "t,m,e\n2451545.0,14,0.1\n2451545.1,140,0.1\n");
  const auto said = [&](const auto& change) {
    io::LightColumns columns;
    columns.magnitude = "m";
    columns.sigma = "e";
    change(columns);
    return message_of([&] { io::read_light_columns(table, columns); }).substr(table.size());
  };
  EXPECT_EQ(said([](io::LightColumns&) {}), ":3: magnitude 140; expected one from -100 to 100");
  EXPECT_EQ(said([](io::LightColumns& c) { c.flux = "m"; }),
            ": both a column of fluxes and one of magnitudes named; expected one of them");
  EXPECT_EQ(said([](io::LightColumns& c) { c.magnitude = ""; }),
            ": neither a column of fluxes and one of magnitudes named; expected one of them");
  EXPECT_EQ(said([](io::LightColumns& c) { c.time = ""; }),
            ": no column of times is named; expected one");
  EXPECT_EQ(said([](io::LightColumns& c) { c.one_sigma = 0.1; }),
            ": a column of errors and one error of all points; expected one of them");
  EXPECT_EQ(said([](io::LightColumns& c) { c.to_sun[1] = "e"; }),
            ": 1 columns of a vector to the Sun; expected three or none");
  EXPECT_EQ(said([](io::LightColumns& c) { c.session = "night"; }),
            ":2: there is no column night; expected one of t, m or e");
  EXPECT_EQ(said([](io::LightColumns& c) {
              c.form = io::LightColumns::Times::dates;
              c.magnitude = "e";
            }),
            ":2: column t: \"2451545.0\" it does not start with a date like 2013-01-05");
  EXPECT_EQ(
      said([](io::LightColumns& c) {
        c.form = io::LightColumns::Times::julian_dates;
        c.scale = ephemeris::TimeScale::UT1;
      }),
      ": times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC is observed");
  const std::string empty = write("e", "# nothing\n");
  io::LightColumns columns;
  columns.flux = "1";
  columns.time = "1";
  EXPECT_MESSAGE(io::read_light_columns(empty, columns),
                 empty + ": has no rows; expected points of a light curve");
}

TEST_F(LightColumnFiles, SessionsHaveNamesAndErrorsMayBeEmpty) {
  io::LightColumns columns;
  columns.flux = "f";
  columns.sigma = "e";
  columns.session = "s";
  const io::LightCurveFile file = io::read_light_columns(
      write("named",
            "t;f;e;s\n1;1.0;;B 2021-03-01\n2;1.1;0.1;1.0\n3;1.2;0.1;B 2021-03-01\n"
            "4;1.0;0.1;1\n"),
      columns);
  ASSERT_EQ(file.sessions.size(), 2U);
  EXPECT_EQ(file.sessions[0].curve.name, "B 2021-03-01");
  EXPECT_EQ(file.sessions[1].curve.name, "1");
  EXPECT_THAT(file.sessions[0].lines, ElementsAre(2U, 4U));
  EXPECT_EQ(file.sessions[0].curve.points[0].sigma, 0.0);
  EXPECT_REJECTED(require_sound(file), "error 0; expected one above 0");
}

TEST_F(LightColumnFiles, LinesThatAreLeftOutAreNotChecked) {
  io::LightColumns columns;
  columns.magnitude = "m";
  columns.sigma = "e";
  columns.session = "s";
  const std::string table =
      write("bad",
            "s,t,m,e\n,x,14,0.1\nA,1,14,0.1\nB,2,nan,0.1\nA,3,900,0.1\nA,4,15,\nB,5\nC,6,14,0.1\n");
  EXPECT_REJECTED(io::read_light_columns(table, columns), "bad:2: column");
  columns.leave_out = {2, 4, 5, 7};
  const io::LightCurveFile file = io::read_light_columns(table, columns);
  ASSERT_EQ(file.sessions.size(), 3U);  // as they are counted without leave_out
  EXPECT_EQ(file.sessions[0].curve.name, "A");
  EXPECT_THAT(file.sessions[0].lines, ElementsAre(3U, 6U));
  EXPECT_THAT(file.sessions[0].left_out, ElementsAre(2U, 5U));
  EXPECT_EQ(file.sessions[0].curve.points[1].sigma, 0.0);
  EXPECT_NEAR(light::mean_flux(file.sessions[0].curve), 1.0, budget::light_flux);
  EXPECT_TRUE(file.sessions[1].curve.points.empty());
  EXPECT_THAT(file.sessions[1].left_out, ElementsAre(4U, 7U));
  EXPECT_THAT(file.sessions[2].lines, ElementsAre(8U));
}

TEST_F(LightColumnFiles, OfColumnsComeBackBitForBit) {
  const std::vector<light::LightCurve> curves{
      {"a\nb",
       false,
       {{0.1, 1.0 / 3.0, 0.01, {1e8, 1.0, 0.0}, {0.1, 0.2, 0.3}},
        {1e9 / 7.0, 1.0, 0.02, {0.0, 1.0, 0.0}, {1e-300, 0.0, 0.3}}}},
      {"", false, {{-5.0, 2.0, 0.5, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}}};
  const std::vector<std::string> notes{"t in s"};
  io::write_light_csv(path("a.csv"), curves, notes);
  EXPECT_THAT(text("a.csv"), ::testing::StartsWith(
                                 "# t in s\n# session 1: a\\x0ab, relative\n# session 2: relative\n"
                                 "session,t,flux,sigma,sun_x,sun_y,sun_z,observer_x,observer_y,"
                                 "observer_z\n1,0.1,"));
  const io::LightCurveFile file =
      io::read_light_columns(path("a.csv"), io::light_csv_columns(true));
  ASSERT_EQ(file.sessions.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(file.sessions[k].curve.points, curves[k].points);
  EXPECT_EQ(file.sessions[0].curve.name, "1");
  const std::vector<light::LightCurve> plain{{"", true, {{1.0, 2.0, 3.0, {}, {}}}}};
  EXPECT_THAT(io::light_csv(plain),
              HasSubstr("# session 1: calibrated\nsession,t,flux,sigma\n1,1,2,3\n"));
  EXPECT_THAT(io::light_csv_columns(false).to_sun, ElementsAre("", "", ""));
}

TEST_F(LightColumnFiles, OfColumnsKeepWhatIsCalibrated) {
  const std::vector<light::LightCurve> curves{{"", true, {{1.0, 2.0, 3.0, {}, {}}}},
                                              {"", true, {{2.0, 2.0, 3.0, {}, {}}}}};
  io::write_light_csv(path("a.csv"), curves);
  const io::LightCurveFile file =
      io::read_light_columns(path("a.csv"), io::light_csv_columns(false, true));
  ASSERT_EQ(file.sessions.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(file.sessions[k].curve.is_calibrated);
    EXPECT_EQ(file.sessions[k].curve.points, curves[k].points);
  }
}

TEST(LightCurvesInColumns, AreNotWrittenAsWhatTheyAreNot) {
  const std::vector<light::LightCurve> sound{{"", true, {{1.0, 2.0, 3.0, {}, {}}}},
                                             {"", true, {{2.0, 2.0, 3.0, {}, {}}}}};
  const auto said = [&](const auto& change) {
    std::vector<light::LightCurve> curves = sound;
    change(curves);
    return message_of([&] { io::light_csv(curves); });
  };
  using Curves = std::vector<light::LightCurve>;
  EXPECT_EQ(said([](Curves&) {}), "");
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
  const ephemeris::Date noon{ephemeris::TimeScale::TDB, 2458330.5, 8.0 / 24.0};
  const auto at = [&](double t) {
    return ephemeris::Date{noon.scale, noon.day, noon.fraction + t / 86400.0};
  };
  const auto mars = [&](double t) {
    return ephemeris::planetary_position(ephemeris::Planetary::mars, ephemeris::Planetary::sun,
                                         at(t));
  };
  const auto earth = [&](double t) {
    return ephemeris::planetary_position(ephemeris::Planetary::earth, ephemeris::Planetary::sun,
                                         at(t));
  };
  const auto sun = [](double) { return Vec3{}; };
  const light::LightCurve curve{"Mars", true, {{0.0, 1.0, 0.1, {}, {}}}};
  const light::LightCurve seen =
      light::with_vectors(curve, light::LightTime::at_observer, mars, earth, sun, 299792.458);
  const light::Aspect a = light::aspect(seen.points[0]);
  EXPECT_NEAR(a.observer_distance, 57.59e6, budget::light_mars_km);
  EXPECT_NEAR(seen.points[0].t, -a.observer_distance / 299792.458, budget::light_date_s);
  EXPECT_NEAR(a.sun_distance, norm(mars(seen.points[0].t)), budget::light_date_s);
}

}  // namespace
}  // namespace polhode
