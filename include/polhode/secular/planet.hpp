// SPDX-License-Identifier: MIT
// What is known of the spin of planets: the pole, what makes it precess, what tides need.
//
// Equations   star and satellites as PrecessionRates; geodetic is de Sitter's.
// Units       rad; rates in rad/s; m, s, masses of satellites in that of the planet.
// Domain      the Earth and Mars at J2000.
// Accuracy    that of the sources, some 1e-4 of the rates.
// Errors      DomainError for a planet that is not known, of known_planet.
#pragma once

#include <span>
#include <string_view>

#include "polhode/secular/spin_precession.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

// A satellite far outside, near the plane of the orbit of its planet. None where mass is 0.
struct OuterSatellite {
  double mass = 0.0;
  double distance = 0.0;  // semi-major axis
};

struct PlanetSpin {
  std::string_view name;  // "mars"
  double ra, dec;         // of the north pole, equator of J2000
  double ellipticity;     // (C - (A + B)/2) / C
  double spin_rate;       // rad/s
  double orbital_period;  // s
  PrecessionRates rates;  // rad/s
  double gm;
  double radius;             // of the equator
  double inertia_factor;     // C / M R^2
  OuterSatellite satellite;  // whose torque is the satellites of `rates`
  std::string_view source;   // of the rates, in words
};

std::span<const PlanetSpin> planet_spins();
// Null where there is none of this name.
const PlanetSpin* planet_spin(std::string_view name);
// DomainError where there is none.
const PlanetSpin& known_planet(std::string_view name);
// A direction of the equator of J2000 along ecliptic-J2000, and so the pole of a planet.
Vec3 ecliptic_direction(double ra, double dec);
Vec3 planet_pole(const PlanetSpin& of);
// Its rates in another unit of time, in which a Julian year is `year`.
PrecessionRates planet_rates(const PlanetSpin& of, double year);

}  // namespace secular
}  // namespace v0
}  // namespace polhode
