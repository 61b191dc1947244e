// SPDX-License-Identifier: MIT
// The table of scenario keys: surfaces.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
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

constexpr Alternatives alternatives[] = {{"surface[]", "position+normal+area|shape"}};

}  // namespace

SchemaPart surface_keys() { return {keys, alternatives}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
