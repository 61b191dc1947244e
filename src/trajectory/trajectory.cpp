// SPDX-License-Identifier: MIT
#include "polhode/trajectory/trajectory.hpp"

#include <algorithm>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

Sample Trajectory::sample(double t) const {
  const double low = std::min(start(), stop()), high = std::max(start(), stop());
  if (!(low <= t && t <= high))
    throw DomainError("Trajectory::at: t = " + detail::number_text(t) + " must be from " +
                      detail::number_text(low) + " to " + detail::number_text(high));
  if (t == start()) return parts_.initial;
  if (parts_.dense.empty())
    throw DomainError(
        "Trajectory::at: no dense output: the run was not asked for it (dense), or its samples "
        "alone were saved");
  const bool forward = start() <= stop();
  // the first step that ends at t or beyond it
  const auto step = std::partition_point(
      parts_.dense.begin(), parts_.dense.end(),
      [&](const auto& piece) { return forward ? piece->t1() < t : piece->t1() > t; });
  return (step == parts_.dense.end() ? parts_.dense.back() : *step)->sample(t);
}

}  // namespace v0
}  // namespace polhode
