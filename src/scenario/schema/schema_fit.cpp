// SPDX-License-Identifier: MIT
// The table of scenario keys: what of a file of kind "fit" is unknown (its state, body, torques and
// jumps), how it is looked for, and what simulations add. Observations: fit/observation_keys.cpp.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

using enum KeyType;
using enum Presence;

constexpr std::string_view of_any = "attitude|rate|moments|products";

constexpr Key fit_rows[] = {
    {.path = "free", .presence = required, .help = "What `polhode fit` looks for; all else stays."},
    {.path = "free.unknowns",
     .type = choices,
     .presence = required,
     .allowed = "attitude|rate|moments|products|shape|law",
     .example = "[\"attitude\", \"rate\", \"moments\"]",
     .help =
         "Attitude and angular velocity at t = 0 (of a search of light curves: in the middle of "
         "the data, where its table has them), the ratios Ixx/Izz and Iyy/Izz, and the "
         "products of inertia over Izz, in the body axes that this file gives vectors in. Of "
         "free rotation only ratios matter: Izz stays. Of light curves: attitude and rate, "
         "which they always have; shape, the ratios b/a and c/b of the ellipsoid; moments of "
         "their own; law, the weight of Lambert's law beside that of Lommel and Seeliger."},
    {.path = "free.prior[]", .help = "What is known of unknowns beforehand, as normal numbers."},
    {.path = "free.prior[].kind",
     .type = choice,
     .presence = required,
     .allowed = of_any,
     .example = "\"rate\"",
     .help = "Of which unknowns."},
    {.path = "free.prior[].mean",
     .type = numbers,
     .dimension = Dimension::rate,
     .length = 3,
     .example = "[14.5, 33.5, -98.7]",
     .help = "Of the angular velocity along the body axes; left out, that of the start.",
     .kinds = "rate"},
    {.path = "free.prior[].mean",
     .type = numbers,
     .length = 2,
     .example = "[3.1, 3.2]",
     .help = "Of Ixx/Izz and Iyy/Izz; left out, those of the start.",
     .kinds = "moments"},
    {.path = "free.prior[].mean",
     .type = numbers,
     .length = 3,
     .example = "[0, 0, 0]",
     .help = "Of Ixy/Izz, Iyz/Izz, Ixz/Izz; left out, those of the start.",
     .kinds = "products"},
    {.path = "free.prior[].sigmas",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::angle,
     .length = 3,
     .example = "[15, 15, 15]",
     .help = "Standard errors of the attitude of the start about the body axes.",
     .kinds = "attitude",
     .range = Range::positive},
    {.path = "free.prior[].euler_sigmas",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::angle,
     .length = 3,
     .example = "[15, 15, 15]",
     .help = "Standard errors of its Euler angles phi, theta, psi.",
     .kinds = "attitude",
     .range = Range::positive},
    {.path = "free.prior[].sigmas",
     .type = numbers,
     .presence = required,
     .dimension = Dimension::rate,
     .length = 3,
     .example = "[0.1, 0.1, 0.1]",
     .help = "Standard errors along the body axes.",
     .kinds = "rate",
     .range = Range::positive},
    {.path = "free.prior[].sigmas",
     .type = numbers,
     .presence = required,
     .length = 2,
     .example = "[0.1, 0.1]",
     .help = "Standard errors of the two ratios.",
     .kinds = "moments",
     .range = Range::positive},
    {.path = "free.prior[].sigmas",
     .type = numbers,
     .presence = required,
     .length = 3,
     .example = "[0.01, 0.01, 0.01]",
     .help = "Standard errors of the three.",
     .kinds = "products",
     .range = Range::positive},

    {.path = "fit",
     .fallback = "{}",
     .help =
         "How `polhode fit` looks: least squares by Levenberg and Marquardt's method, with exact "
         "derivatives."},
    {.path = "fit.loss",
     .type = choice,
     .allowed = "squared|huber|soft-l1|cauchy",
     .fallback = "\"squared\"",
     .example = "\"squared\"",
     .help = "What an observation costs: the square of its residual, or less where it is far out."},
    {.path = "fit.loss_scale",
     .type = number,
     .fallback = "1",
     .example = "1",
     .help = "From how many standard errors on; of the squared loss nothing.",
     .range = Range::positive},
    {.path = "fit.iterations",
     .type = integer,
     .fallback = "200",
     .example = "200",
     .help =
         "At most, for each start; left out, 60 in a search of light curves, whose fits near the "
         "lowest go on for four times as many."},
    {.path = "fit.tolerance",
     .type = number,
     .fallback = "1e-12",
     .example = "1e-12",
     .help = "Of the motion and its derivatives where torques act, in a step: long arcs that were "
             "seen with errors of degrees need no more than 1e-9.",
     .range = Range::positive},
    {.path = "fit.starts",
     .type = integer,
     .fallback = "1",
     .example = "1",
     .help = "From how many states it begins, up to 1e6: that of the file, then others with any "
             "attitude and a rate about that of the file, where these are unknown. Of a search of "
             "light curves: at first, in all, left out 20 for each pair of periods; pairs near the "
             "lowest get more."},
    {.path = "fit.rate_spread",
     .type = number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "0",
     .help = "Standard deviation of each component of these rates.",
     .range = Range::not_negative},
    {.path = "fit.within",
     .type = number,
     .fallback = "20",
     .example = "20",
     .help = "Solutions are reported up to this much above the least chi-square; those of light "
             "curves by `fit.within_factor`.",
     .range = Range::not_negative},
    {.path = "fit.most_solutions",
     .type = integer,
     .fallback = "20",
     .example = "20",
     .help = "How many solutions are listed, and written to files, at most; `--json` has all."},
    {.path = "fit.seed",
     .type = integer,
     .fallback = "1",
     .example = "1",
     .help = "Another seed draws other starts."},

    {.path = "simulate",
     .fallback = "{}",
     .help = "What `polhode simulate` adds to what would be seen at the times of [time]."},
    {.path = "simulate.seed",
     .type = integer,
     .fallback = "1",
     .example = "1",
     .help = "Another seed draws other noise."},
};

constexpr Alternatives fit_alternatives[] = {{"free.prior[]", "sigmas|euler_sigmas", "attitude"}};

constexpr KindText fit_kinds[] = {
    {"", "fit", "A rotation, what was observed of it, and what of it is unknown."},
    {"free.prior[]", "attitude", "The attitude at t = 0."},
    {"free.prior[]", "rate", "The angular velocity at t = 0 along the body axes."},
    {"free.prior[]", "moments", "The ratios of moments Ixx/Izz and Iyy/Izz."},
    {"free.prior[]", "products",
     "The products of inertia over Izz, as elements of the tensor: Ixy is minus the integral of x "
     "y dm."},
};

}  // namespace

SchemaPart fit_keys() { return {fit_rows, fit_alternatives, fit_kinds}; }

namespace {

constexpr std::string_view of_momentum = "momentum-body|momentum-inertial";

constexpr Key torque_rows[] = {
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

constexpr KindText jump_kinds[] = {
    {"free.jump[]", "rate", "The angular velocity, along the body axes."},
    {"free.jump[]", "momentum-body", "The angular momentum, along the body axes."},
    {"free.jump[]", "momentum-inertial", "The angular momentum, along the inertial axes."},
};

}  // namespace

SchemaPart fit_torque_keys() { return {torque_rows, {}, jump_kinds}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
