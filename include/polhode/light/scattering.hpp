// SPDX-License-Identifier: MIT
// Scattering: how much light a piece of surface sends to an observer, by the angles under which it
// is lit and seen; and how the whole fades with the phase angle.
//
// Equations   S(mu, mu0) = single mu mu0 / (mu + mu0) + multiple mu mu0: the laws of Lommel and
//             Seeliger (1, 0) and of Lambert (0, 1), and the sum of both (1, c) that convex
//             inversion takes (Kaasalainen, Torppa & Muinonen 2001, Icarus 153, 37, where c = 0.1).
//             f(alpha) = amplitude exp(-alpha / width) + slope alpha + 1 (the same work).
// Units       mu = cos of the angle between normal and observer, mu0 between normal and Sun; phase
//             angle alpha in radians, width too, slope in 1 / rad. Brightness is an integral of
//             S dA: in units of area, to be multiplied by albedo and flux of the Sun.
// Domain      mu, mu0 in [-1, 1]; S is 0 unless both are positive. alpha in [0, pi], width > 0.
//             phase_angle: any vectors but 0; at alpha = 0 and pi it has no derivative by them.
// Accuracy    a few roundings.
// Cost        a few flops; an exponential; an arc tangent.
#pragma once

#include <cmath>

#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

template <Number T>
struct BasicScattering {
  T single = T(1.0);
  T multiple = T(0.0);

  static constexpr BasicScattering lommel_seeliger() { return {T(1.0), T(0.0)}; }
  static constexpr BasicScattering lambert() { return {T(0.0), T(1.0)}; }
  static constexpr BasicScattering mixed(const T& c) { return {T(1.0), c}; }

  // S(mu, mu0)
  constexpr T at(const T& mu, const T& mu0) const {
    const T both = mu * mu0;
    const T sum = mu + mu0 + T(1e-300);  // 0 / 0 is 0, as the limit is
    const T sent = single * (both / sum) + multiple * both;
    return select(mu < T(0.0), T(0.0), select(mu0 < T(0.0), T(0.0), sent));
  }

  constexpr bool operator==(const BasicScattering&) const
    requires Real<T>
  = default;
};
using Scattering = BasicScattering<double>;

template <Real T>
struct BasicPhaseFunction {
  T amplitude = T(0.0);
  T width = T(1.0);
  T slope = T(0.0);

  // f(alpha)
  T at(const T& alpha) const {
    using std::exp;
    return amplitude * exp(-alpha / width) + slope * alpha + T(1.0);
  }

  constexpr bool operator==(const BasicPhaseFunction&) const = default;
};
using PhaseFunction = BasicPhaseFunction<double>;

// The angle at the body between Sun and observer, 0 .. pi.
template <Real T>
T phase_angle(const BasicVec3<T>& to_sun, const BasicVec3<T>& to_observer) {
  using std::atan2;
  // not acos(s . o): it loses half of the digits at small angles
  return atan2(norm(cross(to_sun, to_observer)), dot(to_sun, to_observer));
}

}  // namespace light
}  // namespace v0
}  // namespace polhode
