// SPDX-License-Identifier: MIT
// Bodies whose light in one session is that of a solution, with other counts of turns until another
// session.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/fit/light_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct TurnCounts {
  std::size_t count = 1;                // that the errors of the periods leave
  std::size_t without_body = 0;         // of them those that no body near the solution has
  bool has_periods = true;              // else the solution alone: its periods are not determined
  std::vector<BrightEllipsoid> bodies;  // at the epoch of the solution; none of more than `most`
};

// See light_extension.hpp; `distance` is D.
TurnCounts turn_counts(const LightSolution& solution, const LightUnknowns& unknowns,
                       double distance, std::size_t most);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
