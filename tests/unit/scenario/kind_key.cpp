// SPDX-License-Identifier: MIT
// What is no description of a key does not compile.
#include "polhode/text/kind_key.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "message_of.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/scenario/scenario.hpp"
#include "text/number_text.hpp"

namespace polhode {
namespace {

using polhode::test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

enum class Sense { forward, backward };

struct Part {
  double size;
};
struct Arguments : Part {
  std::optional<Vec3> axis;
  io::LinearMap map;
  std::vector<double> times;
  bool strong;
  Sense sense;
  std::string word;
  std::optional<std::string> other;
  std::vector<std::string> words;
  std::vector<Sense> senses;
  int whole;
};
struct Stranger {
  double size;
};

// Whether a key that is made in this way is a constant. The words are right, but for one.
template <auto at>
concept Quantity = requires {
  typename std::bool_constant<(io::quantity_key<at>("r", io::Dimension::torque, "A."), true)>;
};
template <auto at>
concept WithoutDimension = requires { io::quantity_key<at>("r", "A."); };
template <auto at>
concept WithoutText = requires { io::quantity_key<at>("r", io::Dimension::torque); };
template <auto at>
concept WithEmptyText = requires {
  typename std::bool_constant<(io::quantity_key<at>("r", io::Dimension::torque, ""), true)>;
};
template <auto at>
concept WithoutStop = requires {
  typename std::bool_constant<(io::quantity_key<at>("r", io::Dimension::torque, "A"), true)>;
};
template <auto at>
concept WithoutName = requires {
  typename std::bool_constant<(io::quantity_key<at>("", io::Dimension::torque, "A."), true)>;
};
static_assert(Quantity<&Arguments::axis> && Quantity<&Arguments::map> &&
              Quantity<&Arguments::times> && Quantity<&Part::size>);
static_assert(!WithoutDimension<&Arguments::axis> && !WithoutText<&Arguments::axis>);
static_assert(!WithEmptyText<&Arguments::axis> && !WithoutStop<&Arguments::axis>);
static_assert(!WithoutName<&Arguments::axis>);

// The member has the type of the values.
template <auto at>
concept Flag = requires { typename std::bool_constant<(io::flag_key<at>("r", "A."), true)>; };
template <auto at>
concept Name = requires { typename std::bool_constant<(io::name_key<at>("r", "A."), true)>; };
template <auto at>
concept File = requires { typename std::bool_constant<(io::file_key<at>("r", "A."), true)>; };
template <auto at>
concept OneUnit = requires { typename std::bool_constant<(io::unit_key<at>("r", "A."), true)>; };
template <auto at>
concept Columns = requires { typename std::bool_constant<(io::columns_key<at>("r", "A."), true)>; };
static_assert(Flag<&Arguments::strong>);
static_assert(!Flag<&Part::size> && !Flag<&Arguments::word> && !Flag<&Arguments::whole>);
static_assert(Name<&Arguments::word> && Name<&Arguments::other>);
static_assert(!Name<&Arguments::words> && !Name<&Part::size> && !Name<&Arguments::strong>);
static_assert(File<&Arguments::word> && !File<&Arguments::axis> && !File<&Arguments::strong>);
static_assert(OneUnit<&Arguments::other> && !OneUnit<&Part::size>);
static_assert(Columns<&Arguments::words> && !Columns<&Arguments::word>);
static_assert(!Quantity<&Arguments::strong> && !Quantity<&Arguments::word>);
static_assert(!Quantity<&Arguments::whole> && !Quantity<&Arguments::sense>);

// So have the enumerators of a choice, each with a word.
template <auto... enumerators>
concept Choice = requires {
  typename std::bool_constant<(
      io::choice_key<&Arguments::sense, enumerators...>("r", "forward|backward", "A."), true)>;
};
template <auto at>
concept WithOneWord = requires {
  typename std::bool_constant<(
      io::choice_key<at, Sense::forward, Sense::backward>("r", "forward", "A."), true)>;
};
template <auto at>
concept WithEmptyWord = requires {
  typename std::bool_constant<(
      io::choice_key<at, Sense::forward, Sense::backward>("r", "forward|", "A."), true)>;
};
template <auto at>
concept ChoiceOfNumbers =
    requires { typename std::bool_constant<(io::choice_key<at, 0, 1>("r", "a|b", "A."), true)>; };
template <auto at>
concept ChoiceOfFlags = requires {
  typename std::bool_constant<(io::choice_key<at, false, true>("r", "no|yes", "A."), true)>;
};
static_assert(ChoiceOfFlags<&Arguments::strong> && !ChoiceOfFlags<&Arguments::whole>);
static_assert(Choice<Sense::forward, Sense::backward>);
static_assert(!Choice<Sense::forward> && !Choice<> && !Choice<0, 1>);
static_assert(!WithOneWord<&Arguments::sense> && !WithEmptyWord<&Arguments::sense>);
static_assert(!ChoiceOfNumbers<&Arguments::whole>);
template <auto... enumerators>
concept Choices = requires {
  typename std::bool_constant<(
      io::choices_key<&Arguments::senses, enumerators...>("r", "forward|backward", "A."), true)>;
};
static_assert(Choices<Sense::forward, Sense::backward>);
static_assert(!Choices<Sense::forward> && !Choices<0, 1>);

// A range belongs to numbers, and nothing stands for what is required.
template <auto at>
concept PositiveQuantity = requires {
  typename std::bool_constant<(io::quantity_key<at>("r", io::Dimension::torque, "A.").positive(),
                               true)>;
};
template <auto at>
concept PositiveFlag =
    requires { typename std::bool_constant<(io::flag_key<at>("r", "A.").positive(), true)>; };
template <auto at>
concept FlagThatIsNotNegative =
    requires { typename std::bool_constant<(io::flag_key<at>("r", "A.").not_negative(), true)>; };
template <auto at>
concept PositiveName =
    requires { typename std::bool_constant<(io::name_key<at>("r", "A.").positive(), true)>; };
template <auto at>
concept RequiredWithFallback = requires {
  typename std::bool_constant<(io::flag_key<at>("r", "A.").required().otherwise("true"), true)>;
};
template <auto at>
concept FallbackOfRequired = requires {
  typename std::bool_constant<(io::flag_key<at>("r", "A.").otherwise("true").required(), true)>;
};
static_assert(PositiveQuantity<&Part::size> && PositiveQuantity<&Arguments::times>);
static_assert(!PositiveQuantity<&Arguments::map>);  // of a matrix it would say nothing
static_assert(!PositiveFlag<&Arguments::strong> && !FlagThatIsNotNegative<&Arguments::strong>);
static_assert(!PositiveName<&Arguments::word>);
static_assert(!RequiredWithFallback<&Arguments::strong>);
static_assert(!FallbackOfRequired<&Arguments::strong>);

// Limits belong to integers, and a length to arrays that have none of their own.
template <auto at>
concept LimitedInteger =
    requires { typename std::bool_constant<(io::integer_key<at>("r", "A.").from_to(1, 9), true)>; };
template <auto at>
concept LimitedQuantity = requires {
  typename std::bool_constant<(io::quantity_key<at>("r", io::Dimension::torque, "A.").from_to(1, 9),
                               true)>;
};
template <auto at>
concept ArrayOfTwo = requires {
  typename std::bool_constant<(io::quantity_key<at>("r", io::Dimension::torque, "A.").of_length(2),
                               true)>;
};
static_assert(LimitedInteger<&Arguments::whole> && !LimitedInteger<&Arguments::strong>);
static_assert(!LimitedQuantity<&Part::size>);
static_assert(ArrayOfTwo<&Arguments::times>);
static_assert(!ArrayOfTwo<&Arguments::axis> && !ArrayOfTwo<&Part::size>);

// Nothing else makes a key.
static_assert(!std::is_aggregate_v<io::KindKey<Arguments>>);
static_assert(!std::is_default_constructible_v<io::KindKey<Arguments>>);
static_assert(!std::is_constructible_v<io::KindKey<Arguments>, io::Key>);

// Keys of a struct that the arguments derive from; not of another one.
template <class A>
concept HasSize = requires {
  typename std::bool_constant<(io::quantity_key<&Part::size, A>("r", io::Dimension::torque, "A."),
                               true)>;
};
static_assert(HasSize<Part> && HasSize<Arguments> && !HasSize<Stranger>);

struct Derived : Arguments {};
constexpr io::KindKey<Derived> keys[] = {
    io::quantity_key<&Part::size, Derived>("size", io::Dimension::length, "A size.").positive(),
    io::choice_key<&Arguments::sense, Derived, Sense::forward, Sense::backward>(
        "sense", "forward|backward", "Which way.")
        .otherwise("\"forward\""),
    io::flag_key<&Arguments::strong, Derived>("strong", "Twice as much.").required(),
};

TEST(KindKey, ItsRowSaysAllThatWasSaid) {
  std::vector<io::Key> rows;
  for (const io::KindKey<Derived>& key : keys) rows.push_back(key.key());
  EXPECT_EQ(rows, io::keys_of<Derived>(keys));
  EXPECT_EQ(rows[0], (io::Key{.path = "size",
                              .type = io::KeyType::number,
                              .dimension = io::Dimension::length,
                              .help = "A size.",
                              .range = io::Range::positive}));
  EXPECT_EQ(rows[1].allowed, "forward|backward");
  EXPECT_EQ(rows[1].example, rows[1].fallback);
  EXPECT_EQ(rows[2].presence, io::Presence::required);
}

// One struct of a file is one of C++: what a key says of a missing one is what C++ has there.
TEST(KindKey, DefaultsOfFilesAreThoseOfTheLibrary) {
  const auto method = [](const std::string& table) {
    return *io::scenario_from_text(
                "schema = 1\nbody.moments = [1, 2, 3]\nstate.andoyer = { l = 0, g = "
                "0, h = 0, L = 0.5, G = 1, H = 0 }\n[method]\n" +
                    table,
                "f.toml")
                .rotation()
                .method;
  };
  EXPECT_EQ(method("kind = \"adaptive\""), Method(Adaptive{}));
  EXPECT_EQ(method("kind = \"splitting\"\nstep = 0.5"), Method(Splitting{.step = 0.5}));
  EXPECT_EQ(method("kind = \"variation-of-constants\""), Method(VariationOfConstants{}));
  const std::span<const io::Key> all = io::scenario_schema().keys;
  const auto factor = std::find_if(all.begin(), all.end(), [](const io::Key& key) {
    return key.path == "perturbation[].shape_factor";
  });
  ASSERT_NE(factor, all.end());
  EXPECT_EQ(factor->fallback, detail::number_text(DampedMaterial{}.shape_factor));
}

TEST(KindKey, IntegersOutsideTheirLimitsAreRejected) {
  const auto message = [](const std::string& line) {
    return message_of([&] {
      io::scenario_from_text(
          "schema = 1\nkind = \"fit\"\nbody.moments = [1, 2, 3]\nstate.andoyer = { l = 0, g = 0, "
          "h = 0, L = 0.5, G = 1, H = 0 }\n[[observation]]\nkind = \"rate\"\nfile = \"r.csv\"\n"
          "times = \"at-body\"\nsigma = 1\n[free]\nunknowns = [\"rate\"]\n[fit]\n" +
              line,
          "f.toml");
    });
  };
  EXPECT_EQ(message("starts = 0"),
            "f.toml:13:10: fit.starts: got 0; expected a whole number from 1 to 1e6");
  EXPECT_EQ(message("seed = -1"),
            "f.toml:13:8: fit.seed: got -1; expected a whole number from 0 to 2^63 - 1");
  EXPECT_EQ(message("scan.order = 10"),
            "f.toml:13:14: fit.scan.order: got 10; expected a whole number from 1 to 9");
}

// Those that are in the key, for editors and pages.
TEST(KindKey, RangesAreInSchemaAndPages) {
  const io::Key rows[] = {
      {.path = "size",
       .type = io::KeyType::number,
       .dimension = io::Dimension::length,
       .help = "A size.",
       .range = io::Range::positive},
      {.path = "parts",
       .type = io::KeyType::numbers,
       .length = 2,
       .help = "Parts.",
       .range = io::Range::not_negative},
      {.path = "free", .type = io::KeyType::number, .help = "Any number."},
  };
  const std::string page = io::markdown_reference({rows, {}}), json = io::json_schema({rows, {}});
  EXPECT_THAT(page, HasSubstr("| `size` | length, positive |"));
  EXPECT_THAT(page, HasSubstr("| `parts` | 2 x pure number, not negative |"));
  EXPECT_THAT(page, HasSubstr("| `free` | number |"));
  const auto part = [&](const std::string& from, const std::string& to) {
    const std::size_t begin = json.find(from);
    return json.substr(begin, json.find(to, begin) - begin);
  };
  EXPECT_THAT(part("\"size\"", "\"parts\""),
              AllOf(HasSubstr("\"exclusiveMinimum\": 0"), HasSubstr("\"value\"")));
  EXPECT_THAT(part("\"parts\"", "\"free\""), HasSubstr("\"minimum\": 0"));
  EXPECT_THAT(part("\"free\"", "\"$defs\""), Not(HasSubstr("inimum")));
}

}  // namespace
}  // namespace polhode
