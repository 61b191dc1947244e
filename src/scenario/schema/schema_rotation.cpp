// SPDX-License-Identifier: MIT
// The table of scenario keys: surfaces, orbits and events of a rotation.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

using enum KeyType;
using enum Presence;

constexpr Key surface_rows[] = {
    {.path = "surface[]",
     .help = "What light and air act on: flat plates, or the facets of a mesh; any number of "
             "tables. Facets do not shade each other."},
    {.path = "surface[].position",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::length,
     .length = 3,
     .example = "[0.001, 0.0, 0.0]",
     .help = "Centre of a plate, from the centre of mass along the body axes of this file."},
    {.path = "surface[].normal",
     .type = numbers,
     .presence = alternative,
     .length = 3,
     .example = "[1.0, 0.0, 0.0]",
     .help = "Its normal, away from the body; of any length."},
    {.path = "surface[].area",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::area,
     .example = "\"10 m2\"",
     .help = "Its area.",
     .range = Range::positive},
    {.path = "surface[].sides",
     .type = integer,
     .allowed = "1|2",
     .fallback = "1",
     .example = "1",
     .help = "2 for a plate whose back is free too."},
    {.path = "surface[].shape",
     .type = text,
     .presence = alternative,
     .example = "\"body.obj\"",
     .help = "A mesh, Wavefront OBJ, along the body axes of this file; relative to its folder.",
     .is_file = true},
    {.path = "surface[].scale",
     .type = number,
     .dimension = Dimension::length,
     .example = "\"1 km\"",
     .help = "What one unit of the mesh is; required with shape.",
     .range = Range::positive},
    {.path = "surface[].centre_of_mass",
     .type = numbers,
     .dimension = Dimension::length,
     .length = 3,
     .example = "[0.0, 0.0, 0.0]",
     .help = "Where the centre of mass is in the mesh; left out, that of the mesh of [body], or "
             "where that has none, its origin."},
    {.path = "surface[].specular",
     .type = number,
     .fallback = "0",
     .example = "0.1",
     .help = "Fraction of the light that is mirrored."},
    {.path = "surface[].diffuse",
     .type = number,
     .fallback = "0",
     .example = "0.3",
     .help = "Fraction that is scattered by Lambert's law; what is left is absorbed."},
    {.path = "surface[].emitted",
     .type = number,
     .fallback = "0",
     .example = "0",
     .help = "Fraction of the absorbed light that is given back at once as heat, by Lambert's "
             "law."},
    {.path = "surface[].normal_accommodation",
     .type = number,
     .fallback = "1",
     .example = "1",
     .help = "Of air: 1 where molecules leave with the speed of the wall, 0 where they are "
             "mirrored."},
    {.path = "surface[].tangential_accommodation",
     .type = number,
     .fallback = "1",
     .example = "1",
     .help = "The same for their momentum along the wall."},
};

constexpr Alternatives surface_alternatives[] = {{"surface[]", "position+normal+area|shape"}};

}  // namespace

SchemaPart surface_keys() { return {surface_rows, surface_alternatives}; }

namespace {

constexpr Key orbit_rows[] = {{.path = "orbit", .help = "Orbits, by names that the file chooses."}};

}  // namespace

SchemaPart orbit_keys() { return {orbit_rows, {}}; }

namespace {

constexpr Key event_rows[] = {
    {.path = "event[]",
     .help = "A time to find: when a column passes a value. `polhode run --events` writes them."},
    {.path = "event[].name",
     .type = name,
     .example = "\"flip\"",
     .help = "What outputs call it; left out, the name of the column."},
    {.path = "event[].column",
     .type = text,
     .presence = required,
     .example = "\"w3\"",
     .help = "Any column but t, of any group; it need not be written."},
    {.path = "event[].value",
     .type = number,
     .fallback = "0",
     .example = "0",
     .help = "In the unit of the column; angles are compared modulo a turn."},
    {.path = "event[].crossing",
     .type = choice,
     .allowed = "both|rising|falling",
     .fallback = "\"both\"",
     .example = "\"both\"",
     .help = "Which passages count."},
    {.path = "event[].stops",
     .type = boolean,
     .fallback = "false",
     .example = "false",
     .help = "Whether the run ends there, with a last row."},
    {.path = "event[].interval",
     .type = number,
     .dimension = Dimension::time,
     .example = "1",
     .help = "The column is looked at this often at least. Left out: twelve times in the fastest "
             "turn of the body and its frame, which finds what varies as fast as these.",
     .range = Range::positive},
};

}  // namespace

SchemaPart event_keys() { return {event_rows, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
