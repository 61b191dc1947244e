// SPDX-License-Identifier: MIT
// The table of scenario keys: events.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
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

SchemaPart event_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
