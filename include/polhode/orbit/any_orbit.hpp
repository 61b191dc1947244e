// SPDX-License-Identifier: MIT
// AnyOrbit: an orbit of any type, for lists made at run time.
//
// Units       those of the orbit.
// Domain      any Orbit; T = double or DoubleDouble, and Dual times where the orbit takes them.
// Accuracy    that of the orbit.
// Errors      velocity throws DomainError when the orbit takes no Dual time; what the orbit throws
//             passes through.
// Cost        one virtual call. Copies share the orbit, which is immutable.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <utility>

#include "polhode/orbit/detail/erased_orbit.hpp"
#include "polhode/orbit/orbit.hpp"

namespace polhode {
inline namespace v0 {

class AnyOrbit {
 public:
  // `name` stands for the orbit in messages and outputs.
  template <Orbit O>
  AnyOrbit(const std::string& name, O orbit)
      : name_(name),
        velocity_(OrbitOn<O, Dual<double, 1>>),
        orbit_(std::make_shared<const detail::HeldOrbit<O>>(name, std::move(orbit))) {}

  const std::string& name() const { return name_; }
  // The orbit itself where it is an O, else nullptr.
  template <Orbit O>
  const O* target() const {
    const auto* held = dynamic_cast<const detail::HeldOrbit<O>*>(orbit_.get());
    return held == nullptr ? nullptr : &held->orbit();
  }
  bool supports_velocity() const { return velocity_; }
  double time_scale() const { return orbit_->time_scale(); }

  // T = double or DoubleDouble.
  template <Real T>
    requires(std::same_as<T, double> || std::same_as<T, DoubleDouble>)
  BasicVec3<T> position(const T& t) const {
    if constexpr (std::same_as<T, double>) {
      return orbit_->position(t, 0.0);
    } else {
      return orbit_->position(t);
    }
  }
  Vec3 position(double t, double rest) const { return orbit_->position(t, rest); }
  // At many times: many_times.hpp.
  void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const {
    orbit_->positions(times, to, set);
  }
  void motions(const TimeRows& times, const VectorRows& position, const VectorRows& velocity,
               InstructionSet set) const {
    orbit_->motions(times, position, velocity, set);
  }
  template <int N>
  BasicVec3<Dual<double, N>> position(const Dual<double, N>& t) const {
    const BasicVec3<Dual<double, 1>> x = orbit_->position(Dual<double, 1>::variable(t.value, 0));
    return chained(t, {x.x.value, x.y.value, x.z.value},
                   {x.x.derivative[0], x.y.derivative[0], x.z.derivative[0]});
  }
  Vec3 velocity(double t) const {
    const BasicVec3<Dual<double, 1>> x = orbit_->position(Dual<double, 1>::variable(t, 0));
    return {x.x.derivative[0], x.y.derivative[0], x.z.derivative[0]};
  }

 private:
  std::string name_;
  bool velocity_;
  std::shared_ptr<const detail::ErasedOrbit> orbit_;
};

}  // namespace v0
}  // namespace polhode
