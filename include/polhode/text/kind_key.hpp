// SPDX-License-Identifier: MIT
// KindKey<A>: one key of a kind of thing, as constant data, and the member of its plain struct of
// arguments A that the key fills:
//
//     struct SpinBrake { double torque; std::optional<Vec3> axis; };
//     constexpr KindKey<SpinBrake> keys[] = {
//         quantity_key<&SpinBrake::torque>("torque", Dimension::torque, "Its size.")
//             .required()
//             .positive(),
//         quantity_key<&SpinBrake::axis>("axis", Dimension::number, "Left out, axis 3."),
//     };
//
// Units       a quantity has a dimension (polhode/text/units.hpp), and A holds it in core units.
// Domain      members: double, Vec3, std::array<double, N>, std::vector<double>, Mat3, LinearMap,
//             SquareMatrix, NumberOrAuto, and optional ones of them; integers; bool; an
//             enumeration; std::string and std::vector of it. A key
//             without a default that is left out leaves the member as the struct has it; what
//             `otherwise` says stands there alone.
// Errors      a key without a name, a dimension or a text does not compile; nor does one for a
//             member of another type, or a range of what is no number. Arguments of a table that
//             break `positive` and the like: a ScenarioError at the place of the value.
// Cost        none until a table is read.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/text/detail/key_form.hpp"
#include "polhode/text/key.hpp"
#include "polhode/text/key_values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
// Only the functions below make one: a key has a name, a dimension, a sentence, and a member of the
// type that its values have.
template <class A>
class KindKey {
 public:
  constexpr const Key& key() const { return key_; }

  consteval KindKey required() const {
    if (!key_.fallback.empty()) throw "a key that is required has nothing that stands for it";
    return with(&Key::presence, Presence::required);
  }
  // One of the sets of keys of which a table has exactly one.
  consteval KindKey alternative() const { return with(&Key::presence, Presence::alternative); }
  // What a missing key stands for, as TOML.
  consteval KindKey otherwise(std::string_view toml) const {
    if (key_.presence == Presence::required)
      throw "a key that is required has nothing that stands for it";
    const KindKey made = with(&Key::fallback, toml);
    return key_.example.empty() && key_.type != KeyType::table ? made.example(toml) : made;
  }
  // What `polhode init` writes, as TOML.
  consteval KindKey example(std::string_view toml) const { return with(&Key::example, toml); }
  // A line of its table beside which it must be left out: "field = \"earth\"".
  consteval KindKey unused_with(std::string_view line) const {
    return with(&Key::unused_with, line);
  }
  // Stands in the file that `polhode init` writes, though it may be left out.
  consteval KindKey shown() const { return with(&Key::in_template, true); }
  // For tables with a key `kind`: the kinds that have the key, and those that require it.
  consteval KindKey of_kinds(std::string_view words) const { return with(&Key::kinds, words); }
  consteval KindKey needed_by(std::string_view words) const { return with(&Key::needed_by, words); }
  // A time may also be a date, "2013-02-04", counted from state.epoch.
  consteval KindKey or_date() const {
    if (key_.dimension != Dimension::time) throw "only times have dates";
    return with(&Key::takes_date, true);
  }
  // The integers that are allowed, "1|-1".
  consteval KindKey one_of(std::string_view integers) const {
    if (key_.type != KeyType::integer) throw "only integers are listed";
    return with(&Key::allowed, integers);
  }

  // The integers from `least` to `most`, which messages write as `shown`.
  consteval KindKey from_to(std::int64_t least, std::int64_t most,
                            std::string_view shown = {}) const {
    if (key_.type != KeyType::integer) throw "only integers have limits";
    return with(&Key::whole, {least, most, shown});
  }
  // Fixes the length of an array whose member is a std::vector.
  consteval KindKey of_length(int count) const {
    if (key_.type != KeyType::numbers || key_.length != 0) throw "the member has a length";
    return with(&Key::length, count);
  }

  // Of numbers, all of them.
  consteval KindKey positive() const { return within(Range::positive); }
  consteval KindKey not_negative() const { return within(Range::not_negative); }

  // Throws a ScenarioError at the place of a value that is out of range.
  void check(const KeyValues& values) const { detail::require_allowed(values, key_); }
  // Writes what the table says into the arguments.
  void fill(A& arguments, const KeyValues& values) const { fill_(arguments, values, key_.path); }
  // The reverse. False for a member that is left out.
  bool tell(const A& arguments, KeyValue& value) const {
    value.key = key_.path;
    return tell_(arguments, value, key_.allowed);
  }
  // True if the key fills this member.
  template <auto at>
  constexpr bool is_of() const {
    return member_ == &detail::member_id<at>;
  }

 private:
  using Fill = void (*)(A&, const KeyValues&, std::string_view);
  using Tell = bool (*)(const A&, KeyValue&, std::string_view);
  friend struct detail::KeyMaker;
  consteval KindKey(const Key& row, Fill filled_by, Tell told_by, const char* member)
      : key_(row), fill_(filled_by), tell_(told_by), member_(member) {}

  template <class T>
  consteval KindKey with(T Key::*part, T value) const {
    KindKey made = *this;
    made.key_.*part = value;
    return made;
  }
  consteval KindKey within(Range allowed) const {
    if (key_.type != KeyType::number && key_.type != KeyType::numbers)
      throw "only numbers have a range";
    return with(&Key::range, allowed);
  }

  Key key_;
  Fill fill_;
  Tell tell_;
  const char* member_;
};

// Numbers with a dimension; Dimension::number where they have none. A, here and below: another
// struct, which derives from the one that has the member.
template <auto at, class A = detail::Owner<at>>
  requires detail::HasNumbers<at> && detail::HasMember<A, at>
consteval KindKey<A> quantity_key(std::string_view name, Dimension dimension,
                                  std::string_view help) {
  using Form = detail::KeyFormOf<at>;
  return detail::KeyMaker::key<at, A>({.path = name,
                                       .type = Form::type,
                                       .dimension = dimension,
                                       .length = Form::length,
                                       .allowed = detail::special_words<Form>(),
                                       .help = help});
}

// A table inside the table, whose keys follow: "pole", then "pole.ra". Says whether it is there.
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, bool> && detail::HasMember<A, at>
consteval KindKey<A> table_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>(
      {.path = name, .help = help},
      [](A& arguments, const KeyValues& values, std::string_view key) {
        arguments.*at = values.has(key);
      },
      [](const A& arguments, KeyValue&, std::string_view) { return arguments.*at; });
}

// A whole number that the member can hold.
template <auto at, class A = detail::Owner<at>>
  requires detail::HasInteger<at> && detail::HasMember<A, at>
consteval KindKey<A> integer_key(std::string_view name, std::string_view help) {
  using Whole = typename detail::Plain<detail::Member<at>>::type;
  const KindKey<A> made =
      detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::integer, .help = help});
  if constexpr (sizeof(Whole) < sizeof(std::int64_t))
    return made.from_to(std::numeric_limits<Whole>::min(), std::numeric_limits<Whole>::max());
  else if constexpr (std::unsigned_integral<Whole>)
    return made.from_to(0, WholeRange{}.most, "2^63 - 1");
  else
    return made;
}

// true or false.
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, bool> && detail::HasMember<A, at>
consteval KindKey<A> flag_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::boolean, .help = help});
}

// One of the words "step|linear|cubic", for the enumerators, or for false and true, in this order.
template <auto at, class A, auto... enumerators>
  requires detail::HoldsEach<at, enumerators...> && detail::HasMember<A, at>
consteval KindKey<A> choice_key(std::string_view name, std::string_view words,
                                std::string_view help) {
  detail::require_choice(words, sizeof...(enumerators));
  return detail::KeyMaker::key<at, A>(
      {.path = name, .type = KeyType::choice, .allowed = words, .help = help},
      [](A& arguments, const KeyValues& values, std::string_view key) {
        constexpr std::array all = {enumerators...};
        if (values.has(key)) arguments.*at = all.at(values.choice(key));
      },
      [](const A& arguments, KeyValue& value, std::string_view allowed) {
        return detail::tell_member<at>(arguments, [&](const auto& x) {
          value.words = {detail::word_of<enumerators...>(x, allowed)};
        });
      });
}
template <auto at, auto... enumerators>
  requires detail::HoldsEach<at, enumerators...>
consteval KindKey<detail::Owner<at>> choice_key(std::string_view name, std::string_view words,
                                                std::string_view help) {
  return choice_key<at, detail::Owner<at>, enumerators...>(name, words, help);
}

// Several of these words, none twice.
template <auto at, auto... enumerators>
  requires detail::HoldsEachOfList<at, enumerators...>
consteval KindKey<detail::Owner<at>> choices_key(std::string_view name, std::string_view words,
                                                 std::string_view help) {
  using A = detail::Owner<at>;
  detail::require_choice(words, sizeof...(enumerators));
  return detail::KeyMaker::key<at, A>(
      {.path = name, .type = KeyType::choices, .allowed = words, .help = help},
      [](A& arguments, const KeyValues& values, std::string_view key) {
        constexpr std::array all = {enumerators...};
        if (!values.has(key)) return;
        for (const std::size_t place : values.choices(key))
          (arguments.*at).push_back(all.at(place));
      },
      [](const A& arguments, KeyValue& value, std::string_view allowed) {
        for (const auto& x : arguments.*at)
          value.words.push_back(detail::word_of<enumerators...>(x, allowed));
        return true;
      });
}

// One of the words, as text; several of them, none twice.
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::string> && detail::HasMember<A, at>
consteval KindKey<A> word_key(std::string_view name, std::string_view words,
                              std::string_view help) {
  return detail::KeyMaker::key<at, A>(
      {.path = name, .type = KeyType::choice, .allowed = words, .help = help});
}
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::vector<std::string>> && detail::HasMember<A, at>
consteval KindKey<A> words_key(std::string_view name, std::string_view words,
                               std::string_view help) {
  return detail::KeyMaker::key<at, A>(
      {.path = name, .type = KeyType::choices, .allowed = words, .help = help});
}

// The name of a table such as [orbit.NAME].
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::string> && detail::HasMember<A, at>
consteval KindKey<A> name_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::name, .help = help});
}

// Any text.
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::string> && detail::HasMember<A, at>
consteval KindKey<A> text_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::text, .help = help});
}

// The path of a file, from the folder of the scenario.
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::string> && detail::HasMember<A, at>
consteval KindKey<A> file_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>(
      {.path = name, .type = KeyType::text, .help = help, .is_file = true});
}

// A date, "2013-01-05T00:00:00 UTC" or "JD 2456297.5 TDB" (polhode/text/units.hpp).
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::string> && detail::HasMember<A, at>
consteval KindKey<A> epoch_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::epoch, .help = help});
}

// A unit, and the columns of a file by their names or numbers.
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::string> && detail::HasMember<A, at>
consteval KindKey<A> unit_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::unit, .help = help});
}
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::string> && detail::HasMember<A, at>
consteval KindKey<A> unit_key(std::string_view name, Dimension dimension, std::string_view help) {
  return detail::KeyMaker::key<at, A>(
      {.path = name, .type = KeyType::unit, .dimension = dimension, .help = help});
}
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::vector<std::string>> && detail::HasMember<A, at>
consteval KindKey<A> columns_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::columns, .help = help});
}

// Units, one for each column, and keys of the file.
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::vector<std::string>> && detail::HasMember<A, at>
consteval KindKey<A> units_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::units, .help = help});
}
template <auto at, class A = detail::Owner<at>>
  requires detail::Holds<at, std::vector<std::string>> && detail::HasMember<A, at>
consteval KindKey<A> key_list_key(std::string_view name, std::string_view help) {
  return detail::KeyMaker::key<at, A>({.path = name, .type = KeyType::key_list, .help = help});
}

// Keys that several kinds share, and those of one.
template <class A, std::size_t m, std::size_t n>
constexpr std::array<KindKey<A>, m + n> joined(const std::array<KindKey<A>, m>& shared,
                                               const std::array<KindKey<A>, n>& own) {
  return [&]<std::size_t... i, std::size_t... j>(std::index_sequence<i...>,
                                                 std::index_sequence<j...>) {
    return std::array<KindKey<A>, m + n>{shared[i]..., own[j]...};
  }(std::make_index_sequence<m>(), std::make_index_sequence<n>());
}

// The keys alone, for the schema.
template <class A>
std::vector<Key> keys_of(std::span<const KindKey<A>> keys) {
  std::vector<Key> all;
  for (const KindKey<A>& one : keys) all.push_back(one.key());
  return all;
}

// What a table says.
template <class A>
A arguments(std::span<const KindKey<A>> keys, const KeyValues& values) {
  A made{};
  for (const KindKey<A>& one : keys) {
    one.check(values);
    one.fill(made, values);
  }
  return made;
}

// The reverse: a value for each key whose member is not left out.
template <class A>
std::vector<KeyValue> told(std::span<const KindKey<A>> keys, const A& arguments) {
  std::vector<KeyValue> all;
  for (const KindKey<A>& one : keys)
    if (KeyValue value; one.tell(arguments, value)) all.push_back(std::move(value));
  return all;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
