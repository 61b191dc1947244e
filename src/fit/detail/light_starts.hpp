// SPDX-License-Identifier: MIT
// Starts of a search, drawn by their number, their short fits, and which are fitted to the end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "polhode/fit/light_search.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Of those with the lowest `cost`, at most `count` that are unlike each other: the best, and after
// it the next best that is unlike those taken.
template <class Start, class AreAlike>
std::vector<Start> best_unlike(std::vector<Start> all, std::size_t count,
                               const AreAlike& are_alike) {
  std::ranges::stable_sort(all, {}, &Start::cost);
  std::vector<Start> taken;
  for (const Start& one : all) {
    if (taken.size() == count) break;
    const bool is_known =
        std::ranges::any_of(taken, [&](const Start& known) { return are_alike(known, one); });
    if (!is_known) taken.push_back(one);
  }
  return taken;
}

struct LightTrial {
  LightModel body;
  double cost = 0.0;  // what was minimised
};

// Midway between the first and the last time.
double epoch_of(std::span<const light::LightCurve> curves);

class Draws;

class LightStarts {
 public:
  explicit LightStarts(const LightSearch& search);

  // The best attitude that was tried for a phase of a polhode, after some iterations. None where no
  // body was found that has the periods.
  std::optional<LightTrial> trial(std::uint64_t number, const LightUnknowns& unknowns,
                                  int iterations) const;
  // The pairs of periods that a known body cannot have.
  std::size_t pairs_without_motion() const;

 private:
  std::optional<LightModel> known_body(std::size_t pair, Draws& draws) const;

  const LightSearch& search_;
  std::optional<Body> known_;
  std::vector<light::LightCurve> looked_at_;        // on which attitudes of a known body are tried
  std::vector<std::vector<FreeRotation>> motions_;  // that it has, of each pair of periods
};

// Fits the surface of a search from the ellipsoids that it found; its bodies become the solutions.
void fit_surfaces(const LightSearch& search, LightSearchResult& result);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
