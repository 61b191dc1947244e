// SPDX-License-Identifier: MIT
// A format of one's own, JSON Lines, in every place that asks the list of formats.
#include "polhode/output/output_format.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <type_traits>

#include "message_of.hpp"
#include "polhode/run/run.hpp"
#include "polhode/run/scenario_run.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct JsonOptions {
  std::string prefix = "";
  double shift = 0.0;
  bool units = false;
};

constexpr io::KindKey<JsonOptions> json_keys[] = {
    io::text_key<&JsonOptions::prefix>("prefix", "In front of each name."),
    io::quantity_key<&JsonOptions::shift>("shift", io::Dimension::time, "Added to t.")
        .otherwise("0"),
    io::flag_key<&JsonOptions::units>("units", "Whether the names have units.").otherwise("false"),
};

void check_json(const JsonOptions& options, const io::KeyValues& at) {
  if (options.prefix.size() > 8) at.refuse("prefix", "expected up to 8 characters");
  if (options.shift < 0.0) throw DomainError("expected a shift that is not negative");
}

std::string head_of(const io::Provenance& provenance) {
  return "{\"scenario\": \"" + provenance.scenario_name + "\"}\n";
}

std::unique_ptr<io::Sink> open_json(const io::SinkRequest& request) {
  const auto options = request.options<JsonOptions>();
  std::vector<std::string> names;
  for (const io::ColumnGroup& group : request.groups)
    for (const io::Column& column : group.columns)
      names.push_back("\"" + options.prefix + column.name +
                      (options.units ? " " + column.unit : "") + "\": ");
  const auto row = [names, options](std::string& out, std::span<const double> numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      std::ostringstream text;
      text.precision(17);
      text << (i == 0 ? "{" : ", ") << names[i] << numbers[i] + (i == 0 ? options.shift : 0.0);
      out += text.str();
    }
    out += "}\n";
  };
  return io::text_sink(request, head_of(request.provenance), row, "{\"end\": true}\n");
}

io::OutputFormat json_lines() {
  io::OutputFormat format("json-lines", ".jsonl", "How JSON Lines, --out PATH.jsonl, are written.",
                          open_json);
  format.label = "JSON Lines";
  format.take_options<JsonOptions>(json_keys, check_json);
  format.difference = [](const std::string& path, const std::vector<io::ColumnGroup>&,
                         const io::Provenance& provenance) {
    std::ifstream file(path, std::ios::binary);
    std::string line;
    std::getline(file, line);
    return line + "\n" == head_of(provenance) ? "" : "of another name";
  };
  format.citations = {{"bray2017", "Bray, T. (2017). RFC 8259.", "JSON"}};
  return format;
}

constexpr const char* head =
    "schema = 1\nbody.moments = [1, 2, 2.5]\n"
    "time = { stop = 40, step = 0.01 }\n"
    "state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.3, 0.2, 1] }\n";

class OutputFormatTest : public test::InTempFolder {
 protected:
  io::Scenario scenario(const std::string& more = "") const {
    return io::scenario_from_text(head + more, "f.toml", kinds_);
  }
  void run(const io::Scenario& of, const std::vector<std::string>& outputs,
           io::RunOptions how = {}) const {
    io::ScenarioRun(of, {outputs}, std::move(how)).run();
  }

  const io::Kinds kinds_ = io::default_kinds().with(json_lines());
  const io::OutputFormats formats_ = kinds_.formats();
};

TEST_F(OutputFormatTest, AFormatOfOnesOwnIsWritten) {
  const io::Scenario of = scenario("output.columns = [\"g\"]\n");
  run(of, {path("a.jsonl")});
  const std::string lines = text("a.jsonl");
  EXPECT_TRUE(lines.starts_with("{\"scenario\": \"f.toml\"}\n{\"t\": 0, \"g1\": 0."));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 4001 + 2);
  EXPECT_TRUE(lines.ends_with("}\n{\"end\": true}\n"));
  EXPECT_FALSE(fs::exists(path("a.jsonl.part")));
}

TEST_F(OutputFormatTest, ItsKeysAreThoseOfItsTable) {
  const io::Scenario of = scenario(
      "[units]\ntime = \"min\"\n[output]\ncolumns = [\"g\"]\n"
      "[output.json-lines]\nprefix = \"b_\"\nshift = \"1 h\"\nunits = true\n");
  run(of, {path("a.jsonl")});
  EXPECT_THAT(text("a.jsonl"), HasSubstr("\n{\"b_t min\": 60, \"b_g1 1/min\": "));
}

TEST_F(OutputFormatTest, WhatItRefusesStandsAtItsPlaceInTheFile) {
  const auto refused = [&](const std::string& more) {
    return message_of([&] { scenario("[output.json-lines]\n" + more + "\n"); });
  };
  EXPECT_EQ(
      refused("prefix = \"far-too-long\""),
      "f.toml:6:10: output.json-lines.prefix: got \"far-too-long\"; expected up to 8 characters");
  EXPECT_EQ(refused("shift = -1"),
            "f.toml:5:1: output.json-lines: expected a shift that is not negative");
  EXPECT_THAT(refused("prefx = \"a\""), HasSubstr("did you mean prefix?"));
  EXPECT_THAT(refused("shift = \"1 kg\""), HasSubstr("output.json-lines.shift"));
  EXPECT_REJECTED(io::scenario_from_text("[output.json-lines]\n", "f.toml"),
                  "output.json-lines: unknown key");
}

TEST_F(OutputFormatTest, ItIsCitedWhereAFileHasItsTable) {
  const auto has_it = [](const io::Scenario& of) {
    const std::vector<io::Citation> all = io::citations(of);
    return std::any_of(all.begin(), all.end(),
                       [](const io::Citation& one) { return one.key == "bray2017"; });
  };
  EXPECT_TRUE(has_it(scenario("[output.json-lines]\n")));
  EXPECT_FALSE(has_it(scenario("")));
}

// Rows behind the checkpoint, and half a row, are what a kill leaves.
TEST_F(OutputFormatTest, ItGoesOnWhereItWasKilled) {
  const io::Scenario of = scenario();
  run(of, {path("straight.jsonl"), path("straight.csv")});
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"a.jsonl"}, {"b.csv", "b.jsonl"}}) {
    std::vector<std::string> outputs;
    for (const std::string& name : names) outputs.push_back(path(name));
    io::RunOptions how;
    how.checkpoint_seconds = 0.0;
    int asked = 0;
    how.stop = [&asked] { return ++asked == 20; };  // behind the first block of rows
    EXPECT_THROW(run(of, outputs, std::move(how)), io::RunInterrupted);
    for (const std::string& output : outputs)
      std::ofstream(output + ".part", std::ios::app | std::ios::binary) << "0.5, 1\n{\"t\": 3";
    EXPECT_REJECTED(run(of, outputs), "an unfinished run is there");

    io::ScenarioRun rest(of, {outputs}, {.begin = io::RunBegin::resume});
    EXPECT_TRUE(rest.continues());
    EXPECT_GT(rest.rows(), 0);
    rest.run();
    EXPECT_EQ(text(names.back()), text("straight.jsonl"));
    EXPECT_TRUE(io::ScenarioRun(of, {outputs}, {.begin = io::RunBegin::resume}).is_complete());
  }
  EXPECT_EQ(text("b.csv"), text("straight.csv"));
}

TEST_F(OutputFormatTest, ACompleteFileOfAnotherRunIsNotTaken) {
  const io::Scenario of = scenario();
  std::ofstream(path("a.jsonl")) << "{\"scenario\": \"g.toml\"}\n";
  const auto resumed = [&](const io::Scenario& run) {
    return message_of(
        [&] { io::ScenarioRun(run, {{path("a.jsonl")}}, {.begin = io::RunBegin::resume}); });
  };
  EXPECT_THAT(resumed(of), HasSubstr("a.jsonl: is there, of another name; restart"));
  io::OutputFormat mute = json_lines();
  mute.difference = {};
  const io::Scenario other = io::scenario_from_text(head, "f.toml", io::default_kinds().with(mute));
  EXPECT_THAT(resumed(other), HasSubstr("is there, and does not say of which scenario; restart"));
}

TEST_F(OutputFormatTest, ARunThatLacksWhatItNeedsIsRefused) {
  const auto refused = [&](io::FormatNeeds needs, const std::string& more,
                           const std::string& name = "a.jsonl") {
    io::OutputFormat format = json_lines();
    format.needs = needs;
    format.columns = [](const io::SinkRequest&) { return std::vector<std::string>{"omega"}; };
    const io::Kinds kinds = io::default_kinds().with(std::move(format));
    return message_of(
        [&] { run(io::scenario_from_text(head + more, "f.toml", kinds), {path(name)}); });
  };
  const std::string epoch = "state.epoch = \"2029-04-13T21:46:00 ";
  EXPECT_EQ(refused({.dates = true}, ""),
            path("a.jsonl") + ": JSON Lines has dates; expected epoch in [state]");
  EXPECT_EQ(refused({.dates = true}, epoch + "UT1\"\n"),
            path("a.jsonl") +
                ": the epoch is in UT1, which does not run evenly; expected UTC, TAI, TT or TDB");
  EXPECT_EQ(refused({}, "output.columns = [\"q\"]\n"),
            path("a.jsonl") + ": expected \"omega\" among the columns of [output]");
  EXPECT_EQ(refused({.dates = true}, epoch + "TDB\"\n"), "");
  EXPECT_FALSE(fs::exists(path("a.jsonl.part")));
  fs::create_symlink("/dev/null", path("null.jsonl"));
  EXPECT_EQ(refused({.file = true}, "", "null.jsonl"),
            path("null.jsonl") + ": is not a regular file; JSON Lines needs one");
}

TEST_F(OutputFormatTest, DatesThatDoNotRiseAreRefused) {
  io::OutputFormat format = json_lines();
  format.needs.rising = true;
  const io::Scenario of = io::scenario_from_text(
      "schema = 1\nbody.moments = [1, 2, 2.5]\ntime.at = [0.0, 2.0, 1.0]\n"
      "state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.3, 0.2, 1] }\n",
      "f.toml", io::default_kinds().with(std::move(format)));
  EXPECT_MESSAGE(
      run(of, {path("a.jsonl")}),
      path("a.jsonl") + ": the dates of JSON Lines rise; expected times in [time] that rise");
}

TEST_F(OutputFormatTest, MessagesNameTheFormatsThatThereAre) {
  const io::OutputFormats these({*formats_.named("csv"), *formats_.named("hdf5"),
                                 *formats_.named("aem"), *formats_.named("json-lines")});
  EXPECT_EQ(io::paths_in_words(these), "PATH.csv, PATH.h5, PATH.aem or PATH.jsonl");
  EXPECT_MESSAGE(these.of_output(path("a.xlsx")),
                 path("a.xlsx") +
                     ": the extension says what to write; expected .csv, .h5, .aem or .jsonl, or - "
                     "for CSV to standard output");
  EXPECT_MESSAGE(
      these.of_output(path("")),
      path("") +
          ": is a folder; expected a file to write, PATH.csv, PATH.h5, PATH.aem or PATH.jsonl");
  EXPECT_EQ(formats_.of_output("-").name, "csv");
  EXPECT_EQ(formats_.of_output("/dev/null").name, "csv");
  EXPECT_EQ(formats_.named("json-lines")->extension, ".jsonl");
  EXPECT_EQ(formats_.named("jsonl"), nullptr);
  const io::OutputFormats files({*formats_.named("hdf5"), *formats_.named("aem")});
  EXPECT_MESSAGE(files.of_output("-"), "-: the extension says what to write; expected .h5 or .aem");
}

TEST_F(OutputFormatTest, NamesAndExtensionsAreThereOnce) {
  const auto refused = [&](const std::string& name, const std::string& extension) {
    return message_of([&] { formats_.with({name, extension, "A format.", open_json}); });
  };
  EXPECT_EQ(refused("json", ".json"), "");
  EXPECT_THAT(refused("csv", ".tsv"), HasSubstr("there is csv, .csv"));
  EXPECT_THAT(refused("table", ".csv"), HasSubstr("there is csv, .csv"));
  EXPECT_THAT(refused("a.b", ".ab"), HasSubstr("got the name \"a.b\""));
  EXPECT_THAT(refused("columns", ".ab"), HasSubstr("got the name"));
  for (const char* extension : {"ab", ".", "", ".a b", ".part", ".checkpoint"})
    EXPECT_THAT(refused("ab", extension), HasSubstr("got the extension")) << extension;
  EXPECT_REJECTED(formats_.with({"ab", ".ab", "", open_json}), "expected a text");
  EXPECT_REJECTED(formats_.with({"ab", ".ab", "A format.", {}}), "a function open");
}

// The list that it came from keeps what it had.
TEST_F(OutputFormatTest, AListIsAValue) {
  EXPECT_EQ(io::default_output_formats().all().size() + 1, formats_.all().size());
  EXPECT_EQ(io::default_output_formats().of_extension("a.jsonl"), nullptr);
}

TEST_F(OutputFormatTest, RowsAreReadBackAsTheyWereWritten) {
  const std::vector<io::ColumnGroup> groups{{"t", {{"t", "s"}}}, {"g", {{"g1", "1"}, {"g2", "1"}}}};
  const std::vector<double> rows{0.0, -0.0, 5e-324, 0.1, 1.0 / 3.0, -1.7976931348623157e308};
  for (const char* name : {"a.csv", "a.h5"}) {
    const std::vector<std::string> paths{path("a.aem"), path(name)};
    EXPECT_TRUE(io::can_read_rows(formats_, paths));
    io::open_sink(path(name), groups, {})->push(rows);
    EXPECT_EQ(io::first_rows(formats_, paths, groups, 2), rows) << name;  // of PATH.part
    const auto sink = io::open_sink(path(name), groups, {});
    sink->push(rows);
    sink->finish();
    EXPECT_EQ(io::first_rows(formats_, paths, groups, 2), rows) << name;
    EXPECT_THAT(io::first_rows(formats_, paths, groups, 1), ElementsAre(0.0, -0.0, 5e-324)) << name;
    EXPECT_REJECTED(io::first_rows(formats_, paths, groups, 3), "expected 3 rows");
  }
  EXPECT_FALSE(io::can_read_rows(formats_, std::vector{path("a.aem"), path("a.jsonl")}));
  EXPECT_REJECTED(io::first_rows(formats_, std::vector{path("a.jsonl")}, groups, 1),
                  "got none that is read back; expected PATH.csv");
}

}  // namespace
}  // namespace polhode
