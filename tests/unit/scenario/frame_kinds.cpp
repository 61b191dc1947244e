// SPDX-License-Identifier: MIT
// Kinds of reference frames that a program adds to ours.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using polhode::test::message_of;
using ::testing::HasSubstr;

struct Arguments {
  double period;
  std::string orbit;
};

constexpr io::KindKey<Arguments> keys[] = {
    io::quantity_key<&Arguments::period>("period", io::Dimension::time, "Of one turn about axis 3.")
        .required()
        .example("24")
        .positive(),
    io::name_key<&Arguments::orbit>("orbit", "An orbit that must be there.").example("\"moon\""),
};

io::MadeFrame made(const Arguments& a, const io::FrameContext& at) {
  if (!a.orbit.empty()) static_cast<void>(at.orbit("orbit"));
  if (a.period == 13.0) throw DomainError("thirteen is refused");
  return {Frame::precessing({0.0, 0.0, 1.0}, 2.0 * std::numbers::pi / a.period, 0.0), "turntable"};
}

io::FrameKind turntable(std::string_view name = "turntable") {
  return io::frame_kind<Arguments>(name, "A frame that turns about axis 3.", keys, made);
}

std::string file(const std::string& frame) {
  return R"(schema = 1
units.time = "h"
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 0.1, theta = 1, psi = 0.5, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
time = { stop = 5, count = 2 }
)" + frame;
}

io::Scenario read(const std::string& frame,
                  const io::Kinds& kinds = io::default_kinds().with(turntable())) {
  return io::scenario_from_text(file(frame), "f.toml", kinds);
}

TEST(FrameKinds, OneOfYourOwnIsMadeFromItsKeys) {
  const io::Scenario scenario = read("frame.turntable.period = \"2 d\"\n");
  const FrameMotion own = scenario.rotation().frame.at(7.0);
  const FrameMotion ours =
      Frame::precessing({0.0, 0.0, 1.0}, 2.0 * std::numbers::pi / 48.0, 0.0).at(7.0);
  EXPECT_EQ(own.q_IS, ours.q_IS);
  EXPECT_EQ(own.mu_S, ours.mu_S);
  EXPECT_EQ(scenario.rotation().frame_text, "turntable");
  EXPECT_TRUE(io::run_facts(scenario).moving_frame);
  bool noted = false;
  for (const std::string& note : io::provenance(scenario).notes)
    noted = noted || note.find("the moving frame: turntable;") != std::string::npos;
  EXPECT_TRUE(noted);
}

// rate = 0.05 + 0.002 t + 0.01 cos(0.3 t + 0.2), per hour.
double varying_rate(double t) { return 0.05 + 0.002 * t + 0.01 * std::cos(0.3 * t + 0.2); }
double varying_angle(double t) {
  return 0.05 * t + 0.001 * t * t + 0.01 / 0.3 * (std::sin(0.3 * t + 0.2) - std::sin(0.2));
}
constexpr const char* varying = "rate_formula = \"5e-2 + 2e-3*t + 0.01*cos(0.3*t + 0.2)\"";

std::string table_of_rates() {
  std::string times, rates;
  for (double t = -1.0; t <= 6.0; t += 0.5) {
    times += std::to_string(t) + ", ";
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g, ", varying_rate(t));
    rates += digits;
  }
  return "times = [" + times + "]\nrates = [" + rates + "]";
}

TEST(FrameKinds, APrecessionRateMayDependOnTime) {
  const test::TempFolder folder;
  std::string rows = "t,rate\n";
  for (double t = -1.0; t <= 6.0; t += 0.5) {
    char row[64];
    std::snprintf(row, sizeof row, "%.17g,%.17g\n", 60.0 * t, varying_rate(t) / 60.0);
    rows += row;
  }
  folder.write("rates.csv", rows);
  const Vec3 axis{0.0, 0.6, 0.8};
  const auto frame = [&](const std::string& lines) {
    const std::string path = folder.write(
        "f.toml", file("[frame.precessing]\naxis = [0, 3, 4]\nepoch = 0.5\n" + lines + "\n"));
    return io::read_scenario(path).rotation().frame;
  };
  const auto distance = [&](const Frame& of, double t) {
    const double angle = varying_angle(t) - varying_angle(0.5);
    const FrameMotion m = of.at(t);
    const Quaternion expected{std::cos(0.5 * angle), std::sin(0.5 * angle) * axis.x,
                              std::sin(0.5 * angle) * axis.y, std::sin(0.5 * angle) * axis.z};
    const Quaternion d = conj(m.q_IS) * expected;
    return std::hypot(d.x, d.y, d.z) + norm(m.mu_S - varying_rate(t) * axis);
  };
  for (const double t : {-0.9, 0.0, 0.5, 1.23, 4.97}) {
    EXPECT_LE(distance(frame(varying), t), budget::frame_rate_formula);
    EXPECT_LE(distance(frame(table_of_rates()), t), budget::frame_rate_table);
    EXPECT_LE(distance(frame("file = \"rates.csv\"\ntime_unit = \"min\"\nrate_unit = "
                             "\"rad/min\""),
                       t),
              budget::frame_rate_table);
  }
  // outside of the rows nothing is known
  EXPECT_TRUE(std::isnan(frame(table_of_rates()).at(6.5).q_IS.w));
}

TEST(FrameKinds, WhatIsNoRateIsRejected) {
  struct Row {
    std::string keys, message;
  };
  const std::string head = "[frame.precessing]\naxis = [0, 0, 1]\n";
  for (const Row& row :
       {Row{"rate_formula = \"\"", "expected a number, t, sin( or cos( at \"\", character 1"},
        Row{"rate_formula = \"5e-3 * u\"", "expected a number, t, sin( or cos( at \"u\""},
        Row{"rate_formula = \"t*cos(t)\"", "expected a number at \"cos(t)\""},
        Row{"rate_formula = \"2*t^0.5\"", "expected a whole power from 1 to 20"},
        Row{"rate_formula = \"cos(2*t\"", "expected +, - or )"},
        Row{"rate_formula = \"1 2\"", "expected +, - or *"},
        Row{"rate_formula = \"cos()\"", "expected a number at \")\""},
        Row{"rate_formula = \"1e200*1e200*t\"", "expected finite numbers"},
        Row{"times = [0, 1, 2]\nrates = [1, 2]", "expected 3 numbers, as many as times has"},
        Row{"times = [0, 2, 1, 3]\nrates = [1, 2, 3, 4]", "row 2: time 1 must be after 2"},
        Row{"times = [1, 2, 3, 4]\nrates = [1, 2, 3, 4]",
            "expected a time that the table of rates covers"},
        Row{"times = [0, 1, 2, 3]\nrates = [1, 2, 3, 4]",
            "expected a frame that is known for all of the run and at t = 0; nothing is known"},
        Row{"rate = 1\ncolumns = [\"1\", \"2\"]", "expected a key file as well"},
        Row{"rate = 1\nrate_formula = \"1\"", "expected exactly one of"},
        Row{"rates = [1, 2]", "expected"}})
    EXPECT_THAT(message_of([&] { read(head + row.keys + "\n", io::default_kinds()); }),
                HasSubstr(row.message))
        << row.keys;
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
      read("frame.turntable.period = 2\n", io::default_kinds()),
      "frame.turntable: unknown key; expected precessing, orbit-plane or local-vertical");
}

TEST(FrameKinds, WhatIsNotSoundIsRefusedWhenItIsAdded) {
  const auto error = [](const io::FrameKind& kind) {
    return message_of([&] { io::default_kinds().with(kind); });
  };
  EXPECT_EQ(error(turntable()), "");
  EXPECT_EQ(error(turntable("precessing")),
            "Kinds: frame \"precessing\" is there; expected another name");
  io::FrameKind kind = turntable();
  kind.made = nullptr;
  EXPECT_EQ(error(kind), "Kinds: frame \"turntable\": got no function that makes it; expected one");
  kind = turntable();
  kind.sets = "period|rate";
  EXPECT_EQ(error(kind),
            "Kinds: frame \"turntable\": got \"rate\" in its sets; expected one of its keys");
}

TEST(FrameKinds, ATemplateHasIt) {
  const io::Kinds kinds = io::default_kinds().with(turntable());
  const io::Scenario scenario =
      io::scenario_from_text(io::scenario_template("turntable", kinds.schema()), "template", kinds);
  EXPECT_EQ(scenario.rotation().frame_text, "turntable");
  io::FrameKind following = turntable("following");
  for (io::Key& key : following.keys) key.presence = io::Presence::required;
  const io::Kinds with_orbit = io::default_kinds().with(following);
  EXPECT_EQ(io::scenario_from_text(io::scenario_template("following", with_orbit.schema()),
                                   "template", with_orbit)
                .rotation()
                .orbits.at(0)
                .name,
            "moon");
}

}  // namespace
}  // namespace polhode
