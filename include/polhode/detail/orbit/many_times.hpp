// SPDX-License-Identifier: MIT
// Positions on an orbit at many times, in rows: for those who ask for several at once.
//
// Units       those of the orbit.
// Domain      any Orbit. One that can use the lanes of the processor has `positions` and, if it has
//             a velocity, `motions`, with the arguments below; any other is asked time by time.
// Accuracy    the bits of position(t, rest), and of a position and velocity by a Dual time, by
//             every set of instructions.
// Errors      what the orbit throws passes through.
// Cost        that of the orbit; a time on KeplerOrbit with e > 0.5 a fifth of it.
#pragma once

#include <array>
#include <cstddef>

#include "polhode/detail/orbit/shared_places.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/orbit/orbit.hpp"

namespace polhode {
inline namespace v0 {

// Times t[i] + rest[i]; null: no rest.
struct TimeRows {
  std::size_t count;
  const double* t;
  const double* rest = nullptr;
  // What is known of these very times; null: nothing.
  SharedPlaces* known = nullptr;

  double rest_of(std::size_t i) const { return rest == nullptr ? 0.0 : rest[i]; }
};

// Vectors, as many as there are times.
struct VectorRows {
  double* x;
  double* y;
  double* z;

  Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3& v) const {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

template <class O>
void positions_at(const O& orbit, const TimeRows& times, const VectorRows& to,
                  [[maybe_unused]] InstructionSet set) {
  const auto ask = [&] {
    if constexpr (requires { orbit.positions(times, to, set); }) {
      orbit.positions(times, to, set);
    } else {
      for (std::size_t i = 0; i < times.count; ++i)
        to.set(i, position_at(orbit, times.t[i], times.rest_of(i)));
    }
  };
  using enum SharedPlaces::Asked;
  SharedPlaces::once(times.known, orbit, times.rest == nullptr ? positions : positions_with_rests,
                     times.count, std::array{to.x, to.y, to.z}, ask);
}

// Positions and velocities at t: rests are not looked at.
template <class O>
  requires OrbitOn<O, Dual<double, 1>>
void motions_at(const O& orbit, const TimeRows& times, const VectorRows& position,
                const VectorRows& velocity, [[maybe_unused]] InstructionSet set) {
  const auto ask = [&] {
    if constexpr (requires { orbit.motions(times, position, velocity, set); }) {
      orbit.motions(times, position, velocity, set);
    } else {
      for (std::size_t i = 0; i < times.count; ++i) {
        const auto x = orbit.position(Dual<double, 1>::variable(times.t[i], 0));
        position.set(i, {x.x.value, x.y.value, x.z.value});
        velocity.set(i, {x.x.derivative[0], x.y.derivative[0], x.z.derivative[0]});
      }
    }
  };
  SharedPlaces::once(
      times.known, orbit, SharedPlaces::Asked::motions, times.count,
      std::array{position.x, position.y, position.z, velocity.x, velocity.y, velocity.z}, ask);
}

}  // namespace v0
}  // namespace polhode
