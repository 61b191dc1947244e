// SPDX-License-Identifier: MIT
// How the members of arguments are written in a file, and read from its values.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "polhode/math/vector.hpp"
#include "polhode/text/key.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/separated.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

template <class A>
class KindKey;

// A matrix, or three numbers, its diagonal.
struct LinearMap {
  Mat3 matrix;
  bool is_diagonal;
};

// A square matrix of any size.
struct SquareMatrix {
  std::vector<double> elements;  // row by row
  std::size_t size = 0;
};

// A number, or the word "auto".
struct NumberOrAuto {
  double number = 0.0;
  bool is_auto = false;
};

namespace detail {

template <class A, class M>
A owner(M A::*);
template <class A, class M>
M member(M A::*);
template <auto at>
using Owner = decltype(owner(at));
template <auto at>
using Member = decltype(member(at));

template <class M>
struct Plain {
  using type = M;
  static constexpr bool is_optional = false;
};
template <class M>
struct Plain<std::optional<M>> {
  using type = M;
  static constexpr bool is_optional = true;
};

// How a member is written in a file, read from its value, and told as one.
template <class M>
struct KeyForm;
template <>
struct KeyForm<double> {
  static constexpr KeyType type = KeyType::number;
  static constexpr int length = 0;
  static double read(const KeyValues& at, std::string_view key) { return at.number(key); }
  static void tell(double x, KeyValue& value) { value.numbers = {x}; }
};
template <>
struct KeyForm<Vec3> {
  static constexpr KeyType type = KeyType::numbers;
  static constexpr int length = 3;
  static Vec3 read(const KeyValues& at, std::string_view key) { return at.vector(key); }
  static void tell(const Vec3& x, KeyValue& value) { value.numbers = {x.x, x.y, x.z}; }
};
template <std::size_t count>
struct KeyForm<std::array<double, count>> {
  static constexpr KeyType type = KeyType::numbers;
  static constexpr int length = static_cast<int>(count);
  static std::array<double, count> read(const KeyValues& at, std::string_view key) {
    std::array<double, count> all{};
    for (std::size_t i = 0; i < count; ++i) all[i] = at.numbers(key).at(i);
    return all;
  }
  static void tell(const std::array<double, count>& x, KeyValue& value) {
    value.numbers.assign(x.begin(), x.end());
  }
};
template <>
struct KeyForm<std::vector<double>> {
  static constexpr KeyType type = KeyType::numbers;
  static constexpr int length = 0;
  static std::vector<double> read(const KeyValues& at, std::string_view key) {
    return at.numbers(key);
  }
  static void tell(const std::vector<double>& x, KeyValue& value) { value.numbers = x; }
};
template <>
struct KeyForm<LinearMap> {
  static constexpr KeyType type = KeyType::linear_map;
  static constexpr int length = 0;
  static LinearMap read(const KeyValues& at, std::string_view key);
  static void tell(const LinearMap& x, KeyValue& value);
};
template <>
struct KeyForm<Mat3> {
  static constexpr KeyType type = KeyType::matrix;
  static constexpr int length = 0;
  static Mat3 read(const KeyValues& at, std::string_view key);
  static void tell(const Mat3& x, KeyValue& value);
};
template <>
struct KeyForm<SquareMatrix> {
  static constexpr KeyType type = KeyType::square;
  static constexpr int length = 0;
  static SquareMatrix read(const KeyValues& at, std::string_view key);
  static void tell(const SquareMatrix& x, KeyValue& value) { value.numbers = x.elements; }
};
template <>
struct KeyForm<NumberOrAuto> {
  static constexpr KeyType type = KeyType::number;
  static constexpr int length = 0;
  static constexpr std::string_view words = "auto";
  static NumberOrAuto read(const KeyValues& at, std::string_view key) {
    return {at.number(key), !at.words(key).empty()};
  }
  static void tell(const NumberOrAuto& x, KeyValue& value) {
    value.numbers = {x.number};
    if (x.is_auto) value.words = {std::string(words)};
  }
};
template <std::integral Whole>
struct KeyForm<Whole> {
  static Whole read(const KeyValues& at, std::string_view key) {
    return static_cast<Whole>(at.integer(key));
  }
  static void tell(Whole x, KeyValue& value) { value.whole = static_cast<std::int64_t>(x); }
};
template <>
struct KeyForm<bool> {
  static bool read(const KeyValues& at, std::string_view key) { return at.flag(key); }
  static void tell(bool x, KeyValue& value) { value.whole = x ? 1 : 0; }
};
template <>
struct KeyForm<std::string> {
  static std::string read(const KeyValues& at, std::string_view key) { return at.word(key); }
  static void tell(const std::string& x, KeyValue& value) { value.words = {x}; }
};
template <>
struct KeyForm<std::vector<std::string>> {
  static std::vector<std::string> read(const KeyValues& at, std::string_view key) {
    return at.words(key);
  }
  static void tell(const std::vector<std::string>& x, KeyValue& value) { value.words = x; }
};

template <auto at>
using KeyFormOf = KeyForm<typename Plain<Member<at>>::type>;

template <auto at, class A>
void fill_member(A& arguments, const KeyValues& values, std::string_view key) {
  if (values.has(key)) arguments.*at = KeyFormOf<at>::read(values, key);
}

// Gives a value to `tell`, unless the member may be left out and is.
template <auto at, class A, class Tell>
bool tell_member(const A& arguments, const Tell& tell) {
  if constexpr (Plain<Member<at>>::is_optional) {
    if (!(arguments.*at)) return false;
    tell(*(arguments.*at));
  } else {
    tell(arguments.*at);
  }
  return true;
}
template <auto at, class A>
bool tell_value(const A& arguments, KeyValue& value, std::string_view /*words*/) {
  return tell_member<at>(arguments, [&](const auto& x) { KeyFormOf<at>::tell(x, value); });
}

// What a key can be made for: a member that holds a value of this type, or may; numbers; each of
// these enumerators; and arguments that have the member.
template <auto at, class T>
concept Holds = std::same_as<typename Plain<Member<at>>::type, T>;
template <auto at>
concept HasNumbers = requires { KeyFormOf<at>::length; };
template <auto at>
concept HasInteger = std::integral<typename Plain<Member<at>>::type> && !Holds<at, bool>;
template <auto at, auto... enumerators>
concept HoldsEach = sizeof...(enumerators) > 0 &&
                    (std::is_enum_v<typename Plain<Member<at>>::type> ||
                     Holds<at, bool>)&&(Holds<at, std::remove_cv_t<decltype(enumerators)>>&&...);
template <class A, auto at>
concept HasMember = std::derived_from<A, Owner<at>>;

// A member that holds any number of these enumerators.
template <auto at, auto... enumerators>
concept HoldsEachOfList = sizeof...(enumerators) > 0 &&
                          (std::same_as<Member<at>, std::vector<decltype(enumerators)>> && ...);

// The address identifies the member.
template <auto at>
inline constexpr char member_id = 0;

// Words accepted instead of a number.
template <class Form>
consteval std::string_view special_words() {
  if constexpr (requires { Form::words; }) return Form::words;
  return {};
}

// Fails to compile: a name and a sentence are what makes a key.
consteval void require_words(std::string_view name, std::string_view help) {
  if (name.empty()) throw "a key needs a name";
  if (help.empty() || !help.ends_with('.')) throw "a key needs a sentence that says what it is";
}

// So does a choice that has not a word for each of `count` enumerators, or has an empty one.
consteval void require_choice(std::string_view words, std::size_t count) {
  std::size_t ends = 1;
  for (const char c : words) ends += c == '|' ? 1 : 0;
  if (ends != count) throw "a choice needs a word for each enumerator";
  if (words.empty() || words.front() == '|' || words.back() == '|' ||
      words.find("||") != std::string_view::npos)
    throw "a choice has no empty words";
}

// The word "step" of "step|linear|cubic" for the first of these enumerators.
template <auto... enumerators, class E>
std::string word_of(E x, std::string_view words) {
  constexpr std::array all = {enumerators...};
  const auto place = std::find(all.begin(), all.end(), x) - all.begin();
  return std::string(separated(words, '|').at(static_cast<std::size_t>(place)));
}

// Nothing else makes one.
struct KeyMaker {
  template <auto at, class A>
  static consteval KindKey<A> key(const Key& key) {
    return KeyMaker::key<at, A>(key, fill_member<at, A>, tell_value<at, A>);
  }
  template <auto at, class A>
  static consteval KindKey<A> key(const Key& key, typename KindKey<A>::Fill fill,
                                  typename KindKey<A>::Tell tell) {
    require_words(key.path, key.help);
    return {key, fill, tell, &member_id<at>};
  }
};

// Throws a ScenarioError at the place of a number outside, and of a key that is left out with
// another.
void require_allowed(const KeyValues& at, const Key& key);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
