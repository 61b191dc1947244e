// SPDX-License-Identifier: MIT
#include "scenario/number_location.hpp"

#include <charconv>

namespace polhode {
inline namespace v0 {
namespace detail {

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
  if (found == values.end() || !is_number(found->second) || place.path.starts_with("map.") ||
      indexed == (found->second.key->type == KeyType::number) ||
      place.index >= found->second.numbers.size())
    return std::nullopt;
  return place;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
