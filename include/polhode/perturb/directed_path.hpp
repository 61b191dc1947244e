// SPDX-License-Identifier: MIT
// DirectedPath: an orbit or its reverse, for terms that must know which of two bodies moves.
//
// Equations   the centre as seen from the body is minus the body as seen from the centre.
// Units       those of the orbit.
// Domain      a velocity where the orbit has one (AnyOrbit::supports_velocity). For Tangent the
//             orbit is evaluated in double: no variable moves the time.
// Accuracy    that of the orbit. The velocity is that at t, without the rest of the time.
// Errors      those of the orbit.
// Cost        that of the orbit.
#pragma once

#include "polhode/orbit/any_orbit.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

struct DirectedPath {
  AnyOrbit orbit;
  bool reversed = false;

  template <Real T>
  BasicVec3<T> position(const BasicSetting<T>& at) const {
    const BasicVec3<T> x = along(at);
    return reversed ? -x : x;
  }
  double time_scale() const { return orbit.time_scale(); }
  // At many times: position in double, and velocity, which is that without rests.
  void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const {
    orbit.positions(times, to, set);
    if (reversed) turn_back(times.count, to);
  }
  void motions(const TimeRows& times, const VectorRows& position, const VectorRows& velocity,
               InstructionSet set) const {
    orbit.motions(times, position, velocity, set);
    positions(times, position, set);
    if (reversed) turn_back(times.count, velocity);
  }
  Vec3 velocity(double t) const {
    const Vec3 v = orbit.velocity(t);
    return reversed ? -v : v;
  }

 private:
  static void turn_back(std::size_t count, const VectorRows& rows) {
    for (std::size_t i = 0; i < count; ++i) rows.set(i, -rows.at(i));
  }
  template <Real T>
  BasicVec3<T> along(const BasicSetting<T>& at) const {
    if constexpr (std::same_as<T, Tangent>) {
      const Vec3 x = orbit.position(at.t.value, at.t_rest.value);
      return {Tangent(x.x), Tangent(x.y), Tangent(x.z)};
    } else {
      return position_at(orbit, at.t, at.t_rest);
    }
  }
};

}  // namespace v0
}  // namespace polhode
