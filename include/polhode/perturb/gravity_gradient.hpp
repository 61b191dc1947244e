// SPDX-License-Identifier: MIT
// GravityGradient: the torque of a point mass on a rigid body, from any orbit.
//
// Equations   MacCullagh: H' = gm / (2 r^3) (3 n.I n - tr I), u = (3 gm / r^3) n x I n, n = r / |r|
//             in body axes. H' is all of the second-degree potential: it vanishes for a sphere.
//             Left out is the energy of the orbit, -gm m / r, which does not depend on the
//             attitude.
// Units       gm and the orbit in the same units of length and time; I in those of the body.
// Domain      gm > 0. The orbit gives the position of the point mass from the body or of the body
//             from the point mass, in inertial or in reference-frame axes. Several point masses are
//             several terms. Distances whose fifth power is in the range of the number type.
// Accuracy    a few roundings of the torque; a sphere has none, exactly. The length of q_SB does
//             not matter, so neither does its rounding within a step.
// Errors      DomainError for a gm that is not positive.
// Cost        one position and some 60 flops. For Tangent the orbit is evaluated in double.
#pragma once

#include <utility>

#include "polhode/orbit/orbit.hpp"
#include "polhode/perturb/detail/argument_checks.hpp"
#include "polhode/perturb/detail/rotate_inverse.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

// What a point mass does, apart from where it is.
struct GravityGradientLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  double gm;

  constexpr bool operator==(const GravityGradientLaw&) const = default;

  template <Number T>
  struct OfTime {
    BasicVec3<T> x_S;
    T r2;  // |x|^2
    T r3;  // |x|^3
  };

  template <Number T, class InS>
  OfTime<T> of_vectors(const std::array<BasicVec3<T>, 1>& position, const InS& in_S) const {
    using std::sqrt;
    const BasicVec3<T>& x = position[0];
    const T r2 = dot(x, x);
    return {in_S(x), r2, r2 * sqrt(r2)};
  }
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& where, const BasicPose<T>& at) const {
    const Direction<T> d = direction(where, at);
    const BasicVec3<T>& I = at.moments;
    const BasicVec3<T>& n = d.along_B;
    // not n x (I n): what is equal in I would cancel
    return {
        {},
        (T(3.0) * d.strength) * BasicVec3<T>{(I.z - I.y) * (n.y * n.z), (I.x - I.z) * (n.z * n.x),
                                             (I.y - I.x) * (n.x * n.y)}};
  }

  template <Number T>
  struct Direction {
    BasicVec3<T> along_B;  // of any length
    T strength;            // gm / r^3 over the square of that length
  };
  template <Number T>
  Direction<T> direction(const OfTime<T>& where, const BasicPose<T>& at) const {
    const BasicQuaternion<T>& q = at.s.q;
    const T q2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    // one root and one division, next to the turn of x and not after it: an integrator waits for
    // them
    const T strength = T(gm) / (where.r3 * (where.r2 * (q2 * q2)));
    return {detail::turned_back_longer(q, where.x_S), strength};
  }
};

template <Orbit O>
class GravityGradient {
 public:
  static constexpr bool kick = true;
  using Law = GravityGradientLaw;

  GravityGradient(double gm, O orbit, SpaceAxes axes = SpaceAxes::inertial)
      : law_{gm}, orbit_(std::move(orbit)), axes_(axes) {
    detail::require_gravity(gm);
  }

  double gm() const { return law_.gm; }
  const Law& law() const { return law_; }
  const O& orbit() const { return orbit_; }
  double time_scale() const { return time_scale_of(orbit_); }
  SpaceAxes axes() const { return axes_; }

  template <Real T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    return of_vectors<T>(at, {position_at(orbit_, at.t, at.t_rest)});
  }
  static constexpr std::size_t vectors_of_time = 1;
  void vectors_at(const TimeRows& times, const std::array<VectorRows, 1>& to,
                  InstructionSet set) const {
    positions_at(orbit_, times, to[0], set);
  }
  template <Real T>
  Law::OfTime<T> of_vectors(const BasicSetting<T>& at,
                            const std::array<BasicVec3<T>, 1>& position) const {
    const bool is_turned = axes_ == SpaceAxes::inertial && !(at.q_IS == BasicQuaternion<T>{});
    return law_.of_vectors(position, [&](const BasicVec3<T>& x) {
      return is_turned ? detail::rotate_inverse(at.q_IS, x) : x;
    });
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law_.effect(of_time(at), pose_of(at));
  }

  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    const Law::Direction<T> d = law_.direction(of_time(at), pose_of(at));
    const Vec3& I = at.body.moments();
    const BasicVec3<T>& n = d.along_B;
    // 3 n.I n - tr I with |n| = 1, a sum of differences of moments
    const T sum = (T(I.x) - T(I.y)) * (n.x * n.x - n.y * n.y) +
                  (T(I.y) - T(I.z)) * (n.y * n.y - n.z * n.z) +
                  (T(I.z) - T(I.x)) * (n.z * n.z - n.x * n.x);
    return T(0.5) * d.strength * sum;
  }

 private:
  Law law_;
  O orbit_;
  SpaceAxes axes_;
};

}  // namespace v0
}  // namespace polhode
