// SPDX-License-Identifier: MIT
// The table of keys as a reference page and as a scenario to start from.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "io/detail/nearest.hpp"
#include "polhode/error.hpp"
#include "polhode/io/schema.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::string_view state_table = "state";

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
    case KeyType::text:
      return "text";
    case KeyType::unit:
      return "unit";
    case KeyType::choice:
      return "";
    case KeyType::choices:
      return "array of ";
    case KeyType::epoch:
      return "date and scale";
  }
  return {};
}

std::string value_cell(const Key& key) {
  std::string cell = value_in_words(key);
  const bool quoted = key.type == KeyType::choice || key.type == KeyType::choices;
  bool first = true;
  for (const std::string_view word : separated(key.allowed, '|')) {
    if (!first) cell += ", ";
    first = false;
    cell += quoted ? "`\"" + std::string(word) + "\"`" : "`" + std::string(word) + "`";
  }
  return cell;
}

std::string default_cell(const Schema& schema, const Key& key) {
  if (key.presence == Presence::required) return "required";
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

std::string heading(const Key* table) {
  if (table == nullptr) return "## Top of the file\n\n";
  std::string path;
  for (const char c : table->path)
    if (c != '[' && c != ']') path += c;
  const bool array = table->path.ends_with("[]");
  return "## `" + std::string(array ? "[[" : "[") + path + (array ? "]]" : "]") + "`\n\n" +
         std::string(table->help) + "\n\n";
}

void append_section(std::string& page, const Schema& schema, const Key* table) {
  const std::string_view path = table == nullptr ? std::string_view() : table->path;
  page += heading(table);
  for (const Alternatives& row : schema.alternatives)
    if (row.table == path) page += "Exactly one of: " + set_in_words(row.sets) + ".\n\n";
  page += "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const Key* key : keys_of(schema, path))
    page += "| `" + std::string(key_name(key->path)) + "` | " + value_cell(*key) + " | " +
            default_cell(schema, *key) + " | " + std::string(key->help) + " |\n";
  page += "\n";
}

void append_comment(std::string& page, std::string_view text) {
  constexpr std::size_t width = 96;
  while (text.size() > width) {
    const std::size_t end = text.rfind(' ', width);
    if (end == std::string_view::npos) break;
    page += "# " + std::string(text.substr(0, end)) + "\n";
    text.remove_prefix(end + 1);
  }
  page += "# " + std::string(text) + "\n";
}

// The keys of the first set of each row of alternatives stand; the others are shown as comments,
// and so is the epoch: a date that is not the user's own must not slip into their files.
bool stands(const Schema& schema, const Key& key) {
  if (key.type == KeyType::epoch) return false;
  if (key.presence != Presence::alternative) return true;
  const std::string_view name = key_name(key.path);
  for (const Alternatives& row : schema.alternatives) {
    if (row.table != key_table(key.path)) continue;
    const std::vector<std::string_view> names = separated(separated(row.sets, '|').front(), '+');
    if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  }
  return false;
}

// A table below [state.CHART] is written in one line: pole = { longitude = 250, latitude = -75 }
std::string example_value(const Schema& schema, const Key& key) {
  if (key.type != KeyType::table) return std::string(key.example);
  std::string inline_table;
  for (const Key* part : keys_of(schema, key.path))
    if (stands(schema, *part))
      inline_table += (inline_table.empty() ? "{ " : ", ") + std::string(key_name(part->path)) +
                      " = " + example_value(schema, *part);
  return inline_table + " }";
}

bool is_section(const Key& key) {
  const bool chart = key_table(key.path) == state_table;
  return key.type == KeyType::table && (key_table(key.path).empty() || chart);
}

void append_example(std::string& page, const Schema& schema, const Key* table) {
  const std::string_view path = table == nullptr ? std::string_view() : table->path;
  if (table != nullptr) {
    page += "\n";
    append_comment(page, table->help);
    page += "[" + std::string(path) + "]\n";
  }
  for (const Key* key : keys_of(schema, path)) {
    if (is_section(*key)) continue;
    append_comment(page, key->help);
    page += (stands(schema, *key) ? "" : "# ") + std::string(key_name(key->path)) + " = " +
            example_value(schema, *key) + "\n";
  }
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

std::vector<std::string_view> state_charts() {
  std::vector<std::string_view> charts;
  for (const Key* key : keys_of(scenario_schema(), state_table))
    if (key->type == KeyType::table) charts.push_back(key_name(key->path));
  return charts;
}

std::string scenario_template(std::string_view chart) {
  const Schema& schema = scenario_schema();
  const std::vector<std::string_view> charts = state_charts();
  if (std::find(charts.begin(), charts.end(), chart) == charts.end()) {
    std::string message = "chart: got \"" + std::string(chart) + "\"; expected ";
    for (std::size_t i = 0; i < charts.size(); ++i)
      message += (i == 0 ? "" : i + 1 == charts.size() ? " or " : ", ") + std::string(charts[i]);
    const std::string_view near = detail::nearest(chart, charts);
    throw DomainError(message + (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
  }
  std::string page = "# A scenario for polhode. Every key: docs/reference/scenario.md\n";
  append_example(page, schema, nullptr);
  for (const Key& key : schema.keys) {
    if (!is_section(key)) continue;
    const bool other = key_table(key.path) == state_table && key_name(key.path) != chart;
    if (!other) append_example(page, schema, &key);
  }
  return page;
}

}  // namespace v0
}  // namespace polhode
