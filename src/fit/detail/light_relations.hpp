// SPDX-License-Identifier: MIT
// Which of many states of a search are one, and what the others are beside it.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/light_geometry.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Near enough that fits from both would most likely meet.
bool are_alike(const BrightEllipsoid& a, const BrightEllipsoid& b);
// Within the errors of the first.
bool are_same(const LightSolution& a, const LightSolution& b, const LightUnknowns& unknowns);

// Says of each solution what it is beside those before it.
void describe_relations(std::vector<FoundLight>& solutions, const LightGeometry& geometry);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
