// SPDX-License-Identifier: MIT
#include "polhode/scenario/scenario.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <variant>

#include "budgets.hpp"
#include "message_of.hpp"
#include "scenario_text.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::Worst;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string head = "schema = 1\n[body]\nmoments = [1, 2, 2.5]\n";
const std::string andoyer = "[state.andoyer]\nl = 1\ng = 2\nh = 3\nL = 0.5\nG = 1\nH = 0.1\n";

std::string error_of(const std::string& text) {
  return test::message_of<io::ScenarioError>([&] { io::scenario_from_text(text, "f.toml"); });
}

TEST(Scenario, KeepsWhatTheFileSays) {
  const io::Scenario s = io::scenario_from_text(
      "schema = 1\ntitle = \"A body\"\n[units]\ntime = \"h\"\nangle = \"deg\"\n"
      "[body]\nmoments = [2, 1, 2.5]\n[state]\nepoch = \"JD 2456297.5 TDB\"\n"
      "axes = \"ecliptic-J2000\"\n"
      "[state.andoyer]\nl = 180\ng = \"1 rad\"\nh = { value = 0.5, unit = \"rev\" }\nL = 0.5\n"
      "G = \"2 1/h\"\nH = 0.1\n[time]\nstop = 1\nstep = \"15 min\"\n"
      "[output]\ncolumns = [\"g\", \"serret\"]\n",
      "folder/f.toml");
  EXPECT_EQ(s.document.name, "f.toml");
  EXPECT_EQ(s.document.title, "A body");
  EXPECT_EQ(s.rotation().chart, "andoyer");
  EXPECT_EQ(s.rotation().epoch, "JD 2456297.5 TDB");
  EXPECT_EQ(s.rotation().axes, "ecliptic-J2000");
  EXPECT_EQ(s.rotation().body.moments(), (Vec3{2.0, 1.0, 2.5}));
  const io::ChartState a = std::get<io::ChartState>(s.rotation().state);
  EXPECT_EQ(a.chart.name, "andoyer");
  EXPECT_THAT(std::span(a.numbers).first(a.chart.variables.size()),
              ElementsAre(std::numbers::pi, 1.0, std::numbers::pi, 0.5, 2.0, 0.1));
  ASSERT_TRUE(s.rotation().time);
  EXPECT_EQ(s.rotation().time->size(), 5);
  EXPECT_EQ((*s.rotation().time)[3], 0.75);
  EXPECT_EQ(s.output.columns, (std::vector<std::string>{"g", "serret"}));
}

// Numbers of a file as text that reads back the same.
std::string digits(double x) {
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

// In the half of the states whose poles are nearest: beyond it the numbers say less.
TEST(Scenario, APoincareSetIsTheStateThatItsAndoyerVariablesAre) {
  for (const io::ChartKind& chart : io::default_charts()) {
    if (!chart.name.starts_with("poincare")) continue;
    const double J = chart.state_fields[0].word == "pi" ? -1.0 : 1.0;
    const double I = chart.state_fields[1].word == "pi" ? -1.0 : 1.0;
    for (const double L : {0.0, J * 0.7, J * 0.999, J})
      for (const double H : {0.0, I * 0.4, I * 0.9999, I}) {
        const std::string text =
            "l = 0.3\ng = 2\nh = -1.2\nL = " + digits(L) + "\nG = 1\nH = " + digits(H) + "\n";
        const io::Scenario from =
            io::scenario_from_text(head + "[state.andoyer]\n" + text, "f.toml");
        const io::ChartNumbers numbers = chart.from_hub(io::initial_state(from), {nullptr});
        std::string state = "[state." + std::string(chart.name) + "]\n";
        for (std::size_t i = 0; i < chart.variables.size(); ++i)
          state += std::string(chart.variables[i].name) + " = " + digits(numbers[i]) + "\n";
        const io::Scenario s = io::scenario_from_text(head + state, "f.toml");
        EXPECT_EQ(s.rotation().chart, chart.name);
        const RotorState a = io::initial_state(from), b = io::initial_state(s);
        const double sign = a.q.w * b.q.w + a.q.x * b.q.x + a.q.y * b.q.y + a.q.z * b.q.z;
        Worst worst;
        for (const double x : {a.q.w - sign * b.q.w, a.q.x - sign * b.q.x, a.q.y - sign * b.q.y,
                               a.q.z - sign * b.q.z, norm(a.g - b.g), 1.0 - std::fabs(sign)})
          worst.add(std::fabs(x));
        EXPECT_LE(worst.value(), budget::io_state) << chart.name << " " << L << " " << H;
      }
  }
}

TEST(Scenario, RootsOfMomentaHaveUnits) {
  const std::string units = "[units]\ntime = \"h\"\nmoment = \"kg m2\"\n";
  const auto text = [](const std::string& Q1) {
    return "[state.poincare-pi-0]\nsigma = 1\nQ1 = " + Q1 +
           "\nQ2 = 0.1\nG = 1\nP1 = 0.2\nP2 = 0.3\n";
  };
  const auto read = [&](const std::string& Q1) {
    return io::scenario_from_text("schema = 1\n" + units + head.substr(11) + text(Q1), "f.toml");
  };
  const auto Q1 = [](const io::Scenario& s) {
    return std::get<io::ChartState>(s.rotation().state).numbers[1];
  };
  EXPECT_EQ(Q1(read("0.5")), 0.5);
  EXPECT_EQ(Q1(read("\"0.5 sqrt(kg m2/h)\"")), 0.5);
  EXPECT_EQ(Q1(read("{ value = 0.0125, unit = \"sqrt(kg m2/s)\" }")), 0.0125 * 60.0);
  EXPECT_THAT(error_of(head + text("\"0.5 kg\"")),
              HasSubstr("f.toml:6:6: state.poincare-pi-0.Q1: "));
  EXPECT_THAT(error_of(head + text("3")),
              HasSubstr("poincare_state: (Q1, P1) = (3, 0.2) must have"));
}

TEST(Scenario, DefaultsAreThoseOfTheSchema) {
  const io::Scenario s = io::scenario_from_text(head + andoyer, "f.toml");
  EXPECT_EQ(s.units().time(), "s");
  EXPECT_EQ(s.units().angle(), "rad");
  EXPECT_EQ(s.rotation().axes, "inertial");
  EXPECT_EQ(s.output.columns, (std::vector<std::string>{"q", "omega"}));
  EXPECT_FALSE(s.rotation().time);
}

TEST(Scenario, RatesOfTheBodyGiveTheMomentum) {
  for (const std::string rate : {"omega_body", "omega_inertial"}) {
    const io::Scenario s = io::scenario_from_text(
        test::scenario_text("", {.units = "[units]\nangle = \"deg\"\n",
                                 .rate = rate + " = [180, 0, \"1 rad/s\"]\n"}),
        "f.toml");
    const RotorState r = io::initial_state(s);
    EXPECT_NEAR(r.g.x, std::numbers::pi, budget::io_state);
    EXPECT_NEAR(r.g.z, 2.5, budget::io_state);
  }
}

// No division and multiplication by the moments: the numbers are those of the file, to the bit.
TEST(Scenario, AMomentumIsThatOfTheState) {
  const std::string state =
      "[state.attitude-rate]\nquaternion = [0.5, -0.5, 0.5, 0.5]\n"
      "momentum_body = [0.1, -0.30000000000000004, 1.7]\n";
  const RotorState s = io::initial_state(
      io::scenario_from_text("schema = 1\n[body]\nmoments = [1, 1.9, 2.3]\n" + state, "a"));
  EXPECT_EQ(s.q, (Quaternion{0.5, -0.5, 0.5, 0.5}));
  EXPECT_EQ(s.g, (Vec3{0.1, -0.30000000000000004, 1.7}));
  const RotorState of_tensor = io::initial_state(io::scenario_from_text(
      "schema = 1\n[body]\ntensor = [[1.9, 0, 0.2], [0, 1, 0], [0.2, 0, 2.3]]\n" + state, "b"));
  EXPECT_NEAR(norm(inertial_momentum(of_tensor) - inertial_momentum(s)), 0.0, budget::io_state);
  EXPECT_THAT(error_of("schema = 1\n[body]\nmoments = [1, 1.9, 2.3]\n" + state +
                       "omega_body = [1, 2, 3]\n"),
              HasSubstr("exactly one of omega_body, omega_inertial, omega_relative, "
                        "momentum_body"));
}

// Each sign of Serret's elements and each lobe of Sadov's gives another state.
TEST(Scenario, SignsOfTheElementsAreRead) {
  const auto momentum = [](const std::string& state) {
    return io::initial_state(io::scenario_from_text(head + state, "f.toml")).g;
  };
  const std::string serret = "[state.serret]\ng0 = 0\nh = 0\nt0 = 0\nG = 1\nH = 0\n";
  const std::string short_axis = serret + "T = 0.21\n", long_axis = serret + "T = 0.4\n";
  EXPECT_GT(momentum(short_axis).z, 0.0);
  EXPECT_LT(momentum(short_axis + "sign_g3 = -1\n").z, 0.0);
  EXPECT_GT(momentum(long_axis).x, 0.0);
  EXPECT_LT(momentum(long_axis + "sign_g1 = -1\n").x, 0.0);
  const std::string sadov =
      "[state.sadov]\nphi_l = 0.3\nphi_g = 0\nphi_h = 0\nI_g = 1\nI_h = 0\nI_l = 0.1\n";
  EXPECT_GT(momentum(sadov).x, 0.0);
  EXPECT_LT(momentum(sadov + "lobe = -1\n").x, 0.0);
  EXPECT_EQ(momentum(sadov), momentum(sadov + "region = \"LAM\"\n"));
  EXPECT_THROW(momentum(sadov + "region = \"SAM\"\n"), io::ScenarioError);
}

// The body axes of the file are those of the tensor: a rotated tensor with the same omega is the
// same motion as the principal moments with the omega in principal axes.
TEST(Scenario, ATensorGivesItsOwnBodyAxes) {
  const std::string state = "[state.attitude-rate]\nquaternion = [0.5, 0.5, 0.5, 0.5]\n";
  const io::Scenario diagonal =
      io::scenario_from_text(head + state + "omega_body = [1, 2, 3]\n", "a");
  const io::Scenario full =
      io::scenario_from_text("schema = 1\n[body]\ntensor = [[1, 0, 0], [0, 2, 0], [0, 0, 2.5]]\n" +
                                 state + "omega_body = [1, 2, 3]\n",
                             "b");
  const FreeRotation a = io::free_rotation(diagonal), b = io::free_rotation(full);
  EXPECT_NEAR(a.energy(), b.energy(), budget::io_state);
  const Vec3 Ga = inertial_momentum(a.at(0.7)), Gb = inertial_momentum(b.at(0.7));
  EXPECT_NEAR(norm(Ga - Gb), 0.0, budget::io_state);
}

// What a file says along principal axes stays so; the columns alone are along the others.
TEST(Scenario, ColumnAxesTurnNothingElse) {
  const std::string rest =
      "[state.attitude-rate]\nquaternion = [0.5, 0.5, 0.5, 0.5]\nomega_body = [1, 2, 3]\n"
      "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [0.1, 0.2, 0.3]\n";
  const io::Scenario plain = io::scenario_from_text(head + rest, "a");
  const io::Scenario turned =
      io::scenario_from_text(head + "column_axes = [0.6, 0, 0, 0.8]\n" + rest, "b");
  EXPECT_EQ(turned.rotation().body.q_FB(), (Quaternion{0.6, 0.0, 0.0, 0.8}));
  EXPECT_EQ(io::initial_state(turned).q, io::initial_state(plain).q);
  EXPECT_EQ(io::initial_state(turned).g, io::initial_state(plain).g);
  const Vec3 u = effect(io::rotor_system(turned), 0.0, io::initial_state(turned)).u;
  EXPECT_EQ(u, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_THAT(error_of("schema = 1\n[body]\ntensor = [[1, 0, 0], [0, 2, 0], [0, 0, 2.5]]\n"
                       "column_axes = [1, 0, 0, 0]\n" +
                       rest),
              HasSubstr("body.column_axes: got [1, 0, 0, 0]; expected a key moments as well"));
}

TEST(Scenario, OrderOfErrorsIsThatOfTheFile) {
  const std::string error = error_of("schema = 1\ntitel = 3\n[body]\nmoments = [1, 2]\n" + andoyer +
                                     "[output]\ncolumns = [\"Q\"]\n");
  const std::size_t first = error.find("f.toml:2:1: titel: unknown key"),
                    second = error.find("f.toml:4:11: body.moments: got [1, 2]"),
                    third = error.find("f.toml:13:12: output.columns: got \"Q\"");
  EXPECT_EQ(first, 0U);
  EXPECT_TRUE(first < second && second < third) << error;
}

TEST(Scenario, AMisspeltKeyIsNotMissingToo) {
  EXPECT_EQ(
      error_of("schema = 1\n[body]\nmomnets = [1, 2, 2.5]\n" + andoyer),
      "f.toml:3:1: body.momnets: unknown key; did you mean moments? expected moments, tensor, "
      "shape, density, scale or column_axes");
}

TEST(Scenario, WhatCannotBeSaysWhyAndWhere) {
  const test::Rejected rows[] = {
      {"schema = 1\n[body]\nmoments = [1, 1, 3]\n" + andoyer,
       "f.toml:3:11: body.moments: got [1, 1, 3]; Body: moments"},
      {head + "[state.andoyer]\nl = 1\ng = 2\nh = 3\nL = 1.5\nG = 1\nH = 0.1\n",
       "f.toml:8:5: state.andoyer.L: got 1.5; "},
      {head + "[state.attitude-rate]\nquaternion = [0, 0, 0, 0]\nomega_body = [1, 2, 3]\n",
       "f.toml:5:14: state.attitude-rate.quaternion: got [0, 0, 0, 0]; "},
      {head + andoyer + "[time]\nstop = 1\nstep = -1\n", "f.toml:13:8: time.step: got -1; "},
      {head + andoyer + "[time]\nstop = \"1e308 yr\"\nstep = 1\n",
       "f.toml:12:8: time.stop: got \"1e308 yr\"; expected a time"},
      {head + "[state.andoyer]\nl = 1e11\ng = 2\nh = 3\nL = 0\nG = 1\nH = 0\n",
       "f.toml:5:5: state.andoyer.l: got 1e+11; expected an angle"},
      {head, "state: got nothing; expected a table"},
      {head + "[state]\naxes = \"inertial\"\n",
       "state: got none of them; expected exactly one of tumbler, attitude-rate"},
      {head + andoyer + "[state.euler]\nphi = 1\ntheta = 1\npsi = 1\nPhi = 1\nTheta = 1\nPsi = 1\n",
       "state: got euler, andoyer; expected exactly one of"},
  };
  test::expect_rejected(error_of, rows);
}

TEST(Scenario, TumblersThatCannotBeSayWhy) {
  const auto error = [&](const std::string& periods, const std::string& rest) {
    return error_of(
        "schema = 1\n[units]\ntime = \"h\"\nangle = \"deg\"\n[body]\n"
        "moments = [0.61, 0.965, 1]\n[state.tumbler]\nmode = \"SAM\"\n" +
        periods + "pole = { longitude = 250, latitude = -75 }\n" + rest);
  };
  const std::string apophis = "precession_period = 30.56\nrotation_period = 263\n";
  EXPECT_EQ(error(apophis, ""), "");
  EXPECT_EQ(error(apophis, "psi0 = 10\n"), "");
  EXPECT_THAT(error(apophis, "psi0 = 80\n"),
              StartsWith("f.toml:12:8: state.tumbler.psi0: got 80; expected at most psi_max = "));
  EXPECT_THAT(error("precession_period = 30.56\nrotation_period = 2\n", ""),
              StartsWith("f.toml:10:19: state.tumbler.rotation_period: got 2; TumblerState: "
                         "P_psi/P_phi = 0.065"));
  EXPECT_THAT(error("precession_period = -1\nrotation_period = 2\n", ""),
              StartsWith("f.toml:9:21: state.tumbler.precession_period: got -1; expected"));
}

// One pole in three notations: the ecliptic one, and both axes of J2000.
TEST(Scenario, PolesTurnWithTheAxes) {
  const auto momentum = [&](const std::string& axes, const std::string& pole) {
    const io::Scenario s = io::scenario_from_text(
        "schema = 1\n[body]\nmoments = [0.61, 0.965, 1]\n[state]\naxes = \"" + axes +
            "\"\n[state.tumbler]\nmode = \"SAM\"\nprecession_period = 30.56\n"
            "rotation_period = 263\npole = " +
            pole + "\n",
        "f.toml");
    const Vec3 G = inertial_momentum(io::initial_state(s));
    return (1.0 / norm(G)) * G;
  };
  const std::string north = "{ longitude = 0, latitude = \"90 deg\" }";
  const std::string equinox = "{ ra = 0, dec = 0 }";
  const std::string pole_of_ecliptic = "{ ra = \"270 deg\", dec = \"239618.552 arcsec\" }";
  const auto expect = [](const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(norm(a - b), 0.0, budget::io_state);
  };
  expect(momentum("ecliptic-J2000", north), {0.0, 0.0, 1.0});
  expect(momentum("inertial", north), {0.0, 0.0, 1.0});
  expect(momentum("ecliptic-J2000", equinox), {1.0, 0.0, 0.0});
  expect(momentum("ecliptic-J2000", pole_of_ecliptic), {0.0, 0.0, 1.0});
  expect(momentum("equator-J2000", north), momentum("equator-J2000", pole_of_ecliptic));
}

TEST(Scenario, NotANumberIsRefusedEverywhere) {
  for (const char* bad : {"nan", "inf", "-inf", "\"nan s\"", "{ value = nan, unit = \"s\" }"})
    EXPECT_THAT(error_of(head + andoyer + "[time]\nstop = " + bad + "\nstep = 1\n"),
                StartsWith("f.toml:12:8: time.stop: got"))
        << bad;
}

TEST(Scenario, ArraysMayHaveOneUnit) {
  const auto error = [&](const std::string& rate) {
    return error_of(
        head + "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = " + rate + "\n");
  };
  EXPECT_EQ(error("{ value = [1, 2, 3], unit = \"rpm\" }"), "");
  EXPECT_EQ(error("[1, \"2 rpm\", { value = 3, unit = \"deg/h\" }]"), "");
  EXPECT_THAT(error("{ value = [1, 2, \"3\"], unit = \"rpm\" }"),
              StartsWith("f.toml:6:31: state.attitude-rate.omega_body: got \"3\"; expected"));
  EXPECT_THAT(error("{ value = [1, 2, nan], unit = \"rpm\" }"),
              HasSubstr("got nan; expected an array of 3 numbers, each an "
                        "angular rate: a number (of rad/s), \"1 rad/s\" or { value = 1, unit = "
                        "\"rad/s\" }; numbers must be finite"));
  EXPECT_THAT(error("{ value = [1, 2], unit = \"rpm\" }"), StartsWith("f.toml:6:14: "));
  EXPECT_THAT(error("{ value = [1, 2, 3], unit = \"rpn\" }"), HasSubstr("did you mean rpm?"));
  EXPECT_THAT(error("{ value = [1, 2, 3], units = \"rpm\" }"), StartsWith("f.toml:6:14: "));
  EXPECT_THAT(error("{ value = [1, 2, 3] }"), StartsWith("f.toml:6:14: "));
}

TEST(Scenario, EpochsAreRealDates) {
  const auto error = [&](const std::string& epoch) {
    return error_of(head + "[state]\nepoch = \"" + epoch + "\"\n" + andoyer);
  };
  for (const char* good :
       {"2013-01-05T00:00:00 UTC", "2013-01-05 TT", "2012-02-29T23:59:59.999 TDB",
        "2016-12-31T23:59:60 UTC", "2013-01-05 18:30 UT1", "JD 2456297.5 TAI", "JD -1.5e3 TT"})
    EXPECT_EQ(error(good), "") << good;
  for (const char* bad : {"2013-02-29 UTC", "2013-13-01 UTC", "2013-1-5 UTC", "2013-01-05",
                          "2013-01-05 EST", "2013-01-05T24:00:00 UTC", "2013-01-05T23:59:60 TT",
                          "2013-01-05T1 UTC", "2013-01-05T12:00:00. UTC", "2013-01-05X12:00:00 UTC",
                          "JD nan UTC", "JD UTC", "JD 1x TT", "", " UTC", "0000-00-00 UTC"})
    EXPECT_THAT(error(bad), HasSubstr("f.toml:5:9: state.epoch: got \"")) << bad;
}

TEST(Scenario, NoiseIsRefusedInOneLine) {
  EXPECT_EQ(error_of(""),
            "f.toml:1:1: file: got no key at all; expected a scenario (polhode init prints one)");
  EXPECT_EQ(error_of("# only a comment\n").find("f.toml:1:1: file: got no key"), 0U);
  std::string deep;
  for (int i = 0; i < 1000000; ++i) deep += "a.";
  for (const std::string& text :
       {deep + "a = 1", "[" + deep + "a]", "x = " + std::string(1000000, '['),
        "x = " + std::string(100000, '{'), std::string(1000, '\0'),
        std::string("[\0te]\na = 1", 11), std::string("\xff\xfe\0\0", 4),
        std::string(17 << 20, ' '), "a = " + std::string(1000000, '9'),
        "a = \"" + std::string(1000000, 'x')}) {
    const std::string error = error_of(text);
    EXPECT_EQ(error.find("f.toml:1:"), 0U) << error.substr(0, 200);
    EXPECT_EQ(error.find('\n'), std::string::npos);
    EXPECT_LT(error.size(), 400U);
  }
}

TEST(Scenario, QuotesAndCommentsMayHoldAnything) {
  const auto error = [&](const std::string& lines) { return error_of(lines + head + andoyer); };
  for (const char* good :
       {"# \xc3\xa9 ... ' \" \n", "title = \"\xc3\xa9 # \"\n", "title = '\xc3\xa9 \\'\n",
        "title = \"\\\"\xc3\xa9\"\n", "title = \"\"\n", "title = ''\n",
        "title = \"\"\"\xc3\xa9 \"\" \\\" \"\"\"\"\"\n", "title = '''\xc3\xa9 '' \\ '''''\n",
        "title = \"\"\"\"\"\"\n"})
    EXPECT_EQ(error(good), "") << good;
  EXPECT_EQ(error("title = \"" + std::string(300, '.') + "\"\n# " + std::string(300, '.') + "\n"),
            "");
  for (const char* bad : {"\xc3\xa9 = 1\n", "title = \xc3\xa9\n", "title = \"\" \xc3\xa9\n",
                          "title = \"a\\\"\" \xc3\xa9\n", "a = +'\xc3\xa9'\n",
                          "title = \"a\"'\xc3\xa9'\n", "title = ''' '''''\xc3\xa9\n"})
    EXPECT_THAT(error(bad), HasSubstr(": file: not TOML: got a character beyond ASCII")) << bad;
  EXPECT_THAT(error("title = \"\xc3\xa9\" \xc3\xa9\n"), StartsWith("f.toml:1:13: file: "));
}

TEST(Scenario, TheKindOfAnExperimentIsARotationUnlessTheFileSaysOtherwise) {
  EXPECT_EQ(io::scenario_from_text(head + andoyer, "f.toml").document.kind, "rotation");
  const io::Scenario named =
      io::scenario_from_text("kind = \"rotation\"\n" + head + andoyer, "f.toml");
  EXPECT_TRUE(std::holds_alternative<io::Rotation>(named.experiment));
  const std::string error = error_of("kind = \"rotaton\"\n" + head + andoyer);
  EXPECT_EQ(error,
            "f.toml:1:8: kind: got \"rotaton\"; expected \"rotation\", \"fit\", \"obliquity\" or "
            "\"nutation\"; did you mean \"rotation\"?");
}

TEST(Scenario, ItsProblemIsTheRunToTheLastRow) {
  const io::Scenario s = io::scenario_from_text(
      head + andoyer + "[time]\nstart = 2\nstop = 8\nstep = 3\n[[perturbation]]\n" +
          "kind = \"constant-torque\"\ntorque = [0, 0, 1]\n[method]\nkind = \"splitting\"\n" +
          "step = 0.5\n",
      "f.toml");
  const Problem problem = io::problem(s.experiment);
  EXPECT_EQ(problem.start, 0.0);
  EXPECT_EQ(problem.stop, 8.0);
  EXPECT_EQ(problem.initial, io::initial_state(s));
  EXPECT_EQ(problem.initial.damper_rate, Vec3{});
  EXPECT_EQ(problem.method, Method(Splitting{.step = 0.5}));
  EXPECT_EQ(problem.system.terms().size(), 1U);
  EXPECT_TRUE(problem.events.empty());
  EXPECT_THROW(
      polhode::io::problem(polhode::io::scenario_from_text(head + andoyer, "f.toml").experiment),
      DomainError);
}

TEST(Scenario, ManyErrorsStayFew) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "key" + std::to_string(i) + " = 1\n";
  const std::string error = error_of(text);
  EXPECT_LE(std::count(error.begin(), error.end(), '\n'), 20);
}

TEST(Scenario, MessagesArePrintable) {
  const std::string error =
      error_of("[units]\nmoment = \"4\xef\xbb\xbf\"\n\"k\xc3\xa9y\" = 1\n" + head + andoyer);
  EXPECT_THAT(error, HasSubstr("a number inside the unit \"4\\xef\\xbb\\xbf\""));
  EXPECT_TRUE(std::all_of(error.begin(), error.end(),
                          [](char c) { return (c >= 0x20 && c < 0x7f) || c == '\n'; }));
}

TEST(Scenario, NamesOfAnyFileStayOneLine) {
  EXPECT_THAT(
      test::message_of<io::ScenarioError>([&] { io::scenario_from_text("", "a\nb\x1b.toml"); }),
      StartsWith("a\\x0ab\\x1b.toml:1:1: "));
}

}  // namespace
}  // namespace polhode
