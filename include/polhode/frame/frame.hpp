// SPDX-License-Identifier: MIT
// Frame: the attitude and rate of the reference frame S in which a rotation is described.
// Kinematics only: the system adds what a moving frame does to the equations of motion.
//
// Equations   v_I = q_IS v_S q_IS*, dq_IS/dt = (1/2) q_IS (0, mu_S): mu_S is the angular velocity
//             of S with respect to inertial axes, in components of S [SA section 4].
// Units       q none; mu in rad per time.
// Domain      inertial; uniformly precessing about a fixed axis; an orbit plane with node Omega(t)
//             and inclination i(t), or with p = sin(i) sin(Omega), q = sin(i) cos(Omega), i <= 90
//             degrees; any attitude q_IS(t) that the user writes as a template function. T is
//             double, DoubleDouble, or a Dual of them.
// Accuracy    budget frame_*. The angle of a uniform precession is formed and reduced in
//             double-double: rate x time of 1e9 rad loses nothing. mu of a user's function is the
//             derivative of q_IS by dual numbers, so that the two cannot disagree.
// Errors      DomainError for a rate, epoch or axis that is not finite, an axis of length 0. p^2 +
//             q^2 > 1 gives NaN; what a user's function throws passes through.
// Cost        inertial none; precessing one sincos; a user's functions with one derivative.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "polhode/frame/detail/erased_frame.hpp"
#include "polhode/frame/frame_motion.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {

class Frame {
 public:
  static Frame inertial() { return Frame(nullptr); }

  // Precession with a constant rate about a constant axis (the same components in I and in S;
  // |axis| is not used); S coincides with I at `epoch`.
  static Frame precessing(const Vec3& axis, double rate, double epoch = 0.0);

  // The axes of an orbit: x along the ascending node, z along the normal; q_IS = Rz(Omega) Rx(i).
  // Omega(t) and i(t) are generic callables on a number type.
  template <class Node, class Inclination>
  static Frame orbit_plane(Node Omega, Inclination i) {
    return from_attitude(
        [Omega, i](const auto& t) { return rotation_z(Omega(t)) * rotation_x(i(t)); });
  }
  // The same plane without a node, regular at i = 0: x is the direction that the shortest turn
  // brings from the inertial x axis. p = sin(i) sin(Omega), q = sin(i) cos(Omega).
  template <class P, class Q>
  static Frame orbit_plane_pq(P p, Q q) {
    return from_attitude([p, q](const auto& t) { return shortest_turn(p(t), q(t)); });
  }

  // Any unit quaternion q_IS(t), as a generic callable on a number type.
  template <class F>
  static Frame from_attitude(F q_IS) {
    return Frame(std::make_shared<const detail::HeldFrame<F>>(std::move(q_IS)));
  }

  bool is_inertial() const { return motion_ == nullptr; }

  // T = double or DoubleDouble; for a Dual state the time is its value (Frame depends on it alone).
  template <Real T>
  BasicFrameMotion<T> at(const T& t) const {
    return is_inertial() ? BasicFrameMotion<T>{} : motion_->at(t);
  }
  template <Real T, int N>
  BasicFrameMotion<Dual<T, N>> at(const Dual<T, N>& t) const {
    const BasicFrameMotion<T> m = at(t.value);
    using D = Dual<T, N>;
    return {{D(m.q_IS.w), D(m.q_IS.x), D(m.q_IS.y), D(m.q_IS.z)},
            {D(m.mu_S.x), D(m.mu_S.y), D(m.mu_S.z)}};
  }

 private:
  explicit Frame(std::shared_ptr<const detail::ErasedFrame> motion) : motion_(std::move(motion)) {}

  // The turn from inertial z to the pole (p, -q, sqrt(1 - p^2 - q^2)) about the node.
  template <Real T>
  static BasicQuaternion<T> shortest_turn(const T& p, const T& q) {
    using std::sqrt;
    const T one(1.0), half(0.5);
    const T cos_i = sqrt(one - (p * p + q * q));
    const T c = sqrt(half * (one + cos_i));
    return {c, half * q / c, half * p / c, T(0.0)};
  }

  std::shared_ptr<const detail::ErasedFrame> motion_;
};

}  // namespace v0
}  // namespace polhode
