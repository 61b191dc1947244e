// SPDX-License-Identifier: MIT
// The table of scenario keys: maps over grids of its own numbers.
#include "io/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "map",
     .help = "What `polhode map` makes: one run for every cell of a grid, up to the last row of "
             "[time]."},
    {.path = "map.kind",
     .type = choice,
     .presence = required,
     .allowed = "chaos|column",
     .example = "\"chaos\"",
     .help = "What a cell gives: mean MEGNO and Lyapunov indicator, or the extremes and the last "
             "value of a column."},
    {.path = "map.column",
     .type = text,
     .presence = required,
     .example = "\"theta\"",
     .help = "Any column but t, of any group, at the rows of [time].",
     .kinds = "column"},
    {.path = "map.axis[]",
     .presence = required,
     .help = "One or more axes of the grid; the last one runs fastest."},
    {.path = "map.axis[].key",
     .type = text,
     .presence = required,
     .example = "\"state.attitude-rate.omega_body[2]\"",
     .help = "A number of this file by its keys, also one with a fallback; perturbation[0] is the "
             "first of its tables, omega_body[2] the third number of an array."},
    {.path = "map.axis[].from",
     .type = number,
     .presence = required,
     .example = "0",
     .help = "Its first value, in the unit that the key has in this file."},
    {.path = "map.axis[].to",
     .type = number,
     .presence = required,
     .example = "1",
     .help = "Its last value."},
    {.path = "map.axis[].count",
     .type = integer,
     .presence = required,
     .example = "11",
     .help = "How many values, both ends included; 1 takes from."},
};

}  // namespace

SchemaPart map_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
