// SPDX-License-Identifier: MIT
// The table of scenario keys: maps over grids, and ensembles with some numbers drawn.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

using enum KeyType;
using enum Presence;

constexpr std::string_view andoyer = "andoyer-section";

constexpr Key map_rows[] = {
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

constexpr Alternatives map_alternatives[] = {{"map", "angle|period", andoyer}};

}  // namespace

SchemaPart map_keys() { return {map_rows, map_alternatives}; }

namespace {

constexpr std::string_view of_one = "normal|uniform|log-uniform|grid";
constexpr std::string_view of_several = "joint-normal|direction|attitude|table";

constexpr Key ensemble_rows[] = {
    {.path = "ensemble",
     .help = "What `polhode ensemble` makes: many runs of this file, its members, with some of its "
             "numbers drawn. `polhode run` takes the file as it stands."},
    {.path = "ensemble.size",
     .type = integer,
     .presence = required,
     .example = "10000",
     .help = "How many members, up to 1e12."},
    {.path = "ensemble.seed",
     .type = integer,
     .fallback = "1",
     .example = "1",
     .help = "Another seed draws other members."},
    {.path = "ensemble.draws",
     .type = choice,
     .allowed = "random|sobol",
     .fallback = "\"random\"",
     .example = "\"random\"",
     .help = "Random numbers, or Sobol's points, over which means settle faster."},
    {.path = "ensemble.keep",
     .type = choice,
     .allowed = "statistics|final|rows",
     .fallback = "\"statistics\"",
     .example = "\"statistics\"",
     .help = "What is written: statistics of the members at each time of [time]; one row for each "
             "member, with what was drawn and its last row; or all rows of all members."},
    {.path = "ensemble.quantiles",
     .type = numbers,
     .fallback = "[0.05, 0.5, 0.95]",
     .example = "[0.05, 0.5, 0.95]",
     .help = "Which quantiles of each column statistics have, from 0 to 1."},
    {.path = "ensemble.bins",
     .type = integer,
     .fallback = "256",
     .example = "256",
     .help = "How many bins quantiles come from where there are too many numbers to keep "
             "(more than 8e6, members times rows times columns), up to 1e6."},
    {.path = "ensemble.chunk",
     .type = integer,
     .example = "1024",
     .help = "Members that are reduced together by one thread. The last digits of statistics "
             "depend on it, and on nothing else of how an ensemble is run. Left out: a 64th of "
             "size, 1 at least and 1024 at most."},
    {.path = "ensemble.indicators",
     .type = choices,
     .allowed = "mean_megno|lyapunov",
     .example = "[\"mean_megno\", \"lyapunov\"]",
     .help = "Indicators of chaos, as those of [map]: columns of the rows of each member, from "
             "t = 0 up to the time of the row. They take two to five times as long as the rest of "
             "a run. Of kind \"rotation\" without a damper, rows on one side of t = 0."},
    {.path = "ensemble.fraction[]",
     .help = "Statistics, and no other keep, have a column NAME_part: which part of the members "
             "whose column is a "
             "number has it from low on and below high."},
    {.path = "ensemble.fraction[].name",
     .type = name,
     .presence = required,
     .example = "\"librating\"",
     .help = "What outputs call it."},
    {.path = "ensemble.fraction[].column",
     .type = text,
     .presence = required,
     .example = "\"g\"",
     .help = "A column of the rows of a member."},
    {.path = "ensemble.fraction[].low",
     .type = number,
     .example = "-90",
     .help = "In the unit of the column; left out: none. An angle with both bounds lies between "
             "them if it does so whole turns apart; with one, as its row has it."},
    {.path = "ensemble.fraction[].high", .type = number, .example = "90", .help = "As low."},
    {.path = "ensemble.histogram[]",
     .help = "Beside statistics, and no other keep, how many members have a column, or two, in "
             "each of even bins: a "
             "file of its own, OUT.NAME.csv or .h5 next to the first output OUT.csv or .h5."},
    {.path = "ensemble.histogram[].name",
     .type = name,
     .presence = required,
     .example = "\"periods\"",
     .help = "In the name of its file."},
    {.path = "ensemble.histogram[].columns",
     .type = KeyType::columns,
     .presence = required,
     .example = "[\"P_phi\", \"body.moments[0]\"]",
     .help = "One or two columns of the rows of a member, or keys that vary."},
    {.path = "ensemble.histogram[].bins",
     .type = integer,
     .fallback = "40",
     .example = "40",
     .help = "Between low and high of each column, up to 1e4."},
    {.path = "ensemble.histogram[].low",
     .type = numbers,
     .example = "[200, 0.5]",
     .help =
         "Of each column, in its unit. Left out with high: the range of the members, or, where "
         "there are too many to keep their numbers, that of the first 1024 at most and a tenth of "
         "it on either side."},
    {.path = "ensemble.histogram[].high",
     .type = numbers,
     .example = "[320, 0.7]",
     .help = "As low."},
    {.path = "ensemble.histogram[].times",
     .type = choice,
     .allowed = "last|all",
     .fallback = "\"last\"",
     .example = "\"last\"",
     .help = "Of the last time of [time], or of each of them."},
    {.path = "ensemble.vary[]",
     .presence = required,
     .help = "What the members differ in. What is drawn for a key depends on the seed, the keys of "
             "its table and the index of the member, not on the other tables."},
    {.path = "ensemble.vary[].kind",
     .type = choice,
     .presence = required,
     .allowed = "normal|uniform|log-uniform|joint-normal|direction|attitude|grid|table",
     .example = "\"normal\"",
     .help = "The distribution. All numbers of the table are in the units that the keys have in "
             "this file: their own, where they were written with one, or those of [units]."},
    {.path = "ensemble.vary[].key",
     .type = text,
     .presence = required,
     .example = "\"state.attitude-rate.omega_body[2]\"",
     .help = "A number of this file by its keys, also one with a fallback; perturbation[0] is the "
             "first of its tables, omega_body[2] the third number of an array.",
     .kinds = of_one},
    {.path = "ensemble.vary[].keys",
     .type = KeyType::key_list,
     .presence = required,
     .example = "[\"state.attitude-rate.omega_body\"]",
     .help =
         "Several numbers, an array by its name. A direction has the three components of a "
         "vector, which keeps its length, or two angles in either order, which are known by their "
         "names: longitude, ra or node, and latitude, dec or inclination; an attitude the four "
         "components of a quaternion.",
     .kinds = of_several},
    {.path = "ensemble.vary[].mean",
     .type = number,
     .example = "1",
     .help = "Left out: the number that the file has.",
     .kinds = "normal"},
    {.path = "ensemble.vary[].sigma",
     .type = number,
     .presence = required,
     .example = "0.1",
     .help = "Standard deviation, before low and high cut; 0 is a fixed number, the mean.",
     .kinds = "normal",
     .range = Range::not_negative},
    {.path = "ensemble.vary[].low",
     .type = number,
     .example = "0",
     .help = "Least number; a normal one may have a bound on one side, on both, or none.",
     .kinds = "normal|uniform|log-uniform",
     .needed_by = "uniform|log-uniform"},
    {.path = "ensemble.vary[].high",
     .type = number,
     .example = "1",
     .help = "Greatest number.",
     .kinds = "normal|uniform|log-uniform",
     .needed_by = "uniform|log-uniform"},
    {.path = "ensemble.vary[].means",
     .type = numbers,
     .example = "[0.1, 0.2, 1]",
     .help = "Left out: the numbers that the file has.",
     .kinds = "joint-normal"},
    {.path = "ensemble.vary[].covariance",
     .type = square,
     .presence = required,
     .example = "[[0.01, 0, 0], [0, 0.01, 0.005], [0, 0.005, 0.01]]",
     .help = "Of the keys, row by row; what others fix may be there.",
     .kinds = "joint-normal"},
    {.path = "ensemble.vary[].from",
     .type = number,
     .presence = required,
     .example = "0",
     .help = "First value of an even grid. Several tables of this kind make one grid of all their "
             "points, the last one the fastest, which begins again where it ends.",
     .kinds = "grid"},
    {.path = "ensemble.vary[].to",
     .type = number,
     .presence = required,
     .example = "1",
     .help = "Its last value.",
     .kinds = "grid"},
    {.path = "ensemble.vary[].count",
     .type = integer,
     .presence = required,
     .example = "11",
     .help = "How many values, both ends included; 1 takes from.",
     .kinds = "grid"},
    {.path = "ensemble.vary[].file",
     .type = text,
     .presence = required,
     .example = "\"clones.csv\"",
     .help = "A file of draws, one row each, CSV or separated by blanks, .gz or not; the path is "
             "from the folder of this file.",
     .kinds = "table",
     .is_file = true},
    {.path = "ensemble.vary[].columns",
     .type = columns,
     .example = "[\"wx\", \"wy\", \"wz\"]",
     .help = "Its column for each number of keys, by name or by number from 1; left out, the first "
             "ones.",
     .kinds = "table"},
    {.path = "ensemble.vary[].order",
     .type = choice,
     .allowed = "rows|draws",
     .fallback = "\"rows\"",
     .example = "\"rows\"",
     .help = "Whether member 0 has the first row and so on, or each member a row that is drawn.",
     .kinds = "table"},
};

constexpr KindText vary_kinds[] = {
    {"ensemble.vary[]", "normal", "A normal number, between two bounds where they are given."},
    {"ensemble.vary[]", "uniform", "Every number between two alike."},
    {"ensemble.vary[]", "log-uniform", "A positive number whose logarithm is uniform."},
    {"ensemble.vary[]", "joint-normal", "Several normal numbers with a covariance."},
    {"ensemble.vary[]", "direction", "A direction of the sky, all of them alike."},
    {"ensemble.vary[]", "attitude", "An attitude, all of them alike (Haar's measure)."},
    {"ensemble.vary[]", "grid", "Points at even distances."},
    {"ensemble.vary[]", "table", "The rows of a file: a posterior, clones of an orbit."},
};

}  // namespace

SchemaPart ensemble_keys() { return {ensemble_rows, {}, vary_kinds}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
