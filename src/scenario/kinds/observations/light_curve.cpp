// SPDX-License-Identifier: MIT
// [[observation]] of kind "light-curve".
#include <array>
#include <optional>
#include <string>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/fit/observation_table.hpp"
#include "scenario/kinds/observations/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

using L = LightObservation;

constexpr std::array light_curve_keys = {
    choice_key<&L::axes, ObservedAxes::inertial, ObservedAxes::ecliptic, ObservedAxes::equator>(
        "axes", "inertial|ecliptic-J2000|equator-J2000",
        "The axes of its vectors; left out, those of `state.axes`. Those of lc are of the "
        "ecliptic.")
        .example("\"ecliptic-J2000\""),
    choice_key<&L::format, L::Format::columns, L::Format::lc, L::Format::alcdef>(
        "format", "columns|lc|alcdef",
        "A table of columns; the format lc of DAMIT, whose times are Julian dates at the body; or "
        "ALCDEF, whose times are Julian dates of UTC. The last two imply `time_format`.")
        .otherwise("\"columns\""),
    choice_key<&L::brightness, L::Brightness::flux, L::Brightness::magnitude>(
        "brightness", "flux|magnitude", "What the second column holds.")
        .otherwise("\"flux\""),
    columns_key<&L::columns>(
        "columns",
        "The columns of time and brightness, by name or by number from 1. Left "
        "out: t and flux or magnitude.")
        .example("[\"t\", \"flux\"]"),
    quantity_key<&L::sigma>(
        "sigma", Dimension::number,
        "Standard error of each point: a part of the mean flux of its session, "
        "or magnitudes. With `sigma_columns` and in ALCDEF, that of points without an error of "
        "their own; 0 only in simulations, for light without noise.")
        .not_negative()
        .example("0.01")
        .shown(),
    columns_key<&L::sigma_columns>("sigma_columns",
                                   "The column of the error, one name. One of the two is "
                                   "needed, but for ALCDEF, whose files may have errors.")
        .example("[\"sigma\"]"),
    columns_key<&L::session_column>(
        "session_column",
        "The column whose numbers or words tell sessions apart, one name; left "
        "out, all rows are one.")
        .example("[\"session\"]"),
    columns_key<&L::sessions>("sessions",
                              "The sessions that are taken, by their order in the file "
                              "from 1; left out, all.")
        .example("[1]"),
    columns_key<&L::leave_out>("leave_out",
                               "Lines of the file, from 1, whose points are left out, as "
                               "residuals name them. They are not checked.")
        .example("[17, 203]"),
    flag_key<&L::sorts>("sort",
                        "Whether points of a session are sorted by time, where "
                        "the file has them in another order.")
        .otherwise("false"),
    flag_key<&L::is_calibrated>("calibrated",
                                "Whether fluxes of all sessions are in one unit; otherwise each "
                                "session has a factor of its own.")
        .otherwise("false"),
    columns_key<&L::sun_columns>("sun_columns",
                                 "Three columns of the vector from the body to the Sun.")
        .example("[\"sun_x\", \"sun_y\", \"sun_z\"]")
        .shown(),
    columns_key<&L::observer_columns>("observer_columns", "The same to the observer.")
        .example("[\"observer_x\", \"observer_y\", \"observer_z\"]")
        .shown(),
    quantity_key<&L::to_sun>("to_sun", Dimension::number,
                             "The vector to the Sun of all points, where no columns have it; what "
                             "simulations take.")
        .example("[-0.9, 0.2, 0.1]"),
    quantity_key<&L::to_observer>("to_observer", Dimension::number, "The same to the observer.")
        .example("[-0.1, 0.9, 0.1]"),
    name_key<&L::orbit>("orbit",
                        "The orbit of the body about the Sun, a table [orbit.NAME], where neither "
                        "columns nor keys have the vectors; the light time follows, too.")
        .example("\"toutatis\""),
    name_key<&L::observer_orbit>("observer_orbit",
                                 "That of the observer, such as an ephemeris of the Earth from the "
                                 "Sun.")
        .example("\"earth\""),
    flag_key<&L::is_of_the_time>("of_the_time",
                                 "Whether fluxes are from the distances that the vectors have; "
                                 "otherwise they are from unit distances.")
        .otherwise("false"),
};

// Sets the format and the scale of the times as the format of the file has them.
void take_format(Observation& of, const L& light, const KeyValues& at) {
  if (light.format == L::Format::columns) return;
  if (!at.is_explicit("time_format")) of.time_format = Observation::TimeFormat::julian;
  if (light.format == L::Format::alcdef && !of.time_scale)
    of.time_scale = ephemeris::TimeScale::UTC;
}

void made_light_curve(Observation& of, const TermContext& at) {
  L light = arguments<L>(light_curve_keys, at);
  take_format(of, light, at);
  if (light.columns.empty())
    light.columns = {"t", light.brightness == L::Brightness::flux ? "flux" : "magnitude"};
  of.light = std::move(light);
}

}  // namespace

Placed<LightObservation> placed_light(const FileValues& file, const std::string& path) {
  return {Table<L>{{}, light_curve_keys}, file, path};
}

ObservationKind light_curve_kind() {
  return {.name = "light-curve",
          .help = "Light curves.",
          .keys = keys_of(std::span<const KindKey<L>>(light_curve_keys)),
          .made = made_light_curve};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
