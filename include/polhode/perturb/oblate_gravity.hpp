// SPDX-License-Identifier: MIT
// OblateGravity: what the oblateness (J2) of the attracting body adds to the gravity gradient. It
// has nothing of the point mass: that is GravityGradient, which goes with it.
//
// Equations   the field is U = -gm / r (1 - J2 (R / r)^2 P2(n.k)), n = r / |r|, k the pole; of its
//             part U' in J2, H' = (1/2) U'_ij integral of x_i x_j dm = -(1/2) U'_ij I_ij, since U'
//             is harmonic:
//             H' = -(s/2) (3 k.Ik - 30 z k.In + (15/2) (7 z^2 - 1) n.In - (3/2) (5 z^2 - 1) tr I),
//             u = -(s/2) (6 k x Ik - 30 z (k x In + n x Ik) + 15 (7 z^2 - 1) n x In),
//             s = gm J2 R^2 / r^5, z = n.k.
// Units       gm, R and the orbit in the same units of length and time; I in those of the body.
// Domain      gm > 0, R > 0, any J2 (for a prolate body it is negative), a pole of any length but
//             0 along the axes of the orbit. The orbit may be that of either body as seen from the
//             other. Left out are J2 with the body's moments of degree 3 and 4, and J3, J4, ... .
// Accuracy    a few roundings of the torque; a sphere has none, exactly.
// Errors      DomainError for a gm that is not positive; of Oblateness, for an R that is not, a J2
//             that is not finite, no pole.
// Cost        one position and some 150 flops. For Tangent the orbit is evaluated in double.
#pragma once

#include <utility>

#include "polhode/perturb/detail/argument_checks.hpp"
#include "polhode/perturb/detail/symmetric_torque.hpp"
#include "polhode/perturb/detail/valid_oblateness.hpp"
#include "polhode/perturb/gravity_gradient.hpp"

namespace polhode {
inline namespace v0 {

// DomainError where it is made for a radius that is not positive, a J2 that is not finite, no pole.
struct Oblateness {
  double J2;
  double radius;                // the equatorial radius that J2 belongs to
  Vec3 pole = {0.0, 0.0, 1.0};  // the axis of figure, along the axes of the orbit
  // Last, and left out: it looks at the others, and holds nothing.
  [[no_unique_address]] detail::ValidOblateness sound = {J2, radius, pole};

  constexpr bool operator==(const Oblateness&) const = default;
};

// What an oblate primary does, apart from where it is.
struct OblateGravityLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  constexpr bool operator==(const OblateGravityLaw&) const = default;

  template <Number T>
  struct OfTime {
    BasicVec3<T> x_S;
    T inverse;  // 1 / r
    BasicVec3<T> pole_S;
    T inverse_pole;
    T strength;  // gm J2 R^2 / r^5
  };

  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& where, const BasicPose<T>& at) const {
    const Directions<T> d = directions(where, at);
    const BasicVec3<T>& I = at.moments;
    const T half(0.5), z = dot(d.n, d.k);
    const BasicVec3<T> sum = T(3.0) * detail::turning(I, d.k, d.k) +
                             (T(-30.0) * z) * detail::turning(I, d.k, d.n) +
                             (T(7.5) * (T(7.0) * z * z - T(1.0))) * detail::turning(I, d.n, d.n);
    return {{}, (-half * where.strength) * sum};
  }

  template <Number T>
  struct Directions {
    BasicVec3<T> n;  // of the orbit, body axes
    BasicVec3<T> k;  // of the pole
  };
  template <Number T>
  Directions<T> directions(const OfTime<T>& where, const BasicPose<T>& at) const {
    return {where.inverse * body_from_reference(at, where.x_S),
            where.inverse_pole * body_from_reference(at, where.pole_S)};
  }
};

template <Orbit O>
class OblateGravity {
 public:
  static constexpr bool kick = true;
  using Law = OblateGravityLaw;

  OblateGravity(double gm, O orbit, const Oblateness& of, SpaceAxes axes = SpaceAxes::inertial)
      : gm_(gm),
        orbit_(std::move(orbit)),
        of_(of),
        axes_(axes),
        strength_(detail::checked_strength(gm, of)) {}

  double gm() const { return gm_; }
  static Law law() { return {}; }
  const O& orbit() const { return orbit_; }
  double time_scale() const { return time_scale_of(orbit_); }
  const Oblateness& oblateness() const { return of_; }
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
    using std::sqrt;
    const BasicVec3<T>& x = position[0];
    const BasicVec3<T> pole{T(of_.pole.x), T(of_.pole.y), T(of_.pole.z)};
    const T s2 = T(1.0) / dot(x, x), s = sqrt(s2);
    return {reference_from_space(at, axes_, x), s, reference_from_space(at, axes_, pole),
            T(1.0) / norm(pole), T(strength_) * (s2 * s2 * s)};
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law().effect(of_time(at), pose_of(at));
  }

  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    const Law::OfTime<T> where = of_time(at);
    const Law::Directions<T> d = law().directions(where, pose_of(at));
    const Vec3& I = at.body.moments();
    const T z = dot(d.n, d.k);
    // I less its mean: H' does not see it, and what is equal in I would cancel
    const auto product = [&](const BasicVec3<T>& a, const BasicVec3<T>& b) {
      const T x = T(I.x), y = T(I.y), m = T(I.z);
      return ((x - y) + (x - m)) * (a.x * b.x) + ((y - m) + (y - x)) * (a.y * b.y) +
             ((m - x) + (m - y)) * (a.z * b.z);
    };
    const T sum = T(3.0) * product(d.k, d.k) - T(30.0) * z * product(d.k, d.n) +
                  T(7.5) * (T(7.0) * z * z - T(1.0)) * product(d.n, d.n);
    return -where.strength * sum / T(6.0);
  }

 private:
  double gm_;
  O orbit_;
  Oblateness of_;
  SpaceAxes axes_;
  double strength_;
};

}  // namespace v0
}  // namespace polhode
