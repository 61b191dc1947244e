// SPDX-License-Identifier: MIT
// SystemState: the state of a System, a rotor and what moves inside it.
//
// Equations   those of System and of KaneDamper: polhode/perturb/kane_damper.hpp.
// Units       those of RotorState; damper_rate in rad per time.
// Domain      damper_rate is relative to the body, in body axes; zero for a system without a
//             damper.
// Cost        ten numbers.
#pragma once

#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// Every function of a rotor also takes the state of a system.
struct SystemState : RotorState {
  Vec3 damper_rate = {};

  constexpr SystemState() = default;
  // Not explicit: a rotor is the state of a system in which nothing else moves.
  constexpr SystemState(const RotorState& s)  // NOLINT(google-explicit-constructor)
      : RotorState(s) {}
  constexpr SystemState(const Quaternion& q_SB, const Vec3& g_B, const Vec3& rate = {})
      : RotorState{q_SB, g_B}, damper_rate(rate) {}

  friend bool operator==(const SystemState& a, const SystemState& b) = default;
  friend bool operator==(const SystemState& a, const RotorState& b) { return a == SystemState(b); }
};

template <class Visit>
void each_number(SystemState& s, Visit&& visit) {
  each_number(static_cast<RotorState&>(s), visit);
  for (double* x : {&s.damper_rate.x, &s.damper_rate.y, &s.damper_rate.z}) visit(*x);
}

}  // namespace v0
}  // namespace polhode
