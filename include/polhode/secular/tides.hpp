// SPDX-License-Identifier: MIT
// The tides that star and satellite raise on a planet, and the state that they change.
//
// Equations   those of polhode/secular/tidal_spin.hpp.
// Units       any time; rates in rad per time or 1 per time; spin and distance of a TidalSpin in
//             units of those at the start.
// Domain      as there.
// Accuracy    rounding.
// Errors      DomainError for rates that are not finite or out of range.
#pragma once

#include "polhode/math/vector.hpp"
#include "polhode/secular/spin_axis.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

struct TidalSpin {
  Vec3 s;
  double spin = 1.0;
  double distance = 1.0;  // of the satellite

  constexpr bool operator==(const TidalSpin&) const = default;
};
// The state of a theory with tides or without.
inline TidalSpin tidal_spin(const TidalSpin& at) { return at; }
inline TidalSpin tidal_spin(const SpinAxis& axis) { return {.s = axis.s}; }
template <class Visit>
void each_number(TidalSpin& at, Visit&& visit) {
  for (double* const x : {&at.s.x, &at.s.y, &at.s.z, &at.spin, &at.distance}) visit(*x);
}

// All in rad per time, or 1 per time, at the start. Without a satellite the last three are 0.
struct TidalRates {
  double spin;                      // of the planet
  double orbit;                     // mean motion of the planet
  double star = 0.0;                // K of the star
  double satellite = 0.0;           // K of the satellite
  double satellite_orbit = 0.0;     // mean motion of the satellite
  double satellite_momentum = 0.0;  // of its orbit, over C
};

// K = 3 k2 lag gm (m / M) (R / a)^3 / a^3 / (C / M R^2): gm and m of the body that raises the tide,
// M and R of the planet.
double tidal_rate(double k2, double lag, double gm, double mass_ratio, double radius,
                  double inertia_factor, double semi_major_axis);
// Throws where they are out of range.
void require_valid(const TidalRates& rates);

}  // namespace secular
}  // namespace v0
}  // namespace polhode
