// SPDX-License-Identifier: MIT
#include "dynamics/adaptive/breakpoints.hpp"

#include <algorithm>
#include <cmath>

namespace polhode {
inline namespace v0 {
namespace detail {

DoubleDouble SmoothStretch::above_from() const { return {std::nextafter(from, to)}; }
DoubleDouble SmoothStretch::below_to() const { return {std::nextafter(to, from)}; }

Breakpoints::Breakpoints(const System& system) {
  for (const AnyPerturbation& term : system.terms()) {
    const std::vector<double> own = term.breakpoints();
    times_.insert(times_.end(), own.begin(), own.end());
  }
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

double Breakpoints::end(double t, double stop) const {
  const SmoothStretch s = stretch(t, stop);
  return stop >= t ? std::min(s.to, stop) : std::max(s.from, stop);
}

SmoothStretch Breakpoints::stretch(double t, double stop) const {
  // t at a breakpoint is where the step begins: the stretch lies on the side of `stop`
  const bool forward = stop >= t;
  const auto next = forward ? std::upper_bound(times_.begin(), times_.end(), t)
                            : std::lower_bound(times_.begin(), times_.end(), t);
  SmoothStretch s;
  if (next != times_.begin()) s.from = *(next - 1);
  if (next != times_.end()) s.to = *next;
  return s;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
