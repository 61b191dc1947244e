// SPDX-License-Identifier: MIT
// The table of scenario keys: the method and events.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr std::string_view adaptive = "adaptive";
constexpr std::string_view splitting = "splitting";
constexpr std::string_view stepped_freely = "adaptive|variation-of-constants";

constexpr Key keys[] = {
    {.path = "method",
     .help =
         "How the rotation is integrated. Left out: not at all where no perturbation acts, since "
         "the free rotation is exact; otherwise adaptive with its defaults."},
    {.path = "method.kind",
     .type = choice,
     .presence = required,
     .allowed = "adaptive|splitting|variation-of-constants",
     .example = "\"adaptive\"",
     .help = "Which method (docs/guide/which-propagator.md)."},
    {.path = "method.tolerance",
     .type = number,
     .fallback = "1e-12",
     .example = "1e-12",
     .help = "Error of one step, relative; from 1e-15 (double-double: 1e-30) to 0.01.",
     .kinds = stepped_freely},
    {.path = "method.precision",
     .type = choice,
     .allowed = "compensated|double-double",
     .fallback = "\"compensated\"",
     .example = "\"compensated\"",
     .help =
         "Arithmetic: double with compensated sums, or double-double, some twenty times slower.",
     .kinds = adaptive},
    {.path = "method.largest_step",
     .type = number,
     .dimension = Dimension::time,
     .example = "1",
     .help = "No step is longer: for a torque that comes and goes within a step. Left out: "
             "adaptive takes a "
             "quarter of a turn of the fastest orbit, field or frame, where there is one.",
     .kinds = stepped_freely},
    {.path = "method.step",
     .type = number,
     .presence = required,
     .dimension = Dimension::time,
     .example = "0.01",
     .help = "The step; positive.",
     .kinds = splitting},
    {.path = "method.scheme",
     .type = choice,
     .allowed = "order2|order4|order6|order8|ABA864|ABA1064",
     .fallback = "\"ABA864\"",
     .example = "\"ABA864\"",
     .help = "How free rotation and perturbation are composed.",
     .kinds = splitting},

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
             "turn of the body and its frame, which finds what varies as fast as these."},
};

}  // namespace

SchemaPart method_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
