// SPDX-License-Identifier: MIT
// Orbit: a position as a function of time. any_orbit.hpp holds one of any type.
//
// Units       those of the orbit: a length, or any unit that the gravitational parameter shares.
// Domain      T = double (any step of a run) and DoubleDouble (runs in double-double). An orbit
//             that also takes Dual times has a velocity.
// Accuracy    that of the orbit.
// Errors      what the orbit throws passes through.
// Cost        that of the orbit.
#pragma once

#include <concepts>
#include <limits>

#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

template <class O, class T>
concept OrbitOn = Real<T> && requires(const O& orbit, const T& t) {
  { orbit.position(t) } -> std::same_as<BasicVec3<T>>;
};
template <class O>
concept Orbit = std::copyable<O> && OrbitOn<O, double> && OrbitOn<O, DoubleDouble>;

// The value with the slope of a time: how an orbit with a velocity takes a Dual time.
template <Real T, int N>
constexpr BasicVec3<Dual<T, N>> chained(const Dual<T, N>& t, const BasicVec3<T>& value,
                                        const BasicVec3<T>& slope) {
  return {t.chained(value.x, slope.x), t.chained(value.y, slope.y), t.chained(value.z, slope.z)};
}

// The time of a quarter of a turn where an orbit is fastest; infinite for one that does not say
// (a member time_scale).
template <class O>
double time_scale_of(const O& orbit) {
  if constexpr (requires {
                  { orbit.time_scale() } -> std::convertible_to<double>;
                }) {
    return orbit.time_scale();
  } else {
    return std::numeric_limits<double>::infinity();
  }
}

// The position at t + rest, for orbits that take what their number type cannot hold of a time.
template <class O, Real T>
BasicVec3<T> position_at(const O& orbit, const T& t, const T& rest) {
  if constexpr (requires { orbit.position(t, rest); }) {
    return orbit.position(t, rest);
  } else {
    return orbit.position(t);
  }
}
// A time that no variable moves, as in a state transition matrix, needs no derivatives.
template <class O, Real T, int N>
BasicVec3<Dual<T, N>> position_at(const O& orbit, const Dual<T, N>& t, const Dual<T, N>& rest) {
  if constexpr (OrbitOn<O, Dual<T, N>>) {
    if (!t.is_constant()) return orbit.position(t);
  }
  const BasicVec3<T> x = position_at(orbit, t.value, rest.value);
  return {x.x, x.y, x.z};
}

}  // namespace v0
}  // namespace polhode
