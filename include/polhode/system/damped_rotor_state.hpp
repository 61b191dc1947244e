// SPDX-License-Identifier: MIT
// DampedRotorState: the state of a rotor whose system may have a damper.
//
// Equations   those of System and of KaneDamper: polhode/perturb/kane_damper.hpp.
// Units       those of RotorState; damper_rate in rad per time.
// Domain      damper_rate is relative to the body, in body axes; zero where there is no damper.
// Accuracy    none: it is a plain value.
// Cost        ten numbers.
#pragma once

#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

struct DampedRotorState {
  RotorState rotor;
  Vec3 damper_rate = {};

  constexpr bool operator==(const DampedRotorState&) const = default;
};

template <class Visit>
void each_number(DampedRotorState& s, Visit&& visit) {
  each_number(s.rotor, visit);
  for (double* x : {&s.damper_rate.x, &s.damper_rate.y, &s.damper_rate.z}) visit(*x);
}

// A rotor whose damper turns with it, and the state of the rotor in either.
inline DampedRotorState damped(const RotorState& s) { return {s, {}}; }
inline const DampedRotorState& damped(const DampedRotorState& s) { return s; }
inline const RotorState& rotor_of(const RotorState& s) { return s; }
inline const RotorState& rotor_of(const DampedRotorState& s) { return s.rotor; }

}  // namespace v0
}  // namespace polhode
