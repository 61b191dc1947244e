// SPDX-License-Identifier: MIT
#include "scenario/tables/light.hpp"

#include <array>
#include <cstdint>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::int64_t most_minima = 10'000, most_labels = 10'000, most_multiples = 9;

constexpr std::array keys_of_light = {
    choice_key<&LightTable::shape, LightPlan::Shape::ellipsoid, LightPlan::Shape::convex,
               LightPlan::Shape::mesh>(
        "shape", "ellipsoid|convex|mesh",
        "What is seen: an ellipsoid along the principal axes; in fits alone a convex body that "
        "is looked for, from the ellipsoid that fits best; or a given mesh, with its shadows, "
        "that of `light.mesh` or else of `body.shape`.")
        .otherwise("\"ellipsoid\""),
    text_key<&LightTable::mesh>(
        "mesh",
        "The mesh that is seen, Wavefront OBJ, along the body axes, in any unit; it need not "
        "be that of [body]. Relative to the folder of this file.")
        .example("\"seen.obj\""),
    quantity_key<&LightTable::semiaxes>(
        "semiaxes", Dimension::number,
        "Of the ellipsoid, along the principal axes, in any unit; left out, that of an even "
        "filling of the moments.")
        .example("[1, 0.7, 0.6]")
        .positive(),
    choice_key<&LightTable::source, fit::MomentSource::shape, fit::MomentSource::start>(
        "moments", "of-shape|of-body",
        "The moments of inertia of a fit where they are no unknowns: of the shape filled "
        "evenly, or those of [body]. Left out, those of a convex body are unknowns about those "
        "of its ellipsoid, and those of a mesh stay. Simulations have those of [body].")
        .otherwise("\"of-shape\""),
    table_key<&LightTable::convex>("convex", "Facets of a convex body, and what keeps them smooth.")
        .otherwise("{}"),
    integer_key<&ConvexPlan::degree, LightTable>(
        "convex.degree",
        "Of the series of the areas of facets, 1 to 40: (degree + 1)^2 coefficients.")
        .otherwise("6")
        .from_to(1, 40),
    integer_key<&ConvexPlan::rows, LightTable>("convex.rows", "8 rows^2 facets, 1 to 200 rows.")
        .otherwise("8")
        .from_to(1, 200),
    quantity_key<&ConvexPlan::roughness_error, LightTable>(
        "convex.roughness_error", Dimension::number,
        "How rough the body is: the standard error of l (l + 1) times each coefficient of "
        "degree l about that of the ellipsoid. Smaller ones give smoother bodies.")
        .otherwise("3")
        .positive(),
    quantity_key<&ConvexPlan::moments_error, LightTable>(
        "convex.moments_error", Dimension::number,
        "The standard error of Ixx/Izz and Iyy/Izz about those of the ellipsoid.")
        .otherwise("0.1")
        .positive(),
    integer_key<&ConvexPlan::pairs, LightTable>(
        "convex.pairs",
        "How many pairs of periods of a search go on to a convex body, those of the best "
        "ellipsoids; left out, all, since the truth may fit an ellipsoid badly.")
        .example("40")
        .from_to(1, most_labels* most_minima),
    choice_key<&LightTable::law, LightLaw::lommel_seeliger, LightLaw::lambert, LightLaw::mixed>(
        "law", "lommel-seeliger|lambert|mixed",
        "The law of scattering; mixed: both, with the weights 1 and `multiple`.")
        .otherwise("\"lommel-seeliger\""),
    quantity_key<&LightTable::multiple>(
        "multiple", Dimension::number,
        "Weight of Lambert's law beside that of Lommel and Seeliger, where the law is mixed.")
        .otherwise("0.1")
        .positive(),
};
constexpr Table<LightTable> light_description = {
    {.path = "light", .fallback = "{}", .help = "How bright the body is, for light curves."},
    keys_of_light};

constexpr std::array keys_of_scan = {
    integer_key<&ScanPlan::order, ScanTable>("order",
                                             "How many multiples of each frequency, 1 to 9.")
        .otherwise("3")
        .shown()
        .from_to(1, most_multiples),
    quantity_key<&ScanPlan::shortest, ScanTable>(
        "shortest", Dimension::time,
        "The shortest period that is looked at; left out, four times the typical time from "
        "point to point.")
        .example("\"2 min\"")
        .positive(),
    quantity_key<&ScanPlan::longest, ScanTable>(
        "longest", Dimension::time, "The longest; left out, all of the time that the data cover.")
        .example("\"3 h\"")
        .positive(),
    choice_key<&ScanPlan::sessions, ScanTable, ScanPlan::Sessions::joined,
               ScanPlan::Sessions::separate>(
        "sessions", "joined|separate",
        "How several nights are scanned. joined: on one grid, fine enough for all the time from "
        "the first point to the last. separate: each session on a coarser grid, then around the "
        "lowest minima of their sum on all of that time; periods longer than a session are not "
        "found.")
        .otherwise("\"joined\""),
    integer_key<&ScanPlan::windows, ScanTable>(
        "windows", "Of separate sessions: how many minima of their sum are looked into.")
        .otherwise("20")
        .from_to(1, most_minima),
    integer_key<&ScanPlan::minima, ScanTable>(
        "minima",
        "How many minima of the landscape are refined. With P1 and P2 exchanged each is there "
        "twice, and listed once.")
        .otherwise("20")
        .from_to(1, most_minima),
    integer_key<&ScanTable::pairs>("pairs", "How many of these the search takes.")
        .otherwise("5")
        .from_to(1, most_minima),
    integer_key<&ScanTable::readings>(
        "labels", "How many readings of each as P_phi and P_psi, the most likely ones.")
        .otherwise("60")
        .from_to(1, most_labels),
    quantity_key<&ScanTable::periods>(
        "at", Dimension::time,
        "Pairs of periods of your own, P1 and P2 one after the other, such as published ones: "
        "chi-square of the series is told at each, and at the minimum next to it.")
        .example("[12, 20]")
        .positive(),
    integer_key<&ScanTable::own_order>(
        "at_order", "How many multiples of each of these, 1 to 9; left out, `order`.")
        .example("3")
        .from_to(1, most_multiples),
};
constexpr Table<ScanTable> scan_description = {
    {.path = "fit.scan",
     .fallback = "{}",
     .help = "The scan of light curves for two frequencies, whose sums and multiples are the lines "
             "of a tumbler."},
    keys_of_scan};

constexpr std::array keys_of_periods = {
    choice_key<&fit::TumblerPeriods::mode, Regime::short_axis, Regime::long_axis>(
        "mode", "SAM|LAM", "Short-axis or long-axis mode.")
        .required()
        .example("\"LAM\""),
    quantity_key<&fit::TumblerPeriods::precession_period>(
        "precession_period", Dimension::time, "P_phi, of the long axis about the angular momentum.")
        .required()
        .example("\"7.4 d\"")
        .positive(),
    quantity_key<&fit::TumblerPeriods::rotation_period>(
        "rotation_period", Dimension::time,
        "P_psi, about the long axis or back and forth about it.")
        .required()
        .example("\"5.4 d\"")
        .positive(),
};
constexpr Table<fit::TumblerPeriods> periods_description = {
    {.path = "fit.periods[]",
     .help = "Pairs of periods that a search begins with, in place of a scan."},
    keys_of_periods};

}  // namespace

SchemaPart light_keys() {
  return part_of<light_description, scan_description, periods_description>();
}
Placed<LightTable> light_table(const FileValues& file) { return {light_description, file}; }
Placed<ScanTable> scan_table(const FileValues& file) { return {scan_description, file}; }
std::vector<Placed<fit::TumblerPeriods>> periods_tables(const FileValues& file) {
  return placed_tables(periods_description, file);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
