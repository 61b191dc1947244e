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
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"

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

// The frame of the local vertical of an orbit (LVLH): what roll, pitch and yaw of a satellite refer
// to.
//
// Equations   axis 3 points to the centre, axis 2 against the normal of the orbit, axis 1 = 2 x 3
//             towards the motion: LVLH_ROTATING of the SANA registry that CCSDS 502.0-B-3 names.
//             q_IS = Rz(node) Rx(i) Rz(u) (1, -1, -1, 1) / 2, u the argument of latitude; of a
//             table the shortest turn to its normal in place of Rz(node) Rx(i).
// Units       those of the orbit.
// Domain      any ellipse or hyperbola. Of an orbit that precesses the plane is that of its
//             elements at the time, not that of position and velocity; of a table it is the latter,
//             from first to last row, less than half a turn apart. Other authors call axes
//             LVLH whose first points away from the centre.
// Accuracy    that of the position: budget local_vertical_axes. q_IS does not change its sign from
//             one turn to the next; mu is its derivative by dual numbers.
// Errors      DomainError for a table of order 2, whose path has no curvature between rows; NaN
//             outside a table.
// Cost        two positions of the orbit; of a table some 2 us, and making the frame walks all
//             rows, 0.33 s for a million.

Frame local_vertical_frame(const KeplerOrbit& orbit);
Frame local_vertical_frame(const PrecessingKeplerOrbit& orbit);
Frame local_vertical_frame(const TurnedKeplerOrbit& orbit);
Frame local_vertical_frame(const TableOrbit& orbit);

// The frame of the plane of an orbit at each time (of date): what a rotation is told in that keeps
// to an orbit whose plane moves.
//
// Equations   axis 3 is the normal of the plane. Axis 1 is the ascending node on inertial axes 1
//             and 2, q_IS = Rz(node) Rx(i); or, without a node, where the shortest turn from axis 3
//             of inertial axes to the normal brings axis 1, q_IS = (1 + n_3, -n_2, n_1, 0) /
//             sqrt(2 (1 + n_3)).
// Units       those of the orbit.
// Domain      of elements the plane is theirs, of a table that of position and velocity at the
//             time, with all its terms of short period. The node needs an inclination: at i = 0 and
//             180 degrees it is NaN, and next to them it runs. The shortest turn serves for all
//             but 180 degrees, but keeps a small turn about the normal of its own.
// Accuracy    that of the plane. mu is the derivative of q_IS by dual numbers: budget orbit_plane_*
//             against differences. Of a table it takes the second derivative between rows.
// Errors      DomainError for a table of order 2, whose path has no curvature between rows; NaN
//             outside a table.
// Cost        of a table some 2 us a time, of elements 0.2 us. Making the frame of a table by its
//             node walks all rows, 0.16 s for a million.

enum class PlaneOrigin { node, shortest_turn };

Frame orbit_plane_frame(const KeplerOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);
Frame orbit_plane_frame(const PrecessingKeplerOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);
Frame orbit_plane_frame(const TurnedKeplerOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);
Frame orbit_plane_frame(const TableOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);

}  // namespace v0
}  // namespace polhode
