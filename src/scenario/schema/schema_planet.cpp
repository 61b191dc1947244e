// SPDX-License-Identifier: MIT
// The table of scenario keys: the planet whose spin axis moves.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "planet",
     .presence = required,
     .help = "The planet, its spin axis at t = 0, and what makes it precess."},
    {.path = "planet.name",
     .type = choice,
     .allowed = "earth|mars",
     .example = "\"mars\"",
     .help = "Fills in what is left out: pole (IAU, J2000), ellipticity, rotation_period, "
             "orbital_period, satellites, geodetic.",
     .in_template = true},
    {.path = "planet.orbit",
     .type = name,
     .presence = required,
     .example = "\"mars\"",
     .help = "The orbit it goes round, the name of a table [orbit.NAME] of kind elements, series "
             "or shipped."},
    {.path = "planet.precession_rate",
     .type = number,
     .dimension = Dimension::rate,
     .example = "\"7.597 arcsec/yr\"",
     .help = "Of the equinox by the torques of star and satellites at t = 0; the precession "
             "constant follows from it, the obliquity and the eccentricity then."},
    {.path = "planet.precession_constant",
     .type = number,
     .dimension = Dimension::rate,
     .example = "\"8.29 arcsec/yr\"",
     .help = "alpha: the rate on a circle at obliquity 0, of star and satellites together."},
    {.path = "planet.ellipticity",
     .type = number,
     .example = "0.00537",
     .help = "Dynamical: (C - (A + B)/2) / C. With the two periods it gives the precession "
             "constant, where that is not given.",
     .range = Range::positive},
    {.path = "planet.rotation_period",
     .type = number,
     .dimension = Dimension::time,
     .example = "\"24.6229 h\"",
     .help = "Against the stars; negative where it turns the other way about the pole."},
    {.path = "planet.orbital_period",
     .type = number,
     .dimension = Dimension::time,
     .example = "\"686.98 d\"",
     .help = "Against the stars.",
     .range = Range::positive},
    {.path = "planet.satellites",
     .type = number,
     .example = "2.161213",
     .help = "The torque of satellites over that of the star on a circle; left out, that of the "
             "planet `name`, or 0. Of a moon far outside: (m / a^3) / (M / A^3) of its mass and "
             "distance and those of the star.",
     .range = Range::not_negative},
    {.path = "planet.geodetic",
     .type = number,
     .dimension = Dimension::rate,
     .example = "\"0.0192 arcsec/yr\"",
     .help = "Geodetic precession, forwards; left out, that of the planet `name`, or 0."},
    {.path = "planet.tidal_drift",
     .type = number,
     .dimension = Dimension::growth,
     .fallback = "0",
     .example = "\"-5.2e-4 1/Myr\"",
     .help = "By which fraction per time the torques of star and satellites grow from t = 0 on, as "
             "tides slow the spin down and move satellites outwards."},
    {.path = "planet.J",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "\"1 deg\"",
     .help = "Andoyer's angle between the figure axis and the spin: the torques are "
             "1 - 3/2 sin(J)^2 of those at J = 0."},
    {.path = "planet.pole",
     .help = "Where the spin points at t = 0; left out, the pole of the planet `name`."},
    {.path = "planet.pole.ra",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "317.68143",
     .help = "Right ascension (J2000); needs an orbit along axes of J2000."},
    {.path = "planet.pole.dec",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "52.8865",
     .help = "Declination that goes with it."},
    {.path = "planet.pole.obliquity",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "25",
     .help = "From the normal of the orbit at t = 0; from 0 to 180 deg."},
    {.path = "planet.pole.precession",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "0",
     .help = "The column of this name at t = 0: by how much the equinox has gone back in the "
             "orbit."},
    {.path = "planet.insolation", .help = "Of what the column insolation is: the mean over a day."},
    {.path = "planet.insolation.latitude",
     .type = number,
     .presence = required,
     .dimension = Dimension::angle,
     .example = "65",
     .help = "From -90 to 90 deg."},
    {.path = "planet.insolation.longitude",
     .type = number,
     .presence = required,
     .dimension = Dimension::angle,
     .example = "90",
     .help = "Of the star as seen from the planet, from the moving equinox: 90 deg is the "
             "northern summer solstice."},
    {.path = "planet.insolation.flux",
     .type = number,
     .presence = required,
     .example = "1361",
     .help = "Of the star at the planet's semi-major axis, W/m2.",
     .range = Range::positive},
};

constexpr Alternatives sets[] = {{"planet.pole", "ra+dec|obliquity+precession"}};

constexpr KindText texts[] = {
    {{}, "obliquity", "The spin axis of a planet over ages, on an orbit that changes."}};

}  // namespace

SchemaPart planet_keys() { return {keys, sets, texts}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
