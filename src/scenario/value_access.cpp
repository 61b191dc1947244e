// SPDX-License-Identifier: MIT
// The values of a scenario by path, the places of its numbers, and errors at their place.
#include "scenario/value_access.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "polhode/scenario/scenario.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/values.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

constexpr std::size_t longest_text = 600;

}  // namespace

Diagnostics::Diagnostics(std::string_view name) : name_(printable(name, longest_path)) {}

void Diagnostics::add(Position where, std::string_view path, std::string_view text) {
  entries_.push_back(
      {where, name_ + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": " +
                  printable(path, longest_path) + ": " + printable(text, longest_text)});
}

std::string Diagnostics::text() const {
  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Entry& a, const Entry& b) { return a.where < b.where; });
  std::string lines;
  for (const Entry& entry : sorted) lines += (lines.empty() ? "" : "\n") + entry.line;
  return lines;
}

void Diagnostics::raise() const {
  if (!entries_.empty()) throw ScenarioError(text());
}

namespace {

// The key of a table that a message of the library names first: "L = 1.5 must be ...", or the
// table.
std::string blamed(const Values& values, std::string_view path, std::string_view message) {
  std::string place(path);
  if (!has(values, path) || value_at(values, path).key->type != KeyType::table) return place;
  if (message.find("P_psi/P_phi") != std::string_view::npos) return place + ".rotation_period";
  std::size_t first = message.size();
  for (const auto& [own, value] : values) {
    const std::size_t found = message.find(" " + std::string(key_name(own)) + " = ");
    if (key_table(own) != path || found >= first) continue;
    first = found;
    place = own;
  }
  return place;
}

// The value that has the place of a key: its own, or that of the table which lacks it.
const Value* placed(const Values& values, std::string_view path) {
  for (; !path.empty(); path = path.substr(0, path.rfind('.'))) {
    if (has(values, path)) return &value_at(values, path);
    if (path.find('.') == std::string_view::npos) break;
  }
  return nullptr;
}

// "a length", "a number".
std::string quantity(Dimension dimension) {
  return dimension == Dimension::number ? "a number" : std::string(dimension_name(dimension));
}

}  // namespace

std::vector<std::string> array_paths(const Values& values, const std::string& array) {
  std::vector<std::string> paths;
  for (;;) {
    const std::string path = array + "[" + std::to_string(paths.size()) + "]";
    const auto first = values.lower_bound(path + ".");
    if (first == values.end() || !first->first.starts_with(path + ".")) return paths;
    paths.push_back(path);
  }
}

const Value& value_at(const Values& values, std::string_view path) {
  const auto found = values.find(path);
  if (found == values.end()) throw std::logic_error("no value of " + std::string(path));
  return found->second;
}
const std::string& word(const Values& values, std::string_view path) {
  return value_at(values, path).words.at(0);
}
bool is_explicit(const Values& values, std::string_view path) {
  const auto found = values.find(path);
  return found != values.end() && found->second.is_explicit;
}
bool has(const Values& values, std::string_view path) { return values.contains(path); }

bool is_unused(const Values& values, const Value& value, std::string_view path) {
  constexpr std::string_view is = " = ";
  const std::string_view line = value.key->unused_with;
  const std::size_t end = line.find(is);
  if (end == std::string_view::npos) return false;
  const auto other =
      values.find(std::string(key_table(path)) + "." + std::string(line.substr(0, end)));
  return other != values.end() && other->second.shown == line.substr(end + is.size());
}

std::string message_at(const Values& values, std::string_view path, const std::string& name,
                       std::string_view message) {
  const std::string place = blamed(values, path, message);
  const bool is_there = has(values, place);
  const Value* value = placed(values, place);
  std::string got = "got nothing; ";
  if (is_there) got = value->key->type == KeyType::table ? "" : "got " + value->shown + "; ";
  Diagnostics diagnostics(name);
  diagnostics.add(value == nullptr ? Position{} : value->where, place, got + std::string(message));
  return diagnostics.text();
}

void refuse(const Values& values, std::string_view path, const std::string& name,
            std::string_view message) {
  throw ScenarioError(message_at(values, path, name, message));
}

void require_range(const Values& values, std::string_view path, const std::string& name) {
  const Value& value = value_at(values, path);
  const Range range = value.key->range;
  const std::string what = quantity(value.key->dimension);
  for (const double x : value.numbers) {
    if (range == Range::positive && !(x > 0.0))
      refuse(values, path, name, "expected a positive" + what.substr(what.find(' ')));
    if (range == Range::not_negative && !(x >= 0.0))
      refuse(values, path, name, "expected " + what + " that is not negative");
  }
}

namespace {

// Those of what wraps an experiment describe no member or cell of it.
bool wraps(std::string_view path) {
  return path.starts_with("map.") || path.starts_with("ensemble.");
}

}  // namespace

bool is_number(const Value& value) {
  const KeyType type = value.key->type;
  return type == KeyType::number || type == KeyType::numbers || type == KeyType::matrix ||
         type == KeyType::linear_map;
}

std::optional<NumberLocation> number_location(const Values& values, std::string_view key) {
  NumberLocation place{std::string(key), 0};
  const std::size_t bracket = key.rfind('[');
  const bool indexed = key.ends_with("]") && bracket != std::string_view::npos;
  if (indexed) {
    place.path = std::string(key.substr(0, bracket));
    const std::string_view digits = key.substr(bracket + 1, key.size() - bracket - 2);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), place.index);
    if (read.ec != std::errc() || read.ptr != digits.data() + digits.size()) return std::nullopt;
  }
  const auto found = values.find(place.path);
  if (found == values.end() || !is_number(found->second) || wraps(place.path) ||
      indexed == (found->second.key->type == KeyType::number) ||
      place.index >= found->second.numbers.size())
    return std::nullopt;
  return place;
}

std::vector<NumberLocation> number_locations(const Values& values, std::string_view key) {
  if (const std::optional<NumberLocation> one = number_location(values, key)) return {*one};
  const auto found = values.find(std::string(key));
  if (found == values.end() || !is_number(found->second) || wraps(key)) return {};
  std::vector<NumberLocation> all;
  for (std::size_t i = 0; i < found->second.numbers.size(); ++i)
    all.push_back({std::string(key), i});
  return all;
}

std::string unit_in_file(const Value& value, std::size_t index, const Units& units) {
  const std::string& own = value.units[index];
  return own.empty() ? units.label(value.key->dimension) : own;
}
double number_in_file(const Value& value, std::size_t index, const Units& units) {
  const double core = value.numbers[index];
  return value.units[index].empty() ? units.from_core(core, value.key->dimension)
                                    : core / to_core(value, index, 1.0, units);
}
double to_core(const Value& value, std::size_t index, double in_file, const Units& units) {
  const std::string& own = value.units[index];
  return own.empty() ? units.to_core(in_file, value.key->dimension)
                     : units.to_core(in_file, own, value.key->dimension);
}

std::vector<std::string> number_keys(const Values& values, std::string_view key) {
  std::string index = "[0]";
  if (key.ends_with("]")) index = key.substr(std::min(key.rfind('['), key.size()));
  std::vector<std::string> paths;
  for (const auto& [path, value] : values) {
    if (!is_number(value) || wraps(path)) continue;
    const std::string one = value.key->type == KeyType::number ? path : path + index;
    paths.push_back(number_location(values, one) ? one : path + "[0]");
  }
  return paths;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
