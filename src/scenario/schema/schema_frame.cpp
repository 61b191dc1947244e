// SPDX-License-Identifier: MIT
// The table of scenario keys: the reference frame.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "frame",
     .help = "The reference frame S that attitudes refer to; left out, it is the inertial one. The "
             "state is then that in S at t = 0; omega is always relative to inertial axes."},
    {.path = "frame.precessing",
     .presence = alternative,
     .help = "A frame that turns with a constant rate about a constant axis."},
    {.path = "frame.precessing.axis",
     .type = numbers,
     .presence = required,
     .length = 3,
     .example = "[0.0, 0.0, 1.0]",
     .help = "The axis, in inertial axes; its length plays no part."},
    {.path = "frame.precessing.rate",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::rate,
     .example = "0.5",
     .help = "The rate of turn, right-handed about the axis."},
    {.path = "frame.precessing.orbit",
     .type = name,
     .presence = alternative,
     .example = "\"earth\"",
     .help = "The name of a table [orbit.NAME] whose mean motion gives the rate: the mean rate of "
             "the longitude, node and pericentre included."},
    {.path = "frame.precessing.turns",
     .type = number,
     .presence = alternative,
     .example = "1.5",
     .help = "Turns of the frame per revolution on that orbit: 1 for a body that keeps one face to "
             "the other, 1.5 for the 3:2 resonance."},
    {.path = "frame.precessing.epoch",
     .type = number,
     .dimension = Dimension::time,
     .fallback = "0",
     .example = "0",
     .help = "When the frame coincides with the inertial axes."},
    {.path = "frame.orbit-plane",
     .presence = alternative,
     .help = "The plane of an orbit: axis 1 along its ascending node, axis 3 along its normal. It "
             "turns with the node, not with the body on the orbit."},
    {.path = "frame.orbit-plane.orbit",
     .type = name,
     .presence = required,
     .example = "\"earth\"",
     .help = "The name of a table [orbit.NAME]."},
};

constexpr Alternatives alternatives[] = {{"frame", "precessing|orbit-plane"},
                                         {"frame.precessing", "rate|orbit+turns"}};

}  // namespace

SchemaPart frame_keys() { return {keys, alternatives}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
