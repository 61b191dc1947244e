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

constexpr Key keys[] = {
    {.path = "perturbation[]",
     .help = "What acts on the body; any number of tables, each of one kind."},
    {.path = "perturbation[].kind",
     .type = choice,
     .presence = required,
     .allowed = "gravity-gradient|constant-torque|damping|solar-pressure|drag",
     .example = "\"gravity-gradient\"",
     .help = "What it is."},
    {.path = "perturbation[].orbit",
     .type = name,
     .presence = required,
     .example = "\"earth\"",
     .help = "The name of a table [orbit.NAME]: where the attracting point mass is, or what the "
             "body goes round.",
     .kinds = "gravity-gradient|solar-pressure|drag"},
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
};

}  // namespace

SchemaPart perturbation_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
