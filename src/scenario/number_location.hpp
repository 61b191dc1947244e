// SPDX-License-Identifier: MIT
// Where a number of a scenario is, by its keys.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct NumberLocation {
  std::string path;
  std::size_t index;
};
// Where "state.euler.theta" or "body.moments[1]" is; none where there is no such number.
std::optional<NumberLocation> number_location(const Values& values, std::string_view key);

// The same, and all numbers of an array by its name alone; empty where there is none.
std::vector<NumberLocation> number_locations(const Values& values, std::string_view key);

// The numbers of a file by their keys, of arrays the first, or that with the index in `key`: what
// is near to a key that is none.
std::vector<std::string> number_keys(const Values& values, std::string_view key);

// Whether a value is one number or an array of them.
bool is_number(const Value& value);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
