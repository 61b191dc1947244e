// SPDX-License-Identifier: MIT
// custom_method: a method from outside, from the map that makes one of its steps. integrate, sinks,
// events, checkpoints and scenarios take it like the others (docs/extending/method.md).
//
// Equations   its own: the map says where a rotor is after a step of h.
// Units       those of the system.
// Domain      steps of one length, but for the last; a rotor without a damper. The map knows the
//             state, the time and the system alone: it keeps nothing between steps, and any length
//             of step is asked of it, since a state inside a step is that of a shorter one.
// Accuracy    that of the map. Quaternions are normalised after each step, and times are kept in
//             two parts.
// Errors      DomainError for a kind that is empty, a step that is not positive and finite, no map.
//             What the map throws reaches whoever integrates. A state that is not finite ends the
//             run with its reason.
// Cost        that of the map: one call for each step, and one for each sample, event or look
//             inside a step. Statistics count the calls that make steps as evaluations.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "polhode/dynamics/method.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {

// The state of `system` at t + h from that at t; h has either sign.
using StepMap =
    std::function<RotorState(const System& system, double t, const RotorState& s, double h)>;

struct FixedStepMap {
  std::string kind;  // "lie-midpoint": in outputs and, with a description, in files
  double step;
  StepMap map;
  // Numbers on which the map depends next to the step: a run is resumed with the same alone.
  std::vector<double> further = {};
};

CustomMethod custom_method(FixedStepMap steps);

}  // namespace v0
}  // namespace polhode
