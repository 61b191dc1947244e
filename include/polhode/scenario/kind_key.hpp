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
// Equations   none.
// Units       a quantity has a dimension (polhode/text/units.hpp), and A holds it in core units.
// Domain      members: double, Vec3, std::array<double, N>, std::vector<double>, LinearMap, and
//             optional ones of them; bool; an enumeration; std::string and std::vector of it. A key
//             without a default that is left out leaves the member as it is.
// Accuracy    none.
// Errors      a key without a name, a dimension or a text does not compile. Arguments of a table
//             that break `positive` and the like: a ScenarioError at the place of the value.
// Cost        none until a table is read.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "polhode/scenario/detail/key_form.hpp"
#include "polhode/scenario/key_values.hpp"
#include "polhode/scenario/schema.hpp"

namespace polhode {
inline namespace v0 {

template <class A>
struct KindKey {
  Key key;
  Range range = Range::any;
  void (*fill)(A&, const KeyValues&, std::string_view) = nullptr;

  constexpr KindKey required() const {
    KindKey made = *this;
    made.key.presence = Presence::required;
    return made;
  }
  // One of the sets of keys of which a table has exactly one.
  constexpr KindKey alternative() const {
    KindKey made = *this;
    made.key.presence = Presence::alternative;
    return made;
  }
  // What a missing key stands for, as TOML.
  constexpr KindKey otherwise(std::string_view toml) const {
    KindKey made = *this;
    made.key.fallback = toml;
    if (made.key.example.empty()) made.key.example = toml;
    return made;
  }
  // What `polhode init` writes, as TOML.
  constexpr KindKey example(std::string_view toml) const {
    KindKey made = *this;
    made.key.example = toml;
    return made;
  }
  // Stands in the file that `polhode init` writes, though it may be left out.
  constexpr KindKey shown() const {
    KindKey made = *this;
    made.key.in_template = true;
    return made;
  }
  // A key as its maker begins it.
  template <auto at>
  static consteval KindKey of(KeyType type, std::string_view name, std::string_view help) {
    detail::require_words(name, help);
    return {Key{.path = name, .type = type, .help = help}, Range::any, detail::fill_member<at, A>};
  }

  constexpr KindKey positive() const { return within(Range::positive); }
  constexpr KindKey not_negative() const { return within(Range::not_negative); }
  constexpr KindKey within(Range allowed) const {
    KindKey made = *this;
    made.range = allowed;
    return made;
  }
};

// Numbers with a dimension; Dimension::number where they have none. With A: of a struct that
// derives from the one that has the member.
template <auto at, class A = detail::Owner<at>>
consteval KindKey<A> quantity_key(std::string_view name, Dimension dimension,
                                  std::string_view help) {
  KindKey<A> made = KindKey<A>::template of<at>(detail::KeyFormOf<at>::type, name, help);
  made.key.dimension = dimension;
  made.key.length = detail::KeyFormOf<at>::length;
  return made;
}

// true or false.
template <auto at, class A = detail::Owner<at>>
consteval KindKey<A> flag_key(std::string_view name, std::string_view help) {
  return KindKey<A>::template of<at>(KeyType::boolean, name, help);
}

// One of the words "step|linear|cubic", for the enumerators in this order.
template <auto at, auto... enumerators>
consteval KindKey<detail::Owner<at>> choice_key(std::string_view name, std::string_view words,
                                                std::string_view help) {
  using A = detail::Owner<at>;
  using M = typename detail::Plain<detail::Member<at>>::type;
  static_assert((std::is_same_v<M, std::remove_cv_t<decltype(enumerators)>> && ...));
  std::size_t count = 1;
  for (const char c : words) count += c == '|' ? 1 : 0;
  if (count != sizeof...(enumerators)) throw "a choice needs a word for each enumerator";
  detail::require_words(name, help);
  KindKey<A> made{Key{.path = name, .type = KeyType::choice, .allowed = words, .help = help}};
  made.fill = [](A& arguments, const KeyValues& values, std::string_view key) {
    constexpr std::array<M, sizeof...(enumerators)> all = {enumerators...};
    if (values.has(key)) arguments.*at = all.at(values.choice(key));
  };
  return made;
}

// The name of a table such as [orbit.NAME].
template <auto at, class A = detail::Owner<at>>
consteval KindKey<A> name_key(std::string_view name, std::string_view help) {
  return KindKey<A>::template of<at>(KeyType::name, name, help);
}

// The path of a file, from the folder of the scenario.
template <auto at, class A = detail::Owner<at>>
consteval KindKey<A> file_key(std::string_view name, std::string_view help) {
  KindKey<A> made = KindKey<A>::template of<at>(KeyType::text, name, help);
  made.key.is_file = true;
  return made;
}

// A unit, and the columns of a file by their names or numbers.
template <auto at, class A = detail::Owner<at>>
consteval KindKey<A> unit_key(std::string_view name, std::string_view help) {
  return KindKey<A>::template of<at>(KeyType::unit, name, help);
}
template <auto at, class A = detail::Owner<at>>
consteval KindKey<A> columns_key(std::string_view name, std::string_view help) {
  return KindKey<A>::template of<at>(KeyType::columns, name, help);
}

// Keys that several kinds share, and those of one.
template <class A, std::size_t m, std::size_t n>
constexpr std::array<KindKey<A>, m + n> joined(const std::array<KindKey<A>, m>& shared,
                                               const std::array<KindKey<A>, n>& own) {
  std::array<KindKey<A>, m + n> all{};
  for (std::size_t i = 0; i < m; ++i) all[i] = shared[i];
  for (std::size_t i = 0; i < n; ++i) all[m + i] = own[i];
  return all;
}

// The keys alone, for the schema.
template <class A>
std::vector<Key> keys_of(std::span<const KindKey<A>> keys) {
  std::vector<Key> all;
  for (const KindKey<A>& one : keys) all.push_back(one.key);
  return all;
}

// What a table says.
template <class A>
A arguments(std::span<const KindKey<A>> keys, const KeyValues& values) {
  A made{};
  for (const KindKey<A>& one : keys) {
    detail::require_range(values, one.key.path, one.range);
    one.fill(made, values, one.key.path);
  }
  return made;
}

}  // namespace v0
}  // namespace polhode
