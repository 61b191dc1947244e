// SPDX-License-Identifier: MIT
// Andoyer's variables at an epoch, as elements.
#include "polhode/free/fukushima_ishizaki.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/chart_jacobian.hpp"

namespace polhode {
inline namespace v0 {

FukushimaIshizakiState to_fukushima_ishizaki(const FreeRotation& motion, double t) {
  if (!std::isfinite(t))
    throw DomainError("to_fukushima_ishizaki: t = " + detail::number_text(t) +
                      ", the epoch, must be finite");
  const AndoyerState a = to_andoyer(motion.at(t));
  return {a.l, a.g, a.h, a.L, a.G, a.H, t};
}

FreeRotation free_rotation(const Body& body, const FukushimaIshizakiState& s) {
  return {body, to_rotor(andoyer_state(s.l0, s.g0, s.h, s.L0, s.G, s.H)), s.t0};
}

RotorState to_rotor(const Body& body, const FukushimaIshizakiState& s, double t) {
  return free_rotation(body, s).at(t);
}

Matrix6 chart_jacobian(const Body& body, const FukushimaIshizakiState& s, double t) {
  const FreeRotation motion = free_rotation(body, s);
  return motion.state_transition(t) *
         chart_jacobian({CanonicalSet::andoyer}, motion.initial_state());
}

}  // namespace v0
}  // namespace polhode
