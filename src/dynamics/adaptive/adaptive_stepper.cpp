// SPDX-License-Identifier: MIT
// Adaptive: the stepper of a rotor, with the time scales and breakpoints of the terms.
#include "dynamics/adaptive/adaptive_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/adaptive/breakpoints.hpp"
#include "dynamics/adaptive/rotor_field.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

double time_scale(const System& system, double start) {
  double shortest = std::numeric_limits<double>::infinity();
  // not NaN, not 0: no step would be made
  const auto add = [&](double time) {
    if (time > 0.0 && time < shortest) shortest = time;
  };
  for (const AnyPerturbation& term : system.terms()) add(term.time_scale());
  if (!system.frame().is_inertial())
    add(0.5 * std::numbers::pi / norm(system.frame().at(start).mu_S));
  return shortest;
}

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

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method) {
  return term_stepper<RotorField>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
