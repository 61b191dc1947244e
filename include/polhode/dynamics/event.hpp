// SPDX-License-Identifier: MIT
// Events: crossings of any scalar function of time and state.
//
// Equations   g(t, s) = 0 between two steps, found as a change of sign and solved on the dense
//             output.
// Units       any.
// Domain      a continuous function of (t, q_SB, g_B), or of a Sample, which has the rate of a
//             damper too. A double root within one step, where the sign does not change, is not
//             seen: limit the step (largest_step) to the time scale of the function. A zero at the
//             very start is not an event.
// Accuracy    the root of the dense output to rounding of t; its time is as wrong as the state
//             there, error of g over |dg/dt|.
// Errors      what the function throws passes through; NaN ends the run with an outcome that says
//             so.
// Cost        one call per step, some ten per event.
#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>

#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {

enum class Crossing { both, rising, falling };

// double f(double t, const RotorState& s), or double f(const Sample&).
class EventFunction {
 public:
  EventFunction() = default;
  template <class F>
    requires std::invocable<const F&, double, const RotorState&>
  EventFunction(F f) {
    using Function = std::function<double(double, const RotorState&)>;
    if constexpr (std::is_pointer_v<F> || std::same_as<F, Function>)
      if (!f) return;
    value_ = [f = std::move(f)](const Sample& at) { return f(at.t, at.s); };
  }
  template <class F>
    requires(std::invocable<const F&, const Sample&> && !std::same_as<F, EventFunction>)
  EventFunction(F f) : value_(std::move(f)) {}

  double operator()(const Sample& at) const { return value_(at); }
  explicit operator bool() const { return static_cast<bool>(value_); }

 private:
  std::function<double(const Sample&)> value_;
};

struct Event {
  std::string name;
  EventFunction function;
  Crossing crossing = Crossing::both;  // as time runs, backwards too
  bool stops = false;                  // the run ends there, with a last sample at the event
  // Of a function that is an angle, folded into one turn: a jump by more than half of it is no
  // crossing. 0: none.
  double period = 0.0;
};

}  // namespace v0
}  // namespace polhode
