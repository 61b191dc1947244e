// SPDX-License-Identifier: MIT
// What steps by collocation keep to, and the sweeps that solve one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "polhode/ode/step_control.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct CollocationControl {
  StepControl step;
  bool is_fixed = false;  // every step is step.first_step long but where something ends it
};

enum class SweepsEnd { converged, diverging, not_finite };

// Until rounding alone changes the stages, or what a term has of noise: its changes may be
// `enough`.
template <class Stages>
SweepsEnd swept(Stages& stages, double enough, std::int64_t& sweeps) {
  constexpr int most_sweeps = 60, least_sweeps = 3;
  constexpr double largest_rounding = 256.0 * std::numeric_limits<double>::epsilon();
  double before = std::numeric_limits<double>::infinity();
  for (int n = 1; n <= most_sweeps; ++n) {
    const double change = stages.sweep();
    ++sweeps;
    if (change == 0.0) return SweepsEnd::converged;
    if (!std::isfinite(change)) return SweepsEnd::not_finite;
    if (n >= least_sweeps && !(change < before)) break;
    before = change;
  }
  return before <= std::max(enough, largest_rounding) ? SweepsEnd::converged : SweepsEnd::diverging;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
