// SPDX-License-Identifier: MIT
// The table of scenario keys: orbits.
#include "io/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "orbit", .help = "Orbits, by names that the file chooses."},
    {.path = "orbit.*",
     .help =
         "The path of the attracting body as seen from the rotating one, or the other way round: "
         "a Kepler orbit in inertial axes, which may precess."},
    {.path = "orbit.*.gm",
     .type = number,
     .presence = required,
     .dimension = Dimension::gm,
     .example = "\"398600.4418 km3/s2\"",
     .help = "Gravitational parameter that gives the period."},
    {.path = "orbit.*.semi_major_axis",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::length,
     .example = "\"7000 km\"",
     .help = "Semi-major axis of an ellipse."},
    {.path = "orbit.*.pericentre",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::length,
     .example = "\"6930 km\"",
     .help = "Distance at pericentre; a hyperbola needs it."},
    {.path = "orbit.*.eccentricity",
     .type = number,
     .fallback = "0",
     .example = "0.01",
     .help = "From 0 to below 1, or above 1."},
    {.path = "orbit.*.inclination",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "51.6",
     .help = "Of the plane to inertial axes 1 and 2."},
    {.path = "orbit.*.node",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "From inertial axis 1 to the ascending node, at the epoch."},
    {.path = "orbit.*.pericentre_argument",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "From the node to the pericentre, at the epoch."},
    {.path = "orbit.*.mean_anomaly",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "Mean anomaly at the epoch."},
    {.path = "orbit.*.epoch",
     .type = number,
     .dimension = Dimension::time,
     .fallback = "0",
     .example = "0",
     .help = "The time t that these elements belong to."},
    {.path = "orbit.*.node_rate",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"-5 deg/d\"",
     .help = "Rate of the node."},
    {.path = "orbit.*.pericentre_rate",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"3.7 deg/d\"",
     .help = "Rate of the argument of the pericentre."},
    {.path = "orbit.*.mean_anomaly_rate",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "0",
     .help = "What is added to the mean motion that gm gives."},
};

constexpr Alternatives alternatives[] = {{"orbit.*", "semi_major_axis|pericentre"}};

}  // namespace

SchemaPart orbit_keys() { return {keys, alternatives}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
