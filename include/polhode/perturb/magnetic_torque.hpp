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

// What a field does to a dipole that the body has.
struct ResidualDipoleLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  Vec3 m;

  bool operator==(const ResidualDipoleLaw&) const = default;

  template <Number T>
  struct OfTime {
    BasicVec3<T> field;  // along the axes of the reference frame
  };
  template <Number T, class InS>
  OfTime<T> of_vectors(const std::array<BasicVec3<T>, 1>& B, const InS& in_S) const {
    return {in_S(B[0])};
  }
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& B, const BasicPose<T>& at) const {
    return {{}, cross(moment<T>(), body_from_reference(at, B.field))};
  }
  template <Number T>
  BasicVec3<T> moment() const {
    return {T(m.x), T(m.y), T(m.z)};
  }
};

template <LocalField F>
class ResidualDipole {
 public:
  static constexpr bool kick = true;
  using Law = ResidualDipoleLaw;

  ResidualDipole(const Vec3& m_B, F field) : law_{m_B}, field_(std::move(field)) {
    detail::require_dipole(m_B);
  }

  const Vec3& moment() const { return law_.m; }
  const Law& law() const { return law_; }
  const F& field() const { return field_; }
  double time_scale() const { return time_scale_of(field_); }

  template <Real T>
    requires LocalFieldOn<F, T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    return of_vectors<T>(at, {field_.field(at.t, at.t_rest)});
  }
  // The field.
  static constexpr std::size_t vectors_of_time = 1;
  void vectors_at(const TimeRows& times, const std::array<VectorRows, 1>& to,
                  InstructionSet set) const {
    fields_at(field_, times, to[0], set);
  }
  template <Real T>
  Law::OfTime<T> of_vectors(const BasicSetting<T>& at,
                            const std::array<BasicVec3<T>, 1>& field) const {
    return law_.of_vectors(field, in_reference(at));
  }
  template <Real T>
    requires LocalFieldOn<F, T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law_.effect(of_time(at), pose_of(at));
  }
  template <Real T>
    requires LocalFieldOn<F, T>
  T energy(const BasicSetting<T>& at) const {
    return -dot(law_.moment<T>(), body_from_reference(at, of_time(at).field));
  }

 private:
  Law law_;
  F field_;
};

// Whether eddy currents are those of a field that changes along the orbit.
enum class FieldRate { along_orbit, left_out };

// What a field does to a body that conducts: u = (M (w x B - dB/dt)) x B.
struct EddyCurrentsLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  Mat3 M;

  bool operator==(const EddyCurrentsLaw&) const = default;

  template <Number T>
  struct OfTime {  // along the axes of the reference frame
    BasicVec3<T> field;
    BasicVec3<T> rate;
  };
  template <Number T, class InS>
  OfTime<T> of_vectors(const std::array<BasicVec3<T>, 2>& B, const InS& in_S) const {
    return {in_S(B[0]), in_S(B[1])};
  }
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& motion, const BasicPose<T>& at) const {
    const BasicVec3<T>& I = at.moments;
    const BasicVec3<T> w{at.s.g.x / I.x, at.s.g.y / I.y, at.s.g.z / I.z};
    const OfTime<T> B = seen(motion, at);
    return {{}, cross(times_tensor(cross(w, B.field) - B.rate), B.field)};
  }
  // In body axes.
  template <Number T>
  OfTime<T> seen(const OfTime<T>& motion, const BasicPose<T>& at) const {
    return {body_from_reference(at, motion.field), body_from_reference(at, motion.rate)};
  }
  template <Number T>
  BasicVec3<T> times_tensor(const BasicVec3<T>& x) const {
    const auto row = [&](int i) { return T(M(i, 0)) * x.x + T(M(i, 1)) * x.y + T(M(i, 2)) * x.z; };
    return {row(0), row(1), row(2)};
  }
};

template <LocalField F>
class EddyCurrents {
 public:
  using Law = EddyCurrentsLaw;

  EddyCurrents(const Mat3& M_B, F field, FieldRate rate = FieldRate::along_orbit)
      : law_{detail::checked_magnetic_tensor(M_B)}, field_(std::move(field)), rate_(rate) {
    if (rate == FieldRate::along_orbit) detail::require_field_rate(field_.has_rate());
  }

  const Mat3& tensor() const { return law_.M; }
  const Law& law() const { return law_; }
  const F& field() const { return field_; }
  double time_scale() const { return time_scale_of(field_); }
  FieldRate rate() const { return rate_; }

  template <Real T>
    requires LocalFieldOn<F, T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    if (rate_ == FieldRate::left_out) return of_vectors<T>(at, {field_.field(at.t, at.t_rest), {}});
    const BasicFieldMotion<T> B = field_.motion(at.t, at.t_rest);
    return of_vectors<T>(at, {B.field, B.rate});
  }
  // The field and its rate.
  static constexpr std::size_t vectors_of_time = 2;
  void vectors_at(const TimeRows& times, const std::array<VectorRows, 2>& to,
                  InstructionSet set) const {
    if (rate_ == FieldRate::along_orbit) return field_motions_at(field_, times, to[0], to[1], set);
    fields_at(field_, times, to[0], set);
    for (std::size_t i = 0; i < times.count; ++i) to[1].set(i, {});
  }
  template <Real T>
  Law::OfTime<T> of_vectors(const BasicSetting<T>& at, const std::array<BasicVec3<T>, 2>& B) const {
    return law_.of_vectors(B, in_reference(at));
  }
  template <Real T>
    requires LocalFieldOn<F, T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law_.effect(of_time(at), pose_of(at));
  }

  // A = [B] M [B]^T I^-1, c = [B] M dB/dt, [B] x = B x x
  AffineTorque affine_torque(const Setting& at) const {
    const Vec3& I = at.body.moments();
    const Law::OfTime<double> B = law_.seen(of_time(at), pose_of(at));
    Mat3 A;
    for (int j = 0; j < 3; ++j) {
      Vec3 w;
      w[j] = 1.0 / I[j];
      const Vec3 column = cross(B.field, law_.times_tensor(cross(w, B.field)));
      for (int i = 0; i < 3; ++i) A(i, j) = column[i];
    }
    return {cross(B.field, law_.times_tensor(B.rate)), A};
  }

 private:
  Law law_;
  F field_;
  FieldRate rate_;
};

}  // namespace v0
}  // namespace polhode
