// SPDX-License-Identifier: MIT
// OptionKey: one key of [output.NAME] as an output format describes it, and the values that the
// format makes its struct of options from:
//
//     constexpr OptionKey keys[] = {
//         integer_option("digits", "6|9|17", "Digits of each number.").otherwise("17"),
//         quantity_option("offset", Dimension::time, "Added to every t.").otherwise("0"),
//     };
//
// Units       a quantity has a dimension, and its value is in core units (polhode/text/units.hpp).
// Domain      names of letters, digits, - and _. What is asked for of the values is there: the
//             reader has seen to defaults; ask has() of keys that have none.
// Errors      a key without a name, a dimension or a text does not compile. OptionError is for what
//             the type of a key lets pass.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/text/key.hpp"

namespace polhode {
inline namespace v0 {

class OptionKey {
 public:
  // What a key that is left out stands for, as TOML.
  consteval OptionKey otherwise(std::string_view toml) const {
    OptionKey made = *this;
    made.key_.fallback = toml;
    if (made.key_.example.empty()) made.key_.example = toml;
    return made;
  }
  // What documents show, as TOML.
  consteval OptionKey example(std::string_view toml) const {
    OptionKey made = *this;
    made.key_.example = toml;
    return made;
  }

  // Its path is the name alone.
  constexpr const Key& key() const { return key_; }

  // See the functions below.
  static consteval OptionKey made(KeyType type, std::string_view name, std::string_view help,
                                  std::string_view allowed, Dimension dimension) {
    if (name.empty() || help.empty()) throw "a key has a name, and a text that says what it is";
    if (type == KeyType::choice && allowed.empty()) throw "a choice has words";
    return OptionKey(
        {.path = name, .type = type, .dimension = dimension, .allowed = allowed, .help = help});
  }

 private:
  explicit constexpr OptionKey(const Key& key) : key_(key) {}

  Key key_;
};

consteval OptionKey text_option(std::string_view name, std::string_view help) {
  return OptionKey::made(KeyType::text, name, help, {}, Dimension::number);
}
consteval OptionKey flag_option(std::string_view name, std::string_view help) {
  return OptionKey::made(KeyType::boolean, name, help, {}, Dimension::number);
}
// One of the integers "1|2"; any where the list is empty.
consteval OptionKey integer_option(std::string_view name, std::string_view allowed,
                                   std::string_view help) {
  return OptionKey::made(KeyType::integer, name, help, allowed, Dimension::number);
}
// One of the words "first|last".
consteval OptionKey choice_option(std::string_view name, std::string_view words,
                                  std::string_view help) {
  return OptionKey::made(KeyType::choice, name, help, words, Dimension::number);
}
// A number; Dimension::number where it has no unit.
consteval OptionKey quantity_option(std::string_view name, Dimension dimension,
                                    std::string_view help) {
  return OptionKey::made(KeyType::number, name, help, {}, dimension);
}

// What one key holds.
struct OptionValue {
  std::string word = {};  // a text or a choice
  double number = 0.0;
  std::int64_t whole = 0;  // an integer; 1 for true
};

class OptionValues {
 public:
  OptionValues() = default;
  explicit OptionValues(std::map<std::string, OptionValue, std::less<>> by_name)
      : by_name_(std::move(by_name)) {}

  // Whether the scenario or a default has it.
  bool has(std::string_view name) const { return by_name_.contains(name); }
  const std::string& word(std::string_view name) const { return at(name).word; }
  double number(std::string_view name) const { return at(name).number; }
  std::int64_t whole(std::string_view name) const { return at(name).whole; }
  bool flag(std::string_view name) const { return at(name).whole != 0; }

 private:
  const OptionValue& at(std::string_view name) const;

  std::map<std::string, OptionValue, std::less<>> by_name_;
};

// A value that the format refuses: "expected ...", at the place of the key.
class OptionError : public DomainError {
 public:
  OptionError(std::string_view name, const std::string& expected)
      : DomainError(expected), key(name) {}
  std::string key;
};

}  // namespace v0
}  // namespace polhode
