// SPDX-License-Identifier: MIT
// Groups of columns: the library's, and those that a program adds, in scenarios.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/run/map_run.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// Twice the kinetic energy, and the angle from body axis 3 to the axis of rotation.
std::array<double, 2> spin_numbers(const io::RowSample& row) {
  const Vec3 w = angular_velocity(row.system, row.t, row.state).inertial;
  return {dot(row.state.g, w), std::atan2(std::hypot(w.x, w.y), w.z)};
}
io::ColumnKind spin() {
  io::ColumnKind kind = io::column_kind(
      "spin-vector", "Twice the energy, and the angle from body axis 3 to omega.",
      {{"twice_E", io::Dimension::energy}, {"tilt", io::Dimension::angle}}, spin_numbers);
  kind.note = "tilt: from body axis 3";
  kind.citations = {{"tilt2026", "A. Author (2026).", "the tilt"}};
  return kind;
}
double spin_rate(const io::RowSample& row) {
  return norm(angular_velocity(row.system, row.t, row.state).inertial);
}
io::ColumnKind rate_kind() {
  return io::column_kind("total_rate", "Rate of rotation.", {{"total_rate", io::Dimension::rate}},
                         spin_rate);
}

io::Kinds kinds() { return io::default_kinds().with(spin()).with(rate_kind()); }

const std::string head =
    "schema = 1\nunits = { angle = \"deg\" }\n[body]\nmoments = [1, 1.7, 2.2]\n"
    "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [10, 20, 30]\n"
    "[time]\nstop = 5\ncount = 6\n";
const std::string adaptive = "[method]\nkind = \"adaptive\"\n";
const std::string output = "[output]\ncolumns = [\"spin-vector\", \"energy\", \"total_rate\"]\n";

io::Scenario read(const std::string& text) {
  return io::scenario_from_text(text, "f.toml", kinds());
}
std::string error_of(const std::string& text) {
  return test::message_of([&] { read(text); });
}

class Kept : public io::Sink {
 public:
  explicit Kept(std::vector<double>& numbers) : numbers_(numbers) {}
  void push(std::span<const double> block) override {
    numbers_.insert(numbers_.end(), block.begin(), block.end());
  }
  void finish() override {}

 private:
  std::vector<double>& numbers_;
};

TEST(ColumnKinds, OursAreSound) {
  for (const io::ColumnKind& kind : io::default_columns().all()) {
    SCOPED_TRACE(kind.name);
    EXPECT_TRUE(kind.help.ends_with('.'));
    EXPECT_FALSE(kind.columns.empty());
    EXPECT_TRUE(static_cast<bool>(kind.numbers));
    EXPECT_THAT(io::markdown_columns(), HasSubstr("| `" + std::string(kind.name) + "` | `"));
  }
  EXPECT_TRUE(io::default_columns().needs_energy("dE") &&
              io::default_columns().needs_energy("energy"));
  EXPECT_FALSE(io::default_columns().needs_energy("g") ||
               io::default_columns().needs_energy("unknown"));
  EXPECT_TRUE(io::default_columns().needs_damper("s2") &&
              !io::default_columns().needs_damper("w2"));
  EXPECT_EQ(io::default_columns().of_column("date"), nullptr);
}

TEST(ColumnKinds, RowsEventsNotesAndCitationsHaveIt) {
  const std::string event = "[[event]]\ncolumn = \"tilt\"\nvalue = 35\n";
  for (const std::string& method : {std::string(), adaptive}) {
    const io::Scenario scenario = read(head + output + event + method);
    const std::vector<io::ColumnGroup> groups = io::row_groups(scenario);
    ASSERT_EQ(groups.size(), 4U);
    EXPECT_EQ(groups[1].columns[1].name, "tilt");
    EXPECT_EQ(groups[1].columns[1].unit, "deg");
    EXPECT_EQ(groups[3].columns[0].unit, "deg/s");
    std::vector<double> rows;
    std::vector<std::unique_ptr<io::Sink>> sinks;
    sinks.push_back(std::make_unique<Kept>(rows));
    const io::RunReport report = io::run(scenario, sinks);
    ASSERT_EQ(rows.size(), 6U * 6U);
    for (std::size_t k = 0; k < rows.size(); k += 6)
      EXPECT_NEAR(rows[k + 1], 2.0 * rows[k + 3], budget::io_elements);
    EXPECT_NEAR(rows[5], std::sqrt(1400.0), budget::io_elements);
    EXPECT_NEAR(rows[2], std::atan2(std::sqrt(500.0), 30.0) * 180.0 / std::numbers::pi,
                budget::io_elements);
    ASSERT_FALSE(report.events.empty());
    const System system = io::rotor_system(scenario);
    const double t = report.events[0].t;
    const io::RowSample there{system, 0.0, t, io::free_rotation(scenario).at(t)};
    EXPECT_NEAR(spin_numbers(there)[1] * 180.0 / std::numbers::pi, 35.0, budget::io_elements);
    EXPECT_THAT(io::provenance(scenario).notes, Contains("tilt: from body axis 3"));
    EXPECT_EQ(io::citations(scenario).back().key, "tilt2026");
  }
}

TEST(ColumnKinds, MapsAndSchemaKnowIt) {
  const io::ScenarioMap map(head + R"([map]
kind = "column"
column = "total_rate"
[[map.axis]]
key = "state.attitude-rate.omega_body[2]"
from = 30
to = 40
count = 2
)",
                            "f.toml", kinds());
  EXPECT_EQ(map.groups().back().columns.back().name, "total_rate_last");
  EXPECT_EQ(map.groups().back().columns.back().unit, "deg/s");
  EXPECT_LT(map.cell(0).numbers.at(2), map.cell(1).numbers.at(2));
  EXPECT_THAT(io::json_schema(kinds().schema()), HasSubstr("\"spin-vector\", \"total_rate\""));
  EXPECT_THAT(io::markdown_columns(kinds().columns()),
              HasSubstr("| `spin-vector` | `twice_E,tilt` |"));
  EXPECT_THAT(error_of(head + "[output]\ncolumns = [\"spin-vectors\"]\n"),
              HasSubstr("did you mean \"spin-vector\"?"));
  EXPECT_THAT(error_of(head + "[[event]]\ncolumn = \"tlit\"\nvalue = 1\n"),
              HasSubstr("did you mean tilt?"));
}

TEST(ColumnKinds, WhatItNeedsIsAskedOfTheFile) {
  const auto error = [](const auto& change, const std::string& text) {
    io::ColumnKind kind = rate_kind();
    change(kind);
    const io::Kinds with = io::default_kinds().with(kind);
    return test::message_of([&] { io::scenario_from_text(text, "f.toml", with); });
  };
  const auto energy = [](io::ColumnKind& kind) { kind.needs_energy = true; };
  const auto damper = [](io::ColumnKind& kind) { kind.needs_damper = true; };
  const std::string columns = head + "[output]\ncolumns = [\"total_rate\"]\n";
  const std::string event = head + "[[event]]\ncolumn = \"total_rate\"\nvalue = 1\n";
  const std::string damping =
      "[[perturbation]]\nkind = \"damping\"\ncoefficients = [0.1, 0.1, 0.1]\n";
  for (const std::string& text : {columns, event}) {
    EXPECT_EQ(error(energy, text), "");
    EXPECT_THAT(error(energy, text + damping), HasSubstr("expected no energy"));
    EXPECT_THAT(error(damper, text), HasSubstr("expected a perturbation of kind \"kane-damper\""));
  }
  const std::string map = head +
                          "[map]\nkind = \"column\"\ncolumn = \"total_rate\"\n[[map.axis]]\n"
                          "key = \"body.moments[2]\"\nfrom = 2.2\nto = 2.3\ncount = 2\n";
  EXPECT_THAT(error(damper, map), HasSubstr("map.column: got \"total_rate\"; expected a pert"));
}

TEST(ColumnKinds, WhatIsNoGroupIsRejected) {
  const auto error = [](const auto& change) {
    io::ColumnKind kind = rate_kind();
    kind.name = "other";
    kind.columns = {{"other_rate", io::Dimension::rate}};
    change(kind);
    return test::message_of([&] { static_cast<void>(kinds().with(kind)); });
  };
  EXPECT_EQ(error([](io::ColumnKind&) {}), "");
  for (const char* name : {"omega", "theta", "andoyer", "tides", "spin-vector", "tilt", "t"})
    EXPECT_EQ(error([&](io::ColumnKind& k) { k.name = name; }),
              "Kinds: column group \"" + std::string(name) + "\" is there; expected another name");
  for (const char* name : {"q", "w3", "obliquity", "tilt", "total_rate", "t"})
    EXPECT_EQ(error([&](io::ColumnKind& k) {
                k.columns = {{name, io::Dimension::rate}};
              }),
              "Kinds: column group \"other\", column \"" + std::string(name) +
                  "\" is there; expected another name");
  EXPECT_THAT(error([](io::ColumnKind& k) { k.name = "my rate"; }),
              HasSubstr("\"my rate\"; expected letters, digits, - and _"));
  EXPECT_THAT(error([](io::ColumnKind& k) {
                k.columns = {{"my-rate", io::Dimension::rate}};
              }),
              HasSubstr("column \"my-rate\"; expected letters, digits and _"));
  EXPECT_THAT(error([](io::ColumnKind& k) { k.columns.push_back(k.columns[0]); }),
              HasSubstr("\"other_rate\" is there twice; expected another name"));
  EXPECT_THAT(error([](io::ColumnKind& k) { k.columns = {}; }),
              HasSubstr("got 0 columns; expected 1 to 16"));
  EXPECT_THAT(error([](io::ColumnKind& k) { k.help = {}; }),
              HasSubstr("got no text; expected one sentence"));
  EXPECT_THAT(error([](io::ColumnKind& k) { k.numbers = {}; }),
              HasSubstr("got no function of a row; expected one"));
}

}  // namespace
}  // namespace polhode
