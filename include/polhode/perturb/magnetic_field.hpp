// SPDX-License-Identifier: MIT
// Magnetic fields: the tilted dipole of a primary that turns, a constant field, a function of the
// user; and the field at the place of a body along its orbit.
//
// Equations   dipole: B = (3 (K.n) n - K) / r^3, n = x / r, K = mu_0 m / (4 pi). Of the potential
//             a (a/r)^2 (g10 cos(theta) + (g11 cos(phi) + h11 sin(phi)) sin(theta)) of the IGRF,
//             K = a^3 (g11, h11, g10) in the axes of the primary (Thebault et al. 2015). K turns
//             with the primary. dB/dt along the orbit is the whole derivative: by the turning
//             of the primary and by the motion of the body.
// Units       K in field times length^3, lengths those of the orbit, rates in rad per time.
// Domain      everything is in inertial axes. A dipole field is the same at x and -x: the orbit may
//             be that of the body or of the primary. Away from r = 0.
// Accuracy    a few roundings of the field.
// Errors      DomainError for numbers that are not finite, a pole of no length, a radius that is
//             not positive.
// Cost        a dipole some 28 ns in addition to the orbit; with its rate 57 ns
//             (benchmarks/magnetic.cpp).
#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <utility>

#include "polhode/detail/orbit/many_times.hpp"
#include "polhode/detail/orbit/uniform_angle.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/orbit/orbit.hpp"
#include "polhode/perturb/detail/argument_checks.hpp"
#include "polhode/perturb/detail/dual_values.hpp"

namespace polhode {
inline namespace v0 {

template <class F, class T>
concept MagneticFieldOn = Real<T> && requires(const F& field, const T& t, const BasicVec3<T>& x) {
  { field.field(t, x) } -> std::same_as<BasicVec3<T>>;
};
// B(t, x), inertial axes.
template <class F>
concept MagneticField = std::copyable<F> && MagneticFieldOn<F, double>;

// A field and how it changes where the body is, in inertial axes.
template <Real T>
struct BasicFieldMotion {
  BasicVec3<T> field;
  BasicVec3<T> rate;
};

// A field at the place of a body: B(t + rest) alone, and with its rate where it has one.
template <class F>
concept LocalField = std::copyable<F> && requires(const F& local, double t) {
  { local.field(t, t) } -> std::same_as<Vec3>;
  { local.motion(t, t) } -> std::same_as<BasicFieldMotion<double>>;
  { local.has_rate() } -> std::same_as<bool>;
};

// At many times: the bits of field(t, rest) and motion(t, rest).
template <LocalField F>
void fields_at(const F& local, const TimeRows& times, const VectorRows& to,
               [[maybe_unused]] InstructionSet set) {
  if constexpr (requires { local.fields(times, to, set); }) {
    local.fields(times, to, set);
  } else {
    for (std::size_t i = 0; i < times.count; ++i)
      to.set(i, local.field(times.t[i], times.rest_of(i)));
  }
}
template <LocalField F>
void field_motions_at(const F& local, const TimeRows& times, const VectorRows& field,
                      const VectorRows& rate, [[maybe_unused]] InstructionSet set) {
  if constexpr (requires { local.motions(times, field, rate, set); }) {
    local.motions(times, field, rate, set);
  } else {
    for (std::size_t i = 0; i < times.count; ++i) {
      const BasicFieldMotion<double> B = local.motion(times.t[i], times.rest_of(i));
      field.set(i, B.field);
      rate.set(i, B.rate);
    }
  }
}

template <class F, class T>
concept LocalFieldOn = Real<T> && requires(const F& local, const T& t) {
  { local.field(t, t) } -> std::same_as<BasicVec3<T>>;
};

// How a primary stands and turns. Its axis 3 is the pole; the meridian is the angle of its axis 1
// at the epoch, from the ascending node of its equator on inertial axes 1 and 2, or from inertial
// axis 1 where the pole is axis 3 (the Earth: Greenwich sidereal time).
struct PrimaryRotation {
  Vec3 pole{0.0, 0.0, 1.0};  // of any length
  double rate = 0.0;
  double meridian = 0.0;
  double epoch = 0.0;

  constexpr bool operator==(const PrimaryRotation&) const = default;
};
// From the axes of the primary at its epoch to inertial ones. DomainError for what is no rotation.
Quaternion axes_at_epoch(const PrimaryRotation& primary);

// Of degree one, as the IGRF lists them.
struct GaussCoefficients {
  double g10;
  double g11;
  double h11;

  constexpr bool operator==(const GaussCoefficients&) const = default;
};

class DipoleField {
 public:
  // `strength` is K along the axes of the primary.
  explicit DipoleField(const Vec3& strength, const PrimaryRotation& primary = {});
  static DipoleField from_gauss(const GaussCoefficients& gauss, double reference_radius,
                                const PrimaryRotation& primary = {});

  const Vec3& strength() const { return strength_; }
  const PrimaryRotation& primary() const { return primary_; }
  // That of the primary.
  double time_scale() const;

  // K(t) in inertial axes.
  template <Real T>
  BasicVec3<T> strength_at(const T& t) const {
    return strength_of(angle_.at(t));
  }
  template <Real T>
  BasicVec3<T> field(const T& t, const BasicVec3<T>& x) const {
    return field_of(strength_at(t), x);
  }
  // At many times and places x, with the rate of the field along a motion with velocities v: the
  // bits of field() in double, and of its Dual. Rests of times are not looked at. A place may be
  // where its field goes.
  void fields(const TimeRows& times, const VectorRows& x, const VectorRows& field,
              InstructionSet set) const;
  void motions(const TimeRows& times, const VectorRows& x, const VectorRows& v,
               const VectorRows& field, const VectorRows& rate, InstructionSet set) const;

 private:
  // Of sine and cosine of the angle of the primary.
  template <Real T>
  BasicVec3<T> strength_of(const SinCos<T>& angle) const {
    const T &s = angle.sin, &c = angle.cos;
    const auto turned = [&](double along, double across, double side) {
      return T(along) + (c * T(across) + s * T(side));
    };
    return {turned(along_.x, across_.x, side_.x), turned(along_.y, across_.y, side_.y),
            turned(along_.z, across_.z, side_.z)};
  }
  template <Real T>
  static BasicVec3<T> field_of(const BasicVec3<T>& K, const BasicVec3<T>& x) {
    using std::sqrt;
    const T r2 = dot(x, x);
    const T f = T(1.0) / ((r2 * r2) * sqrt(r2));
    return (T(3.0) * dot(K, x) * f) * x - (r2 * f) * K;
  }
  // f(i, sine, cosine) of the angle at every time
  template <class F>
  void each_angle(const TimeRows& times, InstructionSet set, const F& f) const;

  Vec3 strength_;
  PrimaryRotation primary_;
  UniformAngle angle_;
  Vec3 along_, across_, side_;  // of K at the epoch: along the pole, across it, and pole x K
};

// A field that a function gives: f(t, x), generic on the number type or for double alone. Generic
// ones have a rate.
template <class F>
class FieldFunction {
 public:
  explicit FieldFunction(F function) : function_(std::move(function)) {}

  template <Real T>
    requires std::same_as<std::invoke_result_t<const F&, const T&, const BasicVec3<T>&>,
                          BasicVec3<T>>
  BasicVec3<T> field(const T& t, const BasicVec3<T>& x) const {
    return function_(t, x);
  }

 private:
  F function_;
};

// The same field at any time.
class ConstantField {
 public:
  explicit ConstantField(const Vec3& field_I);

  const Vec3& value() const { return field_; }
  static bool has_rate() { return true; }

  template <Real T>
  BasicVec3<T> field(const T&, const T&) const {
    return {T(field_.x), T(field_.y), T(field_.z)};
  }
  template <Real T>
  BasicFieldMotion<T> motion(const T& t, const T& rest) const {
    return {field(t, rest), {}};
  }

 private:
  Vec3 field_;
};

// A field at the place of the body that a function of time gives, for double alone: it has no rate.
class FieldOfTime {
 public:
  explicit FieldOfTime(std::function<Vec3(double)> function) : function_(std::move(function)) {}

  static bool has_rate() { return false; }
  Vec3 field(const double& t, const double&) const { return function_(t); }
  BasicFieldMotion<double> motion(const double& t, const double& rest) const {
    return {field(t, rest), {}};
  }

 private:
  std::function<Vec3(double)> function_;
};

template <Orbit O, MagneticField F>
class FieldAlongOrbit {
 public:
  FieldAlongOrbit(O orbit, F field) : orbit_(std::move(orbit)), field_(std::move(field)) {}

  const O& orbit() const { return orbit_; }
  const F& source() const { return field_; }
  // The shorter one of orbit and field.
  double time_scale() const { return std::fmin(time_scale_of(orbit_), time_scale_of(field_)); }
  // Whether orbit and field can be differentiated by time.
  bool has_rate() const {
    if constexpr (!differentiable<double>) {
      return false;
    } else if constexpr (requires { orbit_.supports_velocity(); }) {
      return orbit_.supports_velocity();
    } else {
      return true;
    }
  }

  // At many times (many_times.hpp), field() and motion() in double.
  void fields(const TimeRows& times, const VectorRows& to, InstructionSet set) const {
    positions_at(orbit_, times, to, set);
    if constexpr (requires { field_.fields(times, to, to, set); }) {
      field_.fields(times, to, to, set);
    } else {
      for (std::size_t i = 0; i < times.count; ++i) to.set(i, field_.field(times.t[i], to.at(i)));
    }
  }
  void motions(const TimeRows& times, const VectorRows& field, const VectorRows& rate,
               InstructionSet set) const {
    if constexpr (!differentiable<double>) {
      detail::field_without_rate();
    } else {
      motions_at(orbit_, times, field, rate, set);
      if constexpr (requires { field_.motions(times, field, rate, field, rate, set); }) {
        field_.motions(times, field, rate, field, rate, set);
      } else {
        for (std::size_t i = 0; i < times.count; ++i) {
          using D = Dual<double, 1>;
          const Vec3 x = field.at(i), v = rate.at(i);
          const BasicVec3<D> B = field_.field(D::variable(times.t[i], 0),
                                              {D(x.x, {v.x}), D(x.y, {v.y}), D(x.z, {v.z})});
          field.set(i, detail::values_of(B));
          rate.set(i, {B.x.derivative[0], B.y.derivative[0], B.z.derivative[0]});
        }
      }
    }
  }

  // For a Dual: at a time that no variable moves.
  template <Real T>
    requires(detail::is_dual_number<T> || MagneticFieldOn<F, T>)
  BasicVec3<T> field(const T& t, const T& rest) const {
    if constexpr (detail::is_dual_number<T>) {
      const auto B = field(t.value, rest.value);
      return {B.x, B.y, B.z};
    } else {
      return field_.field(t, position_at(orbit_, t, rest));
    }
  }
  template <Real T>
    requires(detail::is_dual_number<T> || MagneticFieldOn<F, T>)
  BasicFieldMotion<T> motion(const T& t, const T& rest) const {
    if constexpr (detail::is_dual_number<T>) {
      const auto B = motion(t.value, rest.value);
      return {{B.field.x, B.field.y, B.field.z}, {B.rate.x, B.rate.y, B.rate.z}};
    } else if constexpr (differentiable<T>) {
      // t alone: what its rest adds to the rate of a field is far below a rounding of the torque
      const auto time = Dual<T, 1>::variable(t, 0);
      const BasicVec3<Dual<T, 1>> B = field_.field(time, orbit_.position(time));
      return {detail::values_of(B), {B.x.derivative[0], B.y.derivative[0], B.z.derivative[0]}};
    } else if constexpr (differentiable<double> && !std::same_as<T, double>) {
      const BasicFieldMotion<double> B = motion(to_double(t), 0.0);
      return {field(t, rest), {T(B.rate.x), T(B.rate.y), T(B.rate.z)}};
    } else {
      detail::field_without_rate();
    }
  }

 private:
  template <class T>
  static constexpr bool differentiable = OrbitOn<O, Dual<T, 1>> && MagneticFieldOn<F, Dual<T, 1>>;

  O orbit_;
  F field_;
};

}  // namespace v0
}  // namespace polhode
