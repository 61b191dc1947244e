// SPDX-License-Identifier: MIT
// Magnetic torques: the residual dipole of a spacecraft, and the eddy currents in its conductors.
//
// Equations   residual dipole: u = m x B, H' = -m.B. Eddy currents: u = (M (w x B - dB/dt)) x B,
//             M the magnetic tensor, w = I^-1 g the inertial angular velocity, dB/dt the derivative
//             of the field at the body in inertial axes: dB/dt - w x B is how the body sees its
//             field change (Sagnieres 2018, eq. 2.20, as D-SPOSE has it). Without dB/dt it is u =
//             (M (w x B)) x B: the body comes to rest in space and not in the field.
// Units       m torque per field, M torque per rate and field squared; SI: A m2 and S m4.
// Domain      vectors and tensors in principal body axes. M symmetric (to 8 eps of its largest
//             entry) and non-negative definite (to as much). The field in inertial axes.
// Accuracy    a few roundings of the torque.
// Errors      DomainError for a moment or a tensor that is not finite, not symmetric, or would
//             drive the body; for a rate of a field that has none.
// Cost        the field and some 60 flops.
#pragma once

#include <utility>

#include "polhode/perturb/detail/argument_checks.hpp"
#include "polhode/perturb/effect.hpp"
#include "polhode/perturb/magnetic_field.hpp"

namespace polhode {
inline namespace v0 {

template <LocalField F>
class ResidualDipole {
 public:
  static constexpr bool kick = true;

  ResidualDipole(const Vec3& m_B, F field) : m_(m_B), field_(std::move(field)) {
    detail::require_dipole(m_B);
  }

  const Vec3& moment() const { return m_; }
  const F& field() const { return field_; }
  double time_scale() const { return time_scale_of(field_); }

  template <Real T>
    requires LocalFieldOn<F, T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return {{}, cross(moment_of<T>(), field_B(at))};
  }
  template <Real T>
    requires LocalFieldOn<F, T>
  T energy(const BasicSetting<T>& at) const {
    return -dot(moment_of<T>(), field_B(at));
  }

 private:
  template <Real T>
  BasicVec3<T> moment_of() const {
    return {T(m_.x), T(m_.y), T(m_.z)};
  }
  template <Real T>
  BasicVec3<T> field_B(const BasicSetting<T>& at) const {
    return body_from_inertial(at, field_.field(at.t, at.t_rest));
  }

  Vec3 m_;
  F field_;
};

// Whether eddy currents are those of a field that changes along the orbit.
enum class FieldRate { along_orbit, left_out };

template <LocalField F>
class EddyCurrents {
 public:
  EddyCurrents(const Mat3& M_B, F field, FieldRate rate = FieldRate::along_orbit)
      : M_(detail::checked_magnetic_tensor(M_B)), field_(std::move(field)), rate_(rate) {
    if (rate == FieldRate::along_orbit) detail::require_field_rate(field_.has_rate());
  }

  const Mat3& tensor() const { return M_; }
  const F& field() const { return field_; }
  double time_scale() const { return time_scale_of(field_); }
  FieldRate rate() const { return rate_; }

  template <Real T>
    requires LocalFieldOn<F, T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const Vec3& I = at.body.moments();
    const BasicVec3<T> w{at.s.g.x / T(I.x), at.s.g.y / T(I.y), at.s.g.z / T(I.z)};
    const BasicFieldMotion<T> B = seen(at);
    return {{}, cross(times_tensor(cross(w, B.field) - B.rate), B.field)};
  }

  // A = [B] M [B]^T I^-1, c = [B] M dB/dt, [B] x = B x x
  AffineTorque affine_torque(const Setting& at) const {
    const Vec3& I = at.body.moments();
    const BasicFieldMotion<double> B = seen(at);
    Mat3 A;
    for (int j = 0; j < 3; ++j) {
      Vec3 w;
      w[j] = 1.0 / I[j];
      const Vec3 column = cross(B.field, times_tensor(cross(w, B.field)));
      for (int i = 0; i < 3; ++i) A(i, j) = column[i];
    }
    return {cross(B.field, times_tensor(B.rate)), A};
  }

 private:
  // Field and rate in body axes.
  template <Real T>
  BasicFieldMotion<T> seen(const BasicSetting<T>& at) const {
    if (rate_ == FieldRate::left_out)
      return {body_from_inertial(at, field_.field(at.t, at.t_rest)), {}};
    const BasicFieldMotion<T> B = field_.motion(at.t, at.t_rest);
    return {body_from_inertial(at, B.field), body_from_inertial(at, B.rate)};
  }
  template <Real T>
  BasicVec3<T> times_tensor(const BasicVec3<T>& x) const {
    const auto row = [&](int i) {
      return T(M_(i, 0)) * x.x + T(M_(i, 1)) * x.y + T(M_(i, 2)) * x.z;
    };
    return {row(0), row(1), row(2)};
  }

  Mat3 M_;
  F field_;
  FieldRate rate_;
};

}  // namespace v0
}  // namespace polhode
