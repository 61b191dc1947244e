// SPDX-License-Identifier: MIT
// Maps over the spin axes of planets. Oracles: the scenario with the numbers of the cell, run by
// itself, and the closed form of the precession on an orbit that stays.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/run/map_run.hpp"
#include "temp_folder.hpp"
#include "unit/run/map_refusal.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::larger;
using polhode::test::refusal;
using polhode::test::smaller;
using ::testing::HasSubstr;

constexpr double deg = std::numbers::pi / 180.0;

// The orbit stays, or has a node that moves.
std::string file(const std::string& orbit, const std::string& more) {
  return R"(schema = 1
kind = "obliquity"
units = { time = "kyr", angle = "deg" }
planet = { orbit = "own", precession_constant = 3, pole = { obliquity = 30, precession = 95 } }
method = { kind = "splitting", scheme = "order8", step = 2 }
time = { stop = -4000, step = 2 }
orbit.own = { kind = )" +
         orbit + " }\n" + more;
}
const std::string shipped = R"("shipped", name = "mars")";
const std::string frequency = "[map]\nkind = \"frequency\"\n";
const std::string column = "[map]\nkind = \"column\"\ncolumn = \"obliquity\"\n";
const std::string two_axes = R"([[map.axis]]
key = "planet.precession_constant"
from = 2
to = 4
count = 3
[[map.axis]]
key = "planet.pole.obliquity"
from = 10
to = 70
count = 2
)";

TEST(MapOfSpins, TheExtremesAreThoseOfTheRun) {
  const io::ScenarioMap map(file(shipped, column + two_axes), "m");
  ASSERT_EQ(map.groups()[2].columns[1].name, "obliquity_largest");
  EXPECT_EQ(map.groups()[2].columns[1].unit, "deg");
  std::string plain = file(shipped, "");
  plain.replace(plain.find("obliquity = 30"), 14, "obliquity = 70");
  plain.replace(plain.find("constant = 3"), 12, "constant = 4");
  const io::Scenario scenario = io::scenario_from_text(plain, "plain");
  const auto& of = std::get<io::Obliquity>(scenario.experiment);
  double least = INFINITY, most = -INFINITY, last = 0.0;
  integrate(io::spin_problem(of), *of.time,
            [&](std::span<const BasicSample<secular::SpinAxis>> samples) {
              for (const BasicSample<secular::SpinAxis>& one : samples) {
                last = secular::spin_angles(one.s, of.history.at(one.t)).obliquity / deg;
                least = smaller(least, last);
                most = larger(most, last);
              }
            });
  const std::vector<double> found = map.cell(5).numbers;
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], least, budget::map_extremes);
  EXPECT_NEAR(found[1], most, budget::map_extremes);
  EXPECT_NEAR(found[2], last, budget::map_extremes);
  EXPECT_LT(found[0], found[1]);
}

class MapOfSpinsInFolder : public test::InTempFolder {};

// psi = constant cos(obliquity) t, in either direction of time.
TEST_F(MapOfSpinsInFolder, OnAnOrbitThatStaysTheFrequencyIsThatOfTheClosedForm) {
  const std::string fixed = R"("elements", file = ")" +
                            write("fixed.txt",
                                  "-4000 0 0 0.01 0.02\n0 0 0 0.01 0.02\n"
                                  "4000 0 0 0.01 0.02\n8000 0 0 0.01 0.02\n") +
                            R"(", columns = ["t", "k", "h", "q", "p"], )" +
                            R"(units = ["kyr", "1", "1", "1", "1"], axes = "inertial")";
  for (const char* const stop : {"-4000", "4000"}) {
    std::string text = file(fixed, frequency + two_axes);
    text.replace(text.find("stop = -4000") + 7, 5, stop);
    const io::ScenarioMap map(text, "m");
    EXPECT_EQ(map.groups()[2].columns[0].unit, "deg/kyr");
    for (std::int64_t k = 0; k < map.size(); ++k) {
      const std::vector<double> at = map.axis_values(k), found = map.cell(k).numbers;
      const double expected = at[0] * std::cos(at[1] * deg);
      EXPECT_NEAR(found[0], expected, budget::map_frequency);
      EXPECT_NEAR(found[1], expected, budget::map_frequency);
      EXPECT_LT(found[2], budget::map_frequency);
    }
  }
}

// Laskar & Robutel 1993: Mars at 25 deg lies in a chaotic zone, at 76 deg the motion is regular.
TEST(MapOfSpins, ChaosChangesTheFrequency) {
  std::string text = file(shipped, frequency + R"([[map.axis]]
key = "planet.pole.obliquity"
from = 28
to = 76
count = 2
)");
  text.replace(text.find("-4000"), 5, "-20000");
  text.replace(text.find("constant = 3"), 12, "constant = 2.33");
  const io::ScenarioMap map(text, "m");
  EXPECT_GT(map.cell(0).numbers[2], budget::map_chaotic);
  EXPECT_LT(map.cell(1).numbers[2], budget::map_regular);
}

TEST(MapOfSpins, WhatIsNone) {
  EXPECT_THAT(
      refusal(file(shipped, "[map]\nkind = \"chaos\"\n" + two_axes)),
      HasSubstr("map.kind: got \"chaos\"; expected \"column\" or \"frequency\" in a file of "
                "kind \"obliquity\""));
  EXPECT_THAT(
      refusal(file(shipped, "[map]\nkind = \"column\"\ncolumn = \"obliquty\"\n" + two_axes)),
      HasSubstr("did you mean obliquity?"));
  EXPECT_THAT(
      refusal(file(shipped, "[map]\nkind = \"column\"\ncolumn = \"insolation\"\n" + two_axes)),
      HasSubstr("map.column: got \"insolation\"; expected a table planet.insolation"));
  EXPECT_THAT(refusal(file(shipped, frequency)), HasSubstr("map.axis: got nothing"));
  std::string few = file(shipped, frequency + two_axes);
  few.replace(few.find("step = 2 }\norbit"), 8, "step = 300");
  EXPECT_THAT(refusal(few), HasSubstr("expected 16 rows or more"));
  EXPECT_THAT(refusal(R"(schema = 1
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 10, theta = 60, psi = 30, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
time = { stop = 20, step = 0.5 }
[map]
kind = "frequency"
[[map.axis]]
key = "body.moments[0]"
from = 0.8
to = 1
count = 2
)"),
              HasSubstr("map.kind: got \"frequency\"; expected \"chaos\""));
}

}  // namespace
}  // namespace polhode
