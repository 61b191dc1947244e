// SPDX-License-Identifier: MIT
#include "scenario/tables/fit.hpp"

#include <array>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::int64_t million = 1'000'000;

constexpr std::array keys_of_free = {
    words_key<&FreeTable::unknowns>(
        "unknowns", "attitude|rate|moments|products|shape|law",
        "Attitude and angular velocity at t = 0 (of a search of light curves: in the middle of "
        "the data, where its table has them), the ratios Ixx/Izz and Iyy/Izz, and the "
        "products of inertia over Izz, in the body axes that this file gives vectors in. Of "
        "free rotation only ratios matter: Izz stays. Of light curves: attitude and rate, "
        "which they always have; shape, the ratios b/a and c/b of the ellipsoid; moments of "
        "their own; law, the weight of Lambert's law beside that of Lommel and Seeliger.")
        .required()
        .example("[\"attitude\", \"rate\", \"moments\"]"),
};
constexpr Table<FreeTable> free_description = {
    {.path = "free",
     .presence = Presence::required,
     .help = "What `polhode fit` looks for; all else stays."},
    keys_of_free};

constexpr std::array keys_of_fit = {
    choice_key<&FitTable::loss, fit::Loss::Kind::squared, fit::Loss::Kind::huber,
               fit::Loss::Kind::soft_l1, fit::Loss::Kind::cauchy>(
        "loss", "squared|huber|soft-l1|cauchy",
        "What an observation costs: the square of its residual, or less where it is far out.")
        .otherwise("\"squared\""),
    quantity_key<&FitTable::loss_scale>(
        "loss_scale", Dimension::number,
        "From how many standard errors on; of the squared loss nothing.")
        .otherwise("1")
        .positive(),
    integer_key<&FitTable::iterations>(
        "iterations",
        "At most, for each start; left out, 60 in a search of light curves, whose fits near the "
        "lowest go on for four times as many.")
        .otherwise("200")
        .from_to(1, million, "1e6"),
    quantity_key<&FitTable::tolerance>(
        "tolerance", Dimension::number,
        "Of the motion and its derivatives where torques act, in a step: long arcs that were "
        "seen with errors of degrees need no more than 1e-9.")
        .otherwise("1e-12")
        .positive(),
    integer_key<&FitTable::starts>(
        "starts",
        "From how many states it begins, up to 1e6: that of the file, then others with any "
        "attitude and a rate about that of the file, where these are unknown. Of a search of "
        "light curves: at first, in all, left out 20 for each pair of periods; pairs near the "
        "lowest get more.")
        .otherwise("1")
        .from_to(1, million, "1e6"),
    quantity_key<&FitTable::rate_spread>("rate_spread", Dimension::rate,
                                         "Standard deviation of each component of these rates.")
        .otherwise("0")
        .not_negative(),
    quantity_key<&FitTable::within>(
        "within", Dimension::number,
        "Solutions are reported up to this much above the least chi-square; those of light "
        "curves by `fit.within_factor`.")
        .otherwise("20")
        .not_negative(),
    integer_key<&FitTable::most_solutions>(
        "most_solutions",
        "How many solutions are listed, and written to files, at most; `--json` has all.")
        .otherwise("20")
        .from_to(1, million, "1e6"),
    integer_key<&FitTable::seed>("seed", "Another seed draws other starts.").otherwise("1"),
    choice_key<&FitTable::searches, false, true>(
        "from", "start|search",
        "Of light curves: from the state and shape of this file, or from many that have the "
        "periods of a scan, or those of [[fit.periods]].")
        .otherwise("\"start\"")
        .example("\"search\""),
    choice_key<&FitTable::is_tumbler, false, true>(
        "rotation", "any|tumbler",
        "Of light curves: any stops after the scan if one period describes the data as well "
        "as two do, or a constant brightness as well as one; tumbler goes on to two periods.")
        .otherwise("\"any\""),
    choice_key<&FitTable::one_by_one, false, true>(
        "sessions", "together|one-by-one",
        "Of light curves: one-by-one fits one session first (a search: the one with most "
        "points; a start: the one that it fits best). Then the nearest session joins, with "
        "every number of turns in between that the errors of the periods allow, and so on.")
        .otherwise("\"together\""),
    quantity_key<&FitTable::within_factor>(
        "within_factor", Dimension::number,
        "Solutions of light curves are reported up to so many times the least chi-square, or "
        "the least loss where `fit.loss` is robust; 1 or more.")
        .otherwise("2")
        .positive(),
};
constexpr KindText kinds_of_fit[] = {
    {"", "fit", "A rotation, what was observed of it, and what of it is unknown."}};
constexpr Table<FitTable> fit_description = {
    {.path = "fit",
     .fallback = "{}",
     .help = "How `polhode fit` looks: least squares by Levenberg and Marquardt's method, with "
             "exact derivatives."},
    keys_of_fit,
    {},
    kinds_of_fit};

constexpr std::array keys_of_simulate = {
    integer_key<&SimulateTable::seed>("seed", "Another seed draws other noise.").otherwise("1"),
    quantity_key<&SimulateTable::sessions>(
        "sessions", Dimension::time,
        "From when to when each session of light curves is, as times or dates; left out, all "
        "rows of [time] are one.")
        .example("[0, 6, 24, 30]")
        .or_date(),
};
constexpr Table<SimulateTable> simulate_description = {
    {.path = "simulate",
     .fallback = "{}",
     .help = "What `polhode simulate` adds to what would be seen at the times of [time]."},
    keys_of_simulate};

}  // namespace

SchemaPart free_keys() { return part_of<free_description>(); }
Placed<FreeTable> free_table(const FileValues& file) { return {free_description, file}; }

SchemaPart fit_keys() { return part_of<fit_description, simulate_description>(); }
Placed<FitTable> fit_table(const FileValues& file) { return {fit_description, file}; }
Placed<SimulateTable> simulate_table(const FileValues& file) {
  return {simulate_description, file};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
