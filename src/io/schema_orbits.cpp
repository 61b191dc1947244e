// SPDX-License-Identifier: MIT
// The table of scenario keys: orbits.
#include "io/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr std::string_view of_kepler = "kepler";
constexpr std::string_view of_state = "state";
constexpr std::string_view of_table = "table";
constexpr std::string_view of_ephemeris = "ephemeris";
constexpr std::string_view bodies =
    "sun|mercury|venus|earth|moon|mars|jupiter|saturn|uranus|neptune";

constexpr Key keys[] = {
    {.path = "orbit", .help = "Orbits, by names that the file chooses."},
    {.path = "orbit.*",
     .help = "The path of the attracting body as seen from the rotating one, or the other way "
             "round, in inertial axes."},
    {.path = "orbit.*.kind",
     .type = choice,
     .allowed = "kepler|state|table|ephemeris",
     .fallback = "\"kepler\"",
     .example = "\"kepler\"",
     .help = "Elements, which may precess; a position and a velocity; a table in a file; or Sun, "
             "Moon and planets as they move (docs/guide/orbits.md)."},
    {.path = "orbit.*.gm",
     .type = number,
     .dimension = Dimension::gm,
     .example = "\"398600.4418 km3/s2\"",
     .help = "Gravitational parameter: it gives the period of a Kepler orbit, and a perturbation "
             "that names the orbit takes it. With kind ephemeris left out: that of the target.",
     .needed_by = "kepler|state"},
    {.path = "orbit.*.semi_major_axis",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::length,
     .example = "\"7000 km\"",
     .help = "Semi-major axis of an ellipse.",
     .kinds = of_kepler},
    {.path = "orbit.*.pericentre",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::length,
     .example = "\"6930 km\"",
     .help = "Distance at pericentre; a hyperbola needs it.",
     .kinds = of_kepler},
    {.path = "orbit.*.eccentricity",
     .type = number,
     .fallback = "0",
     .example = "0.01",
     .help = "From 0 to below 1, or above 1.",
     .kinds = of_kepler},
    {.path = "orbit.*.inclination",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "51.6",
     .help = "Of the plane to inertial axes 1 and 2.",
     .kinds = of_kepler},
    {.path = "orbit.*.node",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "From inertial axis 1 to the ascending node, at the epoch.",
     .kinds = of_kepler},
    {.path = "orbit.*.pericentre_argument",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "From the node to the pericentre, at the epoch.",
     .kinds = of_kepler},
    {.path = "orbit.*.mean_anomaly",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "Mean anomaly at the epoch.",
     .kinds = of_kepler},
    {.path = "orbit.*.epoch",
     .type = number,
     .dimension = Dimension::time,
     .fallback = "0",
     .example = "0",
     .help = "The time t that these elements, or position and velocity, belong to.",
     .kinds = "kepler|state"},
    {.path = "orbit.*.node_rate",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"-5 deg/d\"",
     .help = "Rate of the node.",
     .kinds = of_kepler},
    {.path = "orbit.*.pericentre_rate",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"3.7 deg/d\"",
     .help = "Rate of the argument of the pericentre.",
     .kinds = of_kepler},
    {.path = "orbit.*.mean_anomaly_rate",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "0",
     .help = "What is added to the mean motion that gm gives.",
     .kinds = of_kepler},

    {.path = "orbit.*.position",
     .type = numbers,
     .presence = required,
     .dimension = Dimension::length,
     .length = 3,
     .example = "[7000.0, 0.0, 0.0]",
     .help = "Position at the epoch.",
     .kinds = of_state},
    {.path = "orbit.*.velocity",
     .type = numbers,
     .presence = required,
     .dimension = Dimension::speed,
     .length = 3,
     .example = "[0.0, 5.0, 5.6]",
     .help = "Velocity at the epoch.",
     .kinds = of_state},
    {.path = "orbit.*.J2",
     .type = number,
     .fallback = "0",
     .example = "1.0826e-3",
     .help = "Oblateness of the attracting body, whose pole is axis 3 of `axes`: node, pericentre "
             "and mean anomaly of the osculating ellipse then advance at their secular rates of "
             "first order.",
     .kinds = of_state},
    {.path = "orbit.*.radius",
     .type = number,
     .dimension = Dimension::length,
     .example = "\"6378.137 km\"",
     .help = "Equatorial radius that J2 belongs to.",
     .kinds = of_state},
    {.path = "orbit.*.axes",
     .type = choice,
     .allowed = "inertial|ecliptic-J2000|equator-J2000",
     .example = "\"equator-J2000\"",
     .help = "The axes of position and velocity or of the columns; left out, those of "
             "`state.axes`.",
     .kinds = "state|table"},

    {.path = "orbit.*.file",
     .type = text,
     .presence = required,
     .example = "\"moon.csv.gz\"",
     .help = "A table of positions, CSV or separated by blanks, .gz or not, or a CCSDS Orbit "
             "Ephemeris Message (.oem); the path is from the folder of this file.",
     .kinds = of_table},
    {.path = "orbit.*.columns",
     .type = columns,
     .example = "[\"t\", \"x\", \"y\", \"z\"]",
     .help =
         "Columns that hold time, x, y, z and, where there are seven, the velocity: by the names "
         "that the file gives them or by their numbers from 1. Left out: t, x, y, z and, if "
         "there, vx, vy, vz, or where no line names them, the first four or seven.",
     .kinds = of_table},
    {.path = "orbit.*.time_format",
     .type = choice,
     .allowed = "number|JD|MJD|date",
     .fallback = "\"number\"",
     .example = "\"number\"",
     .help = "What the column of times holds: time from t = 0, Julian dates, modified ones, or "
             "dates like 2013-01-05T18:30:00. All but the first need `state.epoch`.",
     .kinds = of_table},
    {.path = "orbit.*.time_scale",
     .type = choice,
     .allowed = "UTC|TAI|TT|TDB",
     .fallback = "\"TT\"",
     .example = "\"TDB\"",
     .help = "Time scale of these dates.",
     .kinds = of_table},
    {.path = "orbit.*.time_unit",
     .type = unit,
     .example = "\"s\"",
     .help = "Unit of the column of times, which count from t = 0; left out, `units.time`.",
     .kinds = of_table},
    {.path = "orbit.*.length_unit",
     .type = unit,
     .example = "\"km\"",
     .help = "Unit of x, y, z; left out, `units.length`.",
     .kinds = of_table},
    {.path = "orbit.*.velocity_unit",
     .type = unit,
     .example = "\"km/s\"",
     .help = "Unit of the velocities; left out, that of lengths over that of times.",
     .kinds = of_table},
    {.path = "orbit.*.order",
     .type = integer,
     .example = "10",
     .help = "Order of the interpolation: 2 to 16, even; with velocities 4 to 32, a multiple of "
             "4. Left out: 10, with velocities 12.",
     .kinds = of_table},

    {.path = "orbit.*.target",
     .type = choice,
     .presence = required,
     .allowed = bodies,
     .example = "\"moon\"",
     .help = "The body whose positions these are. It needs `state.epoch`, `state.axes` of J2000, a "
             "unit of length, and [time].",
     .kinds = of_ephemeris},
    {.path = "orbit.*.centre",
     .type = choice,
     .presence = required,
     .allowed = bodies,
     .example = "\"earth\"",
     .help = "The body it is seen from, without light time.",
     .kinds = of_ephemeris},
};

constexpr Alternatives alternatives[] = {{"orbit.*", "semi_major_axis|pericentre", "kepler"}};

}  // namespace

SchemaPart orbit_keys() { return {keys, alternatives}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
