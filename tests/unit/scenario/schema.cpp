// SPDX-License-Identifier: MIT
#include "polhode/scenario/schema.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "output/obliquity_columns.hpp"
#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/schema_table.hpp"
#include "scenario/tables/body.hpp"
#include "scenario/tables/time.hpp"
#include "scenario/values.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::message_of;
using polhode::test::Worst;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// What later sections need: names that the file chooses, and arrays of tables.
constexpr io::Key growing_keys[] = {
    {.path = "orbit", .help = "Orbits by name."},
    {.path = "orbit.*", .help = "One orbit."},
    {.path = "orbit.*.period",
     .type = io::KeyType::number,
     .presence = io::Presence::required,
     .dimension = io::Dimension::time,
     .example = "1",
     .help = "Its period."},
    {.path = "event[]", .help = "What ends a run."},
    {.path = "event[].kind",
     .type = io::KeyType::choice,
     .presence = io::Presence::required,
     .allowed = "crossing|count",
     .help = "Its kind."},
    {.path = "event[].at", .type = io::KeyType::number, .fallback = "3", .help = "Where."},
};
constexpr io::Schema growing{growing_keys, {}};

TEST(Schema, EveryRowIsComplete) {
  // kinds of one table may have keys of one name
  std::set<std::pair<std::string_view, std::string_view>> rows;
  std::set<std::string_view> paths;
  for (const io::Key& key : io::scenario_schema().keys) {
    EXPECT_TRUE(rows.insert({key.path, key.kinds}).second) << key.path;
    paths.insert(key.path);
    EXPECT_THAT(std::string(key.help), ::testing::EndsWith(".")) << key.path;
    EXPECT_EQ(key.example.empty(), key.type == io::KeyType::table) << key.path;
    const std::string_view table = io::key_table(key.path);
    EXPECT_TRUE(table.empty() || paths.contains(table)) << key.path;
    const bool listed = key.type == io::KeyType::choice || key.type == io::KeyType::choices;
    EXPECT_TRUE(!listed || !key.allowed.empty()) << key.path;
  }
}

// Whether alternatives are those of a kind that the key belongs to.
bool are_of_kinds(const io::Alternatives& row, const io::Key& key) {
  if (row.table != io::key_table(key.path)) return false;
  if (row.kinds.empty() || key.kinds.empty()) return true;
  const std::vector<std::string_view> kinds = io::separated(row.kinds, '|');
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](std::string_view kind) { return io::belongs(key, kind); });
}

bool names_key(const io::Alternatives& row, const io::Key& key) {
  for (const std::string_view set : io::separated(row.sets, '|'))
    for (const std::string_view name : io::separated(set, '+'))
      if (name == io::key_name(key.path)) return true;
  return false;
}

// Kinds of one table may have keys of one name, each among its own alternatives.
TEST(Schema, AlternativesNameKeysOfTheirTable) {
  const io::Schema& schema = io::scenario_schema();
  std::set<std::string> members, met;
  for (const io::Alternatives& row : schema.alternatives)
    for (const std::string_view set : io::separated(row.sets, '|'))
      for (const std::string_view name : io::separated(set, '+'))
        members.insert(std::string(row.table) + "." + std::string(name));
  for (const io::Key& key : schema.keys) {
    const bool is_named = std::any_of(
        schema.alternatives.begin(), schema.alternatives.end(),
        [&](const io::Alternatives& row) { return are_of_kinds(row, key) && names_key(row, key); });
    EXPECT_EQ(key.presence == io::Presence::alternative, is_named) << key.path;
    if (is_named) met.insert(std::string(key.path));
  }
  EXPECT_EQ(met, members);
}

TEST(Schema, ColumnsAreThoseThatRowsCanHold) {
  const auto keys = io::scenario_schema().keys;
  const auto columns = std::find_if(keys.begin(), keys.end(),
                                    [](const io::Key& k) { return k.path == "output.columns"; });
  ASSERT_NE(columns, keys.end());
  std::vector<std::string_view> known = io::column_group_names();
  for (const std::string_view name : io::detail::spin_column_groups())
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  EXPECT_EQ(io::separated(columns->allowed, '|'), known);
}

TEST(Schema, TemplatesAreScenarios) {
  EXPECT_THAT(io::state_charts(),
              ElementsAre("tumbler", "attitude-rate", "euler", "andoyer", "poincare-0-0",
                          "poincare-0-pi", "poincare-pi-0", "poincare-pi-pi", "serret", "sadov"));
  for (const std::string_view chart : io::state_charts()) {
    const io::Scenario scenario = io::scenario_from_text(io::scenario_template(chart), "template");
    EXPECT_EQ(scenario.rotation().chart, chart);
    EXPECT_EQ(scenario.rotation().time->size(), 1441) << chart;
  }
  EXPECT_THAT(message_of([] { io::scenario_template("tumbelr"); }),
              AllOf(StartsWith("got \"tumbelr\"; expected a chart (tumbler, attitude-rate, "),
                    HasSubstr("), an orbit (kepler, "), HasSubstr("), a frame (precessing, "),
                    EndsWith(" or an output format (aem); did you mean tumbler?")));
}

std::vector<std::string> words_of(std::string_view sort) {
  for (const io::TemplateSort& one : io::scenario_templates())
    if (one.sort == sort) return one.words;
  return {};
}

TEST(Schema, TemplatesOfPerturbationsRunIntoRows) {
  const std::vector<std::string> kinds = words_of("perturbation");
  EXPECT_THAT(kinds,
              ElementsAre("gravity-gradient", "constant-torque", "damping", "tide",
                          "internal-damping", "anelastic-damping", "torque-table", "solar-pressure",
                          "drag", "residual-dipole", "eddy-currents", "kane-damper"));
  for (const std::string& kind : kinds) {
    const io::Scenario scenario = io::scenario_from_text(io::scenario_template(kind), "template");
    EXPECT_THAT(scenario.rotation().kinds, ElementsAre(std::string(kind)));
    EXPECT_EQ(scenario.rotation().terms.size() + (scenario.rotation().damper ? 1U : 0U), 1U);
    const bool on_surface = kind == "solar-pressure" || kind == "drag";
    const bool is_magnetic = kind == "residual-dipole" || kind == "eddy-currents";
    const bool of_gravity = kind == "gravity-gradient" || kind == "tide";
    EXPECT_EQ(scenario.rotation().orbits.size(), of_gravity || is_magnetic || on_surface ? 1U : 0U);
    EXPECT_EQ(scenario.rotation().surface != nullptr, on_surface);
    EXPECT_TRUE(scenario.rotation().method.has_value());
    EXPECT_EQ(scenario.rotation().events.size(), 1U);
    const bool is_physical = is_magnetic || on_surface || kind == "anelastic-damping";
    EXPECT_EQ(scenario.units().moment(), is_physical ? "kg m2" : "1") << kind;
    EXPECT_EQ(scenario.units().time(), is_physical ? "s" : "h") << kind;
    // the numbers are those of a body that something moves
    const FreeRotation free = io::free_rotation(scenario);
    const Vec3 slip = scenario.rotation().damper ? Vec3{1.0, 0.0, 0.0} : Vec3{};
    const System system = at_damper_rate(io::rotor_system(scenario), slip);
    Worst largest;
    for (double t = 0.0; t < 700.0; t += 30.0) {
      const Effect moved = effect(system, t, free.at(t));
      largest.add(norm(moved.v) + norm(moved.u));
    }
    EXPECT_GT(largest.value(), 0.0) << kind;
    EXPECT_THAT(io::scenario_template(kind), HasSubstr("\n# dut1 = "));
  }
}

// Those of orbits that are read from files name these files, and are the user's to fill in.
TEST(Schema, TemplatesOfOrbitsFramesAndMethodsAreScenarios) {
  EXPECT_THAT(words_of("chart"), ElementsAreArray(io::state_charts()));
  EXPECT_THAT(words_of("experiment"), ElementsAre("fit", "obliquity", "nutation"));
  EXPECT_THAT(words_of("orbit"), ElementsAre("kepler", "state", "table", "ephemeris", "elements",
                                             "series", "shipped"));
  for (const char* orbit : {"kepler", "state", "table", "ephemeris"}) {
    const io::Scenario scenario = io::scenario_from_text(io::scenario_template(orbit), "template");
    ASSERT_EQ(scenario.rotation().orbits.size(), 1U);
    EXPECT_EQ(scenario.rotation().orbits.front().kind, orbit);
    EXPECT_THAT(scenario.rotation().kinds, ElementsAre("gravity-gradient"));
  }
  EXPECT_THAT(io::scenario_template("shipped"), HasSubstr("\n[orbit.mars]\n"));
  for (const char* orbit : {"elements", "series"})
    EXPECT_REJECTED(io::scenario_from_text(io::scenario_template(orbit), "template"),
                    ": cannot be read: ");
  for (const std::string& frame : words_of("frame")) {
    const io::Scenario scenario = io::scenario_from_text(io::scenario_template(frame), "template");
    EXPECT_NE(scenario.rotation().frame_text, "inertial") << frame;
    EXPECT_TRUE(scenario.rotation().kinds.empty());
  }
  EXPECT_THAT(words_of("method"),
              ElementsAre("adaptive", "collocation", "splitting", "variation-of-constants"));
  for (const std::string& method : words_of("method")) {
    const io::Scenario scenario = io::scenario_from_text(io::scenario_template(method), "template");
    EXPECT_EQ(method_traits(*scenario.rotation().method).kind, method);
    EXPECT_THAT(scenario.rotation().kinds, ElementsAre("constant-torque"));
  }
  EXPECT_THAT(words_of("observation"), ElementsAre("attitude", "direction", "rate", "light-curve"));
  for (const std::string& kind : words_of("observation")) {
    const io::Scenario scenario = io::scenario_from_text(io::scenario_template(kind), "template");
    ASSERT_EQ(io::require_fit(scenario).observations.size(), 1U);
    EXPECT_EQ(io::require_fit(scenario).observations.front().kind, kind);
    EXPECT_EQ(io::require_fit(scenario).light.searches, kind == "light-curve");
  }
  EXPECT_THAT(io::scenario_template("aem"), HasSubstr("\n[output.aem]\n"));
}

// Keys of one kind: refused with another, required with their own.
constexpr io::Key kinded_keys[] = {
    {.path = "term[]", .help = "Terms."},
    {.path = "term[].kind",
     .type = io::KeyType::choice,
     .presence = io::Presence::required,
     .allowed = "a|b",
     .help = "Its kind."},
    {.path = "term[].x",
     .type = io::KeyType::number,
     .presence = io::Presence::required,
     .help = "Of a.",
     .kinds = "a"},
    {.path = "term[].y",
     .type = io::KeyType::number,
     .fallback = "3",
     .help = "Of b.",
     .kinds = "b"},
};

TEST(Schema, KeysMayBelongToAKind) {
  constexpr io::Schema kinded{kinded_keys, {}};
  const auto read = [&](const char* text) {
    io::detail::Diagnostics diagnostics("f");
    const io::detail::ReadFile file = io::detail::read_values(text, kinded, diagnostics);
    diagnostics.raise();
    return file.values;
  };
  const io::detail::Values values = read("[[term]]\nkind = \"a\"\nx = 1\n[[term]]\nkind = \"b\"\n");
  EXPECT_EQ(values.at("term[0].x").numbers.at(0), 1.0);
  EXPECT_FALSE(values.contains("term[0].y"));
  EXPECT_EQ(values.at("term[1].y").numbers.at(0), 3.0);
  const auto error = [&](const char* text) {
    return message_of<io::ScenarioError>([&] { read(text); });
  };
  EXPECT_EQ(error("[[term]]\nkind = \"b\"\nx = 1\n"),
            "f:3:1: term[0].x: a key of kind \"a\"; expected with kind = \"b\" only kind or y");
  EXPECT_EQ(error("[[term]]\nkind = \"a\"\n"), "f:1:1: term[0].x: got nothing; expected a number");
  EXPECT_THAT(io::json_schema(kinded), HasSubstr("\"const\": \"a\""));
}

constexpr io::Key spin_keys[] = {
    {.path = "spin", .presence = io::Presence::required, .help = "Of the second kind alone."},
    {.path = "spin.rate",
     .type = io::KeyType::number,
     .presence = io::Presence::required,
     .example = "1",
     .help = "A number."},
    {.path = "here",
     .type = io::KeyType::number,
     .presence = io::Presence::alternative,
     .help = "A."},
    {.path = "there",
     .type = io::KeyType::number,
     .presence = io::Presence::alternative,
     .help = "B."},
};
constexpr io::Alternatives of_spin[] = {{"", "here|there"}};

TEST(Schema, AKindBringsItsOwnTablesAndSharesOthers) {
  const io::detail::ExperimentRow kinds[] = {
      {"rotation", {io::detail::body_keys(), io::detail::time_keys()}},
      {"spin", {io::detail::SchemaPart{spin_keys, of_spin}, io::detail::time_keys()}},
  };
  const io::detail::SchemaTable table(kinds);
  const io::Schema schema = table.schema();
  const auto error = [&](const std::string& text) -> std::string {
    io::detail::Diagnostics diagnostics("f");
    io::detail::read_values("schema = 1\n" + text, schema, diagnostics);
    return message_of<io::ScenarioError>([&] { diagnostics.raise(); });
  };
  const std::string body = "[body]\nmoments = [1, 2, 2]\n", spin = "[spin]\nrate = 1\n",
                    time = "[time]\nat = [1]\n", kind = "kind = \"spin\"\n";
  EXPECT_EQ(error(body + time), "");
  EXPECT_EQ(error(kind + "here = 1\n" + spin + time), "");
  EXPECT_EQ(error(time),
            "f:1:1: body: got nothing; expected a table [body] with one of moments, tensor, shape "
            "with density");
  EXPECT_EQ(error(kind + "there = 1\n" + time),
            "f:1:1: spin: got nothing; expected a table [spin]");
  EXPECT_THAT(error(kind + "here = 1\n" + spin + body),
              HasSubstr("body: a key of kind \"rotation\"; expected with kind = \"spin\" only"));
  EXPECT_THAT(error(body + spin), HasSubstr("spin: a key of kind \"spin\"; expected with"));
  EXPECT_THAT(error(kind + spin), HasSubstr("expected exactly one of"));
  EXPECT_THAT(error(kind + "here = 1\nspni.rate = 1\n"), HasSubstr("did you mean spin?"));
  EXPECT_THAT(io::json_schema(schema), HasSubstr("\"const\": \"spin\""));
  const auto is_time = [](const io::Key& key) { return key.path == "time"; };
  EXPECT_EQ(std::count_if(schema.keys.begin(), schema.keys.end(), is_time), 1);
}

TEST(Schema, NamesThatTheFileChoosesArePlain) {
  io::detail::Diagnostics diagnostics("f");
  io::detail::read_values("[orbit.\"a.b\"]\nperiod = 3\n", growing, diagnostics);
  EXPECT_THROW(diagnostics.raise(), io::ScenarioError);
}

TEST(Schema, ReadsNamesThatTheFileChooses) {
  io::detail::Diagnostics diagnostics("f");
  const io::detail::ReadFile file = io::detail::read_values(
      "[orbit.moon]\nperiod = \"27 d\"\n[orbit.sun]\nperiod = 3\n", growing, diagnostics);
  diagnostics.raise();
  EXPECT_EQ(file.values.at("orbit.moon.period").numbers.at(0), 27 * 86400.0);
  EXPECT_EQ(file.values.at("orbit.sun.period").numbers.at(0), 3.0);
}

TEST(Schema, ReadsArraysOfTables) {
  io::detail::Diagnostics diagnostics("f");
  const io::detail::ReadFile file = io::detail::read_values(
      "[[event]]\nkind = \"count\"\n[[event]]\nkind = \"crossing\"\nat = 5\n", growing,
      diagnostics);
  diagnostics.raise();
  EXPECT_EQ(file.values.at("event[0].kind").words.at(0), "count");
  EXPECT_EQ(file.values.at("event[0].at").numbers.at(0), 3.0);
  EXPECT_EQ(file.values.at("event[1].at").numbers.at(0), 5.0);
}

TEST(Schema, ErrorsInsideThemNameTheirPath) {
  io::detail::Diagnostics diagnostics("f");
  io::detail::read_values("[orbit.moon]\nperoid = 3\n[[event]]\nkind = \"cuont\"\n", growing,
                          diagnostics);
  const std::string message = test::message_of<io::ScenarioError>([&] { diagnostics.raise(); });
  EXPECT_THAT(
      message,
      HasSubstr("f:2:1: orbit.moon.peroid: unknown key; did you mean period? expected period\n"));
  EXPECT_THAT(message, HasSubstr("f:4:8: event[0].kind: got \"cuont\"; expected \"crossing\" or "
                                 "\"count\"; did you mean \"count\"?"));
}

TEST(Schema, DocumentsKnowThemToo) {
  EXPECT_THAT(io::json_schema(growing), HasSubstr("\"additionalProperties\": {"));
  EXPECT_THAT(io::json_schema(growing), HasSubstr("\"type\": \"array\""));
  EXPECT_THAT(io::markdown_reference(growing), HasSubstr("## `[orbit.*]`"));
  EXPECT_THAT(io::markdown_reference(growing), HasSubstr("## `[[event]]`"));
}

}  // namespace
}  // namespace polhode
