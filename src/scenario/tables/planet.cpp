// SPDX-License-Identifier: MIT
#include "scenario/tables/planet.hpp"

#include <array>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::array keys_of_planet = {
    word_key<&PlanetTable::name>(
        "name", "earth|mars",
        "Fills in what is left out: pole (IAU, J2000), ellipticity, rotation_period, "
        "orbital_period, satellites, geodetic, gm, radius, inertia_factor.")
        .example("\"mars\"")
        .shown(),
    name_key<&PlanetTable::orbit>(
        "orbit",
        "The orbit it goes round, the name of a table [orbit.NAME] of kind elements, series or "
        "shipped.")
        .required()
        .example("\"mars\""),
    quantity_key<&PlanetTable::precession_rate>(
        "precession_rate", Dimension::rate,
        "Of the equinox by the torques of star and satellites at t = 0; the precession constant "
        "follows from it, the obliquity and the eccentricity then.")
        .example("\"7.597 arcsec/yr\""),
    quantity_key<&PlanetTable::precession_constant>(
        "precession_constant", Dimension::rate,
        "alpha: the rate on a circle at obliquity 0, of star and satellites together.")
        .example("\"8.29 arcsec/yr\""),
    quantity_key<&PlanetTable::ellipticity>(
        "ellipticity", Dimension::number,
        "Dynamical: (C - (A + B)/2) / C. With the two periods it gives the precession constant, "
        "where that is not given.")
        .example("0.00537")
        .positive(),
    quantity_key<&PlanetTable::rotation_period>(
        "rotation_period", Dimension::time,
        "Against the stars; negative where it turns the other way about the pole.")
        .example("\"24.6229 h\""),
    quantity_key<&PlanetTable::orbital_period>("orbital_period", Dimension::time,
                                               "Against the stars.")
        .example("\"686.98 d\"")
        .positive(),
    quantity_key<&PlanetTable::satellites>(
        "satellites", Dimension::number,
        "The torque of satellites over that of the star on a circle; left out, that of the planet "
        "`name`, or 0. Of a moon far outside: (m / a^3) / (M / A^3) of its mass and distance and "
        "those of the star. Tables [[planet.satellite]] may stand instead.")
        .example("2.161213")
        .not_negative(),
    quantity_key<&PlanetTable::gm>("gm", Dimension::gm,
                                   "Gravitational parameter of the planet. Only satellites and "
                                   "tides need it, and the next two.")
        .example("\"398600.4418 km3/s2\"")
        .positive(),
    quantity_key<&PlanetTable::radius>("radius", Dimension::length,
                                       "Of its equator; 1 where units.length is \"1\".")
        .example("\"6378.1366 km\"")
        .positive(),
    quantity_key<&PlanetTable::inertia_factor>("inertia_factor", Dimension::number, "C / (M R^2).")
        .example("0.3307")
        .positive(),
    quantity_key<&PlanetTable::geodetic>(
        "geodetic", Dimension::rate,
        "Geodetic precession, forwards; left out, that of the planet `name`, or 0.")
        .example("\"0.0192 arcsec/yr\""),
    quantity_key<&PlanetTable::tidal_drift>(
        "tidal_drift", Dimension::growth,
        "By which fraction per time the torques of star and satellites grow from t = 0 on, as "
        "tides slow the spin down and move satellites outwards.")
        .otherwise("0")
        .example("\"-5.2e-4 1/Myr\""),
    quantity_key<&PlanetTable::J>(
        "J", Dimension::angle,
        "Andoyer's angle between the figure axis and the spin: the torques are "
        "1 - 3/2 sin(J)^2 of those at J = 0.")
        .otherwise("0")
        .example("\"1 deg\""),
};
constexpr KindText kinds_of_planet[] = {
    {{}, "obliquity", "The spin axis of a planet over ages, on an orbit that changes."}};
constexpr Table<PlanetTable> planet_description = {
    {.path = "planet",
     .presence = Presence::required,
     .help = "The planet, its spin axis at t = 0, and what makes it precess."},
    keys_of_planet,
    {},
    kinds_of_planet};

constexpr std::array keys_of_pole = {
    quantity_key<&PoleTable::ra>("ra", Dimension::angle,
                                 "Right ascension (J2000); needs an orbit along axes of J2000.")
        .alternative()
        .example("317.68143"),
    quantity_key<&PoleTable::dec>("dec", Dimension::angle, "Declination that goes with it.")
        .alternative()
        .example("52.8865"),
    quantity_key<&PoleTable::obliquity>("obliquity", Dimension::angle,
                                        "From the normal of the orbit at t = 0; from 0 to 180 deg.")
        .alternative()
        .example("25"),
    quantity_key<&PoleTable::precession>(
        "precession", Dimension::angle,
        "The column of this name at t = 0: by how much the equinox has gone back in the orbit.")
        .alternative()
        .example("0"),
};
constexpr Alternatives sets_of_pole[] = {{"planet.pole", "ra+dec|obliquity+precession"}};
constexpr Table<PoleTable> pole_description = {
    {.path = "planet.pole",
     .help = "Where the spin points at t = 0; left out, the pole of the planet `name`."},
    keys_of_pole,
    sets_of_pole};

constexpr std::array keys_of_satellite = {
    choice_key<&SatelliteTable::kind, SatelliteTable::Kind::outer, SatelliteTable::Kind::inner>(
        "kind", "outer|inner", "Where it goes round.")
        .required()
        .example("\"outer\""),
    quantity_key<&SatelliteTable::mass>("mass", Dimension::number, "Over that of the planet.")
        .required()
        .example("0.0123000371")
        .positive(),
    quantity_key<&SatelliteTable::distance>("distance", Dimension::length, "Semi-major axis.")
        .required()
        .example("\"384399 km\"")
        .positive(),
    quantity_key<&SatelliteTable::eccentricity>("eccentricity", Dimension::number, "Of its orbit.")
        .of_kinds("outer")
        .otherwise("0")
        .example("0.0549")
        .not_negative(),
    quantity_key<&SatelliteTable::inclination>("inclination", Dimension::angle,
                                               "Its mean against the orbit of the planet.")
        .of_kinds("outer")
        .otherwise("0")
        .example("5.1454"),
};
constexpr KindText kinds_of_satellite[] = {
    {"planet.satellite[]", "outer",
     "Far outside, near the plane of the orbit of the planet, as the Moon: it pulls at the equator "
     "as the star does."},
    {"planet.satellite[]", "inner",
     "In the plane of the equator, as Titan: it is carried along, and the precession of planet and "
     "satellites together is what ellipticity and the periods then give."}};
constexpr Table<SatelliteTable> satellite_description = {
    {.path = "planet.satellite[]",
     .help = "Satellites one by one, in place of satellites and of what the planet `name` has."},
    keys_of_satellite,
    {},
    kinds_of_satellite};

constexpr std::array keys_of_tides = {
    quantity_key<&TidesTable::k2>("k2", Dimension::number, "Love's number of the planet.")
        .required()
        .example("0.305")
        .not_negative(),
    quantity_key<&TidesTable::lag>("lag", Dimension::time,
                                   "By how much the tide is late; with k2 = 0.305 this one has the "
                                   "Moon go away at 3.8 cm a year.")
        .required()
        .example("\"638 s\"")
        .not_negative(),
};
constexpr Table<TidesTable> tides_description = {
    {.path = "planet.tides",
     .help = "Tides of constant time lag, raised by the star and by an outer satellite: the spin "
             "slows down, the satellite goes away, the obliquity changes, and the precession with "
             "them."},
    keys_of_tides};

constexpr std::array keys_of_insolation = {
    quantity_key<&InsolationTable::latitude>("latitude", Dimension::angle, "From -90 to 90 deg.")
        .required()
        .example("65"),
    quantity_key<&InsolationTable::longitude>(
        "longitude", Dimension::angle,
        "Of the star as seen from the planet, from the moving equinox: 90 deg is the northern "
        "summer solstice.")
        .required()
        .example("90"),
    quantity_key<&InsolationTable::flux>("flux", Dimension::number,
                                         "Of the star at the planet's semi-major axis, W/m2.")
        .required()
        .example("1361")
        .positive(),
};
constexpr Table<InsolationTable> insolation_description = {
    {.path = "planet.insolation", .help = "Of what the column insolation is: the mean over a day."},
    keys_of_insolation};

}  // namespace

SchemaPart planet_keys() {
  return part_of<planet_description, pole_description, satellite_description, tides_description,
                 insolation_description>();
}

Placed<PlanetTable> planet_table(const FileValues& file) { return {planet_description, file}; }
Placed<PoleTable> pole_table(const FileValues& file) { return {pole_description, file}; }
std::vector<Placed<SatelliteTable>> satellite_tables(const FileValues& file) {
  return placed_tables(satellite_description, file);
}
Placed<TidesTable> tides_table(const FileValues& file) { return {tides_description, file}; }
Placed<InsolationTable> insolation_table(const FileValues& file) {
  return {insolation_description, file};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
