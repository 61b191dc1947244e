// SPDX-License-Identifier: MIT
// Maps: every cell is the scenario that a file with its numbers would be; rows survive a kill.
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/analysis/section.hpp"
#include "polhode/error.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/run/map_run.hpp"
#include "temp_folder.hpp"
#include "unit/run/map_refusal.hpp"
#include "unit/run/shuffled_executor.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::larger;
using polhode::test::refusal;
using polhode::test::ShuffledExecutor;
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
  const io::ScenarioMap map(body + "[map]\nkind = \"chaos\"\n" + two_axes, "m.toml");
  ASSERT_EQ(map.size(), 6);
  EXPECT_EQ(map.axis_values(0), (std::vector<double>{1.5, 60.0}));
  EXPECT_EQ(map.axis_values(3), (std::vector<double>{1.7, 90.0}));
  std::string plain = body;
  plain.replace(plain.find("theta = 60"), 10, "theta = 90");
  const io::Scenario scenario = io::scenario_from_text(plain, "plain");
  const Problem problem{io::rotor_system(scenario), io::initial_state(scenario), 0.0, 20.0};
  const analysis::ChaosIndicator expected =
      analysis::chaos_indicator(problem, SaveAt::times({20.0}));
  EXPECT_EQ(map.cell(3).numbers, (std::vector<double>{expected.mean_megno(), expected.lyapunov()}));
  const std::vector<io::ColumnGroup> groups = map.groups();
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[1].columns[0].name, "state.euler.theta");
  EXPECT_EQ(groups[1].columns[0].unit, "deg");
  EXPECT_EQ(groups[2].columns[1].unit, "1/h");
}

TEST(ScenarioMap, ExtremesAreThoseOfTheRows) {
  const io::ScenarioMap map(body + "[map]\nkind = \"column\"\ncolumn = \"psi\"\n" + two_axes, "m");
  std::string plain = body;
  plain.replace(plain.find("1, 1.7"), 6, "1, 1.5");
  const io::Scenario scenario = io::scenario_from_text(plain, "plain");
  const FreeRotation motion = io::free_rotation(scenario);
  double least = INFINITY, most = -INFINITY, last = 0.0;
  for (std::int64_t k = 0; k <= 40; ++k) {
    last = to_euler(motion.at(0.5 * static_cast<double>(k))).psi * 180.0 / M_PI;
    least = smaller(least, last);
    most = larger(most, last);
  }
  const io::MapCell cell = map.cell(0);
  ASSERT_EQ(cell.numbers.size(), 3U);
  EXPECT_NEAR(cell.numbers[0], least, budget::map_extremes);
  EXPECT_NEAR(cell.numbers[1], most, budget::map_extremes);
  EXPECT_NEAR(cell.numbers[2], last, budget::map_extremes);
}

TEST(ScenarioMap, WhatAChartRefusesIsACellWithItsReason) {
  const io::ScenarioMap map(body + R"([map]
kind = "chaos"
[[map.axis]]
key = "body.moments[0]"
from = 0.1
to = 1
count = 2
)",
                            "m");
  const io::MapCell cell = map.cell(0);
  EXPECT_TRUE(std::isnan(cell.numbers[0]));
  EXPECT_THAT(cell.failure, HasSubstr("body.moments"));
  EXPECT_EQ(map.cell(1).failure, "");
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
  const io::ScenarioMap map(moon + R"([map]
kind = "spin-orbit-section"
orbit = "planet"
[[map.axis]]
key = "state.attitude-rate.omega_body[2]"
from = 130
to = 140
count = 2
)",
                            "m");
  const io::Scenario scenario = io::scenario_from_text(moon, "plain");
  const Problem problem{io::rotor_system(scenario), io::initial_state(scenario), 0.0, 100.0};
  const std::vector<analysis::SpinOrbitPoint> expected =
      analysis::spin_orbit_section(problem,
                                   KeplerOrbit(*io::kepler_elements(scenario.rotation().orbits[0])))
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
    const io::ScenarioMap map(moon + "[map]\nkind = \"andoyer-section\"\n" + keys, "m");
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

// A cell of a map with files next to it is what a file with its numbers gives, message by message.
std::vector<std::string> lines_of(const io::MapCell& cell) {
  if (!cell.failure.empty()) return {cell.failure};
  std::vector<std::string> lines;
  for (const double x : cell.numbers)
    lines.push_back(std::to_string(std::bit_cast<std::int64_t>(x)));
  return lines;
}

// The same, by a text in which the numbers stand.
std::vector<std::string> lines_of_text(const std::string& text, const std::string& name) {
  try {
    return lines_of(io::ScenarioMap(text, name).cell(0));
  } catch (const io::ScenarioError& error) {
    return {error.what()};
  }
}

// Also where the same test runs twice at a time.
class InFolder : public test::InTempFolder {
 protected:
  const std::string folder_ = std::filesystem::path(path("f")).parent_path().string();
};

class Overrides : public InFolder {
 protected:
  Overrides() {
    std::ofstream table(folder_ + "/way.csv");
    table << "t,x,y,z\n";
    for (int k = 0; k <= 40; ++k)
      table << k << "," << 5.0 * std::cos(0.1 * k) << "," << 5.0 * std::sin(0.1 * k) << ",0\n";
    std::ofstream(folder_ + "/burn.csv") << "t,x,y,z\n0,0,0,0\n1.1,1e-3,0,0\n1.2,0,0,0\n50,0,0,0\n";
    std::ofstream(folder_ + "/box.obj") << R"(v -1 -2 -3
v 1 -2 -3
v 1 2 -3
v -1 2 -3
v -1 -2 3
v 1 -2 3
v 1 2 3
v -1 2 3
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";
  }

  // The cell where `key` is `to`, by a map from a text where it is `from`, and by the text.
  void expect_same(const std::string& key, const std::string& from, const std::string& to) {
    const auto text = [&](const std::string& number) {
      std::string all = scenario_;
      const std::size_t at = all.find("@" + key + "@");
      EXPECT_NE(at, std::string::npos) << key;
      all.replace(at, key.size() + 2, number);
      for (const auto& [other, usual] : usual_) {
        const std::size_t place = all.find("@" + other + "@");
        if (place != std::string::npos) all.replace(place, other.size() + 2, usual);
      }
      return all;
    };
    const auto axis = [&](const std::string& number) {
      return "[map]\nkind = \"column\"\ncolumn = \"L\"\n[[map.axis]]\nkey = \"" + key +
             "\"\nfrom = " + number + "\nto = " + number + "\ncount = 1\n";
    };
    const std::string name = folder_ + "/f.toml";
    const std::vector<std::string> found =
        lines_of(io::ScenarioMap(text(from) + axis(to), name).cell(0));
    EXPECT_EQ(found, lines_of_text(text(to) + axis(to), name)) << key;
    EXPECT_NE(found, lines_of_text(text(from) + axis(from), name)) << key;
  }

  const std::vector<std::pair<std::string, std::string>> usual_ = {
      {"time.stop", "30"},
      {"body.density", "1"},
      {"state.attitude-rate.omega_body[1]", "0.3"},
      {"state.attitude-rate.euler.phi", "10"},
      {"orbit.way.gm", "2"},
      {"orbit.planet.semi_major_axis", "7"},
      {"perturbation[0].gm", "1"},
      {"perturbation[1].coefficients[0]", "1e-3"},
      {"perturbation[2].torque[1]", "1e-2"},
      {"surface[0].specular", "0.2"},
      {"surface[0].scale", "1"},
      {"method.tolerance", "1e-9"},
      {"frame.precessing.rate", "0.01"}};
  const std::string scenario_ = R"(schema = 1
units = { time = "h", angle = "deg", length = "m", moment = "kg m2" }
body = { shape = "box.obj", scale = 1, density = @body.density@ }
time = { stop = @time.stop@, count = 5 }
orbit.way = { kind = "table", file = "way.csv", gm = @orbit.way.gm@ }
orbit.planet = { gm = 1, semi_major_axis = @orbit.planet.semi_major_axis@, eccentricity = 0.1 }
frame.precessing = { axis = [0, 0, 1], rate = @frame.precessing.rate@ }
method = { kind = "adaptive", tolerance = @method.tolerance@ }
state.attitude-rate.euler = { phi = @state.attitude-rate.euler.phi@, theta = 20, psi = 0 }
state.attitude-rate.omega_body = [9, @state.attitude-rate.omega_body[1]@, 130]
perturbation = [
  { kind = "gravity-gradient", orbit = "planet", gm = @perturbation[0].gm@ },
  { kind = "damping", coefficients = [@perturbation[1].coefficients[0]@, 1e-3, 1e-3] },
  { kind = "constant-torque", torque = [0, @perturbation[2].torque[1]@, 0] },
  { kind = "gravity-gradient", orbit = "way" },
  { kind = "torque-table", file = "burn.csv", outside = "zero" },
  { kind = "solar-pressure", orbit = "planet", pressure = 10, pressure_distance = 5 }]
[[surface]]
shape = "box.obj"
scale = @surface[0].scale@
centre_of_mass = [0.3, 0.2, 0.1]
specular = @surface[0].specular@
)";
};

TEST_F(Overrides, AreWhatAFileWithTheirNumbersGives) {
  expect_same("time.stop", "30", "25");
  expect_same("body.density", "1", "1.5");
  expect_same("state.attitude-rate.omega_body[1]", "0.3", "7");
  expect_same("state.attitude-rate.euler.phi", "10", "70");
  expect_same("orbit.way.gm", "2", "40");
  expect_same("orbit.planet.semi_major_axis", "7", "5");
  expect_same("perturbation[0].gm", "1", "50");
  expect_same("perturbation[1].coefficients[0]", "1e-3", "0.5");
  expect_same("perturbation[2].torque[1]", "1e-2", "20");
  expect_same("surface[0].specular", "0.2", "0.7");
  expect_same("surface[0].scale", "1", "1.5");
  expect_same("method.tolerance", "1e-9", "1e-7");
  expect_same("frame.precessing.rate", "0.01", "3");
}

TEST_F(Overrides, AreRefusedAsAFileWithTheirNumbersIs) {
  expect_same("time.stop", "30", "50");  // beyond the table
  expect_same("body.density", "1", "-1");
  expect_same("orbit.way.gm", "2", "-2");
  expect_same("orbit.planet.semi_major_axis", "7", "-7");
  expect_same("perturbation[0].gm", "1", "-1");
  expect_same("surface[0].specular", "0.2", "1.5");
  expect_same("surface[0].scale", "1", "0");
  expect_same("method.tolerance", "1e-9", "-1");
}

TEST_F(Overrides, ShareWhatTheyDoNotChange) {
  const io::ScenarioMap map(body + R"([map]
kind = "column"
column = "L"
[orbit.way]
kind = "table"
file = "way.csv"
gm = 1
[[perturbation]]
kind = "gravity-gradient"
orbit = "way"
[[perturbation]]
kind = "torque-table"
file = "burn.csv"
outside = "zero"
[[map.axis]]
key = "body.moments[1]"
from = 1.5
to = 1.9
count = 2
)",
                            folder_ + "/shares.toml");
  const io::MapCell before = map.cell(1);
  EXPECT_EQ(before.failure, "");
  std::filesystem::remove(folder_ + "/way.csv");
  std::filesystem::remove(folder_ + "/burn.csv");
  EXPECT_EQ(lines_of(map.cell(1)), lines_of(before));  // no file is read again
}

TEST_F(Overrides, ShareFilesWithTheScenarioThatWasRead) {
  const io::Scenario scenario = io::scenario_from_text(body + R"([map]
kind = "column"
column = "L"
[[perturbation]]
kind = "torque-table"
file = "burn.csv"
outside = "zero"
[[map.axis]]
key = "body.moments[1]"
from = 1.5
to = 1.9
count = 2
)",
                                                       folder_ + "/shares.toml");
  std::filesystem::remove(folder_ + "/burn.csv");
  EXPECT_EQ(io::ScenarioMap(scenario).cell(1).failure, "");
}

// A map into a file, in a folder of its own.
class MapRuns : public InFolder {
 protected:
  // Of all cells, or up to one.
  io::MapReport run(const io::ScenarioMap& map, io::RunBegin begin, std::int64_t up_to = -1,
                    const std::string& path = "m.csv",
                    ensemble::Executor* executor = nullptr) const {
    io::RunOptions options;
    options.begin = begin;
    options.checkpoint_seconds = 0.0;
    std::int64_t done = 0;
    options.progress = [&](const io::RunProgress& at) {
      done = static_cast<std::int64_t>(at.reached);
    };
    options.stop = [&] { return done == up_to; };
    options.threads = 1;
    options.executor = executor;
    return io::MapRun(map, {folder_ + "/" + path}, std::move(options)).run();
  }
  std::string checkpoint() const { return path_ + ".checkpoint"; }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(folder_))
      names.push_back(file.path().filename().string());
    return names;
  }

  const std::string path_ = folder_ + "/m.csv";
};

void expect_equal(const io::MapReport& one, const io::MapReport& other) {
  EXPECT_EQ(one.points, other.points);
  ASSERT_EQ(one.groups.size(), other.groups.size());
  for (std::size_t i = 0; i < one.groups.size(); ++i) {
    EXPECT_EQ(one.groups[i].cells, other.groups[i].cells);
    EXPECT_EQ(one.groups[i].rows, other.groups[i].rows);
  }
  ASSERT_EQ(one.ranges.size(), other.ranges.size());
  for (std::size_t i = 0; i < one.ranges.size(); ++i) {
    EXPECT_EQ(one.ranges[i].least, other.ranges[i].least);
    EXPECT_EQ(one.ranges[i].most, other.ranges[i].most);
  }
  ASSERT_EQ(one.failures.size(), other.failures.size());
  for (std::size_t i = 0; i < one.failures.size(); ++i) {
    EXPECT_EQ(one.failures[i].cell, other.failures[i].cell);
    EXPECT_EQ(one.failures[i].why, other.failures[i].why);
  }
}

const std::string section = moon + R"([map]
kind = "spin-orbit-section"
orbit = "planet"
[[map.axis]]
key = "body.moments[1]"
from = 0.8
to = 2
count = 13
)";

TEST_F(MapRuns, KeepSectionsWhole) {
  const io::ScenarioMap map(section, "m.toml");
  const io::MapReport whole = run(map, io::RunBegin::anew);
  const std::string straight = text_of(path_);
  EXPECT_THAT(straight, HasSubstr("\n2,nan,nan,nan,nan\n"));  // no body
  EXPECT_THAT(files(), ::testing::ElementsAre("m.csv"));
  EXPECT_EQ(whole.cells, 13);
  EXPECT_EQ(whole.failures.size(), 3U);
  EXPECT_THAT(whole.failures[0].why, HasSubstr("body.moments"));
  EXPECT_EQ(whole.points, 16 * 10);
  for (std::int64_t stop = 1; stop < 13; ++stop) {
    std::filesystem::remove(path_);
    EXPECT_THROW(run(map, io::RunBegin::resume, stop), io::RunInterrupted);
    EXPECT_FALSE(std::filesystem::exists(path_));
    const io::MapReport report = run(map, io::RunBegin::resume);
    EXPECT_EQ(text_of(path_), straight) << stop;
    EXPECT_THAT(files(), ::testing::ElementsAre("m.csv"));
    expect_equal(report, whole);
  }
}

TEST_F(MapRuns, KeepAReasonOnce) {
  std::string text = section;
  text.replace(text.find("from = 0.8\nto = 2\ncount = 13"), 28, "from = 2\nto = 2\ncount = 9");
  const io::ScenarioMap map(text, "m.toml");
  EXPECT_THROW(run(map, io::RunBegin::anew, 7), io::RunInterrupted);
  const std::string kept = text_of(checkpoint()), reason = map.cell(0).failure;
  ASSERT_NE(reason, "");
  const std::size_t first = kept.find(reason);
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(kept.find(reason, first + 1), std::string::npos);
  const io::MapReport report = run(map, io::RunBegin::resume);
  ASSERT_EQ(report.failures.size(), 9U);
  for (const io::MapReport::Failure& failure : report.failures) EXPECT_EQ(failure.why, reason);
}

// Several blocks of rows: the checkpoint stands after five cells that are in the file and two that
// wait for their block to fill.
const std::string strobed = moon + R"([map]
kind = "andoyer-section"
period = 0.05
[[map.axis]]
key = "body.moments[1]"
from = 0.8
to = 1
count = 13
)";

TEST_F(MapRuns, GoOnFromTheCheckpointOfAnEarlierOne) {
  const io::ScenarioMap map(strobed, "m.toml");
  run(map, io::RunBegin::resume);  // nothing there: from the start
  const std::string straight = text_of(path_);
  std::filesystem::remove(path_);
  EXPECT_THROW(run(map, io::RunBegin::anew, 7), io::RunInterrupted);
  const std::string kept = text_of(checkpoint()), part = text_of(path_ + ".part");
  EXPECT_EQ(std::count(part.begin(), part.end(), '\n') -
                std::count(straight.begin(), straight.end(), '#'),
            1 + 5 * 2001);
  EXPECT_THROW(run(map, io::RunBegin::anew), DomainError);  // seven cells would be lost
  EXPECT_EQ(text_of(checkpoint()), kept);
  // killed after the checkpoint: the part has grown by any number of bytes
  for (const std::size_t more : {std::size_t{0}, std::size_t{1}, std::size_t{400000}}) {
    std::ofstream(checkpoint(), std::ios::binary) << kept;
    std::ofstream(path_ + ".part", std::ios::binary) << part << straight.substr(part.size(), more);
    std::filesystem::remove(path_);
    run(map, io::RunBegin::resume);
    EXPECT_EQ(text_of(path_), straight) << more;
  }
  // killed between the name of the file and the end of the checkpoint
  std::ofstream(checkpoint(), std::ios::binary) << kept;
  run(map, io::RunBegin::resume);
  EXPECT_EQ(text_of(path_), straight);
  EXPECT_THAT(files(), ::testing::ElementsAre("m.csv"));
}

TEST_F(MapRuns, RefuseWhatIsOfAnother) {
  const io::ScenarioMap map(section, "m.toml");
  EXPECT_THROW(run(map, io::RunBegin::anew, 9), io::RunInterrupted);
  const std::string kept = text_of(checkpoint()), part = text_of(path_ + ".part");
  const auto refusal_of = [&](const io::ScenarioMap& other) {
    return test::message_of([&] { run(other, io::RunBegin::resume); });
  };
  std::string text = section;
  text.replace(text.find("count = 13"), 10, "count = 14");
  EXPECT_THAT(refusal_of(io::ScenarioMap(text, "m.toml")),
              HasSubstr("m.csv.checkpoint: is of another map: scenario was \"m.toml "));
  std::string damaged = kept;
  damaged.back() = static_cast<char>(damaged.back() ^ 1);
  for (const std::string& bytes : {damaged, kept.substr(0, kept.size() - 1), kept + "x",
                                   std::string("another file\n"), std::string()}) {
    std::ofstream(checkpoint(), std::ios::binary) << bytes;
    EXPECT_THAT(refusal_of(map), HasSubstr("is not a checkpoint of this version")) << bytes.size();
  }
  std::ofstream(checkpoint(), std::ios::binary) << kept;
  std::ofstream(path_ + ".part", std::ios::binary) << part.substr(0, part.size() - 1);
  EXPECT_THAT(refusal_of(map), HasSubstr("cannot be continued"));
  std::ofstream(path_ + ".part", std::ios::binary) << "X" << part.substr(1);
  EXPECT_THAT(refusal_of(map), HasSubstr("it is the output of another scenario"));
}

// Processes whose cells are computed in any order.
ShuffledExecutor shuffled(const std::string& text, int processes, unsigned seed) {
  return {[&] { return io::map_work(io::scenario_from_text(text, "m.toml")); }, processes, seed};
}

TEST_F(MapRuns, OnAnExecutorAreThoseOfThreads) {
  const std::string chaos = body + "[map]\nkind = \"chaos\"\n" + two_axes;
  for (const std::string& text : {section, strobed, chaos}) {  // of sections some cells fail
    const io::ScenarioMap map(text, "m.toml");
    const io::MapReport threads = run(map, io::RunBegin::restart);
    ShuffledExecutor executor = shuffled(text, 3, 5);
    expect_equal(run(map, io::RunBegin::anew, -1, "e.csv", &executor), threads);
    EXPECT_EQ(text_of(folder_ + "/e.csv"), text_of(path_));
    std::filesystem::remove(folder_ + "/e.csv");
  }
}

TEST_F(MapRuns, StoppedOnAnExecutorGoOnOnThreadsAndBack) {
  const io::ScenarioMap map(section, "m.toml");
  const io::MapReport whole = run(map, io::RunBegin::anew);
  const std::string straight = text_of(path_);
  std::filesystem::remove(path_);
  for (std::int64_t stop = 1; stop < 13; ++stop) {
    ShuffledExecutor executor = shuffled(section, 2, 7);
    EXPECT_THROW(run(map, io::RunBegin::resume, stop, "m.csv", stop % 2 == 1 ? &executor : nullptr),
                 io::RunInterrupted);
  }
  expect_equal(run(map, io::RunBegin::resume), whole);
  EXPECT_EQ(text_of(path_), straight);
}

// Of many cells several go together to a process, 3 of these 300; on threads each is alone.
TEST_F(MapRuns, OfManyCellsGoOnBetweenTwoOfThem) {
  const std::string text = body + R"([map]
kind = "column"
column = "qw"
[[map.axis]]
key = "body.moments[1]"
from = 1.1
to = 1.9
count = 300
)";
  const io::ScenarioMap map(text, "m.toml");
  const io::MapReport whole = run(map, io::RunBegin::anew);
  const std::string straight = text_of(path_);
  std::filesystem::remove(path_);
  ShuffledExecutor executor = shuffled(text, 3, 11);
  EXPECT_THROW(run(map, io::RunBegin::anew, 4), io::RunInterrupted);
  EXPECT_THROW(run(map, io::RunBegin::resume, 10, "m.csv", &executor), io::RunInterrupted);
  EXPECT_THROW(run(map, io::RunBegin::resume, 11), io::RunInterrupted);
  expect_equal(run(map, io::RunBegin::resume, -1, "m.csv", &executor), whole);
  EXPECT_EQ(text_of(path_), straight);
}

TEST_F(MapRuns, OnAnExecutorOfAnotherMapAreRejected) {
  const io::ScenarioMap map(section, "m.toml");
  std::string text = section;
  text.replace(text.find("count = 13"), 10, "count = 14");
  ShuffledExecutor other = shuffled(text, 2, 1);
  EXPECT_REJECTED(run(map, io::RunBegin::anew, -1, "m.csv", &other),
                  "m.toml: is not the map that is run: scenario was");
  ShuffledExecutor many = shuffled(section, 14, 1);
  EXPECT_REJECTED(run(map, io::RunBegin::restart, -1, "m.csv", &many),
                  "m.toml: map: 14 processes for 13 cells; expected a cell for each at least: "
                  "fewer processes");
}

TEST_F(MapRuns, WhatProgressThrowsKeepsTheCellsBefore) {
  const io::ScenarioMap map(section, "m.toml");
  io::RunOptions options;
  options.threads = 3;
  options.progress = [](const io::RunProgress& at) {
    if (at.reached == 7.0) throw std::runtime_error("enough");
  };
  EXPECT_THROW(io::MapRun(map, {path_}, std::move(options)).run(), std::runtime_error);
  io::RunOptions rest;
  rest.begin = io::RunBegin::resume;
  io::MapRun run(map, {path_}, std::move(rest));
  EXPECT_TRUE(run.continues());
  EXPECT_EQ(run.reached(), 7.0);
  EXPECT_EQ(run.run().cells, 13);
}

}  // namespace
}  // namespace polhode
