// SPDX-License-Identifier: MIT
// The table of keys as a reference page.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "polhode/scenario/schema.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

std::string value_in_words(const Key& key) {
  const std::string what(dimension_name(key.dimension));
  const std::string each = key.dimension == Dimension::number ? "number" : what.substr(2);
  switch (key.type) {
    case KeyType::table:
      return "table";
    case KeyType::integer:
      return key.allowed.empty() ? "whole number" : "";
    case KeyType::number:
      return each == "number" ? each : what.substr(what.find(' ') + 1);
    case KeyType::numbers:
      return (key.length > 0 ? std::to_string(key.length) + " x " : "array of ") +
             what.substr(what.find(' ') + 1);
    case KeyType::matrix:
      return "3 x 3 x " + what.substr(what.find(' ') + 1);
    case KeyType::linear_map:
      return "3 x " + what.substr(what.find(' ') + 1) + ", or 3 x 3";
    case KeyType::square:
      return "n x n numbers";
    case KeyType::key_list:
      return "array of keys";
    case KeyType::boolean:
      return "`true`, `false`";
    case KeyType::text:
      return "text";
    case KeyType::name:
      return "name";
    case KeyType::unit:
      return "unit";
    case KeyType::choice:
      return "";
    case KeyType::choices:
      return "array of ";
    case KeyType::columns:
      return "array of names or numbers of columns";
    case KeyType::units:
      return "array of units";
    case KeyType::epoch:
      return "date and scale";
  }
  return {};
}

std::string value_cell(const Key& key) {
  std::string cell = value_in_words(key);
  const bool word = key.type == KeyType::number && !key.allowed.empty();
  const bool quoted = word || key.type == KeyType::choice || key.type == KeyType::choices;
  if (key.takes_date) cell += key.type == KeyType::numbers ? " or date" : ", or a date";
  if (key.range == Range::positive) cell += ", positive";
  if (key.range == Range::not_negative) cell += ", not negative";
  if (word) cell += ", or ";
  bool first = true;
  for (const std::string_view one : separated(key.allowed, '|')) {
    if (!first) cell += ", ";
    first = false;
    cell += quoted ? "`\"" + std::string(one) + "\"`" : "`" + std::string(one) + "`";
  }
  return cell;
}

std::string default_cell(const Schema& schema, const Key& key) {
  if (key.presence == Presence::required) return "required";
  if (!key.needed_by.empty())
    return "required with " + detail::one_of(separated(key.needed_by, '|'), "`");
  if (key.presence == Presence::optional)
    return key.fallback.empty() || key.fallback == "{}" ? ""
                                                        : "`" + std::string(key.fallback) + "`";
  for (const Alternatives& row : schema.alternatives) {
    if (row.table != key_table(key.path)) continue;
    for (const std::string_view set : separated(row.sets, '|')) {
      const std::vector<std::string_view> names = separated(set, '+');
      if (std::find(names.begin(), names.end(), key_name(key.path)) != names.end()) return "one of";
    }
  }
  return "";
}

std::string set_in_words(std::string_view sets) {
  std::string words;
  const std::vector<std::string_view> list = separated(sets, '|');
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) words += i + 1 == list.size() ? " or " : ", ";
    const std::vector<std::string_view> names = separated(list[i], '+');
    for (std::size_t j = 0; j < names.size(); ++j)
      words += (j > 0 ? " with `" : "`") + std::string(names[j]) + "`";
  }
  return words;
}

// "With kind `a` or `b`: ".
std::string kinds_in_words(const Key& key) {
  if (key.kinds.empty()) return "";
  return "With kind " + detail::one_of(separated(key.kinds, '|'), "`") + ": ";
}

std::string heading(const Key* table) {
  if (table == nullptr) return "## Top of the file\n\n";
  std::string path;
  for (const char c : table->path)
    if (c != '[' && c != ']') path += c;
  const bool array = table->path.ends_with("[]");
  return "## `" + std::string(array ? "[[" : "[") + path + (array ? "]]" : "]") + "`\n\n" +
         std::string(table->help) + "\n\n";
}

// What each kind of the table is.
void append_kinds(std::string& page, const Schema& schema, std::string_view table) {
  bool any = false;
  for (const KindText& one : schema.kinds) {
    if (one.table != table) continue;
    page += "- `\"" + std::string(one.kind) + "\"`: " + std::string(one.text) + "\n";
    any = true;
  }
  if (any) page += "\n";
}

void append_section(std::string& page, const Schema& schema, const Key* table) {
  const std::string_view path = table == nullptr ? std::string_view() : table->path;
  page += heading(table);
  for (const Alternatives& row : schema.alternatives)
    if (row.table == path)
      page += (row.kinds.empty()
                   ? "Exactly"
                   : "With kind " + detail::one_of(separated(row.kinds, '|'), "`") + " exactly") +
              std::string(" one of: ") + set_in_words(row.sets) + ".\n\n";
  append_kinds(page, schema, path);
  page += "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const Key* key : keys_of(schema, path))
    page += "| `" + std::string(key_name(key->path)) + "` | " + value_cell(*key) + " | " +
            default_cell(schema, *key) + " | " + kinds_in_words(*key) + std::string(key->help) +
            (key->unused_with.empty() ? ""
                                      : " Left out with `" + std::string(key->unused_with) + "`.") +
            " |\n";
  page += "\n";
}

}  // namespace

std::string markdown_reference(const Schema& schema) {
  std::string page;
  append_section(page, schema, nullptr);
  for (const Key& key : schema.keys)
    if (key.type == KeyType::table) append_section(page, schema, &key);
  return page;
}

std::string markdown_units() {
  std::string page = "| unit | what it is | in others |\n|---|---|---|\n";
  for (const KnownUnit& unit : known_units()) {
    const std::string base = unit.base.empty() ? "" : "`" + std::string(unit.base) + "`";
    std::string factor = unit.factor == 1.0 ? "" : fmt::format("{:.12g} ", unit.factor);
    if (unit.base == "rad")
      factor =
          unit.factor > 1.0 ? "2 pi " : fmt::format("pi/{:.0f} ", std::numbers::pi / unit.factor);
    page += "| `" + std::string(unit.symbol) + "` | " + std::string(unit.name) + " | " + factor +
            base + " |\n";
  }
  return page;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
