// SPDX-License-Identifier: MIT
#include "scenario/value_access.hpp"

#include <stdexcept>

#include "polhode/scenario/schema.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
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

const Value& value_at(const Values& values, std::string_view path) {
  const auto found = values.find(path);
  if (found == values.end()) throw std::logic_error("no value of " + std::string(path));
  return found->second;
}
double number(const Values& values, std::string_view path) {
  return value_at(values, path).numbers.at(0);
}
Vec3 vector(const Values& values, std::string_view path) {
  const std::vector<double>& n = value_at(values, path).numbers;
  return {n.at(0), n.at(1), n.at(2)};
}
const std::string& word(const Values& values, std::string_view path) {
  return value_at(values, path).words.at(0);
}
int sign(const Values& values, std::string_view path) {
  return static_cast<int>(value_at(values, path).whole);
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
