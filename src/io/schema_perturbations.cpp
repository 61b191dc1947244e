// SPDX-License-Identifier: MIT
// The table of scenario keys: perturbations. A key that several kinds share
// stands once, with all of them.
#include "io/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr std::string_view gravity_gradient = "gravity-gradient";
constexpr std::string_view constant_torque = "constant-torque";
constexpr std::string_view damping = "damping";
constexpr std::string_view residual_dipole = "residual-dipole";
constexpr std::string_view eddy_currents = "eddy-currents";
constexpr std::string_view magnetic = "residual-dipole|eddy-currents";
constexpr std::string_view at_a_place = "gravity-gradient|residual-dipole|eddy-currents";

constexpr Key keys[] = {
    {.path = "perturbation[]",
     .help = "What acts on the body; any number of tables, each of one kind."},
    {.path = "perturbation[].kind",
     .type = choice,
     .presence = required,
     .allowed = "gravity-gradient|constant-torque|damping|residual-dipole|eddy-currents",
     .example = "\"gravity-gradient\"",
     .help = "What it is."},
    {.path = "perturbation[].orbit",
     .type = name,
     .presence = required,
     .example = "\"earth\"",
     .help = "The name of a table [orbit.NAME]: where the attracting point mass, or what has the "
             "magnetic field, is.",
     .kinds = at_a_place},
    {.path = "perturbation[].gm",
     .type = number,
     .dimension = Dimension::gm,
     .example = "\"398600.4418 km3/s2\"",
     .help = "Gravitational parameter of the attracting mass; left out, that of the orbit.",
     .kinds = gravity_gradient},
    {.path = "perturbation[].torque",
     .type = numbers,
     .presence = required,
     .dimension = Dimension::torque,
     .length = 3,
     .example = "[0.0, 0.0, 0.001]",
     .help = "The torque.",
     .kinds = constant_torque},
    {.path = "perturbation[].axes",
     .type = choice,
     .allowed = "body|inertial",
     .fallback = "\"body\"",
     .example = "\"body\"",
     .help = "The axes in which its components are constant.",
     .kinds = constant_torque},
    {.path = "perturbation[].coefficients",
     .type = linear_map,
     .presence = required,
     .dimension = Dimension::damping,
     .example = "[0.001, 0.001, 0.001]",
     .help = "D of the torque -D omega in body axes: its diagonal, or three rows.",
     .kinds = damping},
    {.path = "perturbation[].moment",
     .type = numbers,
     .presence = required,
     .dimension = Dimension::magnetic_moment,
     .length = 3,
     .example = "[0.0, 0.0, 1.0]",
     .help = "Magnetic moment of the body, along its axes.",
     .kinds = residual_dipole},
    {.path = "perturbation[].tensor",
     .type = linear_map,
     .presence = required,
     .dimension = Dimension::magnetic_tensor,
     .example = "[1.0, 1.0, 1.0]",
     .help = "Magnetic tensor M of the torque (M (omega x B - dB/dt)) x B in body axes: its "
             "diagonal, or three rows.",
     .kinds = eddy_currents},
    {.path = "perturbation[].field_rate",
     .type = boolean,
     .fallback = "true",
     .example = "true",
     .help = "Whether dB/dt along the orbit counts; false: currents by omega x B alone.",
     .kinds = eddy_currents},
    {.path = "perturbation[].gauss",
     .type = numbers,
     .presence = required,
     .dimension = Dimension::magnetic_field,
     .length = 3,
     .example = "[-0.029, -0.0015, 0.0048]",
     .help = "Gauss coefficients g10, g11, h11 of the dipole field, as the IGRF lists them.",
     .kinds = magnetic},
    {.path = "perturbation[].reference_radius",
     .type = number,
     .presence = required,
     .dimension = Dimension::length,
     .example = "\"6371.2 km\"",
     .help = "The radius that belongs to them.",
     .kinds = magnetic},
    {.path = "perturbation[].pole",
     .type = numbers,
     .length = 3,
     .fallback = "[0.0, 0.0, 1.0]",
     .example = "[0.0, 0.0, 1.0]",
     .help = "The pole about which the field turns, in inertial axes; of any length.",
     .kinds = magnetic},
    {.path = "perturbation[].rotation_rate",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"360.98564736629 deg/d\"",
     .help = "How fast it turns.",
     .kinds = magnetic},
    {.path = "perturbation[].meridian",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help =
         "Where the meridian of longitude 0 is at the time `meridian_epoch`: from inertial axis "
         "1, or, where the pole is not axis 3, from the ascending node of its equator.",
     .kinds = magnetic},
    {.path = "perturbation[].meridian_epoch",
     .type = number,
     .dimension = Dimension::time,
     .fallback = "0",
     .example = "0",
     .help = "The time t that the meridian belongs to.",
     .kinds = magnetic},
};

}  // namespace

SchemaPart perturbation_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
