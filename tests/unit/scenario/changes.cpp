// SPDX-License-Identifier: MIT
#include "polhode/scenario/changes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "message_of.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

constexpr std::string_view apophis =
    "# A comment, with an accent: \xc3\xa9\nschema = 1\ntitle = \"Apophis \xc3\xa9\"  # behind"
    R"(
[units]
time = "h"
angle = "deg"

[body]
moments = [0.61, 0.965, 1.0]  # ratios
[state.tumbler]
precession_period = 30.56
rotation_period = 263
pole = { longitude = 250, latitude = -75 }
mode = "SAM"
# what is looked for
[[event]]
column = "theta"
value = 90
[[event]]
name = "second"
column = "psi"
[time]
stop = 720  # a month
step = 0.5
)";

std::string changed(std::vector<io::ScenarioChange> changes, std::string_view text = apophis) {
  return io::changed_text(text, changes);
}
// The text with the first occurrence of a part replaced.
std::string with(std::string_view part, std::string_view by) {
  std::string text(apophis);
  return text.replace(text.find(part), part.size(), by);
}
std::string refusal_of(const std::string& key, const std::string& value) {
  return test::message_of<io::ChangeError>([&] { changed({{key, value}}); });
}

TEST(ScenarioChanges, AValueTakesThePlaceOfTheOldOneAndAllElseStays) {
  EXPECT_EQ(changed({{"state.tumbler.rotation_period", "100"}}), with("263", "100"));
  EXPECT_EQ(changed({{"title", "\"Other\""}}), with("\"Apophis \xc3\xa9\"", "\"Other\""));
  EXPECT_EQ(changed({{"body.moments", "[1, 2, 2.5]"}}), with("[0.61, 0.965, 1.0]", "[1, 2, 2.5]"));
  EXPECT_EQ(changed({{"body.moments.1", "0.9"}}), with("0.965", "0.9"));
  EXPECT_EQ(changed({{"state.tumbler.pole.latitude", "10.5"}}), with("-75", "10.5"));
  EXPECT_EQ(changed({{"event.0.value", "45"}}), with("value = 90", "value = 45"));
  EXPECT_EQ(changed({{"event[1].column", "phi"}}), with("\"psi\"", "\"phi\""));
}

TEST(ScenarioChanges, BareWordsAndQuantitiesAreTexts) {
  EXPECT_EQ(changed({{"state.tumbler.mode", "LAM"}}), with("\"SAM\"", "\"LAM\""));
  EXPECT_EQ(changed({{"time.stop", "30 d"}}), with("720", "\"30 d\""));
  EXPECT_EQ(changed({{"time.stop", "2013-02-04 UTC"}}), with("720", "\"2013-02-04 UTC\""));
}

TEST(ScenarioChanges, AnEmptyValueTakesTheKeyOut) {
  EXPECT_EQ(changed({{"time.step", ""}}), with("step = 0.5\n", ""));
  EXPECT_EQ(changed({{"state.tumbler.pole.latitude", ""}}), with(", latitude = -75", ""));
  EXPECT_EQ(changed({{"state.tumbler.pole.longitude", ""}}), with("longitude = 250,", ""));
  EXPECT_EQ(changed({{"time", ""}}), with("[time]\nstop = 720  # a month\nstep = 0.5\n", ""));
  EXPECT_EQ(changed({{"event.1", ""}}),
            with("[[event]]\nname = \"second\"\ncolumn = \"psi\"\n", ""));
  EXPECT_EQ(changed({{"time.count", ""}}), apophis);  // is not there
}

TEST(ScenarioChanges, ANewKeyComesIntoItsTable) {
  EXPECT_EQ(changed({{"event.1.value", "10"}}),
            with("[[event]]\nname", "[[event]]\nvalue = 10\nname"));
  EXPECT_EQ(changed({{"time.start", "5"}}), with("[time]\n", "[time]\nstart = 5\n"));
  EXPECT_EQ(changed({{"state.tumbler.pole.x", "1"}}), with("{ longitude", "{ x = 1, longitude"));
  // [state] has no header, [output] is not there at all
  const std::string epoch = changed({{"state.epoch", "2013-01-05 UTC"}});
  EXPECT_EQ(io::scenario_from_text(epoch, "a.toml").rotation().epoch, "2013-01-05 UTC");
  const io::Scenario columns =
      io::scenario_from_text(changed({{"output.columns", "[\"euler\"]"}}), "a.toml");
  EXPECT_EQ(columns.output.columns, std::vector<std::string>{"euler"});
  EXPECT_EQ(columns.rotation().events.size(), 2U);
}

TEST(ScenarioChanges, ATableInBracesTakesThePlaceOfATable) {
  const io::Scenario at =
      io::scenario_from_text(changed({{"time", "{ at = [1, 2, 4] }"}}), "a.toml");
  ASSERT_TRUE(io::row_times(at));
  EXPECT_EQ(io::row_times(at)->size(), 3);
  EXPECT_EQ((*io::row_times(at))[2], 4.0);
  const std::string pole = changed({{"state.tumbler.pole", "{ longitude = 1, latitude = 2 }"}});
  EXPECT_EQ(pole, with("{ longitude = 250, latitude = -75 }", "{ longitude = 1, latitude = 2 }"));
  const std::string none = changed({{"event", "[]"}});
  EXPECT_EQ(none.find("[[event]]"), std::string::npos);
  EXPECT_NE(none.find("[time]\nstop = 720"), std::string::npos);
}

TEST(ScenarioChanges, GoOneAfterTheOther) {
  const std::string text =
      changed({{"time.step", ""}, {"time.count", "3"}, {"time.count", "4"}, {"time.stop", "9"}});
  const io::Scenario scenario = io::scenario_from_text(text, "a.toml");
  EXPECT_EQ(io::row_times(scenario)->size(), 4);
  EXPECT_EQ(scenario.document.text, text);
}

TEST(ScenarioChanges, KnowDottedKeysAndTablesWithinArrays) {
  const std::string_view text =
      "schema = 1\nbody.moments = [1, 2, 2.5]\nstate.axes = \"inertial\"\n"
      "state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0, 0, 1] }\n"
      "[orbit.moon]\ngm = 1\n[[perturbation]]\nkind = \"damping\"\n[perturbation.deep]\nx = 1\n";
  EXPECT_EQ(changed({{"body.moments", "[3, 4, 5]"}}, text).find("body.moments = [3, 4, 5]\n"), 11U);
  const std::string deep = changed({{"perturbation.0.deep.y", "2"}}, text);
  EXPECT_TRUE(deep.ends_with("[perturbation.deep]\ny = 2\nx = 1\n")) << deep;
  const std::string out = changed({{"perturbation", ""}}, text);
  EXPECT_TRUE(out.ends_with("[orbit.moon]\ngm = 1\n")) << out;
  const std::string state = changed({{"state", ""}}, text);
  EXPECT_EQ(state.find("state"), std::string::npos) << state;
  const std::string body = changed({{"body.scale", "2"}}, text);
  EXPECT_LT(body.find("body.scale = 2\n"), body.find("[orbit.moon]")) << body;
}

TEST(ScenarioChanges, WhatHasNoPlaceIsRefusedByName) {
  EXPECT_EQ(refusal_of("event.2.value", "1"),
            "event.2.value: got index 2 of 2 elements, counted from 0");
  EXPECT_EQ(refusal_of("time.stop", "[1, 2"),
            "time.stop: got [1, 2; expected a value as TOML has it, such as 5, \"27.38 h\" or "
            "[1, 2]");
  EXPECT_EQ(refusal_of("time.stop", "1\nstep = 2").substr(0, 15), "time.stop: got ");
  EXPECT_EQ(refusal_of("time.stop.x", "1"), "time.stop.x: has no place in the file");
  EXPECT_EQ(refusal_of("time..stop", "1").substr(0, 23), "time..stop: got no key;");
  EXPECT_THROW(io::change_of("time.stop"), io::ChangeError);
  EXPECT_THROW(io::change_of("=5"), io::ChangeError);
  EXPECT_EQ(io::change_of(" time.stop = 5 ").key, "time.stop");
  EXPECT_EQ(io::change_of("a=b=c").value, "b=c");
}

TEST(ScenarioChanges, AnUnknownKeyAndABadValueAreErrorsOfTheFile) {
  for (const auto& [key, value, message] :
       {std::tuple{"body.momnets", "[1, 2, 3]", "body.momnets: unknown key; did you mean moments?"},
        std::tuple{"state.tumbler.mode", "SAMM", "state.tumbler.mode: got \"SAMM\"; expected"}}) {
    EXPECT_THAT(test::message_of<io::ScenarioError>([&] {
                  io::scenario_from_text(changed({{key, value}}), "a.toml");
                }),
                testing::HasSubstr(message));
  }
}

TEST(ScenarioChanges, ATextThatIsNotTomlStays) {
  EXPECT_EQ(changed({{"a", "1"}}, "schema = = 1"), "schema = = 1");
}

}  // namespace
}  // namespace polhode
