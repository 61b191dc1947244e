// SPDX-License-Identifier: MIT
// [orbit.NAME] of every kind: what is made of it, and what is refused.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/oblate_motion.hpp"
#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/run/summary.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario_text.hpp"
#include "temp_folder.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;

class ScenarioOrbits : public test::InTempFolder {
 protected:
  io::Scenario read(const std::string& orbit, const std::string& more = "") const {
    return io::scenario_from_text(
        test::scenario_text("[orbit.moon]\n" + orbit + more,
                            {.units = units_, .state = "[state]\n" + state_}),
        path("f.toml"));
  }
  std::string error_of(const std::string& orbit, const std::string& more = "") const {
    return test::message_of<io::ScenarioError>([&] { read(orbit, more); });
  }
  static Vec3 at(const io::Scenario& s, double t) {
    return io::any_orbit(s.rotation().orbits.at(0)).position(t);
  }

  std::string units_ = "[units]\ntime = \"s\"\nangle = \"deg\"\nlength = \"km\"\n";
  std::string state_ = "axes = \"equator-J2000\"\n";
};

const std::string leo =
    "kind = \"state\"\ngm = 398600.4418\nposition = [7000, 100, 300]\n"
    "velocity = [-0.5, 5, 5.6]\n";

TEST_F(ScenarioOrbits, AStateIsTheKeplerOrbitThroughIt) {
  const io::Scenario s = read(leo + "epoch = 100\n");
  EXPECT_EQ(s.rotation().orbits[0].gm, 398600.4418);
  EXPECT_LT(norm(at(s, 100.0) - Vec3{7000.0, 100.0, 300.0}), budget::table_orbit_kepler * 7000.0);
  EXPECT_LT(norm(io::any_orbit(s.rotation().orbits[0]).velocity(100.0) - Vec3{-0.5, 5.0, 5.6}),
            budget::table_orbit_kepler * 10.0);
}

// The node of a polar-like orbit falls back at the rate that j2_rates gives.
TEST_F(ScenarioOrbits, AnOblatePrimaryTurnsIt) {
  const io::Scenario s = read(leo + "J2 = 1.0826e-3\nradius = 6378.137\n");
  const auto& motion = std::get<PrecessingKeplerOrbit>(s.rotation().orbits[0].motion);
  EXPECT_EQ(motion.rates(), j2_rates(motion.elements(), 1.0826e-3, 6378.137));
  EXPECT_LT(motion.rates().node, 0.0);
  // the same orbit, given and asked for along other axes
  state_ = "axes = \"ecliptic-J2000\"\n";
  const io::Scenario turned =
      read(leo + "axes = \"equator-J2000\"\nJ2 = 1.0826e-3\nradius = 6378.137\n");
  const double e = 84381.448 / 3600.0 * std::numbers::pi / 180.0;
  for (const double t : {0.0, 1e5}) {
    const Vec3 x = at(s, t), y = at(turned, t);
    EXPECT_LT(norm(y - Vec3{x.x, std::cos(e) * x.y + std::sin(e) * x.z,
                            std::cos(e) * x.z - std::sin(e) * x.y}),
              budget::table_orbit_kepler * 7000.0);
  }
  EXPECT_TRUE(io::any_orbit(turned.rotation().orbits[0]).supports_velocity());
}

// And it is where the force of J2 takes it, a day later too.
TEST_F(ScenarioOrbits, AnOblatePrimaryKeepsItNear) {
  const io::Scenario s = read(leo + "J2 = 1.0826e-3\nradius = 6378.137\n");
  const oracle::OblateMotion motion(398600.4418, 1.0826e-3, 6378.137);
  oracle::PointState point{{7000.0, 100.0, 300.0}, {-0.5, 5.0, 5.6}};
  for (int i = 0; i < 8640; ++i) {
    EXPECT_LE(norm(at(s, 10.0 * i) - point.x), budget::j2_low_orbit_km) << i;
    point = motion.after(point, 10.0);
  }
}

TEST_F(ScenarioOrbits, StatesThatCannotBeSayWhy) {
  EXPECT_THAT(error_of(leo + "J2 = 1e-3\n"), HasSubstr("expected a key radius as well"));
  EXPECT_THAT(error_of(leo + "J2 = 1e-3\nradius = -1\n"), HasSubstr("expected a positive length"));
  EXPECT_THAT(error_of("kind = \"state\"\ngm = 1\nposition = [1, 0, 0]\nvelocity = [1, 0, 0]\n"),
              HasSubstr("the motion not along one line"));
  EXPECT_THAT(error_of(leo + "eccentricity = 0.1\n"), HasSubstr("a key of kind \"kepler\""));
  EXPECT_THAT(error_of("kind = \"state\"\nposition = [1, 0, 0]\nvelocity = [0, 1, 0]\n"),
              HasSubstr("orbit.moon.gm: got nothing"));
  EXPECT_THAT(error_of("gm = 1\n"), HasSubstr("exactly one of semi_major_axis, pericentre"));
  state_ = "";
  EXPECT_THAT(error_of(leo + "axes = \"equator-J2000\"\n"),
              HasSubstr("axes that have a known place in those of the state"));
}

// x = 1000 cos t, y = 1000 sin t, z = t / 10, in km and min
std::string circle(int rows, const char* header, bool velocities) {
  std::string text = header;
  char line[200];
  for (int k = 0; k < rows; ++k) {
    const double t = -0.5 + 0.05 * k, c = 1000.0 * std::cos(t), s = 1000.0 * std::sin(t);
    if (velocities)
      std::snprintf(line, sizeof line, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t, c, s,
                    0.1 * t, -s, c, 0.1);
    else
      std::snprintf(line, sizeof line, "%.17g,%.17g,%.17g,%.17g\n", t, c, s, 0.1 * t);
    text += line;
  }
  return text;
}

TEST_F(ScenarioOrbits, ATableIsReadNextToItsScenario) {
  const std::string table = "kind = \"table\"\nfile = \"moon.csv\"\n";
  const std::string minutes = "time_unit = \"min\"\n";
  const Vec3 truth{1000.0 * std::cos(2.0), 1000.0 * std::sin(2.0), 0.2};
  write("moon.csv", circle(100, "t,x,y,z\n", false));
  EXPECT_LT(norm(at(read(table + minutes), 120.0) - truth), budget::table_orbit_file * 1000.0);
  EXPECT_LT(norm(at(read(table), 2.0) - truth), budget::table_orbit_file * 1000.0);
  EXPECT_EQ(read(table).rotation().orbits[0].gm, std::nullopt);
  EXPECT_EQ(read(table + "gm = 5\n").rotation().orbits[0].gm, 5.0);
  // metres in the file, velocities, and columns by number
  write("moon.csv", circle(100, "", true));
  const io::Scenario s = read(table + minutes + "length_unit = \"m\"\norder = 8\n");
  EXPECT_LT(norm(at(s, 120.0) - 1e-3 * truth), budget::table_orbit_file);
  EXPECT_TRUE(std::get<TableOrbit>(s.rotation().orbits[0].motion).has_velocities());
  EXPECT_EQ(std::get<TableOrbit>(s.rotation().orbits[0].motion).order(), 8);
  EXPECT_LT(norm(io::any_orbit(s.rotation().orbits[0]).velocity(120.0) -
                 (1e-3 / 60.0) * Vec3{-truth.y, truth.x, 0.1}),
            budget::table_orbit_file);
  const io::Scenario swapped = read(table + minutes + "columns = [1, 3, 2, 4]\n");
  EXPECT_LT(norm(at(swapped, 120.0) - Vec3{truth.y, truth.x, truth.z}),
            budget::table_orbit_file * 1000.0);
  // ecliptic columns, equatorial state
  const Vec3 x = at(read(table + "columns = [1, 2, 3, 4]\naxes = \"ecliptic-J2000\"\n"), 2.0);
  const double e = 84381.448 / 3600.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(x.z, std::sin(e) * truth.y + std::cos(e) * truth.z,
              budget::table_orbit_file * 1000.0);
}

TEST_F(ScenarioOrbits, TablesThatCannotServeSayWhy) {
  const std::string table = "kind = \"table\"\nfile = \"moon.csv\"\n";
  EXPECT_THAT(error_of(table), HasSubstr("moon.csv: cannot be read: No such file"));
  write("moon.csv", "t,x,y,z\n0,1,2,3\n1,1,2,3\n1,1,2,3\n2,1,2,3\n");
  EXPECT_THAT(error_of(table), HasSubstr("moon.csv:4: time 1 stands twice, here and in line 3"));
  write("moon.csv", "t,x,y,z\n0,1,2,3\n2,1,2,3\n1,1,2,3\n3,1,2,3\n");
  EXPECT_THAT(error_of(table), HasSubstr("moon.csv:4: time 1 comes after 2 of line 3"));
  write("moon.csv", "t,x,y,z\n0,1,2,3\n1,1,nan,3\n");
  EXPECT_THAT(error_of(table), HasSubstr("moon.csv:3: column y: \"nan\" is not a finite number"));
  write("moon.csv", "t,x,y,z\n0,1,2,3\n1,1,2,3\n");
  EXPECT_THAT(error_of(table), HasSubstr("2 rows must be 4 at least"));
  write("moon.csv", "time,x,y,z\n0,1,2,3\n");
  EXPECT_THAT(error_of(table), HasSubstr("there is no column t; expected one of time, x, y or z"));
  EXPECT_THAT(error_of(table + "columns = [\"time\", \"x\"]\n"), HasSubstr("expected 4 columns"));
  write("moon.csv", "");
  EXPECT_THAT(error_of(table), HasSubstr("holds no row"));
  write("moon.csv", "1 2\n");
  EXPECT_THAT(error_of(table), HasSubstr("has 2 columns; expected time, x, y, z"));
  write("moon.csv", circle(100, "t,x,y,z\n", false));
  EXPECT_THAT(error_of(table, "[time]\nstop = 20\ncount = 3\n"),
              HasSubstr("it covers the times -0.5 to 4.45 s; expected all of the run, 0 to 20"));
  EXPECT_THAT(error_of(table, "[time]\nat = [1, 2, 5, 3]\n"), HasSubstr("0 to 5"));
  EXPECT_EQ(error_of(table, "[time]\nstop = 4\ncount = 3\n"), "");
  EXPECT_THAT(error_of(table + "order = 7\n"), HasSubstr("order 7 must be a multiple of 2"));
  EXPECT_THAT(error_of(table + "time_unit = \"km\"\n"), HasSubstr("orbit.moon.time_unit"));
  EXPECT_THAT(error_of("kind = \"table\"\n"), HasSubstr("orbit.moon: got none of them"));
  EXPECT_THAT(error_of(table, "[[perturbation]]\nkind = \"gravity-gradient\"\norbit = \"moon\"\n"),
              HasSubstr("expected a key gm as well"));
}

// Rows in the scenario itself are those of a file, to the bit.
TEST_F(ScenarioOrbits, AFewRowsMayStandInTheScenario) {
  write("moon.csv", "0,1.1,2,3,1,0,7\n1,2,4,3,1,3,0\n2,3,8,2,1,5,0\n3.5,3,8,2,1,0,0\n");
  const std::string rows =
      "kind = \"table\"\nallow_coarse = true\ntimes = [0, 1, 2, 3.5]\nx = [1.1, 2, 3, 3]\ny = [2, "
      "4, 8, 8]\n"
      "z = [3, 3, 2, 2]\n";
  const std::string slopes = "vx = [1, 1, 1, 1]\nvy = [0, 3, 5, 0]\nvz = [7, 0, 0, 0]\n";
  const auto table = [&](const std::string& orbit) {
    return std::get<TableOrbit>(read(orbit).rotation().orbits.at(0).motion);
  };
  EXPECT_EQ(table(rows + slopes),
            table("kind = \"table\"\nallow_coarse = true\nfile = \"moon.csv\"\n"));
  EXPECT_FALSE(table(rows).has_velocities());
  const std::string along = "axes = \"ecliptic-J2000\"\n";
  EXPECT_EQ(table(rows + slopes + along),
            table("kind = \"table\"\nallow_coarse = true\nfile = \"moon.csv\"\n" + along));
  EXPECT_THAT(error_of(rows + "vx = [1, 1, 1, 1]\n"), HasSubstr("expected vx, vy and vz, or none"));
  EXPECT_THAT(error_of(rows + "time_unit = \"s\"\n"), HasSubstr("expected a key file as well"));
  EXPECT_THAT(error_of("kind = \"table\"\nallow_coarse = true\ntimes = [0, 1]\nx = [1, 2]\n"),
              HasSubstr("got times, x; expected exactly one of times with x with y with z, file"));
  EXPECT_THAT(error_of("kind = \"table\"\nallow_coarse = true\ntimes = [0, 1, 2, 3]\nx = [1, 2]\ny "
                       "= [1]\nz = [1]\n"),
              HasSubstr("orbit.moon.x: got [1, 2]; expected 4 numbers, as many as times has"));
  EXPECT_THAT(
      error_of("kind = \"table\"\nallow_coarse = true\nfile = \"moon.csv\"\nvz = [1, 1, 1, 1]\n"),
      HasSubstr("expected keys times, x, y and z as well"));
  EXPECT_THAT(error_of(rows, "[time]\nstop = 20\ncount = 3\n"),
              HasSubstr("orbit.moon.times: got [0, 1, 2, 3.5]; it covers the times 0 to 3.5"));
}

// Elements along the equator in a run along the ecliptic, and the reverse.
TEST_F(ScenarioOrbits, ElementsMayBeAlongOtherAxes) {
  const std::string keys =
      "gm = 398600.4418\nsemi_major_axis = 7000\neccentricity = 0.01\ninclination = 98\n"
      "node = 20\nnode_rate = 1e-5\n";
  const io::Scenario own = read(keys);
  state_ = "axes = \"ecliptic-J2000\"\n";
  const io::Scenario other = read(keys + "axes = \"equator-J2000\"\n");
  EXPECT_EQ(read(keys + "axes = \"ecliptic-J2000\"\n").rotation().orbits[0].motion.index(),
            own.rotation().orbits[0].motion.index());
  const double e = 84381.448 / 3600.0 * std::numbers::pi / 180.0;
  for (const double t : {0.0, 5e4}) {
    const Vec3 x = at(own, t), y = at(other, t);
    EXPECT_LT(norm(y - Vec3{x.x, std::cos(e) * x.y + std::sin(e) * x.z,
                            std::cos(e) * x.z - std::sin(e) * x.y}),
              budget::table_orbit_kepler * 7000.0);
  }
}

// Rows an hour apart, dated by Julian dates of nine digits: their ends miss by their rounding, and
// by what TDB and TT differ on the way.
TEST_F(ScenarioOrbits, DatesMayMissTheEndsOfTheRunByTheirRounding) {
  const double rate = 1e-5;  // rad/s
  const auto truth = [&](double t) {
    return Vec3{1000.0 * std::cos(rate * t), 1000.0 * std::sin(rate * t), 0.0};
  };
  const auto table = [&](double first, double last, double step) {
    std::string text = "JD,x,y,z\n";
    for (double t = first; t < last + 0.5 * step; t += step) {
      const Vec3 x = truth(t);
      char line[200];
      std::snprintf(line, sizeof line, "24611%.9f,%.12g,%.12g,%.12g\n", 19.5 + t / 86400.0, x.x,
                    x.y, x.z);
      text += line;
    }
    write("moon.csv", text);
  };
  const auto keys = [](const char* scale) {
    return "kind = \"table\"\nfile = \"moon.csv\"\ncolumns = [\"JD\", \"x\", \"y\", \"z\"]\n"
           "time_format = \"JD\"\ntime_scale = \"" +
           std::string(scale) + "\"\n";
  };
  const std::string day = "[time]\nstop = 86400\ncount = 3\n";
  table(0.0, 86400.0, 3600.0);
  for (const char* scale : {"TDB", "TT"}) {
    state_ = "axes = \"equator-J2000\"\nepoch = \"JD 2461119.5 TDB\"\n";
    ASSERT_EQ(error_of(keys(scale), day), "") << scale;
    const io::Scenario s = read(keys(scale), day);
    for (const double t : {0.0, 40000.0, 86400.0})
      EXPECT_LT(norm(at(s, t) - truth(t)), budget::table_orbit_dates * 1000.0) << t;
  }
  // farther than that they end too early
  state_ = "axes = \"equator-J2000\"\nepoch = \"JD 2461119.5 TDB\"\n";
  EXPECT_THAT(error_of(keys("TDB"), "[time]\nstop = 86400.01\ncount = 3\n"),
              HasSubstr("expected all of the run, 0 to 86400.01"));
  // and where rows are a second apart, by a thousandth of that
  table(0.0, 30.0, 1.0);
  EXPECT_EQ(error_of(keys("TDB"), "[time]\nstop = 30.0008\ncount = 3\n"), "");
  EXPECT_THAT(error_of(keys("TDB"), "[time]\nstop = 30.0015\ncount = 3\n"),
              HasSubstr("expected all of the run"));
}

TEST_F(ScenarioOrbits, NumbersMayMissTheEndsOfTheRunByTheirRounding) {
  std::string text = "t,x,y,z\n";
  for (int k = 0; k < 8; ++k) text += std::to_string(k) + ",1,2," + std::to_string(k) + "\n";
  const std::string table = "kind = \"table\"\nfile = \"moon.csv\"\ntime_unit = \"min\"\n";
  write("moon.csv", text.replace(text.find("0,1"), 1, "1e-15"));
  EXPECT_EQ(error_of(table, "[time]\nstop = 420\ncount = 3\n"), "");
  EXPECT_THAT(error_of(table, "[time]\nstop = 420.000001\ncount = 3\n"), HasSubstr("it covers"));
}

// Of Kepler orbits by few rows: the estimate next to the error.
TEST_F(ScenarioOrbits, ACoarseTableIsCalledOne) {
  for (const double e : {0.0, 0.3})
    for (const bool slopes : {false, true})
      for (const int per_turn : {4, 8, 12, 20}) {
        const KeplerOrbit truth({.gm = 1.0, .pericentre = 1.0 - e, .eccentricity = e});
        const double step = 2.0 * std::numbers::pi / per_turn;
        PositionTable rows;
        for (int k = 0; k <= 3 * per_turn; ++k) {
          rows.times.push_back(step * k);
          rows.positions.push_back(truth.position(step * k));
          if (slopes) rows.velocities.push_back(truth.velocity(step * k));
        }
        const TableOrbit orbit(rows);
        test::Worst error;
        for (double t = 0.0; t < orbit.last_time(); t += step / 8.0)
          error.add(norm(orbit.position(t) - truth.position(t)) / norm(orbit.position(t)));
        const double estimate = interpolation_error(orbit);
        EXPECT_GT(estimate, budget::table_orbit_estimate_least * error.value())
            << e << slopes << per_turn;
        if (error.value() > budget::table_orbit_kepler) {
          EXPECT_LT(estimate, budget::table_orbit_estimate_most * error.value())
              << e << slopes << per_turn;
        }
      }
  const auto said = [&](int rows, const std::string& more = "") {
    std::string text = "t,x,y,z\n";
    for (int k = 0; k < 3 * rows; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / rows;
      text += std::to_string(100 * k) + "," + std::to_string(7000.0 * std::cos(angle)) + "," +
              std::to_string(7000.0 * std::sin(angle)) + ",0\n";
    }
    write("moon.csv", text);
    const io::Scenario s = read("kind = \"table\"\nfile = \"moon.csv\"\n" + more);
    std::string printed = io::summary_table(io::summary(s));
    for (const std::string& warning : io::warnings(s)) printed += warning + "\n";
    return printed;
  };
  EXPECT_THAT(said(4, "allow_coarse = true\n"),
              HasSubstr("of the distance: rows are too far apart\n"));
  EXPECT_THAT(said(8),
              HasSubstr("rows that are too far apart: between them the interpolation errs"));
  EXPECT_THAT(said(20), HasSubstr("orbit moon: interpolation error"));
  EXPECT_THAT(said(20), HasSubstr("3e-07 of the distance\n"));
  EXPECT_THAT(said(20), HasSubstr("table moon.csv, 60 rows, t = 0 to 5900 s\n"));
}

// A circle of 7000 km, by two or three rows.
TEST_F(ScenarioOrbits, AFewRowsAreJudgedToo) {
  constexpr double r = 7000.0, rate = 1.078e-3;
  const auto write_rows = [&](int count, double step, bool slopes) {
    std::string text = slopes ? "t,x,y,z,vx,vy,vz\n" : "t,x,y,z\n";
    for (int k = 0; k < count; ++k) {
      const double t = k * step, c = std::cos(rate * t), s = std::sin(rate * t);
      text += std::to_string(t) + "," + std::to_string(r * c) + "," + std::to_string(r * s) + ",0";
      if (slopes)
        text += "," + std::to_string(-r * rate * s) + "," + std::to_string(r * rate * c) + ",0";
      text += "\n";
    }
    write("moon.csv", text);
  };
  const std::string table = "kind = \"table\"\nfile = \"moon.csv\"\n";
  const std::string coarse = "rows that are too far apart: between them the interpolation errs";
  for (const auto& [count, step] : {std::pair{2, 5000.0}, {3, 3000.0}}) {
    write_rows(count, step, true);
    EXPECT_THAT(error_of(table), HasSubstr(coarse)) << count;
    EXPECT_THAT(io::warnings(read(table + "allow_coarse = true\n")).at(0), HasSubstr(coarse));
  }
  write_rows(2, 10.0, true);
  EXPECT_TRUE(io::warnings(read(table)).empty());
  write_rows(3, 10.0, false);
  const io::Scenario lines = read(table + "order = 2\n");
  EXPECT_THAT(io::warnings(lines).at(0),
              HasSubstr("the interpolation error cannot be estimated from so few rows"));
  EXPECT_THAT(io::summary_table(io::summary(lines)),
              HasSubstr("unknown: too few rows to estimate it"));
}

// What Horizons sends: a banner, names, and rows between two marks.
TEST_F(ScenarioOrbits, HorizonsIsReadAsItComes) {
  std::string text =
      "API VERSION: 1.2\nAPI SOURCE: NASA/JPL Horizons API\n\n*******\n"
      "Ephemeris / API_USER Sun Nov 22, 2026 Pasadena, USA      / Horizons\n*******\n"
      "Target body name: Moon (301)                      {source: DE441}\n*****\n"
      "            JDTDB,            Calendar Date (TDB),          X,         Y, Z,\n"
      "*****\n$$SOE\n";
  for (int k = 0; k < 25; ++k) {
    const double angle = 0.01 * k;
    char line[200];
    std::snprintf(line, sizeof line,
                  "%.9f, A.D. 2026-Mar-20 00:00:00.0000,  %.16E, %.16E, %.16E,\n",
                  2461119.5 + k / 24.0, 1000.0 * std::cos(angle), 1000.0 * std::sin(angle), 0.0);
    text += line;
  }
  text += "$$EOE\n*****\n\nTIME\n\n  Barycentric Dynamical Time (\"TDB\"), output\n*****\n";
  const std::string keys =
      "kind = \"table\"\nfile = \"moon.txt\"\ncolumns = [\"JDTDB\", \"X\", \"Y\", \"Z\"]\n"
      "time_format = \"JD\"\ntime_scale = \"TDB\"\n";
  state_ = "axes = \"equator-J2000\"\nepoch = \"2026-03-20T00:00:00 TDB\"\n";
  write("moon.txt", text);
  ASSERT_EQ(error_of(keys, "[time]\nstop = 86400\ncount = 3\n"), "");
  const io::Scenario s = read(keys, "[time]\nstop = 86400\ncount = 3\n");
  EXPECT_LT(norm(at(s, 43200.0) - Vec3{1000.0 * std::cos(0.12), 1000.0 * std::sin(0.12), 0.0}),
            budget::table_orbit_dates * 1000.0);
  EXPECT_EQ(std::get<TableOrbit>(s.rotation().orbits[0].motion).table().times.size(), 25U);
  EXPECT_EQ(s.rotation().orbits[0].text, "table moon.txt");
  EXPECT_THAT(error_of(keys + "order = 2\n", "[time]\nstop = 90000\ncount = 3\n"),
              HasSubstr("it covers"));
  std::string other = text;
  const std::size_t names = other.find("            JDTDB");
  other.replace(names, other.find('\n', names) - names, "JDTDB\n   X     Y     Z");
  write("moon.txt", other);
  EXPECT_THAT(error_of(keys), HasSubstr("expected what Horizons sends with CSV_FORMAT = YES"));
  write("moon.txt", text.substr(0, text.find("$$SOE")));
  EXPECT_THAT(error_of(keys), HasSubstr("the file ends before $$SOE"));
}

const std::string moon = "kind = \"ephemeris\"\ntarget = \"moon\"\ncentre = \"earth\"\n";
const std::string ten_days = "[time]\nstop = 864000\ncount = 11\n";

TEST_F(ScenarioOrbits, AnEphemerisIsTheBodyWhereItIs) {
  state_ = "axes = \"equator-J2000\"\nepoch = \"2013-01-05T00:00:00 UTC\"\n";
  const ephemeris::Date epoch = ephemeris::calendar_date(ephemeris::TimeScale::UTC, {2013, 1, 5});
  const io::Scenario s = read(moon, ten_days);
  for (const double t : {0.0, 1000.0, 123456.7, 864000.0}) {
    const Vec3 truth = ephemeris::planetary_position(
        ephemeris::Planetary::moon, ephemeris::Planetary::earth, ephemeris::date_after(epoch, t));
    EXPECT_LT(norm(at(s, t) - truth), budget::ephemeris_orbit * norm(truth));
  }
  EXPECT_EQ(s.rotation().orbits[0].gm, ephemeris::planetary_gm(ephemeris::Planetary::moon));
  EXPECT_EQ(read(moon + "gm = 7\n", ten_days).rotation().orbits[0].gm, 7.0);
  // other axes, other units
  state_ = "axes = \"ecliptic-J2000\"\nepoch = \"2013-01-05T00:00:00 UTC\"\n";
  units_ = "[units]\ntime = \"h\"\nlength = \"m\"\n";
  const io::Scenario other = read(moon, "[time]\nstop = 240\ncount = 11\n");
  const Vec3 x = at(s, 7200.0), y = at(other, 2.0);
  const double e = 84381.448 / 3600.0 * std::numbers::pi / 180.0;
  EXPECT_LT(norm(1e-3 * y - Vec3{x.x, std::cos(e) * x.y + std::sin(e) * x.z,
                                 std::cos(e) * x.z - std::sin(e) * x.y}),
            budget::ephemeris_orbit * norm(x));
  EXPECT_NEAR(*other.rotation().orbits[0].gm /
                  (ephemeris::planetary_gm(ephemeris::Planetary::moon) * 1e9 * 3600.0 * 3600.0),
              1.0, budget::table_orbit_file);
}

TEST_F(ScenarioOrbits, EphemeridesThatCannotBeSayWhy) {
  EXPECT_THAT(error_of(moon, ten_days), HasSubstr("expected a key state.epoch"));
  state_ = "epoch = \"2013-01-05 UTC\"\n";
  EXPECT_THAT(error_of(moon, ten_days), HasSubstr("expected state.axes = \"ecliptic-J2000\""));
  state_ += "axes = \"equator-J2000\"\n";
  EXPECT_THAT(error_of(moon), HasSubstr("expected a table [time]"));
  EXPECT_THAT(error_of("kind = \"ephemeris\"\ntarget = \"sun\"\ncentre = \"sun\"\n", ten_days),
              HasSubstr("expected another body than the target"));
  EXPECT_THAT(error_of("kind = \"ephemeris\"\ntarget = \"pluto\"\ncentre = \"sun\"\n", ten_days),
              HasSubstr("orbit.moon.target: got \"pluto\""));
  EXPECT_THAT(error_of(moon, "[time]\nstop = \"1000 yr\"\ncount = 2\n"),
              HasSubstr("must be in the years 1000 to 3000"));
  units_ = "";
  EXPECT_THAT(error_of(moon, ten_days), HasSubstr("expected a unit of length"));
  state_ = "epoch = \"2013-01-05 UT1\"\naxes = \"equator-J2000\"\n";
  units_ = "[units]\nlength = \"km\"\n";
  EXPECT_THAT(error_of(moon, ten_days), HasSubstr("expected a key state.dut1 as well"));
  state_ += "dut1 = 0.27\n";
  EXPECT_EQ(error_of(moon, ten_days), "");
}

// The last seconds of 2016: a row a second by the clock of UTC, 23:59:60 among them.
TEST_F(ScenarioOrbits, DatesOfTablesKnowLeapSeconds) {
  state_ = "axes = \"equator-J2000\"\nepoch = \"2016-12-31T23:59:58 UTC\"\n";
  const std::string table =
      "kind = \"table\"\nfile = \"moon.csv\"\ntime_format = \"date\"\ntime_scale = \"UTC\"\n";
  write("moon.csv",
        "t,x,y,z\n2016-12-31T23:59:58,0,1,2\n2016-12-31T23:59:59,1,1,2\n"
        "2016-12-31T23:59:60,2,1,2\n2017-01-01T00:00:00.0Z,3,1,2\n2017-01-01 00:00:01,4,1,2\n");
  EXPECT_NEAR(at(read(table), 3.5).x, 3.5, budget::date_second * 1e3);
  EXPECT_THAT(error_of(table + "time_unit = \"s\"\n"),
              HasSubstr("expected no unit together with dates"));
  // TT is 69.184 s ahead of UTC after that second
  const std::string julian =
      "kind = \"table\"\nfile = \"moon.csv\"\ntime_format = \"JD\"\ntime_scale = \"TT\"\n";
  write("moon.csv", "2457754.5 0 1 2\n2457754.501 1 1 2\n2457754.502 2 1 2\n2457754.503 3 1 2\n");
  const io::Scenario s = read(julian);
  const auto& orbit = std::get<TableOrbit>(s.rotation().orbits.at(0).motion);
  EXPECT_NEAR(orbit.first_time(), 3.0 - 69.184, budget::date_second * 1e3);
  EXPECT_NEAR(orbit.last_time() - orbit.first_time(), 259.2, budget::date_second * 1e3);
  write("moon.csv", "t,x,y,z\n2015-12-31T23:59:60,0,1,2\n");
  EXPECT_THAT(error_of(table), HasSubstr("moon.csv:2: column t: \"2015-12-31T23:59:60\""));
  write("moon.csv", "t,x,y,z\n2015-13-31T23:59,0,1,2\n");
  EXPECT_THAT(error_of(table), HasSubstr("there is no such day in the calendar"));
  state_ = "axes = \"equator-J2000\"\n";
  EXPECT_THAT(error_of(julian), HasSubstr("expected a key state.epoch"));
}

}  // namespace
}  // namespace polhode
