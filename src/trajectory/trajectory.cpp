// SPDX-License-Identifier: MIT
#include "polhode/trajectory/trajectory.hpp"

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

void require_inside(double t, double start, double stop) {
  const double low = std::min(start, stop), high = std::max(start, stop);
  if (!(low <= t && t <= high))
    throw DomainError("Trajectory::at: t = " + detail::number_text(t) + " must be from " +
                      detail::number_text(low) + " to " + detail::number_text(high));
}

void no_dense_output() {
  throw DomainError(
      "Trajectory::at: no dense output: the run was not asked for it (dense), or its samples "
      "alone were saved");
}

template class BasicTrajectory<RotorState>;

}  // namespace v0
}  // namespace polhode
