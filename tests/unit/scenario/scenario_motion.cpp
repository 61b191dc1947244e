// SPDX-License-Identifier: MIT
// Frames, orbits, perturbations, methods and events of a scenario.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario_text.hpp"

namespace polhode {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string head =  // six lines
    test::scenario_text("", {.quaternion = "[0.5, 0.5, 0.5, 0.5]"});
const std::string orbit = "[orbit.moon]\ngm = 1\nsemi_major_axis = 1\n";
const std::string gravity = "[[perturbation]]\nkind = \"gravity-gradient\"\norbit = \"moon\"\n";

io::Scenario read(const std::string& rest) { return io::scenario_from_text(head + rest, "f.toml"); }

std::string error_of(const std::string& rest) {
  return test::message_of<io::ScenarioError>([&] { read(rest); });
}

TEST(ScenarioMotion, OrbitsKeepTheirElements) {
  const io::Scenario s = io::scenario_from_text(
      "schema = 1\n[units]\nlength = \"km\"\nangle = \"deg\"\n" + head.substr(11) +
          "[orbit.leo]\ngm = \"3.986004418e14 m3/s2\"\npericentre = \"6678 km\"\n"
          "eccentricity = 0.5\ninclination = 180\nnode_rate = \"-360 deg/d\"\n",
      "f.toml");
  ASSERT_EQ(s.rotation().orbits.size(), 1U);
  const io::ScenarioOrbit& leo = s.rotation().orbits[0];
  EXPECT_EQ(leo.name, "leo");
  const auto& motion = std::get<PrecessingKeplerOrbit>(leo.motion);
  EXPECT_DOUBLE_EQ(motion.gm(), 398600.4418);
  EXPECT_EQ(leo.gm, motion.gm());
  EXPECT_EQ(motion.elements().pericentre, 6678.0);
  EXPECT_EQ(motion.elements().inclination, std::numbers::pi);
  EXPECT_DOUBLE_EQ(motion.rates().node, -2.0 * std::numbers::pi / 86400.0);
}

TEST(ScenarioMotion, TermsStandInTheOrderOfTheFile) {
  const io::Scenario s = read(orbit + gravity +
                              "[[perturbation]]\nkind = \"damping\"\ncoefficients = [1, 1, 1]\n"
                              "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [1, 0, 0]\n");
  ASSERT_EQ(s.rotation().terms.size(), 3U);
  EXPECT_EQ(s.rotation().terms[0].name(), "gravity gradient, orbit moon");
  EXPECT_EQ(s.rotation().terms[1].name(), "damping");
  EXPECT_EQ(s.rotation().terms[2].name(), "constant torque, body axes");
}

// The file's body axes are those of the tensor, so are the components of a torque and of damping: a
// body turned in its axes feels the turned torque.
TEST(ScenarioMotion, TorquesAndDampingStandInTheAxesOfTheTensor) {
  const auto torque = [](const std::string& body, const std::string& term) {
    const io::Scenario s = io::scenario_from_text(
        "schema = 1\n[body]\n" + body +
            "\n[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [1, 2, 3]\n"
            "[[perturbation]]\n" +
            term,
        "f.toml");
    const Vec3 u = effect(io::rotor_system(s), 0.0, io::initial_state(s)).u;
    return rotate(s.rotation().body.q_FB(), u);
  };
  // moments 1, 2, 2.5 about axes turned by atan(3/4) about the third: all numbers are exact
  const std::string turned = "tensor = [[1.36, -0.48, 0], [-0.48, 1.64, 0], [0, 0, 2.5]]";
  const std::string push = "kind = \"constant-torque\"\ntorque = [1, 2, 3]\n";
  EXPECT_NEAR(norm(torque(turned, push) - Vec3{1.0, 2.0, 3.0}), 0.0, budget::io_state);
  const std::string drag =
      "kind = \"damping\"\ncoefficients = [[1, 0.5, 0], [0.5, 2, 0], [0, 0, 3]]\n";
  EXPECT_NEAR(norm(torque(turned, drag) - Vec3{-2.0, -4.5, -9.0}), 0.0, 3.0 * budget::io_state);
  const std::string plain = "kind = \"damping\"\ncoefficients = [1, 2, 3]\n";
  EXPECT_NEAR(norm(torque(turned, plain) - Vec3{-1.0, -4.0, -9.0}), 0.0, 3.0 * budget::io_state);
}

// The attitude of the file is that in the frame; a rate in inertial components is in inertial axes.
TEST(ScenarioMotion, TheStateIsThatInTheFrame) {
  const std::string frame = "[frame.precessing]\naxis = [0, 0, 2]\nrate = 0.5\nepoch = -3\n";
  const std::string text = test::scenario_text(frame, {.rate = "omega_inertial = [1, 0, 0]\n"});
  const RotorState s = io::initial_state(io::scenario_from_text(text, "f.toml"));
  EXPECT_EQ(s.q, Quaternion{});
  // S has turned by 1.5 rad about axis 3, and so has the body
  EXPECT_NEAR(s.g.x, std::cos(1.5), budget::io_state);
  EXPECT_NEAR(s.g.y, -2.0 * std::sin(1.5), budget::io_state);
}

// omega = omega_relative + mu, mu the rate of the frame, here about the third axis of both.
TEST(ScenarioMotion, ARateMayBeRelativeToTheFrame) {
  const std::string text =
      "schema = 1\n[body]\nmoments = [1, 2, 2.5]\n[frame.precessing]\naxis = [0, 0, 1]\n"
      "rate = 0.5\nepoch = -3\n[state.attitude-rate]\nomega_relative = [0.1, 0, 0.2]\n";
  const RotorState s =
      io::initial_state(io::scenario_from_text(text + "quaternion = [1, 0, 0, 0]\n", "f.toml"));
  EXPECT_NEAR(norm(s.g - Vec3{0.1, 0.0, 2.5 * 0.7}), 0.0, budget::io_state);
  // a quarter turn about axis 1: axis 3 of the frame is axis 2 of the body
  const RotorState tilted =
      io::initial_state(io::scenario_from_text(text + "quaternion = [1, 1, 0, 0]\n", "f.toml"));
  EXPECT_NEAR(norm(tilted.g - Vec3{0.1, 2.0 * 0.5, 2.5 * 0.2}), 0.0, budget::io_state);
}

TEST(ScenarioMotion, AFrameMayTurnWithAnOrbit) {
  const auto rate = [](const std::string& keys, const char* turns) {
    const io::Scenario s =
        read("[orbit.moon]\ngm = 2\nsemi_major_axis = 2\n" + keys +
             "[frame.precessing]\naxis = [0, 0, 1]\norbit = \"moon\"\nturns = " + turns + "\n");
    return s.rotation().precession.value().rate;
  };
  EXPECT_NEAR(rate("", "1"), 0.5, budget::io_state);
  EXPECT_NEAR(rate("eccentricity = 0.3\n", "1.5"), 0.75, budget::io_state);
  EXPECT_NEAR(rate("node_rate = -0.2\npericentre_rate = 0.4\nmean_anomaly_rate = 0.01\n", "-1"),
              -0.71, budget::io_state);
  const std::string frame = "[frame.precessing]\naxis = [0, 0, 1]\n";
  EXPECT_THAT(error_of(orbit + frame + "orbit = \"moon\"\n"),
              HasSubstr("expected exactly one of rate, orbit with turns"));
  EXPECT_THAT(error_of(orbit + frame + "rate = 1\nturns = 1\n"),
              HasSubstr("expected exactly one of rate, orbit with turns"));
  EXPECT_THAT(error_of("[orbit.moon]\ngm = 1\npericentre = 1\neccentricity = 2\n" + frame +
                       "orbit = \"moon\"\nturns = 1\n"),
              HasSubstr("frame.precessing.orbit: got \"moon\"; expected an ellipse with elements"));
}

TEST(ScenarioMotion, APeriodGivesTheSizeOfAnOrbit) {
  const io::Scenario s = read("[orbit.moon]\ngm = 3\nperiod = 5\neccentricity = 0.2\n");
  const KeplerElements* elements = io::kepler_elements(s.rotation().orbits.at(0));
  ASSERT_NE(elements, nullptr);
  const double a = std::cbrt(3.0 * std::pow(5.0 / (2.0 * std::numbers::pi), 2));
  EXPECT_NEAR(elements->pericentre, 0.8 * a, budget::io_state);
  EXPECT_NEAR(mean_motion(*elements), 2.0 * std::numbers::pi / 5.0, budget::io_state);
}

TEST(ScenarioMotion, TheFrameOfAnOrbitTurnsWithItsNode) {
  const io::Scenario s = read(orbit +
                              "inclination = 0.3\nnode = 0.2\nnode_rate = 0.1\nepoch = 1\n"
                              "[frame.orbit-plane]\norbit = \"moon\"\n");
  const FrameMotion m = s.rotation().frame.at(3.0);
  const Vec3 normal = rotate(m.q_IS, Vec3{0.0, 0.0, 1.0});
  EXPECT_NEAR(normal.x, std::sin(0.3) * std::sin(0.4), budget::io_state);
  EXPECT_NEAR(normal.y, -std::sin(0.3) * std::cos(0.4), budget::io_state);
  EXPECT_NEAR(norm(rotate(m.q_IS, m.mu_S) - Vec3{0.0, 0.0, 0.1}), 0.0, budget::io_state);
}

TEST(ScenarioMotion, TheMethodIsThatOfTheFileOrASensibleOne) {
  EXPECT_FALSE(io::propagation_method(read("")).has_value());
  EXPECT_FALSE(io::propagation_method(read("[frame.precessing]\naxis = [1, 0, 0]\nrate = 1\n")));
  EXPECT_EQ(io::propagation_method(read(orbit + gravity)), Method(Collocation{}));
  EXPECT_FALSE(io::propagation_method(read("[[event]]\ncolumn = \"theta\"\n")).has_value());
  EXPECT_EQ(read("[method]\nkind = \"splitting\"\nstep = 0.1\n").rotation().method,
            Method(Splitting{.step = 0.1}));
  EXPECT_EQ(read("[method]\nkind = \"adaptive\"\nprecision = \"double-double\"\n"
                 "tolerance = 1e-25\nlargest_step = 2\n")
                .rotation()
                .method,
            Method(Adaptive{
                .tolerance = 1e-25, .precision = Precision::double_double, .largest_step = 2.0}));
  EXPECT_EQ(
      read("[method]\nkind = \"variation-of-constants\"\ntolerance = 1e-9\n").rotation().method,
      Method(VariationOfConstants{.tolerance = 1e-9}));
  EXPECT_THAT(io::propagation_text(read(orbit + gravity)), HasSubstr("the file names no method"));
  EXPECT_EQ(io::propagation_text(read("")), "exact free rotation");
}

TEST(ScenarioMotion, EventsAreInTheUnitOfTheirColumn) {
  const io::Scenario s =
      io::scenario_from_text("schema = 1\n[units]\nangle = \"deg\"\n" + head.substr(11) +
                                 "[[event]]\ncolumn = \"theta\"\nvalue = 90\n"
                                 "crossing = \"falling\"\nstops = true\n"
                                 "[[event]]\nname = \"b\"\ncolumn = \"L_osc\"\n",
                             "f.toml");
  ASSERT_EQ(s.rotation().events.size(), 2U);
  EXPECT_EQ(s.rotation().events[0].name, "theta");
  EXPECT_EQ(s.rotation().events[0].value, std::numbers::pi / 2.0);
  EXPECT_EQ(s.rotation().events[0].crossing, Crossing::falling);
  EXPECT_TRUE(s.rotation().events[0].stops);
  EXPECT_EQ(s.rotation().events[1].name, "b");
  EXPECT_EQ(s.rotation().events[1].crossing, Crossing::both);
  EXPECT_EQ(s.rotation().events[1].interval, 0.0);
  EXPECT_FALSE(s.rotation().events[1].stops);
}

TEST(ScenarioMotion, EllipsesAndHyperbolasAreOrbits) {
  for (const std::string size :
       {"semi_major_axis = 2\neccentricity = 0.5\n", "pericentre = 2\neccentricity = 1.5\n"})
    EXPECT_EQ(error_of("[orbit.moon]\ngm = 1\n" + size), "");
}

TEST(ScenarioMotion, UnknownOrbitsNameTheNearest) {
  const std::string term = "[[perturbation]]\nkind = \"gravity-gradient\"\norbit = ";
  EXPECT_EQ(error_of(orbit + term + "\"mooon\"\n"),
            "f.toml:12:9: perturbation[0].orbit: got \"mooon\"; expected the name of an orbit of "
            "this file: moon; did you mean moon?");
  EXPECT_EQ(error_of(term + "\"moon\"\n"),
            "f.toml:9:9: perturbation[0].orbit: got \"moon\"; expected a table [orbit.moon]");
}

TEST(ScenarioMotion, WhatCannotBeSaysWhy) {
  const test::Rejected rows[] = {
      {"[orbit.moon]\ngm = 1\npericentre = 2\neccentricity = 1\n",
       "f.toml:10:16: orbit.moon.eccentricity: got 1; expected 0 <= e < 1"},
      {"[orbit.moon]\ngm = 1\nsemi_major_axis = 2\neccentricity = -0.1\n",
       "f.toml:10:16: orbit.moon.eccentricity: got -0.1; expected 0 <= e < 1"},
      {"[orbit.moon]\ngm = 1\nsemi_major_axis = 2\neccentricity = 1.5\n",
       "f.toml:9:19: orbit.moon.semi_major_axis: got 2; expected pericentre"},
      {"[orbit.moon]\ngm = 0\npericentre = 2\n",
       "f.toml:8:6: orbit.moon.gm: got 0; expected a positive"},
      {"[orbit.moon]\ngm = 1\npericentre = -2\n",
       "f.toml:9:14: orbit.moon.pericentre: got -2; expected a positive length"},
      {"[orbit.moon]\ngm = 1\n",
       "orbit.moon: got none of them; expected exactly one of semi_major_axis, pericentre"},
      {"[orbit.moon]\ngm = 1\nperiod = 0\n",
       "f.toml:9:10: orbit.moon.period: got 0; expected a positive time"},
      {"[orbit.moon]\ngm = 1\nperiod = 2\neccentricity = 1.5\n",
       "f.toml:9:10: orbit.moon.period: got 2; expected pericentre"},
      {"[orbit.moon]\ngm = 1\npericentre = 2\nsemi_major_axis = 1\n",
       "orbit.moon: got semi_major_axis, pericentre; expected exactly one of"},
      {"[orbit.moon]\ngm = \"1 km3/s2\"\npericentre = 2\n",
       "\"km3/s2\" is not a unit of gravitational parameter here"},
      {orbit + "[frame.orbit-plane]\norbit = \"mon\"\n",
       "f.toml:11:9: frame.orbit-plane.orbit: got \"mon\"; expected the name"},
      {orbit + gravity + "torque = [1, 2, 3]\n",
       "f.toml:13:1: perturbation[0].torque: a key of kind \"constant-torque\"; expected with kind "
       "= \"gravity-gradient\" only kind, orbit, gm, "},
      {"[[perturbation]]\nkind = \"damping\"\n",
       "f.toml:7:1: perturbation[0].coefficients: got nothing; expected"},
      {"[[perturbation]]\ntorque = [1, 2, 3]\n",
       "f.toml:7:1: perturbation[0].kind: got nothing; expected"},
      {"[[perturbation]]\nkind = \"dampening\"\ncoefficients = [1, 1, 1]\n",
       "did you mean \"damping\"?"},
      {"[frame]\n", "expected exactly one of precessing, orbit-plane"},
      {"[[perturbation]]\nkind = \"damping\"\ncoefficients = [1, -1, 1]\n",
       "f.toml:9:16: perturbation[0].coefficients: got [1, -1, 1]; LinearDamping"},
      {"[[perturbation]]\nkind = \"damping\"\ncoefficients = [[1, 2, 3]]\n",
       "expected an array of 3 numbers (a diagonal) or of 3 arrays of 3 numbers"},
      {orbit + gravity + "gm = -1\n",
       "f.toml:13:6: perturbation[0].gm: got -1; expected a positive"},
      {"[frame.precessing]\naxis = [0, 0, 0]\nrate = 1\n",
       "f.toml:8:8: frame.precessing.axis: got [0, 0, 0]; "},
      {"[method]\nkind = \"adaptive\"\ntolerance = 0\n",
       "f.toml:9:13: method.tolerance: got 0; Adaptive: tolerance 0 must be from"},
      {"[method]\nkind = \"adaptive\"\ntolerance = 1e-20\n", "1e-15"},
      {"[method]\nkind = \"splitting\"\nstep = -0.1\n",
       "f.toml:9:8: method.step: got -0.1; Splitting: step -0.1 must be positive"},
      {"[method]\nkind = \"splitting\"\nstep = 1e-300\n[time]\nstop = 1\nstep = 1\n",
       "f.toml:9:8: method.step: got 1e-300; expected a step of which 1e15"},
      {"[method]\nkind = \"splitting\"\n", "method.step: got nothing; expected"},
      {"[method]\nkind = \"splitting\"\nstep = 1\ntolerance = 1e-9\n",
       "f.toml:10:1: method.tolerance: a key of kind \"adaptive\", \"collocation\" or "
       "\"variation-of-constants\"; expected with kind = \"splitting\" only"},
      {"[method]\nkind = \"collocation\"\nstages = 5\n",
       "f.toml:9:10: method.stages: got 5; Collocation: stages must be 4, 8 or"},
      {"[method]\nkind = \"collocation\"\nstep = -1\n",
       "f.toml:9:8: method.step: got -1; expected a positive time"},
      {"[method]\nkind = \"adaptive\"\nlargest_step = 0\n",
       "f.toml:9:16: method.largest_step: got 0; expected a positive time"},
      {"[[event]]\ncolumn = \"tehta\"\n",
       "f.toml:8:10: event[0].column: got \"tehta\"; expected a column such as"},
      {"[[event]]\ncolumn = \"tehta\"\n", "did you mean theta?"},
      {"[[event]]\ncolumn = \"t\"\n", "event[0].column"},
      {"[[event]]\nvalue = 1\n", "event[0].column: got nothing"},
      {"[[event]]\ncolumn = \"L\"\n[[event]]\ncolumn = \"L\"\n",
       "f.toml:10:10: event[1].column: got \"L\"; expected a name of its own"},
      {"[[event]]\ncolumn = \"L\"\nname = \"a,b\"\n",
       "event[0].name: got \"a,b\"; expected a name of letters, digits, - and _"},
      {"[[event]]\ncolumn = \"L\"\nstops = 1\n", "event[0].stops: got 1; expected true or false"},
  };
  test::expect_rejected(error_of, rows);
}

TEST(ScenarioMotion, NotesSayOfEveryAngularVelocityWhichOneItIs) {
  const auto notes = [](const std::string& columns) {
    return io::provenance(read("[output]\ncolumns = [" + columns + "]\n")).notes;
  };
  const std::string inertial =
      "w1, w2, w3: angular velocity relative to inertial axes, body components";
  EXPECT_THAT(notes("\"q\", \"omega\""), Contains(inertial));
  EXPECT_THAT(notes("\"omega_rel\""), Not(Contains(inertial)));
  EXPECT_THAT(
      notes("\"omega_rel\""),
      Contains(StartsWith("w1_rel, w2_rel, w3_rel: angular velocity relative to the reference")));
  EXPECT_THAT(notes("\"omega_inertial\""), Contains(StartsWith("W1, W2, W3: ")));
}

TEST(ScenarioMotion, MatricesTakeOneUnitForAll) {
  const auto scenario = [](const std::string& tensor, const std::string& damping) {
    return io::scenario_from_text(
        "schema = 1\n[units]\nmoment = \"kg m2\"\n[body]\ntensor = " + tensor +
            "\n[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [1, 2, 3]\n"
            "[[perturbation]]\nkind = \"damping\"\ncoefficients = " +
            damping + "\n",
        "f.toml");
  };
  const auto torque = [](const io::Scenario& s) {
    return effect(io::rotor_system(s), 0.0, io::initial_state(s)).u;
  };
  const std::string rows = "[[2, 0.5, 0], [0.5, 2, 0], [0, 0, 1]]";
  const io::Scenario bare = scenario(rows, rows);
  const io::Scenario united = scenario("{ value = " + rows + ", unit = \"kg m2\" }",
                                       "{ value = " + rows + ", unit = \"N m s\" }");
  EXPECT_EQ(united.rotation().body.moments(), bare.rotation().body.moments());
  EXPECT_EQ(torque(united), torque(bare));
  const io::Scenario grams = scenario(rows, "{ value = " + rows + ", unit = \"g m2/s\" }");
  EXPECT_NEAR(norm(1000.0 * torque(grams) - torque(bare)), 0.0, 6.0 * budget::io_state);
  EXPECT_THAT(error_of("[[perturbation]]\nkind = \"damping\"\ncoefficients = { value = " + rows +
                       ", unit = \"kg m2\" }\n"),
              HasSubstr("\"kg m2\" is no"));
}

TEST(ScenarioMotion, EnergyNeedsTermsThatHaveOne) {
  const std::string drag = "[[perturbation]]\nkind = \"damping\"\ncoefficients = [1, 1, 1]\n";
  EXPECT_EQ(error_of(orbit + gravity + "[output]\ncolumns = [\"energy\"]\n"), "");
  EXPECT_THAT(
      error_of(drag + "[output]\ncolumns = [\"energy\"]\n"),
      StartsWith("f.toml:11:11: output.columns: got [\"energy\"]; expected no energy, since "
                 "a perturbation has none: damping"));
  EXPECT_THAT(error_of(drag + "[[event]]\ncolumn = \"dE\"\n"),
              StartsWith("f.toml:11:10: event[0].column: got \"dE\"; expected no energy"));
}

TEST(ScenarioMotion, IntegratedRowsComeInOrder) {
  const std::string times = "[time]\nat = [0, 2, 1]\n";
  EXPECT_EQ(error_of(times), "");
  EXPECT_EQ(error_of(orbit + gravity + "[time]\nat = [2, 1, -1]\n"), "");
  EXPECT_THAT(error_of(orbit + gravity + times),
              StartsWith("f.toml:14:6: time.at: got [0, 2, 1]; expected times in order"));
}

}  // namespace
}  // namespace polhode
