// SPDX-License-Identifier: MIT
// Kinds of methods that a program adds to ours.
#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

#include "message_of.hpp"
#include "own_steps.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

using polhode::test::message_of;

struct Arguments {
  double step;
};

constexpr io::KindKey<Arguments> keys[] = {
    io::quantity_key<&Arguments::step>("step", io::Dimension::time, "How far each step goes.")
        .required()
        .example("0.5")
        .positive(),
};

Method made(const Arguments& a, const io::KeyValues&) { return test::runge_kutta_4(a.step); }

io::MethodKind runge_kutta_kind(std::string_view name = "runge-kutta-4") {
  return io::method_kind<Arguments>(name, "For tests.", keys, made, [](const Method& method) {
    const bool fine = *method_traits(method).step < 0.1;
    return fine ? std::vector<io::Citation>{{"fine1901", "A. Author (1901).", "small steps"}}
                : std::vector<io::Citation>{};
  });
}

std::string file(const std::string& method) {
  return R"(schema = 1
units.time = "min"
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 0.1, theta = 1, psi = 0.5, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
time = { stop = 5, count = 2 }
[[perturbation]]
kind = "constant-torque"
torque = [0, 0, 1]
[method]
)" + method;
}

io::Scenario read(const std::string& method, const io::Kinds& kinds) {
  return io::scenario_from_text(file(method), "f.toml", kinds);
}

const std::string own = "kind = \"runge-kutta-4\"\nstep = ";

TEST(MethodKinds, OneOfYourOwnIsMadeFromItsKeys) {
  const io::Kinds kinds = io::default_kinds().with(runge_kutta_kind());
  const io::Scenario scenario = read(own + "\"15 s\"\n", kinds);
  EXPECT_EQ(io::propagation_method(scenario), Method(test::runge_kutta_4(0.25)));
  EXPECT_EQ(io::propagation_text(scenario), "runge-kutta-4, step 0.25 min");
  EXPECT_MESSAGE(read(own + "-1\n", kinds),
                 "f.toml:11:8: method.step: got -1; expected a positive time");
  EXPECT_REJECTED(read(own + "1\n", io::default_kinds()),
                  "method.kind: got \"runge-kutta-4\"; expected \"adaptive\", ");
  EXPECT_REJECTED(read(own + "1e-20\n", kinds),
                  "method.step: got 1e-20; expected a step of which 1e15 at most");
}

TEST(MethodKinds, ItsKeysAreOfItsKindAlone) {
  const io::Kinds kinds = io::default_kinds().with(runge_kutta_kind());
  EXPECT_REJECTED(read(own + "1\ntolerance = 1e-9\n", kinds),
                  "method.tolerance: a key of kind \"adaptive\", ");
  // the step of the splitting has another text: two rows of one name
  EXPECT_EQ(io::propagation_method(read("kind = \"splitting\"\nstep = 1\n", kinds)),
            Method(Splitting{.step = 1.0}));
}

TEST(MethodKinds, CitationsDependOnTheMethod) {
  const io::Kinds kinds = io::default_kinds().with(runge_kutta_kind());
  const auto cites = [&](const std::string& step) {
    for (const io::Citation& one : io::citations(read(own + step + "\n", kinds)))
      if (one.key == "fine1901") return true;
    return false;
  };
  EXPECT_TRUE(cites("0.001"));
  EXPECT_FALSE(cites("1"));
}

TEST(MethodKinds, WhatIsNotSoundIsRefusedWhenItIsAdded) {
  const auto error = [](const io::MethodKind& kind) {
    return message_of([&] { io::default_kinds().with(kind); });
  };
  EXPECT_EQ(error(runge_kutta_kind()), "");
  EXPECT_EQ(error(runge_kutta_kind("adaptive")),
            "Kinds: method \"adaptive\" is there; expected another name");
  EXPECT_EQ(error(runge_kutta_kind("my steps")),
            "Kinds: method \"my steps\"; expected letters, digits and -");
  io::MethodKind kind = runge_kutta_kind();
  kind.made = nullptr;
  EXPECT_EQ(error(kind),
            "Kinds: method \"runge-kutta-4\": got no function that makes it; expected one");
}

TEST(MethodKinds, AMethodHasTheNameOfItsKind) {
  const io::Kinds kinds = io::default_kinds().with(runge_kutta_kind("rk4"));
  EXPECT_REJECTED(read("kind = \"rk4\"\nstep = 1\n", kinds),
                  "expected a kind whose methods have its name, not runge-kutta-4");
}

TEST(MethodKinds, OursAreSoundAndMakeWhatTheyAreCalled) {
  for (const io::MethodKind& kind : io::default_kinds().methods()) {
    const std::string step = kind.name == "splitting" ? "step = 1\n" : "";
    const auto method = io::propagation_method(
        read("kind = \"" + std::string(kind.name) + "\"\n" + step, io::default_kinds()));
    ASSERT_TRUE(method.has_value());
    EXPECT_EQ(method_traits(*method).kind, kind.name);
    EXPECT_FALSE(kind.cited(*method).empty());
    io::MethodKind other = kind;
    const std::string name = "my-" + std::string(kind.name);
    other.name = name;
    EXPECT_EQ(message_of([&] { io::default_kinds().with(other); }), "");
  }
}

TEST(MethodKinds, ATemplateHasIt) {
  const io::Kinds kinds = io::default_kinds().with(runge_kutta_kind());
  const io::Scenario scenario = io::scenario_from_text(
      io::scenario_template("runge-kutta-4", kinds.schema()), "template", kinds);
  EXPECT_EQ(method_traits(scenario.rotation().method.value()).kind, "runge-kutta-4");
}

}  // namespace
}  // namespace polhode
