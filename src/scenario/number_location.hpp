// SPDX-License-Identifier: MIT
// Where a number of a scenario is, by its keys.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

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

// Whether a value is one number or an array of them.
bool is_number(const Value& value);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
