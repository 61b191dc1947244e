// SPDX-License-Identifier: MIT
// Body: the validated, immutable principal moments of inertia of a rigid body.
//
// Equations   [SA (15)]; kinetic energy T = (1/2) g . omega [SA "kinetic"], omega_i = g_i / I_i
//             [SA (24)].
// Units       any consistent unit of moment of inertia; the library is scale-free.
// Domain      three positive moments in any order with Imax <= Imid + Imin (to 4 eps Imax: flat
//             bodies are allowed and stored as given). Axisymmetric and spherical bodies are
//             ordinary input. A full tensor must be symmetric to 8 eps of its largest entry; if its
//             largest moment exceeds the sum of the others by at most 1e-9 of itself, as that of a
//             plate moved by the parallel axis theorem and back, it is set to the sum.
// Accuracy    moments are stored bit for bit; those of a tensor are exact to the rounding of a
//             symmetric eigen-solver.
// Errors      DomainError naming the moments and the inequality they break; a zero quaternion.
// Cost        a few comparisons; from_tensor diagonalises one 3x3 matrix.
#pragma once

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// [SA (15), (A4)]
class Body {
 public:
  // Principal moments about the body axes b1, b2, b3, in any order.
  Body(double I1, double I2, double I3);

  // Full inertia tensor in body-fixed axes F, whose element (1, 2) is minus the integral of x y dm;
  // finds the principal axes B and keeps the rotation between them.
  static Body from_tensor(const Mat3& tensor_F);

  // Principal moments with a rotation to body-fixed axes F that is known already.
  static Body with_axes(const Vec3& moments, const Quaternion& q_FB);

  // Moments about b1, b2, b3, as given.
  const Vec3& moments() const { return moments_; }
  // Rotation from principal axes to the axes of the tensor: v_F = q_FB v_B q_FB*. Identity when
  // built from moments.
  const Quaternion& q_FB() const { return q_FB_; }

 private:
  Body(const Vec3& moments, const Quaternion& q_FB) : moments_(moments), q_FB_(q_FB) {}
  Vec3 moments_;
  Quaternion q_FB_;
};

// omega_B = I^-1 g_B  [SA (24), (A5), (A7), (A8)]
Vec3 angular_velocity(const Body& body, const RotorState& s);
// omega_I: the same vector in inertial components  [SA (8)-(11)]
Vec3 inertial_angular_velocity(const Body& body, const RotorState& s);
// T = (1/2) g . I^-1 g  [SA "kinetic", (13), "2T", (A6), (A10)-(A12), "Binet", (A55)]
double kinetic_energy(const Body& body, const RotorState& s);

}  // namespace v0
}  // namespace polhode
