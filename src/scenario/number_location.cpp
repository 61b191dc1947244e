// SPDX-License-Identifier: MIT
#include "scenario/number_location.hpp"

#include <algorithm>
#include <charconv>

namespace polhode {
inline namespace v0 {
namespace io {
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

namespace {

constexpr std::size_t rows = 3;  // of a matrix

}  // namespace

// A list of nine numbers is not a matrix.
bool is_matrix(const Value& value) {
  const KeyType type = value.key->type;
  return value.numbers.size() == rows * rows &&
         (type == KeyType::matrix || type == KeyType::linear_map);
}

namespace {

// Takes the last "[1]" off the end of a key.
std::optional<std::size_t> last_index(std::string_view& key) {
  const std::size_t bracket = key.rfind('[');
  if (!key.ends_with("]") || bracket == std::string_view::npos) return std::nullopt;
  const std::string_view digits = key.substr(bracket + 1, key.size() - bracket - 2);
  std::size_t index = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (read.ec != std::errc() || read.ptr != digits.data() + digits.size()) return std::nullopt;
  key.remove_suffix(key.size() - bracket);
  return index;
}

// An inertia tensor is symmetric: an element off the diagonal is there twice.
NumberLocation located(const std::string& path, const Value& value, std::size_t index) {
  if (value.key->type != KeyType::matrix) return {path, index, index};
  const std::size_t mirror = index % rows * rows + index / rows;
  return {path, std::min(index, mirror), std::max(index, mirror)};
}

}  // namespace

std::optional<NumberLocation> number_location(const Values& values, std::string_view key) {
  std::string_view path = key;
  const std::optional<std::size_t> last = last_index(path);
  std::optional<std::size_t> row;
  auto found = values.find(std::string(path));
  if (found == values.end() && last) {  // "body.tensor[0][1]"
    row = last_index(path);
    found = values.find(std::string(path));
  }
  if (found == values.end() || !is_number(found->second) || wraps(path) ||
      last.has_value() == (found->second.key->type == KeyType::number) ||
      (row && (!is_matrix(found->second) || *row >= rows || *last >= rows)))
    return std::nullopt;
  const std::size_t index = row ? *row * rows + *last : last.value_or(0);
  if (index >= found->second.numbers.size()) return std::nullopt;
  return located(found->first, found->second, index);
}

std::string key_text(const Values& values, const NumberLocation& place) {
  const Value& value = values.find(place.path)->second;
  if (value.key->type == KeyType::number) return place.path;
  if (!is_matrix(value)) return place.path + "[" + std::to_string(place.index) + "]";
  return place.path + "[" + std::to_string(place.index / rows) + "][" +
         std::to_string(place.index % rows) + "]";
}

std::vector<NumberLocation> number_locations(const Values& values, std::string_view key) {
  if (const std::optional<NumberLocation> one = number_location(values, key)) return {*one};
  const auto found = values.find(std::string(key));
  if (found == values.end() || !is_number(found->second) || wraps(key)) return {};
  std::vector<NumberLocation> all;
  for (std::size_t i = 0; i < found->second.numbers.size(); ++i)
    if (const NumberLocation place = located(found->first, found->second, i); place.index == i)
      all.push_back(place);
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
}  // namespace io
}  // namespace v0
}  // namespace polhode
