// SPDX-License-Identifier: MIT
// The table of scenario keys: which numbers of the torques of a file of kind "fit" are unknown, and
// where its spin may jump.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr std::string_view of_momentum = "momentum-body|momentum-inertial";

constexpr Key keys[] = {
    {.path = "free.parameter[]",
     .help = "A number of a torque that is unknown, one to which the torque is proportional or "
             "proportional beside a part that stays: a component, GM, a pressure, a tensor. The "
             "fit begins at the number of the file."},
    {.path = "free.parameter[].key",
     .type = text,
     .presence = required,
     .example = "\"perturbation[0].torque[2]\"",
     .help = "The number by its keys; perturbation[0] is the first of its tables, torque[2] the "
             "third number of an array. All else of this table is in the unit that it has in the "
             "file."},
    {.path = "free.parameter[].low",
     .type = number,
     .example = "0",
     .help = "Least number; left out, 0 for what cannot be negative, else none."},
    {.path = "free.parameter[].high", .type = number, .example = "1", .help = "Greatest number."},
    {.path = "free.parameter[].mean",
     .type = number,
     .example = "0",
     .help = "Of a normal prior; left out, the number of the file."},
    {.path = "free.parameter[].sigma",
     .type = number,
     .example = "0.1",
     .help = "Its standard error; left out, no prior.",
     .range = Range::positive},

    {.path = "free.jump[]",
     .help = "A jump of the spin of an unknown size, just after a time that lies between the "
             "observations: a collision, a thruster, the shedding of mass."},
    {.path = "free.jump[].kind",
     .type = choice,
     .presence = required,
     .allowed = "rate|momentum-body|momentum-inertial",
     .example = "\"rate\"",
     .help = "What jumps."},
    {.path = "free.jump[].t",
     .type = number,
     .presence = required,
     .dimension = Dimension::time,
     .example = "100",
     .help = "When, counted from the epoch.",
     .takes_date = true},
    {.path = "free.jump[].change",
     .type = numbers,
     .dimension = Dimension::rate,
     .length = 3,
     .fallback = "[0, 0, 0]",
     .example = "[0, 0, 0]",
     .help = "Where the fit begins: of the angular velocity along the body axes.",
     .kinds = "rate"},
    {.path = "free.jump[].change",
     .type = numbers,
     .dimension = Dimension::momentum,
     .length = 3,
     .fallback = "[0, 0, 0]",
     .example = "[0, 0, 0]",
     .help = "Where the fit begins: of the angular momentum.",
     .kinds = of_momentum},
    {.path = "free.jump[].sigmas",
     .type = numbers,
     .dimension = Dimension::rate,
     .length = 3,
     .example = "[1, 1, 1]",
     .help = "Standard errors of a normal prior about that; left out, none.",
     .kinds = "rate",
     .range = Range::positive},
    {.path = "free.jump[].sigmas",
     .type = numbers,
     .dimension = Dimension::momentum,
     .length = 3,
     .example = "[1, 1, 1]",
     .help = "Standard errors of a normal prior about that; left out, none.",
     .kinds = of_momentum,
     .range = Range::positive},
};

constexpr KindText kinds[] = {
    {"free.jump[]", "rate", "The angular velocity, along the body axes."},
    {"free.jump[]", "momentum-body", "The angular momentum, along the body axes."},
    {"free.jump[]", "momentum-inertial", "The angular momentum, along the inertial axes."},
};

}  // namespace

SchemaPart fit_torque_keys() { return {keys, {}, kinds}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
