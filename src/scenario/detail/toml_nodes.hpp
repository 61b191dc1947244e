// SPDX-License-Identifier: MIT
// What single nodes of a TOML document say. For toml_values.cpp alone, after toml.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/toml.hpp"
#include "scenario/values.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

inline Position position(const toml::source_region& region) {
  const Position start{region.begin.line, region.begin.column};
  return start.line == 0 ? Position{} : start;
}

// One of the words that "|" joins.
inline bool is_listed(std::string_view word, std::string_view joined) {
  const std::vector<std::string_view> words = separated(joined, '|');
  return std::find(words.begin(), words.end(), word) != words.end();
}

// toml++ itself refuses to make a double of a whole number beyond 2^53.
inline std::optional<double> real(const toml::node* node) {
  if (node == nullptr) return std::nullopt;
  if (const auto* whole = node->as_integer()) return static_cast<double>(whole->get());
  if (const auto* floating = node->as_floating_point()) return floating->get();
  return std::nullopt;
}

// { value = .., unit = ".." } has these two keys and no other; the unit, or nothing.
inline std::optional<std::string_view> own_unit(const toml::table& table) {
  if (table.size() != 2 || !table.contains("value")) return std::nullopt;
  return table["unit"].value<std::string_view>();
}

inline const toml::array* items(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return node.as_array();
  return own_unit(*table) ? (*table)["value"].as_array() : nullptr;
}

// None of what is no array, or one without elements.
inline const toml::array* nonempty(const toml::node& node) {
  const toml::array* const array = node.as_array();
  return array == nullptr || array->empty() ? nullptr : array;
}

inline std::string joined(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

// As messages quote it; an array up to some hundred characters.
inline std::string shown(const toml::node& node);

inline std::string shown_array(const toml::array& array) {
  constexpr std::size_t longest = 100;
  std::string text = "[";
  for (const toml::node& item : array) {
    if (text.size() > longest) return text + ", ...]";
    text += (text.size() > 1 ? ", " : "") + shown(item);
  }
  return text + "]";
}

inline std::string shown(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return '"' + printable(*node.value<std::string_view>()) + '"';
    case toml::node_type::integer:
      return std::to_string(*node.value<std::int64_t>());
    case toml::node_type::floating_point:
      return polhode::detail::number_text(*node.value<double>());
    case toml::node_type::boolean:
      return *node.value<bool>() ? "true" : "false";
    case toml::node_type::table:
      return own_unit(*node.as_table())
                 ? "{ value = " + shown(*node.as_table()->get("value")) +
                       ", unit = " + shown(*node.as_table()->get("unit")) + " }"
                 : "a table";
    case toml::node_type::array:
      return shown_array(*node.as_array());
    default:
      return "a date without quotes";
  }
}

// A date in quotes, or without them as TOML has it: "2013-01-05T00:00:00Z".
inline std::optional<std::string> date_text(const toml::node& node) {
  std::ostringstream out;
  if (const auto* const text = node.as_string()) {
    if (is_dated(text->get())) return text->get();
    return std::nullopt;
  }
  if (const auto* const date = node.as_date()) out << date->get();
  if (const auto* const time = node.as_date_time()) out << time->get();
  return out.str().empty() ? std::optional<std::string>() : out.str();
}

// A text; of a date with the scale that a Z says, and without quotes too.
inline std::optional<std::string> text_in(const toml::node& node, bool is_date) {
  const std::optional<std::string> date = is_date ? date_text(node) : std::nullopt;
  return date ? with_scale(*date) : node.value<std::string>();
}

// The keys of `sets` that the table has, each once.
inline std::vector<std::string_view> present_keys(const toml::table& table, std::string_view sets) {
  std::vector<std::string_view> present;
  for (const std::string_view set : separated(sets, '|'))
    for (const std::string_view name : separated(set, '+'))
      if (table.contains(name) && std::find(present.begin(), present.end(), name) == present.end())
        present.push_back(name);
  return present;
}

// The word of the key `kind` that a table has or takes, where that is one.
inline std::string_view kind_in(const toml::table& table, const std::vector<const Key*>& known) {
  for (const Key* key : known) {
    if (key_name(key->path) != "kind") continue;
    const std::vector<std::string_view> kinds = separated(key->allowed, '|');
    std::string_view word = key->fallback;
    if (word.size() > 2) word = word.substr(1, word.size() - 2);
    if (table.contains("kind")) word = table["kind"].value_or(std::string_view());
    return std::find(kinds.begin(), kinds.end(), word) == kinds.end() ? std::string_view() : word;
  }
  return {};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
