// SPDX-License-Identifier: MIT
// Charts that a program adds to ours, in scenarios.
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/run/map_run.hpp"
#include "polhode/run/run.hpp"
#include "polhode/run/summary.hpp"
#include "polhode/scenario/scenario.hpp"
#include "unit/tables/modified_spherical.hpp"

namespace polhode {
namespace {

using test::from_spherical;
using test::modified_spherical;
using test::spherical_variables;
using test::to_spherical;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// The same with a side, a chart of motions: rows of a free one have it in a note.
constexpr io::ChartOption sides[] = {
    {"side", "near|far", "near", "Far turns h by half a turn.", "\"far\""}};
constexpr std::size_t h = 2, side = 6;
RotorState from_sided(const io::ChartNumbers& x, const io::ChartPlace& at) {
  io::ChartNumbers turned = x;
  if (x[side] == 1.0) turned[h] += 3.0;
  return from_spherical(turned, at);
}
io::ChartNumbers to_sided(const RotorState& s, const io::ChartPlace& at) {
  io::ChartNumbers x = to_spherical(s, at);
  x[side] = 0.0;
  return x;
}
io::ChartNumbers of_motion(const FreeRotation& motion, double t) {
  return to_sided(motion.at(t), {&motion.body(), t});
}
constexpr io::Citation works[] = {{"chart2026", "A. Author (2026).", "the sides"}};
constexpr io::ChartKind sided{.name = "sided",
                              .help = "As modified-spherical, with a side.",
                              .variables = spherical_variables,
                              .to_hub = from_sided,
                              .from_hub = to_sided,
                              .in_scenarios = true,
                              .options = sides,
                              .from_motion = of_motion,
                              .sources = works};

io::Kinds kinds() { return io::default_kinds().with(modified_spherical).with(sided); }

const std::string head = "schema = 1\n[body]\nmoments = [1, 1.7, 2.2]\n";
const std::string state =
    "[state.modified-spherical]\nl = 0.1\ng = 0.2\nh = 0.3\nlog_G = 0.5\ncos_J = 0.9\ncos_I = "
    "-0.5\n";
const std::string rows = "[time]\nstop = 5\ncount = 6\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string error_of(const std::string& text, const io::Kinds& of = kinds()) {
  return test::message_of([&] { io::scenario_from_text(text, "f.toml", of); });
}

io::Scenario read(const std::string& text) {
  return io::scenario_from_text(text, "f.toml", kinds());
}

TEST(ChartKinds, AStateIsGivenInIt) {
  const io::Scenario scenario = read(head + state + rows);
  EXPECT_EQ(scenario.rotation().chart, "modified-spherical");
  const RotorState expected = from_spherical({0.1, 0.2, 0.3, 0.5, 0.9, -0.5}, {nullptr});
  EXPECT_EQ(io::initial_state(scenario).q, expected.q);
  EXPECT_EQ(io::initial_state(scenario).g, expected.g);
  EXPECT_THAT(error_of(head + state, io::default_kinds()),
              HasSubstr("state.modified-spherical: unknown key"));
  EXPECT_THAT(error_of(head + replaced(state, "cos_J = 0.9", "cos_J = 1.5")),
              HasSubstr("f.toml:4:1: state.modified-spherical: "));
  EXPECT_THAT(error_of(head + replaced(state, "cos_J", "cos_j")), HasSubstr("did you mean cos_J?"));
}

TEST(ChartKinds, AnOptionThatIsLeftOutIsThatOfTheChart) {
  const std::string text = head + replaced(state, "modified-spherical", "sided");
  const io::Scenario near = read(text), far = read(text + "side = \"far\"\n");
  EXPECT_EQ(io::initial_state(near).q, io::initial_state(read(text + "side = \"near\"\n")).q);
  EXPECT_NE(io::initial_state(near).q, io::initial_state(far).q);
  EXPECT_THAT(error_of(text + "side = \"left\"\n"), HasSubstr("expected \"near\" or \"far\""));
}

// What a run writes into.
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

struct Ran {
  std::vector<double> numbers;
  io::RunReport report;
};
Ran ran(const io::Scenario& scenario) {
  Ran all;
  std::vector<std::unique_ptr<io::Sink>> sinks;
  sinks.push_back(std::make_unique<Kept>(all.numbers));
  all.report = io::run(scenario, sinks);
  return all;
}

const std::string adaptive = "[method]\nkind = \"adaptive\"\n";

TEST(ChartKinds, RowsAndEventsHaveItsColumns) {
  const std::string event = "[[event]]\ncolumn = \"cos_J\"\nvalue = 0.92\n";
  const std::string text =
      head + state + rows + "[output]\ncolumns = [\"modified-spherical\"]\n" + event;
  for (const std::string& method : {std::string(), adaptive}) {
    const io::Scenario scenario = read(text + method);
    EXPECT_EQ(io::row_groups(scenario).at(1).columns.at(3).name, "log_G");
    const Ran all = ran(scenario);
    ASSERT_EQ(all.numbers.size(), 6U * 7U);
    EXPECT_NEAR(all.numbers[4], 0.5, budget::io_elements);
    EXPECT_NEAR(all.numbers[5], 0.9, budget::io_elements);
    ASSERT_FALSE(all.report.events.empty());
    const io::ChartNumbers there =
        to_spherical(io::free_rotation(scenario).at(all.report.events.front().t), {nullptr});
    EXPECT_NEAR(there[4], 0.92, budget::io_elements);
    const std::vector<io::SummaryLine> lines = io::summary(scenario);
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const io::SummaryLine& line) {
      return line.text.starts_with("cos_J = 0.92");
    }));
  }
}

TEST(ChartKinds, ItsBranchIsANoteOfRowsAndACitation) {
  const std::string text = head + state + rows + "[output]\ncolumns = [\"sided\"]\n";
  const io::Scenario free = read(text), integrated = read(text + adaptive);
  EXPECT_THAT(io::provenance(free).notes, Contains("sided: side near"));
  EXPECT_THAT(io::provenance(integrated).notes, Not(Contains("sided: side near")));
  EXPECT_EQ(io::row_groups(free).at(1).columns.size(), 6U);
  EXPECT_EQ(io::row_groups(integrated).at(1).columns.back().name, "side");
  const auto keys = [](const io::Scenario& of) {
    std::vector<std::string> all;
    for (const io::Citation& one : io::citations(of)) all.emplace_back(one.key);
    return all;
  };
  EXPECT_THAT(keys(free), Contains("chart2026"));
  EXPECT_THAT(keys(read(head + state + rows)), Not(Contains("chart2026")));
}

// "moon" is a word of orbits, that others of the works belong to.
TEST(ChartKinds, ACitationIsThatOfTheChartAndNotOfItsName) {
  const auto cited = [](std::string_view name) {
    io::ChartKind chart = modified_spherical;
    chart.name = name;
    const std::string text = head + replaced(state, "modified-spherical", std::string(name));
    return io::citations(io::scenario_from_text(text, "f.toml", io::default_kinds().with(chart)))
        .size();
  };
  for (const char* name : {"moon", "orbit", "chaos"}) EXPECT_EQ(cited(name), cited("plain"));
}

TEST(ChartKinds, MapsHaveItsColumnsAndItsNumbersAsAxes) {
  const io::ScenarioMap map(head + state + rows + R"([map]
kind = "column"
column = "log_G"
[[map.axis]]
key = "state.modified-spherical.log_G"
from = 0.5
to = 1
count = 2
)",
                            "f.toml", kinds());
  EXPECT_EQ(map.groups().back().columns.back().name, "log_G_last");
  EXPECT_NEAR(map.cell(0).numbers.at(2), 0.5, budget::io_elements);
  EXPECT_NEAR(map.cell(1).numbers.at(2), 1.0, budget::io_elements);
}

TEST(ChartKinds, SchemaPageAndTemplateKnowIt) {
  const io::Kinds of = kinds();
  EXPECT_THAT(io::json_schema(of.schema()), HasSubstr("\"log_G\""));
  EXPECT_THAT(io::json_schema(io::default_kinds().schema()), Not(HasSubstr("log_G")));
  EXPECT_THAT(io::markdown_reference(of.schema()), HasSubstr("## `[state.modified-spherical]`"));
  EXPECT_THAT(io::scenario_templates(of.schema()).front().words, Contains("sided"));
  for (const char* chart : {"modified-spherical", "sided"}) {
    const io::Scenario scenario =
        io::scenario_from_text(io::scenario_template(chart, of.schema()), "template", of);
    EXPECT_EQ(scenario.rotation().chart, chart);
  }
}

TEST(ChartKinds, WhatAScenarioCannotTellApartIsRefused) {
  const auto error = [](const auto& change) -> std::string {
    io::ChartKind chart = modified_spherical;
    change(chart);
    return test::message_of([&] { kinds().with(chart); });
  };
  for (const char* name : {"andoyer", "epoch", "tumbler", "omega", "energy", "tide", "sided"})
    EXPECT_THAT(
        error([&](io::ChartKind& c) { c.name = name; }),
        HasSubstr(
            "is the name of a key of [state], a group of columns, a perturbation or an experiment"))
        << name;
  const auto with_number = [&](const io::ChartVariable& one) {
    return error([&](io::ChartKind& c) {
      c.name = "third";
      c.variables = {&one, 1};
    });
  };
  constexpr io::ChartVariable energy{"E", io::Dimension::number, "An energy of no unit.", "1"},
      renamed{"E", io::Dimension::number, "An energy of no unit.", "1", "E_1"},
      time{"t", io::Dimension::time, "A time.", "1"},
      shared{"G", io::Dimension::momentum, "G.", "1"};
  EXPECT_EQ(
      with_number(energy),
      "Kinds: chart \"third\": the column E is another number; expected another name in rows");
  EXPECT_EQ(with_number(renamed), "");
  EXPECT_THAT(with_number(time), HasSubstr("the column t is another number"));
  EXPECT_EQ(with_number(shared), "");
  // of tables alone
  EXPECT_EQ(error([](io::ChartKind& c) {
              c.name = "energy";
              c.in_scenarios = false;
            }),
            "");
}

}  // namespace
}  // namespace polhode
