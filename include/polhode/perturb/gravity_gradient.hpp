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
#include "polhode/perturb/detail/harmonic_gradient.hpp"
#include "polhode/perturb/detail/rotate_inverse.hpp"
#include "polhode/perturb/detail/symmetric_torque.hpp"
#include "polhode/perturb/detail/valid_oblateness.hpp"
#include "polhode/perturb/effect.hpp"
#include "polhode/shape/mass_properties.hpp"

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

// HigherGravity: what a point mass does to the third- and fourth-degree inertia integrals of a
// body. It has nothing of degree 2: that is GravityGradient, which goes with it.
//
// Equations   from H' = -gm integral dm / |r - x|, |r - x|^-1 = sum |x|^k P_k(cos) / r^(k + 1), n =
//             r / |r| in body axes from the body to the point mass:
//             H'_3 = -gm / (2 r^4) (5 n_i n_j n_k m_ijk - 3 n_i m_ijj),
//             H'_4 = -gm / (8 r^5) (35 n_i n_j n_k n_l m_ijkl - 30 n_i n_j m_ijkk + 3 m_iijj),
//             m_ij.. = integral of x_i x_j .. dm. With H'_k = -gm p_k(n) / r^(k + 1), p_k harmonic,
//             u = -gm n x grad p_k(n) / r^(k + 1).
// Units       gm and the orbit in the same units of length and time; the moments of mass in those
//             of the body and that length.
// Domain      gm > 0. Moments about the centre of mass along principal axes. Degree 3 changes sign
//             with r, so it must be said whose path the orbit is. What is left out is of degree 5.
// Accuracy    a few roundings of the torque.
// Errors      DomainError for a gm that is not positive, for moments that are not finite.
// Cost        one position and some 200 flops. For Tangent the orbit is evaluated in double.

// Whose path an orbit is: that of the attracting mass as seen from the body, or that of the body as
// seen from the attracting mass.
enum class OrbitOf { attractor, body };

// What a point mass does, apart from where it is.
struct HigherGravityLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  detail::HarmonicGradient<3> third;
  detail::HarmonicGradient<4> fourth;

  bool operator==(const HigherGravityLaw&) const = default;

  template <Number T>
  struct OfTime {
    BasicVec3<T> x_S;
    T inverse;  // 1 / r, from the body to the point mass
    T third;    // gm / r^4
    T fourth;   // gm / r^5
  };

  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& where, const BasicPose<T>& at) const {
    const BasicVec3<T> n = direction(where, at);
    const Slopes<T> p = slopes(n);
    return {{}, cross(n, -where.third * p.third - where.fourth * p.fourth)};
  }

  template <Number T>
  BasicVec3<T> direction(const OfTime<T>& where, const BasicPose<T>& at) const {
    return where.inverse * body_from_reference(at, where.x_S);
  }
  template <Number T>
  struct Slopes {
    BasicVec3<T> third;
    BasicVec3<T> fourth;
  };
  template <Number T>
  Slopes<T> slopes(const BasicVec3<T>& n) const {
    const shape::BasicMoments<T, 2> squares{n.x * n.x, n.x * n.y, n.x * n.z,
                                            n.y * n.y, n.y * n.z, n.z * n.z};
    const shape::BasicMoments<T, 3> cubes = detail::cubes_of(squares, n);
    return {detail::gradient<3>(third, squares), detail::gradient<4>(fourth, cubes)};
  }
};

template <Orbit O>
class HigherGravity {
 public:
  static constexpr bool kick = true;
  using Law = HigherGravityLaw;

  HigherGravity(double gm, O orbit, const shape::MassMoments& moments_B, OrbitOf orbit_of,
                SpaceAxes axes = SpaceAxes::inertial)
      : gm_(gm), orbit_(std::move(orbit)), moments_(moments_B), orbit_of_(orbit_of), axes_(axes) {
    detail::require_higher_gravity(gm, moments_B);
    law_ = {detail::potential_gradient(moments_B.third),
            detail::potential_gradient(moments_B.fourth)};
  }

  double gm() const { return gm_; }
  const Law& law() const { return law_; }
  const O& orbit() const { return orbit_; }
  double time_scale() const { return time_scale_of(orbit_); }
  const shape::MassMoments& moments() const { return moments_; }
  OrbitOf orbit_of() const { return orbit_of_; }
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
    const T s2 = T(1.0) / dot(x, x), s = sqrt(s2);
    const T third = T(gm_) * (s2 * s2);
    return {reference_from_space(at, axes_, x), orbit_of_ == OrbitOf::body ? -s : s, third,
            third * s};
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law_.effect(of_time(at), pose_of(at));
  }

  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    const Law::OfTime<T> d = of_time(at);
    const BasicVec3<T> n = law_.direction(d, pose_of(at));
    const Law::Slopes<T> p = law_.slopes(n);
    return -d.third * dot(n, p.third) / T(3.0) - d.fourth * dot(n, p.fourth) / T(4.0);
  }

 private:
  double gm_;
  O orbit_;
  shape::MassMoments moments_;
  OrbitOf orbit_of_;
  SpaceAxes axes_;
  Law law_;
};

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
