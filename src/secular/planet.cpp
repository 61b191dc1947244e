// SPDX-License-Identifier: MIT
// Earth and Mars as bodies whose spin axes precess, and the sunlight that falls on a planet.
#include "polhode/secular/planet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "polhode/error.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/secular/insolation.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double arcsec_per_year = std::numbers::pi / 648000.0 / (365.25 * 86400.0);
constexpr double day = 86400.0;

// Of de Sitter for a planet whose year and mean distance (m) are known.
double geodetic(double period, double distance) {
  const double n = 2.0 * std::numbers::pi / period;
  return geodetic_precession(n * n * distance * distance * distance, distance, 299792458.0);
}

// Poles: IAU (Archinal et al. 2018). Earth: K0 and the share of the Moon of Zeebe & Lourens
// (2022); ellipticity of IAU 2000. Mars: J2 = 1.95661e-3 over C / (M R^2) = 0.3644 (Konopliv et al.
// 2016), from which the rate follows: 3/2 n^2 E / w. The inertia of the Earth is J2 / E, and its
// gm, radius and J2 are those of the IERS conventions (2010).
std::array<PlanetSpin, 2> known() {
  const double year = 365.256363 * day, year_of_mars = 686.97985 * day;
  PlanetSpin earth{"earth",
                   0.0,
                   90.0 * degree,
                   3.27379448e-3,
                   7.292115e-5,
                   year,
                   {.star = 17.376255 * arcsec_per_year,
                    .satellites = 17.376255 * 2.161213 * arcsec_per_year,
                    .geodetic = geodetic(year, 149598023e3)},
                   3.986004418e14,
                   6378136.6,
                   1.0826359e-3 / 3.27379448e-3,
                   {.mass = 0.0123000371, .distance = 384399e3},
                   "Zeebe & Lourens 2022"};
  PlanetSpin mars{"mars",
                  317.68143 * degree,
                  52.88650 * degree,
                  1.95661e-3 / 0.3644,
                  350.89198226 * degree / day,
                  year_of_mars,
                  {},
                  4.282837362e13,
                  3396.0e3,
                  0.3644,
                  {},
                  "Konopliv et al. 2016"};
  const double n = 2.0 * std::numbers::pi / year_of_mars;
  mars.rates.star = star_precession(mars.ellipticity, mars.spin_rate, n * n, 1.0);  // Kepler III
  mars.rates.geodetic = geodetic(year_of_mars, 227939366e3);
  return {earth, mars};
}

}  // namespace

std::span<const PlanetSpin> planet_spins() {
  static const std::array<PlanetSpin, 2> all = known();
  return all;
}

const PlanetSpin* planet_spin(std::string_view name) {
  for (const PlanetSpin& one : planet_spins())
    if (one.name == name) return &one;
  return nullptr;
}

const PlanetSpin& known_planet(std::string_view name) {
  if (const PlanetSpin* const known = planet_spin(name)) return *known;
  throw DomainError("planet: got \"" + std::string(name) + "\"; expected earth or mars");
}

Vec3 ecliptic_direction(double ra, double dec) {
  const double c = std::cos(obliquity_J2000), s = std::sin(obliquity_J2000);
  const Vec3 x{std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
  return {x.x, c * x.y + s * x.z, c * x.z - s * x.y};
}
Vec3 planet_pole(const PlanetSpin& of) { return ecliptic_direction(of.ra, of.dec); }

PrecessionRates planet_rates(const PlanetSpin& of, double year) {
  const double second = year / (365.25 * day);
  return {.star = of.rates.star / second,
          .satellites = of.rates.satellites / second,
          .geodetic = of.rates.geodetic / second};
}

double daily_insolation(const SpinAngles& angles, double eccentricity,
                        const InsolationPlace& place) {
  const double half_turn = pi<double>();
  if (!(std::fabs(place.latitude) <= 0.5 * half_turn * (1.0 + 1e-15)) ||
      !(eccentricity >= 0.0 && eccentricity < 1.0))
    return std::nan("");
  const double sine = std::sin(angles.obliquity) * std::sin(place.longitude);
  const double sines = sine * std::sin(place.latitude);
  const double cosines = std::sqrt(std::max(0.0, 1.0 - sine * sine)) * std::cos(place.latitude);
  // cos(H) = -sines / cosines: the star stays up, or down, where that is no cosine
  const double H =
      std::fabs(sines) >= cosines ? (sines > 0.0 ? half_turn : 0.0) : std::acos(-sines / cosines);
  const double e = eccentricity, v = place.longitude + half_turn - angles.pericentre;
  // without an eccentricity the pericentre does not matter
  const double nearness = (e > 0.0 ? 1.0 + e * std::cos(v) : 1.0) / (1.0 - e * e);
  return place.flux / half_turn * nearness * nearness * (H * sines + cosines * std::sin(H));
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
