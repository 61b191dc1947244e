// SPDX-License-Identifier: MIT
// Attitude in its other forms, rotation matrix and 3-1-3 angles, and the hub state from an attitude
// and an angular velocity.
//
// Equations   R = R3(psi) R1(theta) R3(phi) [SA (1), (2)], inertial to body: the rows of R are the
//             body axes. q = qz(phi) qx(theta) qz(psi). g = I omega [SA (24)],
//             omega_I = R^T omega_B [SA (8)].
// Corrections [SA (1)] holds for passive elementary matrices; as active operators it gives R^T.
// Units       angles in radians; rates in radians per unit of time.
// Domain      phi, psi in (-pi, pi], theta in [0, pi]; any angle is accepted as input. At theta = 0
//             psi = 0 and phi + psi is in phi; at theta = pi psi = 0 and phi - psi is in phi.
//             A matrix must be orthogonal to 1e-6 per entry of R R^T - 1, with determinant +1.
// Accuracy    tests/unit/rotor/attitude.cpp. Near theta = 0 the attitude loses nothing, because
//             phi + psi keeps its digits; near theta = pi the same with phi - psi.
// Errors      DomainError from unit_quaternion, from attitude(matrix) and from the rotor_state
//             functions, for input that is not finite, not a rotation, or a zero quaternion.
// Cost        three sincos forth, three atan2 back.
#pragma once

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/detail/euler_frame.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicEulerAngles {
  T phi;
  T theta;
  T psi;

  bool operator==(const BasicEulerAngles&) const
    requires Real<T>
  = default;
};
using EulerAngles = BasicEulerAngles<double>;

// R of [SA (1), (2)]: v_B = R v_I.
template <Number T = double>
BasicMat3<T> attitude_matrix(const BasicQuaternion<T>& q) {
  return transpose(rotation_matrix(normalized(q)));
}

// q = qz(phi) qx(theta) qz(psi)  [SA (1), (2)]
template <Number T>
BasicQuaternion<T> attitude(const BasicEulerAngles<T>& e) {
  using std::cos;
  using std::sin;
  const T half = T(0.5) * e.theta;
  const detail::Phasor<T> phi = detail::phasor(T(T(0.5) * e.phi));
  const detail::Phasor<T> psi = detail::phasor(T(T(0.5) * e.psi));
  return detail::quaternion(
      detail::PhasorPair<T>{T(cos(half)) * (phi * psi), T(sin(half)) * (phi * conj(psi))});
}

// The angles of [SA (1), (2)].
template <Number T = double>
BasicEulerAngles<T> euler_angles(const BasicQuaternion<T>& q) {
  using std::atan2;
  const detail::EulerFrame<T> f = detail::euler_frame(q, BasicVec3<T>{});
  return {detail::argument(f.phi), T(2.0) * T(atan2(f.s, f.c)), detail::argument(f.psi)};
}

// A quaternion as a user types it: finite, not zero; scaled to unit length unless it already has it
// to 4 eps, so that unit input keeps its bits.
Quaternion unit_quaternion(double w, double x, double y, double z);

// Quaternion (body to inertial) of a rotation matrix R (inertial to body).
Quaternion attitude(const Mat3& R);

// The hub state of an attitude and an angular velocity in body or in inertial components.
RotorState rotor_state(const Body& body, const Quaternion& q, const Vec3& omega_B);
RotorState rotor_state_inertial(const Body& body, const Quaternion& q, const Vec3& omega_I);

extern template Mat3 attitude_matrix(const Quaternion&);
extern template Quaternion attitude(const EulerAngles&);
extern template EulerAngles euler_angles(const Quaternion&);

// Attitude as roll, pitch and yaw, the angles of flight.
//
// Equations   q = qz(yaw) qy(pitch) qx(roll): from the frame to the body yaw comes first, about
//             axis 3, then pitch about the new axis 2, then roll about the new axis 1 (3-2-1).
// Units       radians.
// Domain      any attitude. roll and yaw in (-pi, pi], pitch in [-pi/2, pi/2]; where pitch is at
//             its ends yaw is 0 and roll holds both.
// Accuracy    budget roll_pitch_yaw: the angles give the attitude back to rounding, however near to
//             90 degrees pitch is; a rounding of the attitude moves roll and yaw by 1/cos(pitch) of
//             it.
// Errors      none; NaN in, NaN out.
// Cost        three atan2, two hypot.

struct RollPitchYaw {
  double roll;
  double pitch;
  double yaw;

  bool operator==(const RollPitchYaw&) const = default;
};

RollPitchYaw roll_pitch_yaw(const Quaternion& q);
Quaternion attitude(const RollPitchYaw& angles);

}  // namespace v0
}  // namespace polhode
