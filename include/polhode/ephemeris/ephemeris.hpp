// SPDX-License-Identifier: MIT
// Where the Sun, the Moon and the planets are, and tables of it for orbits.
//
// Equations   Earth about the Sun: VSOP2000, abridged (eraEpv00). Moon about the Earth: Meeus
//             (1998), a truncation of ELP2000-82 (eraMoon98). Planets about the Sun: Simon et al.
//             (1994) (eraPlan94); from Mars on they are the barycentres of planet and moons.
// Units       km and s.
// Domain      any body seen from any other, geometric: light time is not applied. Axes of the
//             ICRS, to 0.03 arcsec those of equator and equinox of J2000. The years 1000 to 3000.
// Accuracy    planetary_error. As the sources of ERFA say, in their best years: Earth 11 km at most
//             (1900 to 2100); Moon 6 km and 2.9 arcsec rms, 32 km and 18 arcsec at most (1950 to
//             2100); planets 7 (Mercury, Venus), 26 (Mars), 78 to 87 (Jupiter to Uranus) and 11
//             arcsec (Neptune) at most (1800 to 2100). Against DE406 from 1000 to 3000, at most:
//             Earth 0.8, Moon 24, Mercury 7, Venus 8, Mars 40, Jupiter 78, Saturn 130, Uranus 111,
//             Neptune 45 arcsec. Budget ephemeris_far_*.
// Errors      DomainError for dates outside, a body seen from itself, a span that is not finite.
// Cost        a position takes 10 us (Moon from the Earth, planets from the Sun) to 45 us (what
//             needs the Earth from the Sun); to tabulate a year, once for a run, 40 to 50 ms
//             (benchmarks/ephemeris.cpp).
#pragma once

#include <optional>
#include <string_view>

#include "polhode/ephemeris/date.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace ephemeris {

enum class Planetary { sun, mercury, venus, earth, moon, mars, jupiter, saturn, uranus, neptune };
std::string_view name(Planetary body);
// All names, joined by "|".
std::string_view planetary_names();
std::optional<Planetary> planetary(std::string_view name);

// Gravitational parameter in km^3/s^2, DE440 (Park et al. 2021); from Mars on of the system.
double planetary_gm(Planetary body);

// How far such a position may be off across the line of sight, arcsec: as its authors state in
// the best years of a theory, as measured against DE406 in others. Those are errors as seen from
// the Sun (of the Moon, from the Earth); here at the distance of the date, from nearer by more
// arcseconds. Errors along the radius, which are smaller, are left out. NaN outside all years.
double planetary_error(Planetary target, Planetary centre, const Date& date);
// The years that all theories of the two were compared for.
struct PlanetaryYears {
  int first;
  int last;
};
PlanetaryYears best_years(Planetary target, Planetary centre);

// Position of `target` from `centre`, km.
Vec3 planetary_position(Planetary target, Planetary centre, const Date& date);

// Such positions at even steps, s from an epoch; a TableOrbit of order `order` through them differs
// from the positions between by `error` km at most, as far as it was measured.
struct EphemerisTable {
  PositionTable rows;
  double error;
  int order;
};
// From `first` to `last`, s of TT after `epoch`; to `tolerance` of the distance.
EphemerisTable planetary_table(Planetary target, Planetary centre, const Date& epoch, double first,
                               double last, double tolerance = 1e-10);

// The Earth at a date: how it is oriented, and the dipole of its magnetic field.
//
// Equations   orientation: precession and nutation of the IAU 2006/2000A and the Earth rotation
//             angle (SOFA's celestial-to-terrestrial matrix, by ERFA), without the motion of the
//             pole in the crust. Field: the coefficients of degree 1 of the IGRF-14, linear between
//             its epochs (Alken et al. 2021; IAGA 2024).
// Units       nT; the coefficients belong to the radius 6371.2 km.
// Domain      the field from 1900 to 2030, DomainError outside. UT1 is taken for UTC if dut1 = UT1
//             - UTC (s) is not given: 0.004 deg at most since 1972, 0.2 deg in 1900.
// Accuracy    0.0001 deg with dut1 (the motion of the pole). The dipole is 0.8 to 0.9 of the field
//             of a low orbit, and more farther out.
// Errors      DomainError for a date outside the domain.
// Cost        about 50 us.

// rad per second of UT1
inline constexpr double earth_rotation_rate = 7.292115146706979e-5;
inline constexpr double igrf_radius_km = 6371.2;

// Turns components along the axes of the Earth (axis 3 the pole, axis 1 Greenwich) into those along
// equator and equinox of J2000.
Mat3 j2000_from_earth(const Date& date, std::optional<double> dut1 = std::nullopt);

// g10, g11 and h11 of the IGRF, nT.
Vec3 igrf_dipole(const Date& date);

// The nutation of the real Earth, to hold theories of a rigid one against.
//
// Equations   IAU 2000A (Mathews et al. 2002), 678 terms of Moon and Sun and 687 of the planets
//             (eraNut00a).
// Units       rad; T in Julian centuries of TDB from J2000.
// Domain      on mean ecliptic and equator of date; without the free core nutation. |T| up to some
//             centuries.
// Accuracy    that of the model: 0.2 mas and the free core nutation, some 0.3 mas.
// Errors      none: NaN for NaN.
// Cost        60 us.

struct IauNutation {
  double longitude, obliquity;
};
IauNutation iau_nutation(double T);

// The axes of two-line elements: true equator, mean equinox of date (TEME), which SGP4 answers in.
//
// Equations   x_J2000 = P^T N^T Rz(-dpsi cos eps) x_TEME with the precession P of 1976, the
//             nutation N of 1980 and its dpsi, and the mean obliquity eps of date (Vallado et al.
//             2006); by ERFA.
// Units       none: a rotation.
// Domain      dates of the two theories, some centuries about 2000.
// Accuracy    budget teme_arcsec, against the axes of the ICRS: those of 1976 and 1980 are without
//             the corrections observed since. docs/guide/orbits.md has what that is in metres.
// Cost        some 4 us (benchmarks/ephemeris.cpp).

// Turns components along TEME of a date into those along equator and equinox of J2000.
Mat3 j2000_from_teme(const Date& date);

}  // namespace ephemeris
}  // namespace v0
}  // namespace polhode
