// SPDX-License-Identifier: MIT
// The table of scenario keys: maps over grids of its own numbers.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr std::string_view andoyer = "andoyer-section";

constexpr Key keys[] = {
    {.path = "map",
     .help = "What `polhode map` makes: one run for every cell of a grid, up to the last row of "
             "[time]."},
    {.path = "map.kind",
     .type = choice,
     .presence = required,
     .allowed = "chaos|column|andoyer-section|spin-orbit-section|frequency",
     .example = "\"chaos\"",
     .help = "What a cell gives: mean MEGNO and Lyapunov indicator; the extremes and the last "
             "value of a column; or a row for every point of a surface of section: Andoyer's "
             "elements, or angle, spin and tilt at every pericentre. Of a file of kind "
             "\"obliquity\": a column, or the frequency of the precession in the first and in the "
             "second half of the rows, and by what fraction it changed, which shows chaos."},
    {.path = "map.column",
     .type = text,
     .presence = required,
     .example = "\"theta\"",
     .help = "Any column but t, of any group, at the rows of [time].",
     .kinds = "column"},
    {.path = "map.orbit",
     .type = text,
     .presence = required,
     .example = "\"saturn\"",
     .help = "The name of an ellipse of this file, e > 0: its pericentres are the section.",
     .kinds = "spin-orbit-section"},
    {.path = "map.angle",
     .type = choice,
     .presence = alternative,
     .allowed = "l|g|h",
     .example = "\"g\"",
     .help = "The section is where this angle of Andoyer's passes a value; g or h for the plane of "
             "l and L.",
     .kinds = andoyer},
    {.path = "map.value",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "That value, modulo a turn.",
     .kinds = andoyer},
    {.path = "map.crossing",
     .type = choice,
     .allowed = "both|rising|falling",
     .fallback = "\"rising\"",
     .example = "\"rising\"",
     .help = "Which passages count.",
     .kinds = andoyer},
    {.path = "map.period",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::time,
     .example = "1",
     .help = "The section is once in a period, as that of what acts.",
     .kinds = andoyer,
     .range = Range::positive},
    {.path = "map.epoch",
     .type = number,
     .dimension = Dimension::time,
     .fallback = "0",
     .example = "0",
     .help = "One of the times of a section by period.",
     .kinds = andoyer},
    {.path = "map.axis[]",
     .help = "The axes of the grid; the last one runs fastest. A section without an axis has one "
             "start.",
     .needed_by = "chaos|column|frequency"},
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
     .help = "Its first value, in the unit that the key has in this file: its own, where it was "
             "written "
             "with one, or that of [units]."},
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

constexpr Alternatives alternatives[] = {{"map", "angle|period", andoyer}};

}  // namespace

SchemaPart map_keys() { return {keys, alternatives}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
