// SPDX-License-Identifier: MIT
// Events: crossings of any scalar function of time and state, whatever the state is.
//
// Equations   g(t, s) = 0, solved on the dense output between two looks at g and dg/dt. Looks are a
//             twelfth part of the fastest turn apart at most (of the free body with its momentum,
//             along its whole polhode, and of the frame), and at the end of every step.
// Units       any; `interval` is a time.
// Domain      a continuous function of time and state, (t, q_SB, g_B) for a system, or of a sample,
//             which is both. It finds every change of sign from one look to the next; two zeros
//             between two looks, where the function turns around beyond zero; and a touch, where it
//             turns around at zero to rounding (1e-14 of its values around, and of t), of direction
//             0, that rising and falling leave out: a kink like |x|, or an even power up to the
//             20th. A function that turns around twice between two looks, since it varies faster
//             than the body turns, needs an `interval`. A zero at start or stop is an event; with
//             Problem::continues one at start is not, so that a run in two parts has it once. A
//             function that reaches zero and stays there is two events: its first instant at zero,
//             of the direction in which it came, and the last, of that in which it leaves (0 where
//             these are start or stop). There it may differ from zero by roundings, 1e-14 of its
//             largest value so far. Events at one instant are all reported, also if one of them
//             stops the run.
// Accuracy    the root of the dense output to rounding of t; its time is as wrong as the state
//             there, error of g over |dg/dt|. The time of a touch: the square root of that.
// Errors      what the function throws passes through. NaN, or a step in which more than 1e8 looks
//             would be needed, ends the run with an outcome that says so.
// Cost        two calls per look, about 25 per event. docs/accuracy/events.md.
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

// double f(double t, const S& s), or double f(const BasicSample<S>&).
template <MotionState S>
class BasicEventFunction {
 public:
  BasicEventFunction() = default;
  // Not explicit: a lambda stands for an event function.
  template <class F>
    requires std::invocable<const F&, double, const S&>
  BasicEventFunction(F f) {  // NOLINT(google-explicit-constructor)
    using Function = std::function<double(double, const S&)>;
    if constexpr (std::is_pointer_v<F> || std::same_as<F, Function>)
      if (!f) return;
    value_ = [f = std::move(f)](const BasicSample<S>& at) { return f(at.t, at.s); };
  }
  template <class F>
    requires(std::invocable<const F&, const BasicSample<S>&> &&
             !std::same_as<F, BasicEventFunction>)
  BasicEventFunction(F f)  // NOLINT(google-explicit-constructor)
      : value_(std::move(f)) {}

  double operator()(const BasicSample<S>& at) const { return value_(at); }
  explicit operator bool() const { return static_cast<bool>(value_); }

 private:
  std::function<double(const BasicSample<S>&)> value_;
};
using EventFunction = BasicEventFunction<SystemState>;

template <MotionState S>
struct BasicEvent {
  std::string name;
  BasicEventFunction<S> function;
  Crossing crossing = Crossing::both;  // as time runs, backwards too
  bool stops = false;                  // the run ends there, with a last sample at the event
  // Of a function that is an angle, folded into one turn: a jump by more than half of it is no
  // crossing. 0: none.
  double period = 0.0;
  // No two looks are farther apart: for a function that varies faster than the body turns. 0: looks
  // follow the rotation.
  double interval = 0.0;
};

using Event = BasicEvent<SystemState>;

// DomainError for an event without a function, or an invalid period or interval.
void require_valid_event(const std::string& name, bool has_function, double period,
                         double interval);
template <MotionState S>
void require_valid(const BasicEvent<S>& event) {
  require_valid_event(event.name, static_cast<bool>(event.function), event.period, event.interval);
}

}  // namespace v0
}  // namespace polhode
