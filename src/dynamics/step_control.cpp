// SPDX-License-Identifier: MIT
#include "dynamics/detail/step_control.hpp"

#include <cmath>
#include <numbers>

namespace polhode {
inline namespace v0 {
namespace detail {

double time_scale(const Problem& problem) {
  double shortest = std::numeric_limits<double>::infinity();
  // not NaN, not 0: no step would be made
  const auto add = [&](double time) {
    if (time > 0.0 && time < shortest) shortest = time;
  };
  for (const AnyPerturbation& term : problem.system.terms()) add(term.time_scale());
  if (!problem.system.frame().is_inertial())
    add(0.5 * std::numbers::pi / norm(problem.system.frame().at(problem.start).mu_S));
  return shortest;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
