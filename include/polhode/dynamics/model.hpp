// SPDX-License-Identifier: MIT
// Model: what a run needs to know of a motion of your own: a state, and how it changes.
//
// Equations   dy/dt = rates(t, y), y the numbers of the state as an array. A model M has
//               State                       a MotionState (polhode/trajectory/trajectory.hpp)
//               static constexpr name       "a gyrostat": what messages and checkpoints call it
//               values<T>(s)                the numbers of a state, as std::array<T, N>
//               state(y)                    the state of such numbers, in double, normalised
//               rates(t, y)                 dy/dt; t is a DoubleDouble
//               error_size(error, y, dy)    of a step from y by dy, relative to what y measures
//             and may have
//               started(s)                  checks and normalises an initial state
//               settle(y)                   y is a CompensatedState: restores invariants after a
//                                           step, as |q| = 1
//               turning_rate(t, s)          rad per time, the fastest: how often events are looked
//                                           at. Without it: as often as steps of that tolerance
//                                           need, at 1e-12 once, and as `interval` of an event
//                                           says
//               near(to, s)                 s in that of its forms which is nearer to `to`: q or -q
//               time_scale(t)               no step that begins at t is longer, unless the method
//                                           says largest_step
//               parameters()                numbers that a checkpoint compares, as a vector
//               frozen(t, s, h)             the state after h while all that depends on time stays
//                                           as at t, a DoubleDouble: exact, of either sign of h.
//                                           Splitting then moves it, too. A model of it, `State`
//                                           and `name` alone is for Splitting alone, and has no
//                                           events
//               frozen(parts, s)            in its place: the state after all parts of a step, of
//                                           FrozenPart, one after the other
//               goes_on(s)                  beside frozen: whether a step may end at s. Without it:
//                                           where all of its numbers are finite
// Units       any consistent set.
// Domain      T is double, and DoubleDouble too where the model is a template on the number type:
//             Adaptive with Precision::double_double needs it. Rates are smooth between `start` and
//             `stop`. Adaptive and Collocation move every model, Splitting those that have
//             frozen(); other methods know a System alone.
// Accuracy    that of the method.
// Errors      what a function of the model throws passes through.
// Cost        that of its functions.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <tuple>

#include "polhode/detail/ode/runge_kutta.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {

// The numbers of a state of M in the number type T.
template <class M, Real T>
using ValuesOf =
    decltype(std::declval<const M&>().template values<T>(std::declval<typename M::State>()));

// Where a model works on T.
template <class M, class T>
concept ModelOn =
    MotionState<typename M::State> && requires(const M& m, const typename M::State& s,
                                               const ValuesOf<M, T>& y, const DoubleDouble& t) {
      std::tuple_size<ValuesOf<M, T>>::value;
      { m.state(y) } -> std::same_as<typename M::State>;
      { m.rates(t, y) } -> std::same_as<ValuesOf<M, T>>;
      { m.error_size(y, y, y) } -> std::convertible_to<double>;
    };

// A part of a step of Splitting: all that depends on time stays as it is at t for h.
struct FrozenPart {
  double t;
  double h;
};
// In one step of any scheme.
inline constexpr std::size_t most_frozen_parts = 18;

// What Splitting moves.
template <class M>
concept FrozenModel =
    MotionState<typename M::State> &&
    requires {
      { M::name } -> std::convertible_to<std::string_view>;
    } &&
    (
        requires(const M& m, const DoubleDouble& t, const typename M::State& s, double h) {
          { m.frozen(t, s, h) } -> std::same_as<typename M::State>;
        } ||
        requires(const M& m, std::span<const FrozenPart> parts, const typename M::State& s) {
          { m.frozen(parts, s) } -> std::same_as<typename M::State>;
        });

template <class M>
concept Model = ModelOn<M, double> && requires {
  { M::name } -> std::convertible_to<std::string_view>;
};

}  // namespace v0
}  // namespace polhode
