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
#include "polhode/perturb/detail/turned_back.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

template <Orbit O>
class GravityGradient {
 public:
  static constexpr bool kick = true;

  GravityGradient(double gm, O orbit, SpaceAxes axes = SpaceAxes::inertial)
      : gm_(gm), orbit_(std::move(orbit)), axes_(axes) {
    detail::require_gravity(gm);
  }

  double gm() const { return gm_; }
  const O& orbit() const { return orbit_; }
  double time_scale() const { return time_scale_of(orbit_); }
  SpaceAxes axes() const { return axes_; }

  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const Direction<T> d = direction(at);
    const Vec3& I = at.body.moments();
    const BasicVec3<T>& n = d.along_B;
    // not n x (I n): what is equal in I would cancel
    return {{},
            (T(3.0) * d.strength) * BasicVec3<T>{(T(I.z) - T(I.y)) * (n.y * n.z),
                                                 (T(I.x) - T(I.z)) * (n.z * n.x),
                                                 (T(I.y) - T(I.x)) * (n.x * n.y)}};
  }

  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    const Direction<T> d = direction(at);
    const Vec3& I = at.body.moments();
    const BasicVec3<T>& n = d.along_B;
    // 3 n.I n - tr I with |n| = 1, a sum of differences of moments
    const T sum = (T(I.x) - T(I.y)) * (n.x * n.x - n.y * n.y) +
                  (T(I.y) - T(I.z)) * (n.y * n.y - n.z * n.z) +
                  (T(I.z) - T(I.x)) * (n.z * n.z - n.x * n.x);
    return T(0.5) * d.strength * sum;
  }

 private:
  template <Real T>
  struct Direction {
    BasicVec3<T> along_B;  // of any length
    T strength;            // gm / r^3 over the square of that length
  };
  template <Real T>
  Direction<T> direction(const BasicSetting<T>& at) const {
    using std::sqrt;
    BasicVec3<T> x = position_at(orbit_, at.t, at.t_rest);
    const BasicQuaternion<T>& q = at.s.q;
    const T r2 = dot(x, x), q2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    // one root and one division, beside the turn of x and not after it: an integrator waits for
    // them
    const T strength = T(gm_) / ((r2 * sqrt(r2)) * (r2 * (q2 * q2)));
    const bool is_turned = !(at.q_IS == BasicQuaternion<T>{});
    if (axes_ == SpaceAxes::inertial && is_turned) x = detail::turned_back(at.q_IS, x);
    return {detail::turned_back_longer(q, x), strength};
  }

  double gm_;
  O orbit_;
  SpaceAxes axes_;
};

}  // namespace v0
}  // namespace polhode
