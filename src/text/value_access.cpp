// SPDX-License-Identifier: MIT
// The values of a file by path, and errors at their place.
#include "text/value_access.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr std::size_t longest_text = 600;

}  // namespace

std::string_view key_name(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot != std::string_view::npos) path.remove_prefix(dot + 1);
  if (path.ends_with("[]")) path.remove_suffix(2);
  return path;
}

std::string_view key_table(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

std::string Place::message(std::string_view expected) const {
  return key + ": " + detail::printable(got + std::string(expected), longest_text);
}
void Place::refuse(std::string_view expected) const { throw ScenarioError(message(expected)); }

namespace detail {

bool is_below(std::string_view path, std::string_view table) {
  if (!path.starts_with(table)) return false;
  return path.size() == table.size() || path[table.size()] == '.' || path[table.size()] == '[';
}

namespace {

// "FILE:LINE:COLUMN: KEY"
std::string shown_place(const std::string& name, Position where, const std::string& path) {
  std::string text = name;
  if (where != nowhere)
    text += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  return text + ": " + path;
}

}  // namespace

Diagnostics::Diagnostics(std::string_view name) : name_(printable(name, longest_path)) {}

void Diagnostics::add(Position where, std::string_view path, std::string_view text) {
  entries_.push_back({where, printable(path, longest_path), printable(text, longest_text)});
}

void Diagnostics::leave_out_places(std::string_view table) {
  for (Entry& one : entries_)
    if (is_below(one.path, table)) one.where = nowhere;
}

std::string Diagnostics::text() const {
  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Entry& a, const Entry& b) { return a.where < b.where; });
  std::string lines;
  for (const auto& [where, path, text] : sorted)
    lines += (lines.empty() ? "" : "\n") + shown_place(name_, where, path) + ": " + text;
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

// Of a value that is not there. Those of a program stand in no file.
Position elsewhere(const Values& values) {
  const bool is_in_file = values.empty() || values.begin()->second.where.line != 0;
  return is_in_file ? Position{} : values.begin()->second.where;
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

Place place_of(const Values& values, std::string_view path, const std::string& name) {
  const Value* const value = placed(values, path);
  std::string got = "got nothing; ";
  if (has(values, path))
    got = value->key->type == KeyType::table ? "" : "got " + value->shown + "; ";
  return {shown_place(printable(name, longest_path),
                      value == nullptr ? elsewhere(values) : value->where,
                      printable(path, longest_path)),
          std::move(got)};
}

std::string message_at(const Values& values, std::string_view path, const std::string& name,
                       std::string_view message) {
  return place_of(values, blamed(values, path, message), name).message(message);
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

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
