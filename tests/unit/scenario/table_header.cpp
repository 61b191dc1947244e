// SPDX-License-Identifier: MIT
// What a table says of itself above its rows is held against how a scenario reads it.
#include <gmock/gmock.h>

#include <string>

#include "message_of.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario_text.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class TableHeaders : public test::InTempFolder {
 protected:
  // "", or what is refused of a scenario that reads moon.csv.
  std::string error_of(const std::string& header, const std::string& keys = "") const {
    write("moon.csv", header + rows_);
    return error_of_keys("[orbit.moon]\nkind = \"table\"\nfile = \"moon.csv\"\n" + keys);
  }
  std::string error_of_keys(const std::string& more) const {
    const std::string text =
        test::scenario_text(more, {.units = "[units]\n" + units_, .state = "[state]\n" + state_});
    std::string what =
        test::message_of<io::ScenarioError>([&] { io::scenario_from_text(text, path("f.toml")); });
    const std::string folder = path("");
    for (std::size_t at = what.find(folder); at != std::string::npos; at = what.find(folder))
      what.erase(at, folder.size());
    return what;
  }
  std::string units_ = "time = \"s\"\nlength = \"km\"\n";
  std::string state_ = "epoch = \"2029-04-13T00:00:00 UTC\"\naxes = \"equator-J2000\"\n";
  std::string rows_ =
      "0,7000,0,0,0,7.5,0\n60,6986,452,0,-0.5,7.5,0\n120,6944,903,0,-0.9,7.4,0\n"
      "180,6875,1349,0,-1.4,7.4,0\n";
};

const std::string satellite =
    "# ISS, SGP4; t in s after 2029-04-13T00:00:00.000 UTC; km; equator-J2000\n"
    "# t,x,y,z,vx,vy,vz\n";

TEST_F(TableHeaders, OfThisScenarioAreTaken) {
  EXPECT_EQ(error_of(satellite), "");
  EXPECT_EQ(
      error_of("# ISS; a name; t in s after 2029-04-13T00:00:00.000 UTC; km; equator-J2000\n"), "");
  EXPECT_EQ(error_of("# t counts from 2029-04-13T00:00:00 UTC; axes: equator-J2000\n"
                     "# | epoch: 1999-01-01 UTC\n# units: t [s], x [km]\nt,x,y,z,vx,vy,vz\n"),
            "");
  // the same instant in another scale: TAI - UTC was 37 s
  EXPECT_EQ(error_of("# epoch: 2029-04-13T00:00:37 TAI\n"), "");
  EXPECT_EQ(error_of("# t counts from the epoch; axes: as in the paper; t in the sky\n"), "");
}

TEST_F(TableHeaders, OfAnotherEpochAreRefused) {
  state_ = "epoch = \"2029-04-14T00:00:00 UTC\"\naxes = \"equator-J2000\"\n";
  for (const std::string& header :
       {satellite, std::string("# t counts from 2029-04-13T00:00:00 UTC; axes: equator-J2000\n")})
    EXPECT_THAT(error_of(header),
                AllOf(StartsWith("f.toml:15:8: orbit.moon.file: got \"moon.csv\"; moon.csv:1: t "
                                 "counts from 2029-04-13T00:00:00"),
                      HasSubstr("-86400 s after epoch = \"2029-04-14T00:00:00 UTC\"; expected a "
                                "table from that epoch on")));
  state_ = "epoch = \"2029-04-13T00:00:00.002 UTC\"\naxes = \"equator-J2000\"\n";
  EXPECT_THAT(error_of(satellite), HasSubstr("s after epoch"));
  state_ = "axes = \"equator-J2000\"\n";
  EXPECT_THAT(error_of(satellite),
              HasSubstr("expected epoch = \"2029-04-13T00:00:00.000 UTC\" in [state]"));
  EXPECT_THAT(error_of("# t counts from 2029-13-13T00:00:00 UTC\n"), HasSubstr("expected epoch"));
  state_ = "epoch = \"2029-04-13T00:00:00 UTC\"\naxes = \"equator-J2000\"\n";
  EXPECT_THAT(error_of("# t counts from 2029-13-13T00:00:00 UTC\n"), HasSubstr("f.toml:15:8: "));
}

TEST_F(TableHeaders, OfOtherAxesAreRefused) {
  state_ = "epoch = \"2029-04-13T00:00:00 UTC\"\naxes = \"ecliptic-J2000\"\n";
  EXPECT_THAT(error_of(satellite),
              HasSubstr("moon.csv:1: its axes are equator-J2000; expected axes = \"equator-J2000\" "
                        "with the file or in [state], not \"ecliptic-J2000\""));
  EXPECT_EQ(error_of(satellite, "axes = \"equator-J2000\"\n"), "");
  EXPECT_THAT(error_of("# axes: TEME\n"),
              HasSubstr("moon.csv:1: its axes are TEME; expected \"inertial\", "));
  EXPECT_THAT(error_of("# AXES: equator-J2000; Epoch: 2029-04-14\n"), HasSubstr("its axes are"));
  state_ = "epoch = \"2029-04-13T00:00:00 UTC\"\n";  // axes that nobody names
  EXPECT_THAT(error_of(satellite), HasSubstr("not \"inertial\""));
}

TEST_F(TableHeaders, OfOtherUnitsAreRefused) {
  units_ = "time = \"h\"\nlength = \"km\"\n";
  EXPECT_THAT(error_of(satellite),
              HasSubstr("moon.csv:1: column t is in s; expected time_unit = \"s\" with the file"));
  EXPECT_EQ(error_of(satellite, "time_unit = \"s\"\n"), "");
  units_ = "time = \"s\"\nlength = \"m\"\n";
  EXPECT_THAT(error_of(satellite), HasSubstr("column x is in km; expected length_unit = \"km\""));
  units_ = "time = \"s\"\n";  // lengths of no unit
  EXPECT_EQ(error_of(satellite), "");
  units_ = "time = \"s\"\nlength = \"km\"\n";
  const std::string units =
      "# units: t [s], x [km], y [km], z [m], vx [km/s], vy [m/s], vz [km/s]\n";
  EXPECT_THAT(error_of(units + "t,x,y,z,vx,vy,vz\n"), HasSubstr("column z is in m; expected"));
  for (const char* unit : {"deg", "furlong"})
    EXPECT_THAT(error_of("# units: t [s], x [" + std::string(unit) + "]\nt,x,y,z,vx,vy,vz\n"),
                HasSubstr("moon.csv:1: column x: "))
        << unit;
  EXPECT_THAT(error_of(units + "t,x,y,z,vx,vy,vz\n",
                       "columns = [\"1\", \"2\", \"3\", \"3\", \"5\", \"6\", \"7\"]\n"),
              HasSubstr("column vy is in m/s; expected velocity_unit = \"m/s\""));
}

TEST_F(TableHeaders, OfHorizonsAreHeldAgainstTheScenario) {
  const auto banner = [](const std::string& units, const std::string& frame) {
    return "*****\nOutput units    : " + units + "\nReference frame : " + frame +
           "\n*****\n JDTDB, X, Y, Z,\n*****\n$$SOE\n";
  };
  rows_.clear();
  for (int k = 0; k < 12; ++k)
    rows_ += std::to_string(2462239.5 + k) + ", 7000, " + std::to_string(10 * k) + ", 0,\n";
  rows_ += "$$EOE\n";
  const std::string keys =
      "columns = [\"JDTDB\", \"X\", \"Y\", \"Z\"]\ntime_format = \"JD\"\ntime_scale = \"TDB\"\n";
  EXPECT_EQ(error_of(banner("KM-S", "ICRF"), keys), "");
  EXPECT_THAT(error_of(banner("AU-D", "ICRF"), keys),
              HasSubstr("moon.csv:2: column X is in au; expected length_unit = \"au\""));
  EXPECT_EQ(error_of(banner("AU-D", "ICRF"), keys + "length_unit = \"au\"\n"), "");
  for (const char* frame : {"FK4/B1950", "Earth mean equator of date", "Ecliptic of date"})
    EXPECT_THAT(error_of(banner("KM-S", frame), keys),
                HasSubstr("its axes are " + std::string(frame)));
  EXPECT_THAT(error_of(banner("KM-S", "Ecliptic of J2000.0"), keys),
              HasSubstr("moon.csv:3: its axes are ecliptic-J2000; expected axes"));
  EXPECT_THAT(error_of(banner("KM-S", "ICRF"),
                       "columns = [\"JDTDB\", \"X\", \"Y\", \"Z\"]\ntime_format = \"JD\"\n"),
              HasSubstr("its column \"JDTDB\" holds dates in TDB; expected time_scale = \"TDB\""));
}

TEST_F(TableHeaders, OfTorquesAreHeldAgainstTheScenario) {
  const std::string term =
      "[[perturbation]]\nkind = \"torque-table\"\nfile = \"moon.csv\"\ntorque_unit = \"N m\"\n";
  units_ = "time = \"s\"\nmoment = \"kg m2\"\n";
  rows_ = "0,1,2,3\n60,1,2,3\n120,1,2,3\n180,1,2,3\n";
  write("moon.csv",
        "# t counts from 2029-04-13 UTC\n# units: t [s], u1 [N m]\nt,u1,u2,u3\n" + rows_);
  EXPECT_EQ(error_of_keys(term), "");
  write("moon.csv", "# t counts from 2029-04-12 UTC\n" + rows_);
  EXPECT_THAT(error_of_keys(term), HasSubstr("moon.csv:1: t counts from 2029-04-12 UTC, -86400 s"));
  write("moon.csv", "# units: t [min], u1 [N m]\nt,u1,u2,u3\n" + rows_);
  EXPECT_THAT(error_of_keys(term), HasSubstr("column t is in min; expected time_unit = \"min\""));
  write("moon.csv", "# units: t [s], u1 [N m], u2 [kg km2/s2]\nt,u1,u2,u3\n" + rows_);
  EXPECT_THAT(error_of_keys(term),
              HasSubstr("column u2 is in kg km2/s2; expected torque_unit = \"kg km2/s2\""));
  write("moon.csv", "# axes: equator-J2000\nt,u1,u2,u3\n" + rows_);
  EXPECT_THAT(error_of_keys(term),
              HasSubstr("moon.csv:1: its axes are equator-J2000; expected torques along "
                        "\"equator-J2000\", not axes = \"body\""));
  EXPECT_EQ(error_of_keys(term + "axes = \"inertial\"\n"), "");
  write("moon.csv", "# axes: body\nt,u1,u2,u3\n" + rows_);
  EXPECT_EQ(error_of_keys(term), "");
}

}  // namespace
}  // namespace polhode
