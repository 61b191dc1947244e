// SPDX-License-Identifier: MIT
// Which of many states of a search are one, and what the others are beside it.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Mean directions of all points.
struct LightGeometry {
  Vec3 to_sun, to_observer;
  double time_base;
};
LightGeometry geometry_of(std::span<const LightCurve> curves);

// Near enough that fits from both would most likely meet.
bool are_alike(const BrightEllipsoid& a, const BrightEllipsoid& b);
// Within the errors of the first.
bool are_same(const LightSolution& a, const LightSolution& b, const LightUnknowns& unknowns);

// Says of each solution what it is beside those before it.
void describe_relations(std::vector<FoundLight>& solutions, const LightGeometry& geometry);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
