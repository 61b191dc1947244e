// SPDX-License-Identifier: MIT
// TurnedKeplerOrbit: a PrecessingKeplerOrbit with its elements in axes that are turned about axis
// 1, as those of a satellite are in a run along the ecliptic.
//
// Equations   x = R1(angle) x', R1 = ((1, 0, 0), (0, cos, sin), (0, -sin, cos)), x' the position in
//             the axes of the elements: with obliquity_J2000 from the equator to the ecliptic.
// Units       those of the orbit; the angle in rad.
// Domain      any angle that is finite; the orbit at any time.
// Accuracy    that of the orbit, and one rotation.
// Errors      DomainError for an angle that is not finite.
// Cost        that of the orbit and 1 ns.
#pragma once

#include <numbers>

#include "polhode/orbit/precessing_kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {

// Of the ecliptic of J2000 against the equator, IAU 1976; they share axis 1, the equinox.
constexpr double obliquity_J2000 = 84381.448 * (std::numbers::pi / 648000.0);

class TurnedKeplerOrbit {
 public:
  TurnedKeplerOrbit(const PrecessingKeplerOrbit& orbit, double angle);
  // Elements along the equator of J2000, positions along the ecliptic; and the reverse.
  static TurnedKeplerOrbit from_equator(const PrecessingKeplerOrbit& orbit) {
    return {orbit, obliquity_J2000};
  }
  static TurnedKeplerOrbit from_ecliptic(const PrecessingKeplerOrbit& orbit) {
    return {orbit, -obliquity_J2000};
  }

  const PrecessingKeplerOrbit& orbit() const { return orbit_; }
  double angle() const { return angle_; }
  bool shares_with(const TurnedKeplerOrbit& other) const {
    return angle_ == other.angle_ && orbit_.shares_with(other.orbit_);
  }
  double gm() const { return orbit_.gm(); }
  double time_scale() const { return orbit_.time_scale(); }

  // T = double or DoubleDouble, or a Dual of them.
  Vec3 position(double t, double rest = 0.0) const { return turned(orbit_.position(t, rest)); }
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const {
    return turned(orbit_.position(t));
  }
  // At many times, in lanes: many_times.hpp.
  void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const {
    orbit_.positions(times, to, set);
    for (std::size_t i = 0; i < times.count; ++i) to.set(i, turned(to.at(i)));
  }
  void motions(const TimeRows& times, const VectorRows& position, const VectorRows& velocity,
               InstructionSet set) const {
    orbit_.motions(times, position, velocity, set);
    for (std::size_t i = 0; i < times.count; ++i) {
      position.set(i, turned(position.at(i)));
      velocity.set(i, turned(velocity.at(i)));
    }
  }
  template <Real T, int N>
  BasicVec3<Dual<T, N>> position(const Dual<T, N>& t) const {
    return turned(orbit_.position(t));
  }
  // The derivative of the position.
  template <class T>
  BasicVec3<T> velocity(const T& t) const {
    return turned(orbit_.velocity(t));
  }

 private:
  template <Real T>
  BasicVec3<T> turned(const BasicVec3<T>& x) const {
    return {x.x, T(cosine_) * x.y + T(sine_) * x.z, T(cosine_) * x.z - T(sine_) * x.y};
  }

  PrecessingKeplerOrbit orbit_;
  double angle_, sine_, cosine_;
};

}  // namespace v0
}  // namespace polhode
