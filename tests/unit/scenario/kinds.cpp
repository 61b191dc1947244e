// SPDX-License-Identifier: MIT
// Kinds of torques that a program adds to ours.
#include "polhode/scenario/kinds.hpp"

#include <gmock/gmock.h>

#include <any>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/run/map_run.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

enum class Sense { forward, backward };

struct Arguments {
  double radius;  // of other dimensions than ours has
  std::optional<Vec3> axis;
  Sense sense;
  bool strong;
};

constexpr io::KindKey<Arguments> keys[] = {
    io::quantity_key<&Arguments::radius>("radius", io::Dimension::torque, "Not a length.")
        .required()
        .example("0.25")
        .positive(),
    io::quantity_key<&Arguments::axis>("axis", io::Dimension::number, "Its axis; left out, axis 3.")
        .example("[1, 0, 0]"),
    io::choice_key<&Arguments::sense, Sense::forward, Sense::backward>("sense", "forward|backward",
                                                                       "Which way.")
        .otherwise("\"forward\""),
    io::flag_key<&Arguments::strong>("strong", "Twice as much.").otherwise("false"),
};

io::MadeTerms made(const Arguments& a, const io::TermContext& at) {
  const double size = a.radius * (a.sense == Sense::forward ? 1.0 : -1.0) * (a.strong ? 2.0 : 1.0);
  return AnyPerturbation(
      "push", ConstantTorque::in_body(at.principal(size * a.axis.value_or(Vec3{0.0, 0.0, 1.0}))));
}

io::PerturbationKind push(std::string_view name = "push") {
  return io::perturbation_kind<Arguments>(name, "A torque for tests.", keys, made,
                                          {{"own2026", "A. Author (2026).", "the push"}});
}

const std::string file = R"(schema = 1
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 0.1, theta = 1, psi = 0.5, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
time = { stop = 5, count = 2 }
[[perturbation]]
kind = "push"
)";

std::string error_of(const std::string& text, const io::Kinds& kinds) {
  return test::message_of<io::ScenarioError>(
      [&] { io::scenario_from_text(text, "f.toml", kinds); });
}

Vec3 torque(const io::Scenario& scenario) {
  const auto* term = scenario.rotation().terms.at(0).target<ConstantTorque>();
  return term == nullptr ? Vec3{} : term->torque();
}

TEST(Kinds, OneOfYourOwnMakesTermsFromItsKeys) {
  const io::Kinds kinds = io::default_kinds().with(push());
  const auto read = [&](const std::string& own) {
    return torque(io::scenario_from_text(file + own, "f.toml", kinds));
  };
  EXPECT_EQ(read("radius = 2\n"), (Vec3{0.0, 0.0, 2.0}));
  EXPECT_EQ(read("radius = 2\naxis = [1, 0, 0]\nsense = \"backward\"\nstrong = true\n"),
            (Vec3{-4.0, 0.0, 0.0}));
}

TEST(Kinds, WhatItsKeysRefuseStandsAtTheirPlace) {
  const io::Kinds kinds = io::default_kinds().with(push());
  EXPECT_EQ(error_of(file, kinds),
            "f.toml:5:1: perturbation[0].radius: got nothing; expected a torque: a number (of "
            "1/s2), \"1 1/s2\" or { value = 1, unit = \"1/s2\" }");
  EXPECT_EQ(error_of(file + "radius = -1\n", kinds),
            "f.toml:7:10: perturbation[0].radius: got -1; expected a positive torque");
  EXPECT_THAT(error_of(file + "radius = 1\nsense = \"forwrad\"\n", kinds),
              HasSubstr("expected \"forward\" or \"backward\"; did you mean \"forward\"?"));
  EXPECT_THAT(error_of(file + "radius = 1\nk2 = 1\n", kinds),
              HasSubstr("perturbation[0].k2: a key of kind \"tide\"; expected with kind = \"push\" "
                        "only kind, radius, axis, sense or strong"));
  EXPECT_THAT(error_of(file + "radius = 1\n", io::default_kinds()),
              HasSubstr("perturbation[0].kind: got \"push\"; expected \"gravity-gradient\", "));
}

// A key that is left out has the place of its table.
TEST(Kinds, AKeyThatIsLeftOutIsRefusedAtItsTable) {
  io::PerturbationKind choosy = push("choosy");
  choosy.made = [](const io::TermContext& at) -> io::MadeTerms {
    at.refuse("axis", "expected an axis of a body that is " + std::string("round"));
  };
  const io::Kinds kinds = io::default_kinds().with(choosy);
  std::string text = file;
  text.replace(text.find("push"), 4, "choosy");
  EXPECT_EQ(
      error_of(text + "radius = 1\n", kinds),
      "f.toml:5:1: perturbation[0].axis: got nothing; expected an axis of a body that is round");
  EXPECT_EQ(
      error_of(text + "radius = 1\naxis = [1, 0, 0]\n", kinds),
      "f.toml:8:8: perturbation[0].axis: got [1, 0, 0]; expected an axis of a body that is round");
  choosy.name = "lost";
  choosy.made = [](const io::TermContext& at) -> io::MadeTerms {
    at.gm("gm", "orbit");
    return std::vector<AnyPerturbation>{};
  };
  text.replace(text.find("choosy"), 6, "lost");
  EXPECT_EQ(
      error_of(text + "radius = 1\n", kinds.with(choosy)),
      "f.toml:5:1: perturbation[0].orbit: got nothing; expected the name of a table [orbit.NAME]");
}

// Two kinds may have keys of one name that differ; each reads its own.
TEST(Kinds, AKeyMayMeanAnotherThingInAnotherKind) {
  const io::Kinds kinds = io::default_kinds().with(push());
  const std::string anelastic = R"(kind = "anelastic-damping"
rigidity = 1
quality_factor = 100
body_density = 1
)";
  const std::string text = file.substr(0, file.rfind("kind"));
  EXPECT_EQ(error_of(text + anelastic + "radius = -1\n", kinds),
            "f.toml:10:10: perturbation[0].radius: got -1; expected a positive length");
  EXPECT_THAT(error_of(text + "kind = \"damping\"\ncoefficients = [1, 1, 1]\nradius = 1\n", kinds),
              HasSubstr("radius: a key of kind \"tide\", \"anelastic-damping\" or \"push\"; "));
}

TEST(Kinds, SchemaPageAndTemplateKnowIt) {
  const io::Kinds kinds = io::default_kinds().with(push());
  EXPECT_THAT(io::json_schema(kinds.schema()), HasSubstr("\"const\": \"push\""));
  EXPECT_THAT(io::json_schema(io::default_kinds().schema()), Not(HasSubstr("push")));
  EXPECT_THAT(io::markdown_reference(kinds.schema()),
              HasSubstr("- `\"push\"`: A torque for tests."));
  EXPECT_THAT(
      io::markdown_reference(kinds.schema()),
      HasSubstr("| `radius` | torque, positive | required | With kind `push`: Not a length. |"));
  const io::Scenario scenario =
      io::scenario_from_text(io::scenario_template("push", kinds.schema()), "template", kinds);
  EXPECT_THAT(scenario.rotation().kinds, ElementsAre("push"));
  EXPECT_EQ(torque(scenario), (Vec3{0.0, 0.0, 0.25}));
}

struct Bare {
  std::string orbit;
  std::string moon;
  double size;
  Vec3 axis;
  io::LinearMap map;
  Sense sense;
  std::optional<double> mass;
  std::optional<double> other;
};
constexpr io::KindKey<Bare> bare_keys[] = {
    io::name_key<&Bare::orbit>("orbit", "An orbit of its own.").required().example("\"mars\""),
    io::name_key<&Bare::moon>("moon", "Another one.").required(),
    io::quantity_key<&Bare::size>("size", io::Dimension::length, "A size.").required().positive(),
    io::quantity_key<&Bare::axis>("axis", io::Dimension::number, "An axis.").required(),
    io::quantity_key<&Bare::map>("map", io::Dimension::damping, "A map.").required(),
    io::choice_key<&Bare::sense, Sense::forward, Sense::backward>("sense", "forward|backward",
                                                                  "Which.")
        .required(),
    io::quantity_key<&Bare::mass>("mass", io::Dimension::mass, "A mass.")
        .alternative()
        .example("\"2 kg\""),
    io::quantity_key<&Bare::other>("k", io::Dimension::number, "A number.").alternative(),
};

// Its own orbits, something for a required key without an example, and units that give its own.
TEST(Kinds, ATemplateHasWhatItsKeysNeed) {
  io::PerturbationKind kind =
      io::perturbation_kind<Bare>("bare", "For tests.", bare_keys,
                                  [](const Bare& a, const io::TermContext& at) -> io::MadeTerms {
                                    EXPECT_EQ(at.orbit("orbit").name, "mars");
                                    EXPECT_EQ(at.orbit("moon").name, "moon");
                                    EXPECT_TRUE(a.mass.has_value() != a.other.has_value());
                                    return AnyPerturbation("bare", ConstantTorque::in_body(a.axis));
                                  });
  kind.sets = "mass|k";
  const auto units = [&](std::string_view sets) {
    kind.sets = sets;
    const io::Kinds kinds = io::default_kinds().with(kind);
    const std::string text = io::scenario_template("bare", kinds.schema(), "mine");
    EXPECT_THAT(text,
                ::testing::StartsWith("# A scenario for mine. Every key: mine schema keys\n"));
    const io::Scenario scenario = io::scenario_from_text(text, "template", kinds);
    EXPECT_THAT(scenario.rotation().kinds, ElementsAre("bare"));
    return scenario.units().moment();
  };
  EXPECT_EQ(units("mass|k"), "kg m2");
  EXPECT_EQ(units("k|mass"), "1");
}

TEST(Kinds, CitationsComeWithIt) {
  const io::Kinds kinds = io::default_kinds().with(push());
  const std::vector<io::Citation> all =
      io::citations(io::scenario_from_text(file + "radius = 1\n", "f.toml", kinds));
  EXPECT_EQ(all.back().key, "own2026");
  EXPECT_EQ(all.back().reason, "the push");
}

// "moon" is a word of orbits, that others of the works belong to.
TEST(Kinds, ACitationIsThatOfTheKindAndNotOfItsName) {
  const auto works = [](const std::string& name) {
    std::string text = file;
    text.replace(text.find("push"), 4, name);
    std::vector<std::string> all;
    for (const io::Citation& one : io::citations(io::scenario_from_text(
             text + "radius = 1\n", "f.toml", io::default_kinds().with(push(name)))))
      all.emplace_back(one.key);
    return all;
  };
  for (const char* name : {"moon", "earth", "tumbler-2", "splitting", "order4", "g"})
    EXPECT_EQ(works(name), works("push")) << name;
}

TEST(Kinds, MapsMakeItAgain) {
  const io::Kinds kinds = io::default_kinds().with(push());
  const std::string map = R"(radius = 1
[map]
kind = "column"
column = "w3"
[[map.axis]]
key = "perturbation[0].radius"
from = 1
to = 2
count = 2
)";
  const io::ScenarioMap cells(io::scenario_from_text(file + map, "f.toml", kinds));
  ASSERT_EQ(cells.size(), 2);
  const auto one = [&](const std::string& radius) {
    const std::string text = file + map;
    const std::size_t at = text.find("from = 1");
    return io::ScenarioMap(
               io::scenario_from_text(text.substr(0, at) + "from = " + radius + text.substr(at + 8),
                                      "f.toml", kinds))
        .cell(0);
  };
  for (const int cell : {0, 1}) {
    const io::MapCell found = cells.cell(cell);
    EXPECT_EQ(found.failure, "");
    EXPECT_EQ(found.numbers, one(cell == 0 ? "1" : "2").numbers) << cell;
  }
  EXPECT_NE(cells.cell(0).numbers, cells.cell(1).numbers);
}

TEST(Kinds, ANameIsPlainAndNotTaken) {
  const auto error = [](std::string_view name) {
    return test::message_of([&] { io::default_kinds().with(push(name)); });
  };
  EXPECT_EQ(error("push"), "");
  EXPECT_EQ(error("tide"), "Kinds: perturbation \"tide\" is there; expected another name");
  EXPECT_EQ(error("my push"), "Kinds: perturbation \"my push\"; expected letters, digits and -");
  EXPECT_EQ(error(""), "Kinds: perturbation \"\"; expected letters, digits and -");
}

std::string error_of(const io::PerturbationKind& kind) {
  return test::message_of([&] { io::default_kinds().with(kind); });
}

// What is wrong with a kind is said when it is added, not as an error of a user's file.
TEST(Kinds, AKindThatIsNotSoundIsRefusedWhenItIsAdded) {
  const auto with_key = [](io::Key key) {
    io::PerturbationKind kind = push();
    kind.keys.push_back(key);
    return error_of(kind);
  };
  const std::string_view help = "A length.";
  const io::Key length{
      .path = "l", .type = io::KeyType::number, .dimension = io::Dimension::length, .help = help};
  EXPECT_EQ(with_key(length), "");
  const auto with_fallback = [&](std::string_view toml) {
    io::Key key = length;
    key.fallback = toml;
    return with_key(key);
  };
  const std::string l = "Kinds: perturbation \"push\", key \"l\"";
  EXPECT_EQ(with_fallback("\"2 km\""), "");
  EXPECT_EQ(with_fallback("2 km"), l + ": what stands for it, 2 km: not TOML");
  EXPECT_EQ(with_fallback("2\ny = 3"),
            l + ": what stands for it, 2\\x0ay = 3: more than one value");
  EXPECT_EQ(with_fallback("true"), l + ": what stands for it, true: got true; expected a length: a "
                                       "number (of m), \"1 m\" or { value = 1, unit = \"m\" }");
  io::Key shown = length;
  shown.example = "\"2 kg\"";
  EXPECT_THAT(with_key(shown), HasSubstr(l + ": its example \"2 kg\": got \"2 kg\"; expected"));
  io::Key dumb = length;
  dumb.help = {};
  EXPECT_EQ(with_key(dumb), l + ": got no text; expected one sentence");
  io::Key taken = length;
  taken.path = "radius";
  EXPECT_EQ(with_key(taken),
            "Kinds: perturbation \"push\", key \"radius\" is there twice; expected another name");
  taken.path = "kind";
  EXPECT_EQ(with_key(taken),
            "Kinds: perturbation \"push\", key \"kind\"; expected letters, digits, - and _, and "
            "not \"kind\"");
  io::PerturbationKind kind = push();
  kind.sets = "radius|axle";
  EXPECT_EQ(error_of(kind),
            "Kinds: perturbation \"push\": got \"axle\" in its sets; expected one of its keys");
  kind = push();
  kind.made = nullptr;
  EXPECT_EQ(error_of(kind),
            "Kinds: perturbation \"push\": got no function that makes it; expected one");
  EXPECT_EQ(error_of(push("andoyer")),
            "Kinds: perturbation \"andoyer\" is the name of a chart; expected another name");
}

TEST(Kinds, OptionsOfAFormatAreSound) {
  const auto error = [](const std::vector<io::Key>& options, bool are_read = true) -> std::string {
    io::OutputFormat format("own", ".own", "A format.",
                            [](const io::SinkRequest&) { return std::unique_ptr<io::Sink>(); });
    format.keys = options;
    if (are_read) format.options = [](const io::KeyValues&) { return std::any(); };
    return test::message_of([&] { io::default_kinds().with(format); });
  };
  struct Options {
    int digits;
    double offset;
    bool flag;
  };
  constexpr auto digits_key = io::integer_key<&Options::digits>("digits", "Digits.").one_of("6|9");
  const io::Key digits = digits_key.otherwise("6").key(), many = digits_key.otherwise("8").key(),
                shown = io::quantity_key<&Options::offset>("offset", io::Dimension::time, "A time.")
                            .example("1 s")
                            .key(),
                spaced = io::flag_key<&Options::flag>("my flag", "A flag.").key();
  const std::string own = "Kinds: output format \"own\"";
  EXPECT_EQ(error({}, false), "");
  EXPECT_EQ(error({digits}), "");
  EXPECT_EQ(error({digits}, false), own + ": got keys and no function options; expected one");
  EXPECT_EQ(error({digits, digits}),
            own + ", key \"digits\" is there twice; expected another name");
  EXPECT_THAT(error({many}), HasSubstr(own + ", key \"digits\": what stands for it, 8: got 8"));
  EXPECT_EQ(error({shown}), own + ", key \"offset\": its example 1 s: not TOML");
  EXPECT_THAT(error({spaced}), HasSubstr(own + ", key \"my flag\"; expected letters"));
}

// A symmetric matrix stays one: it is made even whether the axes differ or not.
TEST(Kinds, AMatrixAlongPrincipalAxesIsSymmetric) {
  const Mat3 uneven{{{1.0, 0.25, 0.0}, {0.75, 2.0, 0.5}, {0.0, 0.5, 3.0}}};
  io::PerturbationKind kind = push();
  Mat3 seen;
  kind.made = [&](const io::TermContext& at) -> io::MadeTerms {
    seen = at.principal(uneven);
    return std::vector<AnyPerturbation>{};
  };
  const io::Kinds kinds = io::default_kinds().with(kind);
  io::scenario_from_text(file + "radius = 1\n", "f.toml", kinds);
  EXPECT_EQ(seen(0, 1), 0.5);
  EXPECT_EQ(seen(1, 0), 0.5);
  std::string tensor = file + "radius = 1\n";
  tensor.replace(tensor.find("body.moments = [1, 1.7, 2.2]"), 28,
                 "body.tensor = [[1, 0.1, 0], [0.1, 1.7, 0], [0, 0, 2.2]]");
  io::scenario_from_text(tensor, "f.toml", kinds);
  EXPECT_EQ(seen(0, 1), seen(1, 0));
  EXPECT_NE(seen(0, 1), 0.5);
}

TEST(Kinds, OursAreSound) {
  for (io::PerturbationKind kind : io::default_kinds().perturbations()) {
    const std::string other = "my-" + std::string(kind.name);
    kind.name = other;
    EXPECT_EQ(error_of(kind), "");
  }
}

}  // namespace
}  // namespace polhode
