// SPDX-License-Identifier: MIT
// Starts of a search, drawn by their number, their short fits, and which are fitted to the end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fit/result_bytes.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
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
  EllipsoidModel body;
  double cost = 0.0;  // what was minimised
};
inline void serialize(Archive& bytes, LightTrial& trial) {
  serialize(bytes, trial.body);
  bytes(trial.cost);
}

// Midway between the first and the last time.
double epoch_of(std::span<const LightCurve> curves);

// None where no body was found that has the periods.
std::optional<LightTrial> light_trial(const LightSearch& search, std::uint64_t number);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
