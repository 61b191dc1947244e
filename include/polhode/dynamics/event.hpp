// SPDX-License-Identifier: MIT
// Events: crossings of any scalar function of time and state.
//
// Equations   g(t, s) = 0 between two steps, found as a change of sign and solved on the dense
//             output.
// Units       any.
// Domain      a continuous function of (t, q_SB, g_B). A double root within one step, where the
//             sign does not change, is not seen: limit the step (largest_step) to the time scale of
//             the function. A zero at the very start is not an event.
// Accuracy    the root of the dense output to rounding of t; its time is as wrong as the state
//             there, error of g over |dg/dt|.
// Errors      what the function throws passes through; NaN ends the run with an outcome that says
//             so.
// Cost        one call per step, some ten per event.
#pragma once

#include <functional>
#include <string>

#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

enum class Crossing { both, rising, falling };

struct Event {
  std::string name;
  std::function<double(double, const RotorState&)> function;
  Crossing crossing = Crossing::both;  // as time runs, backwards too
  bool stops = false;                  // the run ends there, with a last sample at the event
  // Of a function that is an angle, folded into one turn: a jump by more than half of it is no
  // crossing. 0: none.
  double period = 0.0;
};

}  // namespace v0
}  // namespace polhode
