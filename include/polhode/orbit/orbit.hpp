// SPDX-License-Identifier: MIT
// Orbit: a position as a function of time, and AnyOrbit, one of any type for lists made at run
// time.
//
// Equations   none.
// Units       those of the orbit: a length, or any unit that the gravitational parameter shares.
// Domain      T = double (any step of a run) and DoubleDouble (runs in double-double). An orbit
//             that also takes Dual times has a velocity.
// Accuracy    that of the orbit.
// Errors      velocity throws DomainError when the orbit takes no Dual time; what the orbit throws
//             passes through.
// Cost        one virtual call. Copies share the orbit, which is immutable.
#pragma once

#include <concepts>
#include <limits>
#include <memory>
#include <string>
#include <utility>

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

namespace detail {

// The position at t + rest, for orbits that take what their number type cannot hold of a time.
template <class O, Real T>
BasicVec3<T> position_at(const O& orbit, const T& t, const T& rest) {
  if constexpr (requires { orbit.position(t, rest); }) {
    return orbit.position(t, rest);
  } else {
    return orbit.position(t);
  }
}

[[noreturn]] void orbit_without_velocity(const std::string& name);

class ErasedOrbit {
 public:
  virtual ~ErasedOrbit() = default;
  virtual Vec3 position(double t, double rest) const = 0;
  virtual BasicVec3<DoubleDouble> position(const DoubleDouble& t) const = 0;
  virtual BasicVec3<Dual<double, 1>> position(const Dual<double, 1>& t) const = 0;
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
  double time_scale() const override { return time_scale_of(orbit_); }

 private:
  std::string name_;
  O orbit_;
};

}  // namespace detail

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
