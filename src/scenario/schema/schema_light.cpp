// SPDX-License-Identifier: MIT
// The table of scenario keys: how a body scatters light, and how periods are looked for in light
// curves. The rest of [fit]: schema_fit.cpp.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "light", .fallback = "{}", .help = "How bright the body is, for light curves."},
    {.path = "light.shape",
     .type = choice,
     .allowed = "ellipsoid|convex|mesh",
     .fallback = "\"ellipsoid\"",
     .example = "\"ellipsoid\"",
     .help =
         "What is seen: an ellipsoid along the principal axes; in fits alone a convex body that "
         "is looked for, from the ellipsoid that fits best; or a given mesh, with its shadows, "
         "that of `light.mesh` or else of `body.shape`."},
    {.path = "light.mesh",
     .type = text,
     .example = "\"seen.obj\"",
     .help = "The mesh that is seen, Wavefront OBJ, along the body axes, in any unit; it need not "
             "be that of [body]. Relative to the folder of this file."},
    {.path = "light.semiaxes",
     .type = numbers,
     .length = 3,
     .example = "[1, 0.7, 0.6]",
     .help = "Of the ellipsoid, along the principal axes, in any unit; left out, that of an even "
             "filling of the moments.",
     .range = Range::positive},
    {.path = "light.moments",
     .type = choice,
     .allowed = "of-shape|of-body",
     .fallback = "\"of-shape\"",
     .example = "\"of-shape\"",
     .help =
         "The moments of inertia of a fit where they are no unknowns: of the shape filled "
         "evenly, or those of [body]. Left out, those of a convex body are unknowns about those "
         "of its ellipsoid, and those of a mesh stay. Simulations have those of [body]."},
    {.path = "light.convex",
     .fallback = "{}",
     .help = "Facets of a convex body, and what keeps them smooth."},
    {.path = "light.convex.degree",
     .type = integer,
     .fallback = "6",
     .example = "6",
     .help = "Of the series of the areas of facets, 1 to 40: (degree + 1)^2 coefficients."},
    {.path = "light.convex.rows",
     .type = integer,
     .fallback = "8",
     .example = "8",
     .help = "8 rows^2 facets, 1 to 200 rows."},
    {.path = "light.convex.roughness_error",
     .type = number,
     .fallback = "3",
     .example = "3",
     .help = "How rough the body is: the standard error of l (l + 1) times each coefficient of "
             "degree l about that of the ellipsoid. Smaller ones give smoother bodies.",
     .range = Range::positive},
    {.path = "light.convex.moments_error",
     .type = number,
     .fallback = "0.1",
     .example = "0.1",
     .help = "The standard error of Ixx/Izz and Iyy/Izz about those of the ellipsoid.",
     .range = Range::positive},
    {.path = "light.convex.pairs",
     .type = integer,
     .example = "40",
     .help = "How many pairs of periods of a search go on to a convex body, those of the best "
             "ellipsoids; left out, all, since the truth may fit an ellipsoid badly."},
    {.path = "light.law",
     .type = choice,
     .allowed = "lommel-seeliger|lambert|mixed",
     .fallback = "\"lommel-seeliger\"",
     .example = "\"lommel-seeliger\"",
     .help = "The law of scattering; mixed: both, with the weights 1 and `multiple`."},
    {.path = "light.multiple",
     .type = number,
     .fallback = "0.1",
     .example = "0.1",
     .help = "Weight of Lambert's law beside that of Lommel and Seeliger, where the law is mixed.",
     .range = Range::positive},

    {.path = "fit.from",
     .type = choice,
     .allowed = "start|search",
     .fallback = "\"start\"",
     .example = "\"search\"",
     .help = "Of light curves: from the state and shape of this file, or from many that have the "
             "periods of a scan, or those of [[fit.periods]]."},
    {.path = "fit.rotation",
     .type = choice,
     .allowed = "any|tumbler",
     .fallback = "\"any\"",
     .example = "\"any\"",
     .help = "Of light curves: any stops after the scan if one period describes the data as well "
             "as two do, or a constant brightness as well as one; tumbler goes on to two periods."},
    {.path = "fit.sessions",
     .type = choice,
     .allowed = "together|one-by-one",
     .fallback = "\"together\"",
     .example = "\"together\"",
     .help = "Of light curves: one-by-one fits one session first (a search: the one with most "
             "points; a start: the one that it fits best). Then the nearest session joins, with "
             "every number of turns in between that the errors of the periods allow, and so on."},
    {.path = "fit.within_factor",
     .type = number,
     .fallback = "2",
     .example = "2",
     .help = "Solutions of light curves are reported up to so many times the least chi-square, or "
             "the least loss where `fit.loss` is robust; 1 or more.",
     .range = Range::positive},
    {.path = "fit.scan",
     .fallback = "{}",
     .help = "The scan of light curves for two frequencies, whose sums and multiples are the lines "
             "of a tumbler."},
    {.path = "fit.scan.order",
     .type = integer,
     .fallback = "3",
     .example = "3",
     .help = "How many multiples of each frequency, 1 to 9.",
     .in_template = true},
    {.path = "fit.scan.shortest",
     .type = number,
     .dimension = Dimension::time,
     .example = "\"2 min\"",
     .help = "The shortest period that is looked at; left out, four times the typical time from "
             "point to point.",
     .range = Range::positive},
    {.path = "fit.scan.longest",
     .type = number,
     .dimension = Dimension::time,
     .example = "\"3 h\"",
     .help = "The longest; left out, all of the time that the data cover.",
     .range = Range::positive},
    {.path = "fit.scan.sessions",
     .type = choice,
     .allowed = "joined|separate",
     .fallback = "\"joined\"",
     .example = "\"joined\"",
     .help =
         "How several nights are scanned. joined: on one grid, fine enough for all the time from "
         "the first point to the last. separate: each session on a coarser grid, then around the "
         "lowest minima of their sum on all of that time; periods longer than a session are not "
         "found."},
    {.path = "fit.scan.windows",
     .type = integer,
     .fallback = "20",
     .example = "20",
     .help = "Of separate sessions: how many minima of their sum are looked into."},
    {.path = "fit.scan.minima",
     .type = integer,
     .fallback = "20",
     .example = "20",
     .help = "How many minima of the landscape are refined. With P1 and P2 exchanged each is there "
             "twice, and listed once."},
    {.path = "fit.scan.pairs",
     .type = integer,
     .fallback = "5",
     .example = "5",
     .help = "How many of these the search takes."},
    {.path = "fit.scan.labels",
     .type = integer,
     .fallback = "60",
     .example = "60",
     .help = "How many readings of each as P_phi and P_psi, the most likely ones."},
    {.path = "fit.scan.at",
     .type = numbers,
     .dimension = Dimension::time,
     .example = "[12, 20]",
     .help = "Pairs of periods of your own, P1 and P2 one after the other, such as published ones: "
             "chi-square of the series is told at each, and at the minimum next to it.",
     .range = Range::positive},
    {.path = "fit.scan.at_order",
     .type = integer,
     .example = "3",
     .help = "How many multiples of each of these, 1 to 9; left out, `order`."},
    {.path = "fit.periods[]",
     .help = "Pairs of periods that a search begins with, in place of a scan."},
    {.path = "fit.periods[].mode",
     .type = choice,
     .presence = required,
     .allowed = "SAM|LAM",
     .example = "\"LAM\"",
     .help = "Short-axis or long-axis mode."},
    {.path = "fit.periods[].precession_period",
     .type = number,
     .presence = required,
     .dimension = Dimension::time,
     .example = "\"7.4 d\"",
     .help = "P_phi, of the long axis about the angular momentum.",
     .range = Range::positive},
    {.path = "fit.periods[].rotation_period",
     .type = number,
     .presence = required,
     .dimension = Dimension::time,
     .example = "\"5.4 d\"",
     .help = "P_psi, about the long axis or back and forth about it.",
     .range = Range::positive},

    {.path = "simulate.sessions",
     .type = numbers,
     .dimension = Dimension::time,
     .example = "[0, 6, 24, 30]",
     .help = "From when to when each session of light curves is, as times or dates; left out, all "
             "rows of [time] are one.",
     .takes_date = true},
};

}  // namespace

SchemaPart light_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
