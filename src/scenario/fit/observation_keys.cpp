// SPDX-License-Identifier: MIT
// The keys of each kind of [[observation]], and the observation that a table of them describes.
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/observation.hpp"
#include "polhode/text/kind_key.hpp"
#include "scenario/detail/kind_rows.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/fit/observation_table.hpp"
#include "scenario/tables/state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

using O = Observation;

constexpr std::array light_curve_keys = {
    choice_key<&O::axes, O::Axes::inertial, O::Axes::ecliptic, O::Axes::equator>(
        "axes", "inertial|ecliptic-J2000|equator-J2000",
        "The axes of its vectors; left out, those of `state.axes`. Those of lc are of the "
        "ecliptic.")
        .example("\"ecliptic-J2000\""),
    choice_key<&O::light_format, O::LightFormat::columns, O::LightFormat::lc,
               O::LightFormat::alcdef>(
        "format", "columns|lc|alcdef",
        "A table of columns; the format lc of DAMIT, whose times are Julian dates at the body; or "
        "ALCDEF, whose times are Julian dates of UTC. The last two imply `time_format`.")
        .otherwise("\"columns\""),
    choice_key<&O::brightness, O::Brightness::flux, O::Brightness::magnitude>(
        "brightness", "flux|magnitude", "What the second column holds.")
        .otherwise("\"flux\""),
    columns_key<&O::columns>(
        "columns",
        "The columns of time and brightness, by name or by number from 1. Left "
        "out: t and flux or magnitude.")
        .example("[\"t\", \"flux\"]"),
    quantity_key<&O::sigma>(
        "sigma", Dimension::number,
        "Standard error of each point: a part of the mean flux of its session, "
        "or magnitudes. With `sigma_columns` and in ALCDEF, that of points without an error of "
        "their own; 0 only in simulations, for light without noise.")
        .not_negative()
        .example("0.01")
        .shown(),
    columns_key<&O::sigma_columns>("sigma_columns",
                                   "The column of the error, one name. One of the two is "
                                   "needed, but for ALCDEF, whose files may have errors.")
        .example("[\"sigma\"]"),
    columns_key<&O::session_column>(
        "session_column",
        "The column whose numbers or words tell sessions apart, one name; left "
        "out, all rows are one.")
        .example("[\"session\"]"),
    columns_key<&O::sessions>("sessions",
                              "The sessions that are taken, by their order in the file "
                              "from 1; left out, all.")
        .example("[1]"),
    columns_key<&O::leave_out>("leave_out",
                               "Lines of the file, from 1, whose points are left out, as "
                               "residuals name them. They are not checked.")
        .example("[17, 203]"),
    flag_key<&O::sorts>("sort",
                        "Whether points of a session are sorted by time, where "
                        "the file has them in another order.")
        .otherwise("false"),
    flag_key<&O::is_calibrated>("calibrated",
                                "Whether fluxes of all sessions are in one unit; otherwise each "
                                "session has a factor of its own.")
        .otherwise("false"),
    columns_key<&O::sun_columns>("sun_columns",
                                 "Three columns of the vector from the body to the Sun.")
        .example("[\"sun_x\", \"sun_y\", \"sun_z\"]")
        .shown(),
    columns_key<&O::observer_columns>("observer_columns", "The same to the observer.")
        .example("[\"observer_x\", \"observer_y\", \"observer_z\"]")
        .shown(),
    quantity_key<&O::to_sun>("to_sun", Dimension::number,
                             "The vector to the Sun of all points, where no columns have it; what "
                             "simulations take.")
        .example("[-0.9, 0.2, 0.1]"),
    quantity_key<&O::to_observer>("to_observer", Dimension::number, "The same to the observer.")
        .example("[-0.1, 0.9, 0.1]"),
    name_key<&O::orbit>("orbit",
                        "The orbit of the body about the Sun, a table [orbit.NAME], where neither "
                        "columns nor keys have the vectors; the light time follows, too.")
        .example("\"toutatis\""),
    name_key<&O::observer_orbit>("observer_orbit",
                                 "That of the observer, such as an ephemeris of the Earth from the "
                                 "Sun.")
        .example("\"earth\""),
    flag_key<&O::is_of_the_time>("of_the_time",
                                 "Whether fluxes are from the distances that the vectors have; "
                                 "otherwise they are from unit distances.")
        .otherwise("false"),
};

constexpr Key table_key = {
    .path = "observation[]",
    .presence = Presence::required,
    .help =
        "What was seen of the body: a file of rows each. Files are read by `polhode fit` alone; "
        "`polhode simulate` writes such."};
constexpr std::array kind_keys = {
    choice_key<&O::kind, O::Kind::attitude, O::Kind::direction, O::Kind::rate,
               O::Kind::light_curve>("kind", "attitude|direction|rate|light-curve",
                                     "What its rows are.")
        .required()
        .example("\"attitude\"")};

constexpr std::array shared = {
    name_key<&O::name>("name", "What tables call it; left out, its file.").example("\"radar\""),
    file_key<&O::file>("file",
                       "Its rows, CSV or separated by blanks, .gz or not, in order of time; the "
                       "path is from the folder of this file.")
        .required()
        .example("\"attitudes.csv\""),
    choice_key<&O::times, LightTime::at_body, LightTime::at_observer>(
        "times", "at-body|at-observer",
        "Whose times rows have: when light left the body, or when it arrived.")
        .required()
        .example("\"at-body\""),
    quantity_key<&O::light_time>(
        "light_time", Dimension::time,
        "From the body to the observer, of times at the observer. Of light "
        "curves it may be left out where vectors to the observer are in "
        "`units.length`: each point then has that of its own distance.")
        .not_negative()
        .example("\"30 s\""),
    choice_key<&O::time_format, O::TimeFormat::number, O::TimeFormat::julian,
               O::TimeFormat::modified_julian, O::TimeFormat::date>(
        "time_format", "number|JD|MJD|date",
        "What the column of times holds: time from t = 0, Julian dates, modified ones, or dates "
        "like 2013-01-05T18:30:00. All but the first need `state.epoch`.")
        .otherwise("\"number\""),
    choice_key<&O::time_scale, TimeScale::UTC, TimeScale::TAI, TimeScale::TT, TimeScale::TDB>(
        "time_scale", "UTC|TAI|TT|TDB", "Time scale of dates, which need one.")
        .example("\"UTC\""),
    unit_key<&O::time_unit>("time_unit", "Unit of times that are numbers; left out, `units.time`.")
        .example("\"d\""),
};
constexpr std::array of_the_sky = {
    choice_key<&O::axes, O::Axes::inertial, O::Axes::ecliptic, O::Axes::equator>(
        "axes", "inertial|ecliptic-J2000|equator-J2000",
        "The axes that it refers to; left out, those of `state.axes`.")
        .example("\"ecliptic-J2000\""),
    unit_key<&O::value_unit>("angle_unit",
                             "Unit of angles and of errors in columns; left out, `units.angle`.")
        .example("\"deg\""),
};

// One of these is needed.
consteval KindKey<O> sigma_key(Dimension dimension, std::string_view help,
                               std::string_view example) {
  return quantity_key<&O::sigma>("sigma", dimension, help)
      .alternative()
      .positive()
      .example(example);
}
consteval KindKey<O> sigma_columns_key(std::string_view help) {
  return columns_key<&O::sigma_columns>("sigma_columns", help).alternative().example("[\"sigma\"]");
}
consteval auto errors_along_axes(Dimension dimension, std::string_view help, std::string_view sigma,
                                 std::string_view sigmas) {
  return std::array{
      sigma_key(dimension, help, sigma),
      quantity_key<&O::sigmas>("sigmas", dimension, "The same for the three body axes.")
          .alternative()
          .positive()
          .example(sigmas),
      sigma_columns_key("The column of the error, or one for each body axis."),
  };
}

constexpr std::array attitude_own = {
    choice_key<&O::form, O::Form::quaternion, O::Form::euler, O::Form::matrix>(
        "form", "quaternion|euler|matrix",
        "What the columns after the time are: a quaternion w, x, y, z, body axes to inertial ones; "
        "Euler's angles phi, theta, psi (3-1-3); or the nine numbers of the matrix from inertial "
        "to body components, row by row. States in other charts become such by `polhode convert`.")
        .otherwise("\"quaternion\""),
    columns_key<&O::columns>("columns",
                             "The column of times, then those of the form, by name or by number "
                             "from 1. Left out: t, and qw, qx, qy, qz or phi, theta, psi or R11, "
                             "R12, ... R33.")
        .example("[\"t\", \"qw\", \"qx\", \"qy\", \"qz\"]"),
};
constexpr auto attitude_errors = errors_along_axes(
    Dimension::angle, "Its standard error about each body axis, one number for all.", "\"2 deg\"",
    "[2, 2, 5]");
constexpr std::array direction_own = {
    quantity_key<&O::axis>("axis", Dimension::number,
                           "The body axis whose direction was seen, of any length.")
        .otherwise("[0, 0, 1]"),
    choice_key<&O::form, O::Form::vector, O::Form::angles>(
        "form", "vector|angles",
        "What the columns after the time are: a vector of any length, or longitude and latitude "
        "(right ascension and declination along the axes of an equator).")
        .otherwise("\"vector\""),
    columns_key<&O::columns>("columns",
                             "The column of times, then those of the form, by name or by number "
                             "from 1. Left out: t, and x, y, z or lon, lat.")
        .example("[\"t\", \"x\", \"y\", \"z\"]"),
    sigma_key(Dimension::angle, "Its standard error in each of two directions across it.",
              "\"2 deg\""),
    sigma_columns_key("The column of the error, one name."),
};
constexpr std::array rate_own = {
    columns_key<&O::columns>("columns",
                             "The column of times, then the angular velocity along the body axes, "
                             "by name or by number from 1. Left out: t, w1, w2, w3.")
        .example("[\"t\", \"w1\", \"w2\", \"w3\"]"),
    unit_key<&O::value_unit>("rate_unit",
                             "Unit of rates and of errors in columns; left out, that of this file.")
        .example("\"deg/d\""),
};
constexpr auto rate_errors = errors_along_axes(
    Dimension::rate, "Its standard error along each body axis, one number for all.",
    "\"0.1 deg/h\"", "[0.1, 0.1, 0.5]");
// The first key is `kind`.
template <std::size_t n>
consteval auto keys_with(const std::array<KindKey<O>, n>& own) {
  return joined(joined(kind_keys, shared), own);
}
constexpr auto attitude_keys = keys_with(joined(joined(of_the_sky, attitude_own), attitude_errors));
constexpr auto direction_keys = keys_with(joined(of_the_sky, direction_own));
constexpr auto rate_keys = keys_with(joined(rate_own, rate_errors));
constexpr auto light_keys = keys_with(light_curve_keys);

struct Row {
  std::string_view word, help, sets;
  std::span<const KindKey<O>> keys;
};
// In the order of Observation::Kind. A kind more is a row here and its numbers in
// observation_rows.cpp.
constexpr Row rows[] = {
    {"attitude", "Attitudes.", "sigma|sigmas|sigma_columns", attitude_keys},
    {"direction", "Directions of a body axis.", "sigma|sigma_columns", direction_keys},
    {"rate", "Angular velocities along the body axes.", "sigma|sigmas|sigma_columns", rate_keys},
    {"light-curve", "Light curves.", "", light_keys},
};

std::vector<KindOfTable> made_rows() {
  static const std::vector<std::vector<Key>> keys = [] {
    std::vector<std::vector<Key>> all;
    for (const Row& row : rows) all.push_back(keys_of(row.keys.subspan(1)));
    return all;
  }();
  std::vector<KindOfTable> kinds;
  for (std::size_t i = 0; i < std::size(rows); ++i)
    kinds.push_back({{{}, rows[i].word, rows[i].help}, keys[i], rows[i].sets});
  return kinds;
}

bool state_is_inertial(const Placed<O>& table) {
  return state_table(table.at().file_values())->axes == "inertial";
}

// Sets the format and the scale of the times as the format of the file has them.
void take_format(Observation& o, const Placed<O>& table) {
  if (o.light_format == O::LightFormat::columns) return;
  if (!table.is_explicit<&O::time_format>()) o.time_format = O::TimeFormat::julian;
  if (o.light_format == O::LightFormat::alcdef && !o.time_scale) o.time_scale = TimeScale::UTC;
}

// Refuses keys of a light curve that do not go together. Its columns and its clock are checked
// before.
void require_light_curve(const Observation& o, const Placed<O>& table) {
  if (o.session_column.size() > 1) table.refuse<&O::session_column>("expected one column");
  if (!o.sun_columns.empty() && o.sun_columns.size() != 3)
    table.refuse<&O::sun_columns>("expected three columns");
  if (!o.observer_columns.empty() && o.observer_columns.size() != 3)
    table.refuse<&O::observer_columns>("expected three columns");
  if (o.orbit.empty() && !o.observer_orbit.empty())
    table.refuse<&O::observer_orbit>("expected a key orbit as well");
  if (!o.orbit.empty() && o.observer_orbit.empty())
    table.refuse<&O::orbit>("expected a key observer_orbit as well");
  if (!o.orbit.empty())
    table.refuse_any<&O::sun_columns, &O::observer_columns, &O::to_sun, &O::to_observer>(
        "expected none: orbits give the vectors");
  if (!o.orbit.empty() && table.at().units().length() == "1")
    table.refuse<&O::orbit>("expected units.length as well, such as \"au\": light takes its time");
  const bool is_alcdef = o.light_format == O::LightFormat::alcdef;
  if (!o.sigma && o.sigma_columns.empty() && !is_alcdef)
    table.refuse<&O::kind>(o.light_format == O::LightFormat::lc
                               ? "expected a key sigma as well: lc has no errors"
                               : "expected a key sigma or sigma_columns as well");
  if (o.light_format == O::LightFormat::columns) return;
  if (o.time_format != O::TimeFormat::julian)
    table.refuse<&O::light_format>("expected time_format = \"JD\", which its files have");
  table.refuse_any<&O::sigma_columns, &O::session_column, &O::sun_columns, &O::observer_columns>(
      "expected none: the format has its own columns");
  if (is_alcdef) {
    if (*o.time_scale != TimeScale::UTC)
      table.refuse<&O::time_scale>("expected \"UTC\", as dates of ALCDEF are");
    return;
  }
  if (o.times != LightTime::at_body)
    table.refuse<&O::times>("expected \"at-body\", as those of lc are");
  if (!o.orbit.empty()) table.refuse<&O::orbit>("expected none: lc has vectors");
  if (state_is_inertial(table))
    table.refuse<&O::light_format>(
        "expected axes of the sky in state.axes, since vectors of lc have such");
  if (o.axes && *o.axes != O::Axes::ecliptic)
    table.refuse<&O::axes>("expected \"ecliptic-J2000\", as those of lc are");
}

std::vector<std::string> usual_columns(const O& o) {
  using enum O::Form;
  if (o.kind == O::Kind::rate) return {"t", "w1", "w2", "w3"};
  if (o.kind == O::Kind::light_curve)
    return {"t", o.brightness == O::Brightness::flux ? "flux" : "magnitude"};
  switch (o.form) {
    case quaternion:
      return {"t", "qw", "qx", "qy", "qz"};
    case euler:
      return {"t", "phi", "theta", "psi"};
    case matrix:
      return {"t", "R11", "R12", "R13", "R21", "R22", "R23", "R31", "R32", "R33"};
    case vector:
      return {"t", "x", "y", "z"};
    case angles:
      return {"t", "lon", "lat"};
  }
  return {};
}

void require_columns(const O& o, const Placed<O>& table) {
  const std::size_t wanted = usual_columns(o).size();
  if (o.columns.size() != wanted)
    table.refuse<&O::columns>("expected " + std::to_string(wanted) + " columns, the time and " +
                              std::to_string(wanted - 1) + " numbers");
  if (o.sigma_columns.empty()) return;
  const bool is_one = o.kind == O::Kind::direction || o.kind == O::Kind::light_curve;
  if (o.sigma_columns.size() != 1 && (is_one || o.sigma_columns.size() != 3))
    table.refuse<&O::sigma_columns>(is_one ? "expected one column" : "expected one column, or 3");
}

void require_clock(const O& o, const Placed<O>& table) {
  const bool is_at_observer = o.times == LightTime::at_observer;
  const bool is_light = o.kind == O::Kind::light_curve;
  const bool has_orbit = is_light && !o.orbit.empty();
  const bool has_vectors = is_light && (!o.observer_columns.empty() || o.to_observer);
  if (is_at_observer && !has_orbit && !o.light_time &&
      !(has_vectors && table.at().units().length() != "1"))
    table.refuse<&O::times>(
        is_light ? "expected a key light_time as well; or vectors to the observer with "
                   "units.length, such as \"au\", from which it follows point by point; "
                   "or times at the body"
                 : "expected a key light_time as well; or times at the body");
  if (has_orbit && o.light_time)
    table.refuse<&O::light_time>("expected none: it follows from the orbits");
  if (!is_at_observer && o.light_time)
    table.refuse<&O::light_time>("expected none of times at the body");
  const bool is_dated = o.time_format != O::TimeFormat::number;
  const auto refuse_dated = [&](std::string_view message) {  // at the key that says so
    table.refuse_any<&O::time_format>(message);
    table.refuse<&O::light_format>(message);
  };
  if (is_dated && !o.time_scale)
    refuse_dated(o.light_format == O::LightFormat::lc
                     ? "expected a key time_scale as well, such as \"UTC\": lc has Julian "
                       "dates and does not say in which time scale"
                     : "expected a key time_scale as well, that of the dates");
  if (is_dated && table.is_explicit<&O::time_unit>())
    table.refuse<&O::time_unit>("expected no unit together with dates");
  if (!is_dated && o.time_scale)
    table.refuse<&O::time_scale>("expected a time_format of dates as well");
  if (is_dated && !state_table(table.at().file_values())->epoch)
    refuse_dated("expected a key state.epoch, the date of t = 0");
  static_cast<void>(table.unit<&O::time_unit>(Dimension::time));
}

void require_axes(const O& o, const Placed<O>& table) {
  const bool is_rate = o.kind == O::Kind::rate;
  if (o.kind != O::Kind::light_curve)
    static_cast<void>(table.unit<&O::value_unit>(is_rate ? Dimension::rate : Dimension::angle));
  if (is_rate || !o.axes) return;
  const bool is_inertial = state_is_inertial(table);
  if ((*o.axes == O::Axes::inertial) != is_inertial)
    table.refuse<&O::axes>(is_inertial
                               ? "expected \"inertial\", as state.axes is; or axes of the sky there"
                               : "expected axes of the sky, as those of state.axes");
}

}  // namespace

SchemaPart observation_keys() {
  static const std::string path = std::string(table_key.path) + ".kind";
  static const KindRows all = [] {
    Key kind = kind_keys[0].key();
    kind.path = path;
    return KindRows(table_key, kind, made_rows());
  }();
  return all.part();
}

Placed<Observation> placed_observation(const FileValues& file, std::size_t index) {
  const KeyValues at(file.values, file.units, "observation[" + std::to_string(index) + "]",
                     file.name);
  return {Table<O>{table_key, rows[at.choice("kind")].keys}, file, at.path()};
}

void refuse_kind(const Scenario& scenario, std::size_t index, std::string_view message) {
  placed_observation(file_values(scenario.document), index).refuse<&O::kind>(message);
}

Observation observation_of(const Placed<Observation>& table) {
  O o = *table;
  if (o.kind == O::Kind::light_curve) take_format(o, table);
  if (o.kind == O::Kind::direction && !(norm(o.axis) > 0.0))
    table.refuse<&O::axis>("expected a vector that is not 0");
  if (o.columns.empty()) o.columns = usual_columns(o);
  require_columns(o, table);
  require_clock(o, table);
  require_axes(o, table);
  if (o.kind == O::Kind::light_curve) require_light_curve(o, table);
  return o;
}

}  // namespace detail

std::string_view kind_word(Observation::Kind kind) {
  return detail::rows[static_cast<std::size_t>(kind)].word;
}

}  // namespace v0
}  // namespace polhode
