// SPDX-License-Identifier: MIT
#include "scenario/number_location.hpp"

#include <algorithm>
#include <charconv>

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// Keys of a map or an ensemble do not describe a cell or a member.
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
