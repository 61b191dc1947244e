// SPDX-License-Identifier: MIT
// Kinds of reference frames that a program adds to ours.
#include <gmock/gmock.h>

#include <numbers>
#include <string>
#include <string_view>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

using polhode::test::message_of;
using ::testing::HasSubstr;

struct Arguments {
  double period;
  std::string orbit;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::period>("period", Dimension::time, "Of one turn about axis 3.")
        .required()
        .example("24")
        .positive(),
    name_key<&Arguments::orbit>("orbit", "An orbit that must be there.").example("\"moon\""),
};

MadeFrame made(const Arguments& a, const FrameContext& at) {
  if (!a.orbit.empty()) static_cast<void>(at.orbit("orbit"));
  if (a.period == 13.0) throw DomainError("thirteen is refused");
  return {Frame::precessing({0.0, 0.0, 1.0}, 2.0 * std::numbers::pi / a.period, 0.0), "turntable"};
}

FrameKind turntable(std::string_view name = "turntable") {
  return frame_kind<Arguments>(name, "A frame that turns about axis 3.", keys, made);
}

std::string file(const std::string& frame) {
  return R"(schema = 1
units.time = "h"
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 0.1, theta = 1, psi = 0.5, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
time = { stop = 5, count = 2 }
)" + frame;
}

Scenario read(const std::string& frame, const Kinds& kinds = default_kinds().with(turntable())) {
  return scenario_from_text(file(frame), "f.toml", kinds);
}

TEST(FrameKinds, OneOfYourOwnIsMadeFromItsKeys) {
  const Scenario scenario = read("frame.turntable.period = \"2 d\"\n");
  const FrameMotion own = scenario.rotation().frame.at(7.0);
  const FrameMotion ours =
      Frame::precessing({0.0, 0.0, 1.0}, 2.0 * std::numbers::pi / 48.0, 0.0).at(7.0);
  EXPECT_EQ(own.q_IS, ours.q_IS);
  EXPECT_EQ(own.mu_S, ours.mu_S);
  EXPECT_EQ(scenario.rotation().frame_text, "turntable");
  EXPECT_TRUE(run_facts(scenario).moving_frame);
  bool noted = false;
  for (const std::string& note : provenance(scenario).notes)
    noted = noted || note.find("the moving frame: turntable;") != std::string::npos;
  EXPECT_TRUE(noted);
}

TEST(FrameKinds, WhatIsWrongStandsAtItsPlace) {
  const auto error = [](const std::string& frame) { return message_of([&] { read(frame); }); };
  EXPECT_EQ(error("frame.turntable.period = -2\n"),
            "f.toml:6:26: frame.turntable.period: got -2; expected a positive time");
  EXPECT_THAT(error("frame.turntable.period = 13\n"), HasSubstr("thirteen is refused"));
  EXPECT_THAT(error("frame.turntable = { period = 2, orbit = \"mars\" }\n"),
              HasSubstr("frame.turntable.orbit: got \"mars\"; expected"));
  EXPECT_THAT(
      error("frame = { turntable.period = 2, precessing = { axis = [0, 0, 1], rate = 1 } }"),
      HasSubstr("expected exactly one of precessing, orbit-plane, local-vertical, turntable"));
  EXPECT_REJECTED(
      read("frame.turntable.period = 2\n", default_kinds()),
      "frame.turntable: unknown key; expected precessing, orbit-plane or local-vertical");
}

TEST(FrameKinds, WhatIsNotSoundIsRefusedWhenItIsAdded) {
  const auto error = [](const FrameKind& kind) {
    return message_of([&] { default_kinds().with(kind); });
  };
  EXPECT_EQ(error(turntable()), "");
  EXPECT_EQ(error(turntable("precessing")),
            "Kinds: frame \"precessing\" is there; expected another name");
  FrameKind kind = turntable();
  kind.made = nullptr;
  EXPECT_EQ(error(kind), "Kinds: frame \"turntable\": got no function that makes it; expected one");
  kind = turntable();
  kind.sets = "period|rate";
  EXPECT_EQ(error(kind),
            "Kinds: frame \"turntable\": got \"rate\" in its sets; expected one of its keys");
}

TEST(FrameKinds, ATemplateHasIt) {
  const Kinds kinds = default_kinds().with(turntable());
  const Scenario scenario =
      scenario_from_text(scenario_template("turntable", kinds.schema()), "template", kinds);
  EXPECT_EQ(scenario.rotation().frame_text, "turntable");
  FrameKind following = turntable("following");
  for (Key& key : following.keys) key.presence = Presence::required;
  const Kinds with_orbit = default_kinds().with(following);
  EXPECT_EQ(scenario_from_text(scenario_template("following", with_orbit.schema()), "template",
                               with_orbit)
                .rotation()
                .orbits.at(0)
                .name,
            "moon");
}

}  // namespace
}  // namespace polhode
