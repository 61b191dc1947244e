// SPDX-License-Identifier: MIT
// Kinds of orbits that a program adds to ours.
#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

struct Arguments {
  double size;
  bool ends_with_the_run = false;
};

constexpr io::KindKey<Arguments> keys[] = {
    io::quantity_key<&Arguments::size>("size", io::Dimension::length, "Of the circle.")
        .required()
        .example("7000.0")
        .positive(),
    io::flag_key<&Arguments::ends_with_the_run>("bounded", "No longer than the run.")
        .otherwise("false"),
};

io::ScenarioOrbit made(const Arguments& a, const io::OrbitContext& at) {
  if (a.ends_with_the_run && (!at.run_span() || at.run_span()->last > 10.0))
    at.refuse("bounded", "expected a run of 10 at most");
  return {.motion = KeplerOrbit({.gm = 8.0, .pericentre = a.size, .eccentricity = 0.0}), .gm = 8.0};
}

io::OrbitKind circle_kind(std::string_view name = "circle") {
  return io::orbit_kind<Arguments>(name, "For tests.", keys, made,
                                   {{"round1901", "A. Author (1901).", "the circle"}});
}

std::string file(const std::string& orbit, const std::string& stop = "5") {
  return R"(schema = 1
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 0.1, theta = 1, psi = 0.5, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
[orbit.planet]
)" + orbit +
         R"([[perturbation]]
kind = "gravity-gradient"
orbit = "planet"
[time]
count = 2
stop = )" +
         stop + "\n";
}

io::Scenario read(const std::string& orbit, const io::Kinds& kinds, const std::string& stop = "5") {
  return io::scenario_from_text(file(orbit, stop), "f.toml", kinds);
}

const std::string own = "kind = \"circle\"\nsize = ";

TEST(OrbitKinds, OneOfYourOwnIsMadeFromItsKeys) {
  const io::Kinds kinds = io::default_kinds().with(circle_kind());
  const io::Scenario scenario = read(own + "2\n", kinds);
  const io::ScenarioOrbit& orbit = scenario.rotation().orbits.at(0);
  EXPECT_EQ(orbit.name, "planet");
  EXPECT_EQ(orbit.kind, "circle");
  EXPECT_EQ(io::kepler_elements(orbit)->pericentre, 2.0);
  EXPECT_THAT(io::citations(scenario), Contains(Field(&io::Citation::key, "round1901")));
  EXPECT_MESSAGE(read(own + "-1\n", kinds),
                 "f.toml:6:8: orbit.planet.size: got -1; expected a positive length");
  EXPECT_REJECTED(read("kind = \"circle\"\n", kinds), "orbit.planet.size");
  EXPECT_REJECTED(read(own + "2\n", io::default_kinds()),
                  "orbit.planet.kind: got \"circle\"; expected \"kepler\", ");
}

TEST(OrbitKinds, OneOfYourOwnKnowsTheRun) {
  const io::Kinds kinds = io::default_kinds().with(circle_kind());
  const std::string bounded = own + "2\nbounded = true\n";
  EXPECT_NO_THROW(read(bounded, kinds, "10"));
  EXPECT_MESSAGE(read(bounded, kinds, "11"),
                 "f.toml:7:11: orbit.planet.bounded: got true; expected a run of 10 at most");
}

TEST(OrbitKinds, ItsKeysAreOfItsKindAlone) {
  const io::Kinds kinds = io::default_kinds().with(circle_kind());
  EXPECT_REJECTED(read(own + "2\neccentricity = 0.1\n", kinds),
                  "orbit.planet.eccentricity: a key of kind \"kepler\"");
  EXPECT_REJECTED(read(own + "2\ngm = 1\n", kinds),
                  "orbit.planet.gm: a key of kind \"kepler\", \"state\", \"table\", ");
  EXPECT_THAT(io::json_schema(kinds.schema()), HasSubstr("\"circle\""));
  EXPECT_THAT(io::markdown_reference(kinds.schema()), HasSubstr("- `\"circle\"`: For tests.\n"));
}

TEST(OrbitKinds, OneThatIsNotSoundIsRefused) {
  EXPECT_MESSAGE(io::default_kinds().with(circle_kind("kepler")),
                 "Kinds: orbit \"kepler\" is there; expected another name");
  EXPECT_REJECTED(io::default_kinds().with(circle_kind("a circle")),
                  "Kinds: orbit \"a circle\"; expected letters, digits and -");
  io::OrbitKind empty = circle_kind();
  empty.made = nullptr;
  EXPECT_REJECTED(io::default_kinds().with(empty), "got no function that makes it; expected one");
}

// What goes round on it has a gm of its own, since the kind has no key for one.
TEST(OrbitKinds, ATemplateHasItUnderATorque) {
  const io::Kinds kinds = io::default_kinds().with(circle_kind());
  const std::string text = io::scenario_template("circle", kinds.schema());
  EXPECT_THAT(text, HasSubstr("\n[orbit.earth]\n# For tests.\nkind = \"circle\"\n"));
  EXPECT_THAT(text, HasSubstr("\ngm = \"398600.4418 km3/s2\"\n"));
  const io::Scenario scenario = io::scenario_from_text(text, "template", kinds);
  EXPECT_EQ(scenario.rotation().orbits.at(0).kind, "circle");
  EXPECT_EQ(scenario.rotation().terms.size(), 1U);
}

TEST(OrbitKinds, ATemplateOverAgesIsOfThePlanetThatMoves) {
  io::OrbitKind kind = circle_kind("ages");
  kind.made = nullptr;
  kind.history = [](const io::OrbitContext&) -> io::ScenarioHistory {
    throw DomainError("never made");
  };
  const std::string text = io::scenario_template("ages", io::default_kinds().with(kind).schema());
  EXPECT_THAT(text, HasSubstr("\n[orbit.mars]\n# For tests.\nkind = \"ages\"\n"));
  EXPECT_THAT(text, HasSubstr("\nkind = \"obliquity\"\n"));
}

// A word stands for the first of them; the other has its table before it.
TEST(OrbitKinds, ATemplateOfANameThatAnotherSortHasIsKnownByItsTable) {
  const io::Kinds kinds = io::default_kinds().with(circle_kind("drag"));
  EXPECT_THAT(io::scenario_template("drag", kinds.schema()),
              HasSubstr("\n[[perturbation]]\n# Air on the facets"));
  EXPECT_THAT(io::scenario_template("orbit.drag", kinds.schema()),
              HasSubstr("\n[orbit.earth]\n# For tests.\nkind = \"drag\"\n"));
  EXPECT_THAT(io::scenario_templates(kinds.schema()),
              Contains(Field(&io::TemplateSort::words, Contains("orbit.drag"))));
}

}  // namespace
}  // namespace polhode
