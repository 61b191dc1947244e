// SPDX-License-Identifier: MIT
#include "dynamics/adaptive/step_control.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
