// SPDX-License-Identifier: MIT
// Maps: every cell is the scenario that a file with its numbers would be; rows survive a kill.
#include "polhode/run/map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "budgets.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/analysis/section.hpp"
#include "polhode/error.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::larger;
using polhode::test::smaller;
using ::testing::HasSubstr;

const std::string body = R"(schema = 1
units = { time = "h", angle = "deg" }
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 10, theta = 60, psi = 30, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
time = { stop = 20, step = 0.5 }
)";
const std::string two_axes = R"(
[[map.axis]]
key = "body.moments[1]"
from = 1.5
to = 1.9
count = 3
[[map.axis]]
key = "state.euler.theta"
from = 60
to = 90
count = 2
)";

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(ScenarioMap, ACellIsTheScenarioWithItsNumbers) {
  const ScenarioMap map(body + "[map]\nkind = \"chaos\"\n" + two_axes, "m.toml");
  ASSERT_EQ(map.size(), 6);
  EXPECT_EQ(map.place(0), (std::vector<double>{1.5, 60.0}));
  EXPECT_EQ(map.place(3), (std::vector<double>{1.7, 90.0}));
  std::string plain = body;
  plain.replace(plain.find("theta = 60"), 10, "theta = 90");
  const Scenario scenario = scenario_from_text(plain, "plain");
  const Problem problem{rotor_system(scenario), initial_state(scenario), 0.0, 20.0, Adaptive{}, {}};
  const ChaosIndicator expected = chaos_indicator(problem, SaveAt::times({20.0}));
  EXPECT_EQ(map.cell(3).numbers, (std::vector<double>{expected.mean_megno(), expected.lyapunov()}));
  const std::vector<ColumnGroup> groups = map.groups();
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[1].columns[0].name, "state.euler.theta");
  EXPECT_EQ(groups[1].columns[0].unit, "deg");
  EXPECT_EQ(groups[2].columns[1].unit, "1/h");
}

TEST(ScenarioMap, ExtremesAreThoseOfTheRows) {
  const ScenarioMap map(body + "[map]\nkind = \"column\"\ncolumn = \"psi\"\n" + two_axes, "m");
  std::string plain = body;
  plain.replace(plain.find("1, 1.7"), 6, "1, 1.5");
  const Scenario scenario = scenario_from_text(plain, "plain");
  const FreeRotation motion = free_rotation(scenario);
  double least = INFINITY, most = -INFINITY, last = 0.0;
  for (std::int64_t k = 0; k <= 40; ++k) {
    last = to_euler(motion.at(0.5 * static_cast<double>(k))).psi * 180.0 / M_PI;
    least = smaller(least, last);
    most = larger(most, last);
  }
  const MapCell cell = map.cell(0);
  ASSERT_EQ(cell.numbers.size(), 3U);
  EXPECT_NEAR(cell.numbers[0], least, budget::map_extremes);
  EXPECT_NEAR(cell.numbers[1], most, budget::map_extremes);
  EXPECT_NEAR(cell.numbers[2], last, budget::map_extremes);
}

TEST(ScenarioMap, WhatAChartRefusesIsACellWithItsReason) {
  const ScenarioMap map(body + R"([map]
kind = "chaos"
[[map.axis]]
key = "body.moments[0]"
from = 0.1
to = 1
count = 2
)",
                        "m");
  const MapCell cell = map.cell(0);
  EXPECT_TRUE(std::isnan(cell.numbers[0]));
  EXPECT_THAT(cell.failure, HasSubstr("body.moments"));
  EXPECT_EQ(map.cell(1).failure, "");
}

std::string refusal(const std::string& text) {
  try {
    const ScenarioMap map(text, "m.toml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

TEST(ScenarioMap, WhatIsNoMap) {
  const std::string chaos = body + "[map]\nkind = \"chaos\"\n";
  const auto axis = [](const char* key, const char* count) {
    return std::string("[[map.axis]]\nkey = \"") + key + "\"\nfrom = 0\nto = 1\ncount = " + count;
  };
  EXPECT_THAT(refusal(body), HasSubstr("expected a table [map]"));
  EXPECT_THAT(refusal(chaos), HasSubstr("map.axis: got nothing"));
  EXPECT_THAT(refusal(chaos + axis("state.euler.tetha", "2")),
              HasSubstr("m.toml:9:7: map.axis[0].key: got \"state.euler.tetha\"; expected a key"));
  EXPECT_THAT(refusal(chaos + axis("state.euler.tetha", "2")),
              HasSubstr("did you mean state.euler.theta?"));
  EXPECT_THAT(refusal(chaos + axis("body.moments", "2")), HasSubstr("mean body.moments[0]?"));
  EXPECT_THAT(refusal(chaos + axis("body.momnets[2]", "2")), HasSubstr("mean body.moments[2]?"));
  EXPECT_THAT(refusal(chaos + axis("body.moments[3]", "2")), HasSubstr("expected a key"));
  EXPECT_THAT(refusal(chaos + axis("state.euler.phi", "0")), HasSubstr("from 1 to 1e9"));
  EXPECT_THAT(refusal(chaos + axis("state.euler.phi", "2") + "\n" + axis("state.euler.phi", "2")),
              HasSubstr("another axis has it"));
  EXPECT_THAT(refusal(body + "[map]\nkind = \"column\"\ncolumn = \"tehta\"\n" +
                      axis("state.euler.phi", "2")),
              HasSubstr("did you mean theta?"));
}

const std::string moon = R"(schema = 1
units = { time = "d", angle = "deg" }
body.moments = [0.7, 0.95, 1]
orbit.planet = { gm = 1, semi_major_axis = 1, eccentricity = 0.1 }
perturbation = [{ kind = "gravity-gradient", orbit = "planet" }]
state.attitude-rate = { euler = { phi = 20, theta = 0, psi = 0 }, omega_body = [0, 0, 130] }
time = { stop = 100, step = 1 }
)";

TEST(ScenarioMap, ASectionHasARowForEachPoint) {
  const ScenarioMap map(moon + R"([map]
kind = "spin-orbit-section"
orbit = "planet"
[[map.axis]]
key = "state.attitude-rate.omega_body[2]"
from = 130
to = 140
count = 2
)",
                        "m");
  const Scenario scenario = scenario_from_text(moon, "plain");
  const Problem problem{
      rotor_system(scenario), initial_state(scenario), 0.0, 100.0, Adaptive{}, {}};
  const std::vector<SpinOrbitPoint> expected =
      spin_orbit_section(problem, KeplerOrbit(*kepler_elements(scenario.rotation().orbits[0])))
          .points;
  const std::vector<double> numbers = map.cell(0).numbers;
  ASSERT_EQ(expected.size(), 16U);
  ASSERT_EQ(map.width(), 4U);
  ASSERT_EQ(numbers.size(), 4 * expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(numbers[4 * k], expected[k].t);
    EXPECT_NEAR(numbers[4 * k + 1], expected[k].angle * 180.0 / M_PI, budget::section_units);
    EXPECT_EQ(numbers[4 * k + 2], expected[k].spin);
  }
  EXPECT_EQ(map.groups().back().columns[1].unit, "deg");
  EXPECT_NE(map.cell(1).numbers, numbers);
}

TEST(ScenarioMap, ASectionNeedsNoAxis) {
  const auto rows = [](const std::string& keys) {
    const ScenarioMap map(moon + "[map]\nkind = \"andoyer-section\"\n" + keys, "m");
    EXPECT_EQ(map.size(), 1);
    EXPECT_EQ(map.groups().size(), 1U);
    return map.cell(0).numbers;
  };
  const std::vector<double> strobed = rows("period = 30\nepoch = 5\n");
  ASSERT_EQ(strobed.size(), 4U * 7U);
  EXPECT_EQ(strobed[0], 5.0);
  EXPECT_EQ(strobed[3 * 7], 95.0);
  const std::vector<double> passed = rows("angle = \"g\"\nvalue = 90\n");
  ASSERT_GT(passed.size(), 7U);
  for (std::size_t k = 2; k < passed.size(); k += 7)
    EXPECT_NEAR(passed[k], 90.0, budget::section_units);
  EXPECT_TRUE(rows("angle = \"g\"\nvalue = 90\ncrossing = \"falling\"\n").empty());
}

TEST(ScenarioMap, WhatIsNoSection) {
  const auto andoyer = [](const std::string& keys) {
    return refusal(moon + "[map]\nkind = \"andoyer-section\"\n" + keys);
  };
  EXPECT_THAT(andoyer(""), HasSubstr("expected exactly one of angle, period"));
  EXPECT_THAT(andoyer("angle = \"g\"\nperiod = 1"), HasSubstr("got angle, period"));
  EXPECT_THAT(andoyer("angle = \"k\""), HasSubstr("m.toml:10:9: map.angle: got \"k\""));
  EXPECT_THAT(andoyer("period = 0"), HasSubstr("map.period: got 0; expected a positive time"));
  EXPECT_THAT(andoyer("period = 1\nvalue = 2"), HasSubstr("expected only with angle"));
  EXPECT_THAT(andoyer("angle = \"h\"\nepoch = 2"), HasSubstr("expected only with period"));
  EXPECT_THAT(andoyer("angle = \"h\"\norbit = \"planet\""),
              HasSubstr("a key of kind \"spin-orbit-section\""));
  const auto pericentres = [](std::string text, const std::string& keys) {
    return refusal(text + "[map]\nkind = \"spin-orbit-section\"\n" + keys);
  };
  EXPECT_THAT(pericentres(moon, ""), HasSubstr("map.orbit: got nothing"));
  EXPECT_THAT(pericentres(moon, "orbit = \"plane\""), HasSubstr("did you mean planet?"));
  std::string circle = moon;
  circle.replace(circle.find("eccentricity = 0.1"), 18, "eccentricity = 0");
  EXPECT_THAT(pericentres(circle, "orbit = \"planet\""),
              HasSubstr("a circular orbit has no pericentre"));
  std::string seen = moon;
  seen.replace(seen.find("body.moments"), 0,
               "state.epoch = \"2000-01-01T12:00:00 TT\"\nstate.axes = \"ecliptic-J2000\"\n"
               "orbit.moon = { kind = \"ephemeris\", target = \"moon\", centre = \"earth\" }\n");
  seen.replace(seen.find("angle = \"deg\""), 0, "length = \"km\", ");
  EXPECT_THAT(pericentres(seen, "orbit = \"moon\""),
              HasSubstr("expected an orbit with elements: others have no pericentre"));
}

TEST(MapRows, KeepSectionsWhole) {
  const std::string folder = ::testing::TempDir() + "/section_rows";
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/s.csv";
  std::filesystem::remove(path + ".cells");
  const ScenarioMap map(moon + R"([map]
kind = "spin-orbit-section"
orbit = "planet"
[[map.axis]]
key = "body.moments[1]"
from = 0.8
to = 2
count = 3
)",
                        "m.toml");
  {
    MapRows rows(map, {path}, RunBegin::restart);
    for (std::int64_t k = 0; k < 3; ++k) rows.push(map.cell(k));
    rows.finish();
  }
  const std::string straight = text_of(path);
  EXPECT_THAT(straight, HasSubstr("\n2,nan,nan,nan,nan\n"));  // no body
  {
    MapRows rows(map, {path}, RunBegin::restart);
    for (std::int64_t k = 0; k < 3; ++k) rows.push(map.cell(k));
  }
  const std::string cells = text_of(path + ".cells");
  std::int64_t whole = 0;
  for (std::size_t length = cells.find('\n'); length <= cells.size(); length += 41) {
    std::ofstream(path + ".cells", std::ios::binary) << cells.substr(0, length);
    MapRows rows(map, {path}, RunBegin::resume);
    whole = std::max<std::int64_t>(whole, rows.size());
    for (std::int64_t k = rows.size(); k < 3; ++k) rows.push(map.cell(k));
    rows.finish();
    EXPECT_EQ(text_of(path), straight) << length;
  }
  EXPECT_GE(whole, 2);
}

TEST(MapRows, GoOnFromWhatIsWholeOfAnEarlierMap) {
  const std::string folder = ::testing::TempDir() + "/map_rows";
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/m.csv";
  std::filesystem::remove(path + ".cells");
  const ScenarioMap map(body + "[map]\nkind = \"chaos\"\n" + two_axes, "m.toml");
  {
    MapRows rows(map, {path}, RunBegin::restart);
    for (std::int64_t k = 0; k < 6; ++k) rows.push(map.cell(k));
    rows.finish();
  }
  EXPECT_FALSE(std::filesystem::exists(path + ".cells"));
  const std::string straight = text_of(path);
  {
    MapRows rows(map, {path}, RunBegin::resume);  // nothing there: from the start
    EXPECT_EQ(rows.size(), 0);
    for (std::int64_t k = 0; k < 4; ++k) rows.push(map.cell(k));
  }
  const std::string cells = text_of(path + ".cells");
  EXPECT_THROW(MapRows(map, {path}, RunBegin::anew), DomainError);  // four cells would be lost
  EXPECT_EQ(text_of(path + ".cells"), cells);
  const auto head = static_cast<std::int64_t>(cells.find('\n') + 1);
  // killed after any number of bytes
  for (const std::int64_t length :
       {std::int64_t{0}, head - 5, head, head + 9, static_cast<std::int64_t>(cells.size()) - 1,
        static_cast<std::int64_t>(cells.size())}) {
    std::ofstream(path + ".cells", std::ios::binary)
        << cells.substr(0, static_cast<std::size_t>(length));
    MapRows rows(map, {path}, RunBegin::resume);
    for (std::int64_t k = rows.size(); k < 6; ++k) rows.push(map.cell(k));
    rows.finish();
    EXPECT_EQ(text_of(path), straight) << length;
  }
  std::ofstream(path + ".cells") << "another file\n";
  EXPECT_THROW(MapRows(map, {path}, RunBegin::resume), DomainError);
}

}  // namespace
}  // namespace polhode
