// SPDX-License-Identifier: MIT
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
#pragma once

#include <utility>

#include "polhode/perturb/detail/argument_checks.hpp"
#include "polhode/perturb/detail/harmonic_gradient.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/shape/mass_moments.hpp"

namespace polhode {
inline namespace v0 {

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
    const BasicMoments<T, 2> squares{n.x * n.x, n.x * n.y, n.x * n.z,
                                     n.y * n.y, n.y * n.z, n.z * n.z};
    const BasicMoments<T, 3> cubes = detail::cubes_of(squares, n);
    return {detail::gradient<3>(third, squares), detail::gradient<4>(fourth, cubes)};
  }
};

template <Orbit O>
class HigherGravity {
 public:
  static constexpr bool kick = true;
  using Law = HigherGravityLaw;

  HigherGravity(double gm, O orbit, const MassMoments& moments_B, OrbitOf orbit_of,
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
  const MassMoments& moments() const { return moments_; }
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
  MassMoments moments_;
  OrbitOf orbit_of_;
  SpaceAxes axes_;
  Law law_;
};

}  // namespace v0
}  // namespace polhode
