// SPDX-License-Identifier: MIT
// An orbit of any type, as AnyOrbit holds it.
#pragma once

#include <string>
#include <utility>

#include "polhode/detail/orbit/many_times.hpp"
#include "polhode/orbit/orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

[[noreturn]] void orbit_without_velocity(const std::string& name);

class ErasedOrbit {
 public:
  virtual ~ErasedOrbit() = default;
  virtual Vec3 position(double t, double rest) const = 0;
  virtual BasicVec3<DoubleDouble> position(const DoubleDouble& t) const = 0;
  virtual BasicVec3<Dual<double, 1>> position(const Dual<double, 1>& t) const = 0;
  virtual void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const = 0;
  virtual void motions(const TimeRows& times, const VectorRows& position,
                       const VectorRows& velocity, InstructionSet set) const = 0;
  virtual double time_scale() const = 0;
};

template <Orbit O>
class HeldOrbit final : public ErasedOrbit {
 public:
  HeldOrbit(std::string name, O orbit) : name_(std::move(name)), orbit_(std::move(orbit)) {}

  const O& orbit() const { return orbit_; }

  Vec3 position(double t, double rest) const override { return position_at(orbit_, t, rest); }
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const override {
    return orbit_.position(t);
  }
  BasicVec3<Dual<double, 1>> position(const Dual<double, 1>& t) const override {
    if constexpr (OrbitOn<O, Dual<double, 1>>) {
      return orbit_.position(t);
    } else {
      orbit_without_velocity(name_);
    }
  }
  void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const override {
    positions_at(orbit_, times, to, set);
  }
  void motions(const TimeRows& times, const VectorRows& position, const VectorRows& velocity,
               InstructionSet set) const override {
    if constexpr (OrbitOn<O, Dual<double, 1>>) {
      motions_at(orbit_, times, position, velocity, set);
    } else {
      orbit_without_velocity(name_);
    }
  }
  double time_scale() const override { return time_scale_of(orbit_); }

 private:
  std::string name_;
  O orbit_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
