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
// Within the errors of the first, with the same counts of turns over the time base: these are known
// far better than each unknown by itself.
bool are_same(const LightSolution& a, const LightSolution& b, const LightUnknowns& unknowns,
              double time_base);

// How many starts came to each solution or to one of its images. They have been described.
std::vector<std::size_t> starts_of_images(const std::vector<FoundLight>& solutions);

// Says of each solution what it is beside those before it; `half_turns` as describe_solutions.
void describe_relations(std::vector<FoundLight>& solutions, const LightGeometry& geometry,
                        bool half_turns);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
