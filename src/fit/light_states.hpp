// SPDX-License-Identifier: MIT
// Solutions of fits of light curves side by side: their geometry, which are one, and in what order
// they are.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "polhode/fit/light_search.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Sums of the directions of all points, and what lies between the first and the last.
struct LightGeometry {
  Vec3 to_sun, to_observer;
  double time_base;
};
LightGeometry geometry_of(std::span<const light::LightCurve> curves);

// Whether two fits of one body of facets came to one spin state: to two standard errors, as facets
// bend the light, or where these are small to 0.01 rad and 1e-4 of the rate; with the same counts
// of turns over the time base.
// `half_turns`: up to half turns about the axes of the ellipsoids that are like the bodies.
bool are_same_spins(const FoundLight& a, const FoundLight& b, bool half_turns, double time_base);

// The spin and the law of a solution with the ellipsoid that is like its body.
LightModel as_ellipsoid(const FoundLight& found);

// Gives a convex body the ellipsoid of the moments that it has if filled evenly.
void set_ellipsoid(FoundLight& one);

// By cost; `solution` is that of an element. Images under a Sun and an observer that do not move
// have one cost but for rounding: of these the one with the highest pole is first, so that the
// order does not depend on the starts.
template <class Found, class Solution>
void sort_by_cost(std::vector<Found>& found, const Solution& solution) {
  constexpr double same_cost = 1e-6;
  const auto cost = [&](const Found& f) { return solution(f).result.cost; };
  std::ranges::stable_sort(found, {}, cost);
  for (auto first = found.begin(); first != found.end();) {
    const double most = (1.0 + same_cost) * cost(*first);
    const auto last =
        std::find_if(first, found.end(), [&](const Found& f) { return !(cost(f) <= most); });
    std::stable_sort(first, last, [&](const Found& a, const Found& b) {
      return solution(a).pole.z > solution(b).pole.z;
    });
    first = last;
  }
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
