// SPDX-License-Identifier: MIT
// TidalTorque: the torque of a point mass on the tidal bulge that it raises, which lags by a
// constant time.
//
// Equations   Mignard (1979), Hut (1981): the bulge is that of the position a time lag ago in the
//             turning body; to first order in the lag,
//             u = 3 k2 gm M R^5 lag / r^8 ((r.w) r - r^2 w + r x dr/dt),
//             r the position and dr/dt the velocity of the point mass, M its mass, w = I^-1 g. For
//             a circular orbit in the equator: 3 k2 gm M R^5 lag / r^6 (n - w).
// Units       gm, R and the orbit in the same units of length and time; M in the unit of the
//             moments over length^2, so that gm M is G M^2; the lag in time.
// Domain      gm, M, R > 0, k2 and lag >= 0, lag times every rate small. The orbit has a velocity
//             and is given in inertial axes; it may be that of either body as seen from the other.
//             The bulge that does not lag has no torque on a sphere: it is not here. g changes u,
//             so that it is no kick.
// Accuracy    a few roundings. On DoubleDouble the velocity of an AnyOrbit is that of double.
// Errors      DomainError for numbers out of the domain, for an AnyOrbit without a velocity.
// Cost        one position, one velocity and some 80 flops.
#pragma once

#include <concepts>
#include <utility>

#include "polhode/orbit/any_orbit.hpp"
#include "polhode/perturb/detail/argument_checks.hpp"
#include "polhode/perturb/detail/orbit_motion.hpp"
#include "polhode/perturb/gravity_gradient.hpp"

namespace polhode {
inline namespace v0 {

struct TidalBody {
  double k2;      // Love number
  double lag;     // time
  double radius;  // that k2 belongs to

  constexpr bool operator==(const TidalBody&) const = default;
};

// What a tide does, apart from where the point mass is.
struct TidalTorqueLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  double strength;

  constexpr bool operator==(const TidalTorqueLaw&) const = default;

  template <Number T>
  struct OfTime {
    BasicVec3<T> x_S;
    BasicVec3<T> spin_S;  // x x dx/dt
  };
  template <Number T, class InS>
  OfTime<T> of_vectors(const std::array<BasicVec3<T>, 2>& orbit, const InS& in_S) const {
    return {in_S(orbit[0]), in_S(cross(orbit[0], orbit[1]))};
  }
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& where, const BasicPose<T>& at) const {
    const BasicVec3<T> r = body_from_reference(at, where.x_S);
    const BasicVec3<T> spin = body_from_reference(at, where.spin_S);
    const BasicVec3<T>& I = at.moments;
    const BasicVec3<T> w{at.s.g.x / I.x, at.s.g.y / I.y, at.s.g.z / I.z};
    const T r2 = dot(r, r), r4 = r2 * r2;
    return {{}, (T(strength) / (r4 * r4)) * (dot(r, w) * r - r2 * w + spin)};
  }
};

template <Orbit O>
  requires OrbitOn<O, Dual<double, 1>>
class TidalTorque {
 public:
  using Law = TidalTorqueLaw;

  // `mass` is that of the point mass, gm / G.
  TidalTorque(double gm, double mass, O orbit, const TidalBody& of)
      : gm_(gm),
        mass_(mass),
        orbit_(std::move(orbit)),
        of_(of),
        law_{detail::tidal_strength(gm, mass, of)} {
    if constexpr (std::same_as<O, AnyOrbit>) detail::require_velocity(orbit_);
  }

  double gm() const { return gm_; }
  double mass() const { return mass_; }
  const O& orbit() const { return orbit_; }
  double time_scale() const { return time_scale_of(orbit_); }
  const TidalBody& tidal_body() const { return of_; }

  const Law& law() const { return law_; }
  template <Real T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    const detail::OrbitMotion<T> orbit = detail::motion_at(orbit_, at.t, at.t_rest);
    return of_vectors<T>(at, {orbit.x, orbit.v});
  }
  // Position and velocity.
  static constexpr std::size_t vectors_of_time = 2;
  void vectors_at(const TimeRows& times, const std::array<VectorRows, 2>& to,
                  InstructionSet set) const {
    motions_at(orbit_, times, to[0], to[1], set);
    positions_at(orbit_, times, to[0], set);  // with the rest of the time
  }
  template <Real T>
  Law::OfTime<T> of_vectors(const BasicSetting<T>& at,
                            const std::array<BasicVec3<T>, 2>& orbit) const {
    return law_.of_vectors(orbit, in_reference(at));
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law_.effect(of_time(at), pose_of(at));
  }

 private:
  double gm_;
  double mass_;
  O orbit_;
  TidalBody of_;
  Law law_;
};

}  // namespace v0
}  // namespace polhode
