// SPDX-License-Identifier: MIT
#include "dynamics/detail/event_root.hpp"

#include <cmath>

namespace polhode {
inline namespace v0 {
namespace detail {

// Illinois' regula falsi with a bisection at every third trip: at most 128 trips, ten as a rule.
double event_root(const Event& event, const DenseStep& step, double t0, double f0, double t1,
                  double f1) {
  if (f0 == 0.0) return t0;
  const bool rises = f1 > 0.0;
  int last_moved = -1;
  for (int trip = 0; trip < 128; ++trip) {
    double t = t1 - f1 * ((t1 - t0) / (f1 - f0));
    if (trip % 3 == 2 || !((t - t0) * (t1 - t) > 0.0)) t = t0 + 0.5 * (t1 - t0);
    if (t == t0 || t == t1) break;  // neighbours
    const double f = event.function(step.sample(t));
    if (f == 0.0) return t;
    if (std::isnan(f)) break;
    const int moved = (f > 0.0) == rises ? 1 : 0;
    (moved == 1 ? t1 : t0) = t;
    (moved == 1 ? f1 : f0) = f;
    if (moved == last_moved) (moved == 1 ? f0 : f1) *= 0.5;  // else the far end never moves
    last_moved = moved;
  }
  return t1;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
