// SPDX-License-Identifier: MIT
// The keys of [[observation]] of kind "light-curve".
#pragma once

#include <array>

#include "polhode/scenario/kind_key.hpp"
#include "polhode/scenario/observation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::array light_curve_keys = {
    choice_key<&Observation::axes, Observation::Axes::inertial, Observation::Axes::ecliptic,
               Observation::Axes::equator>(
        "axes", "inertial|ecliptic-J2000|equator-J2000",
        "The axes of its vectors; left out, those of `state.axes`. Those of lc are of the "
        "ecliptic.")
        .example("\"ecliptic-J2000\""),
    choice_key<&Observation::light_format, Observation::LightFormat::columns,
               Observation::LightFormat::lc, Observation::LightFormat::alcdef>(
        "format", "columns|lc|alcdef",
        "A table of columns; the format lc of DAMIT, whose times are Julian dates at the body; or "
        "ALCDEF, whose times are Julian dates of UTC. The last two imply `time_format`.")
        .otherwise("\"columns\""),
    choice_key<&Observation::brightness, Observation::Brightness::flux,
               Observation::Brightness::magnitude>("brightness", "flux|magnitude",
                                                   "What the second column holds.")
        .otherwise("\"flux\""),
    columns_key<&Observation::columns>(
        "columns",
        "The columns of time and brightness, by name or by number from 1. Left "
        "out: t and flux or magnitude.")
        .example("[\"t\", \"flux\"]"),
    quantity_key<&Observation::sigma>(
        "sigma", Dimension::number,
        "Standard error of each point: a part of the mean flux of its session, "
        "or magnitudes. With `sigma_columns` and in ALCDEF, that of points without an error of "
        "their own; 0 only in simulations, for light without noise.")
        .not_negative()
        .example("0.01")
        .shown(),
    columns_key<&Observation::sigma_columns>("sigma_columns",
                                             "The column of the error, one name. One of the two is "
                                             "needed, but for ALCDEF, whose files may have errors.")
        .example("[\"sigma\"]"),
    columns_key<&Observation::session_column>(
        "session_column",
        "The column whose numbers or words tell sessions apart, one name; left "
        "out, all rows are one.")
        .example("[\"session\"]"),
    columns_key<&Observation::sessions>("sessions",
                                        "The sessions that are taken, by their order in the file "
                                        "from 1; left out, all.")
        .example("[1]"),
    columns_key<&Observation::leave_out>(
        "leave_out",
        "Lines of the file, from 1, whose points are left out, as residuals name them.")
        .example("[17, 203]"),
    flag_key<&Observation::sorts>("sort",
                                  "Whether points of a session are sorted by time, where "
                                  "the file has them in another order.")
        .otherwise("false"),
    flag_key<&Observation::is_calibrated>(
        "calibrated",
        "Whether fluxes of all sessions are in one unit; otherwise each "
        "session has a factor of its own.")
        .otherwise("false"),
    columns_key<&Observation::sun_columns>("sun_columns",
                                           "Three columns of the vector from the body to the Sun.")
        .example("[\"sun_x\", \"sun_y\", \"sun_z\"]")
        .shown(),
    columns_key<&Observation::observer_columns>("observer_columns", "The same to the observer.")
        .example("[\"observer_x\", \"observer_y\", \"observer_z\"]")
        .shown(),
    quantity_key<&Observation::to_sun>(
        "to_sun", Dimension::number,
        "The vector to the Sun of all points, where no columns have it; what "
        "simulations take.")
        .example("[-0.9, 0.2, 0.1]"),
    quantity_key<&Observation::to_observer>("to_observer", Dimension::number,
                                            "The same to the observer.")
        .example("[-0.1, 0.9, 0.1]"),
    name_key<&Observation::orbit>(
        "orbit",
        "The orbit of the body about the Sun, a table [orbit.NAME], where neither "
        "columns nor keys have the vectors; the light time follows, too.")
        .example("\"toutatis\""),
    name_key<&Observation::observer_orbit>(
        "observer_orbit",
        "That of the observer, such as an ephemeris of the Earth from the "
        "Sun.")
        .example("\"earth\""),
    flag_key<&Observation::is_of_the_time>(
        "of_the_time",
        "Whether fluxes are from the distances that the vectors have; "
        "otherwise they are from unit distances.")
        .otherwise("false"),
};

// What its format says of the times.
void take_format(Observation& o, const KeyValues& table);
// What of such a table does not go together; columns and clock are checked.
void require_light_curve(const Observation& o, const KeyValues& table);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
