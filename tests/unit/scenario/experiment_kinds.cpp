// SPDX-License-Identifier: MIT
// A kind of experiment that a program adds to the rotation: a gyrostat, from a file to rows.
#include <gmock/gmock.h>

#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gyrostat.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/custom_experiment.hpp"
#include "polhode/run/run.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/run/summary.hpp"
#include "polhode/scenario/scenario.hpp"
#include "temp_folder.hpp"
#include "text/number_text.hpp"

namespace polhode {
namespace {

using test::Gyrostat;
using test::GyrostatState;
using test::message_of;
using ::testing::HasSubstr;

struct Arguments {
  Vec3 moments;
  double wheel;
};

constexpr io::KindKey<Arguments> keys[] = {
    io::quantity_key<&Arguments::moments>("moments", io::Dimension::moment, "Principal moments.")
        .required()
        .example("[1, 1.7, 2.2]"),
    io::quantity_key<&Arguments::wheel>("wheel", io::Dimension::momentum,
                                        "Of the wheel, about axis 3.")
        .required()
        .example("0.5")
        .positive(),
};

io::CustomExperiment made(const Arguments& a, const io::ExperimentContext& at) {
  if (a.moments.x == 7.0) throw DomainError("seven is refused");
  io::ModelExperiment<Gyrostat> of{
      .model = Gyrostat(a.moments, {0.0, 0.0, a.wheel}, 0.05),
      .initial = {{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}, 0.25},
      .columns = {{"g3", io::Dimension::momentum}, {"wheel", io::Dimension::angle}},
      .row =
          [](const BasicSample<GyrostatState>& s, std::span<double> row) {
            row[0] = s.s.g.z;
            row[1] = s.s.wheel;
          },
      .facts = {{"wheel", "wheel", a.wheel, io::Dimension::momentum}}};
  of.events.push_back({"half", [](const BasicSample<GyrostatState>& s) { return s.t - 5.5; }});
  return io::custom_experiment<Gyrostat>("gyrostat", at, std::move(of));
}

io::ExperimentKind gyrostat(std::string_view name = "gyrostat") {
  return io::experiment_kind<Arguments>(name, "A body with a wheel.", keys, made,
                                        {{"own2026", "A. Author (2026).", "the gyrostat"}});
}

const std::string head = R"(schema = 1
kind = "gyrostat"
units = { time = "min", angle = "deg" }
)";
const std::string body = "gyrostat = { moments = [1, 1.7, 2.2], wheel = 0.5 }\n";
const std::string rows = "time = { start = 2, stop = 9, count = 8 }\n";

io::Scenario read(const std::string& text,
                  const io::Kinds& kinds = io::default_kinds().with(gyrostat())) {
  return io::scenario_from_text(text, "f.toml", kinds);
}

class ExperimentKinds : public test::InTempFolder {};

TEST_F(ExperimentKinds, RowsAreThoseOfTheModelInTheUnitsOfTheFile) {
  const io::Scenario scenario = read(head + body + rows);
  io::ScenarioRun run(scenario, {{path("rows.csv")}, path("events.csv")}, {});
  const io::RunReport report = run.run();
  ASSERT_TRUE(report.outcome.ok()) << report.outcome.advice;
  EXPECT_EQ(report.rows, 8);
  EXPECT_EQ(report.events_met, 1);

  const BasicProblem<Gyrostat> problem{Gyrostat({1.0, 1.7, 2.2}, {0.0, 0.0, 0.5}, 0.05),
                                       GyrostatState{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}, 0.25},
                                       0.0, 2.0, Adaptive{}};
  const auto first = integrate(problem).samples().back().s;
  const double turn = 180.0 / pi<double>();
  EXPECT_THAT(text("rows.csv"), HasSubstr("# units: t [min], g3 [1/min], wheel [deg]"));
  EXPECT_THAT(text("rows.csv"), HasSubstr("t,g3,wheel\n2," + detail::number_text(first.g.z) + "," +
                                          detail::number_text(first.wheel * turn) + "\n"));
  EXPECT_THAT(text("events.csv"), HasSubstr("\nhalf,5.5,1,"));
}

TEST_F(ExperimentKinds, SaysWhatItIs) {
  const io::Scenario scenario = read(head + body + rows);
  EXPECT_EQ(io::propagation_text(scenario), "adaptive, tolerance 1e-12");
  EXPECT_THAT(io::summary_table(io::summary(scenario)), HasSubstr("wheel   0.5 1/min\n"));
  bool cited = false;
  for (const io::Citation& one : io::citations(scenario)) {
    cited = cited || one.key == "own2026";
    EXPECT_NE(one.key, "jacobi1850");  // which is of the rotation
  }
  EXPECT_TRUE(cited);
  EXPECT_THAT(io::scenario_template("gyrostat", io::default_kinds().with(gyrostat()).schema()),
              HasSubstr("[gyrostat]\n# Principal moments.\nmoments = [1, 1.7, 2.2]\n"));
}

// Nothing in it is of a body that tumbles: the title says what it is, and time is that of examples.
TEST_F(ExperimentKinds, ATemplateIsInItsOwnWordsAndUnits) {
  io::ExperimentKind kind = gyrostat();
  kind.help = "A \"wheel\" in a body.";
  const auto text = [&] {
    return io::scenario_template("gyrostat", io::default_kinds().with(kind).schema());
  };
  EXPECT_THAT(text(), HasSubstr("\ntitle = \"A \\\"wheel\\\" in a body\"\n"));
  EXPECT_THAT(text(), HasSubstr("\ntime = \"s\"\n"));
  kind.keys.at(1).example = "\"0.5 kg m2/d\"";
  EXPECT_THAT(text(), HasSubstr("\ntime = \"d\"\n"));
  EXPECT_THAT(text(), HasSubstr("\nmoment = \"kg m2\"\n"));
  EXPECT_EQ(read(text(), io::default_kinds().with(kind)).document.title, "A \"wheel\" in a body");
}

TEST_F(ExperimentKinds, WhatIsWrongStandsAtItsPlace) {
  const auto error = [](const std::string& text) { return message_of([&] { read(text); }); };
  EXPECT_EQ(error(head + body + rows), "");
  EXPECT_THAT(error(head + rows), HasSubstr("f.toml:1:1: gyrostat: got nothing"));
  EXPECT_EQ(error(head + "gyrostat = { moments = [1, 1.7, 2.2], wheel = -1 }\n" + rows),
            "f.toml:4:47: gyrostat.wheel: got -1; expected a positive angular momentum");
  EXPECT_THAT(error(head + "gyrostat = { moments = [7, 7, 7], wheel = 1 }\n" + rows),
              HasSubstr("f.toml:4:12: gyrostat: seven is refused"));
  EXPECT_THAT(error(head + body), HasSubstr("expected a table [time] as well"));
  EXPECT_THAT(error(head + body + rows + "output.columns = [\"q\"]\n"),
              HasSubstr("output.columns: got [\"q\"]; expected none: rows of kind gyrostat"));
  EXPECT_THAT(
      error(head + body + rows + "method = { kind = \"splitting\", step = 1 }\n"),
      HasSubstr("method.kind: got \"splitting\"; expected \"adaptive\" or \"collocation\", since"));
  EXPECT_THAT(error(head + body + rows +
                    "[map]\nkind = \"chaos\"\n[[map.axis]]\nkey = "
                    "\"gyrostat.wheel\"\nfrom = 0\nto = 1\ncount = 2\n"),
              HasSubstr("map: kind: got \"gyrostat\"; expected \"rotation\" or \"obliquity\""));
  EXPECT_THAT(error(head + body + rows + "[body]\nmoments = [1, 2, 2]\n"),
              HasSubstr("body: a key of kind \"rotation\""));
  EXPECT_REJECTED(read(head + body + rows, io::default_kinds()),
                  "kind: got \"gyrostat\"; expected \"rotation\"");
}

// What is asked of a rotor is refused, not answered for another state.
TEST_F(ExperimentKinds, ItIsNoRotor) {
  const io::Scenario scenario = read(head + body + rows);
  const std::string refused = "kind: got \"gyrostat\"; expected \"rotation\"";
  EXPECT_MESSAGE(scenario.rotation(), refused);
  EXPECT_MESSAGE(free_rotation(scenario), refused);
  EXPECT_MESSAGE(io::rotor_system(scenario), refused);
  EXPECT_MESSAGE(io::initial_state(scenario), refused);
  EXPECT_MESSAGE(problem(scenario.experiment), refused);
  EXPECT_MESSAGE(io::row_layout(scenario), refused);
}

TEST_F(ExperimentKinds, NamesOfTablesAreTaken) {
  const auto error = [](std::string_view name) {
    return message_of([&] { io::default_kinds().with(gyrostat(name)); });
  };
  EXPECT_EQ(error("gyrostat"), "");
  for (const char* name : {"body", "perturbation", "rotation", "output"})
    EXPECT_EQ(error(name), "Kinds: experiment \"" + std::string(name) +
                               "\" is the name of another table; expected another name");
  EXPECT_EQ(error("andoyer"),
            "Kinds: experiment \"andoyer\" is the name of a chart; expected another name");
  EXPECT_EQ(error("tide"),
            "Kinds: experiment \"tide\" is the name of a perturbation; expected another name");
  EXPECT_MESSAGE(
      io::default_kinds().with(gyrostat()).with(gyrostat()),
      "Kinds: experiment \"gyrostat\" is the name of another table; expected another name");
}

TEST_F(ExperimentKinds, OneWithoutAModelDoesNotRun) {
  io::ExperimentKind empty = gyrostat();
  empty.made = [](const io::ExperimentContext& at) {
    return io::CustomExperiment{.kind = "gyrostat", .rows = at.rows(), .columns = {}};
  };
  const io::Scenario scenario = read(head + body + rows, io::default_kinds().with(empty));
  EXPECT_REJECTED(run(scenario, {}),
                  "without a model; expected one that custom_experiment has made");
}

}  // namespace
}  // namespace polhode
