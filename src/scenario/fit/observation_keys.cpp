// SPDX-License-Identifier: MIT
// The keys of all kinds of [[observation]], and the observation that a table describes.
#include "scenario/fit/observation_keys.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/observation_kind.hpp"
#include "polhode/text/kind_key.hpp"
#include "scenario/fit/observation_table.hpp"
#include "scenario/kinds/observations/shared_keys.hpp"
#include "scenario/tables/state.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

using O = Observation;
using L = LightObservation;

constexpr Key table_key = {
    .path = "observation[]",
    .presence = Presence::required,
    .help =
        "What was seen of the body: a file of rows each. Files are read by `polhode fit` alone; "
        "`polhode simulate` writes such."};
constexpr Key kind_key = {.path = "observation[].kind",
                          .type = KeyType::choice,
                          .presence = Presence::required,
                          .example = "\"attitude\"",
                          .help = "What its rows are."};

constexpr std::array shared = {
    name_key<&O::name>("name", "What tables call it; left out, its file.").example("\"radar\""),
    file_key<&O::file>("file",
                       "Its rows, CSV or separated by blanks, .gz or not, in order of time; the "
                       "path is from the folder of this file.")
        .required()
        .example("\"attitudes.csv\""),
    choice_key<&O::times, light::LightTime::at_body, light::LightTime::at_observer>(
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
    choice_key<&O::time_scale, ephemeris::TimeScale::UTC, ephemeris::TimeScale::TAI,
               ephemeris::TimeScale::TT, ephemeris::TimeScale::TDB>(
        "time_scale", "UTC|TAI|TT|TDB", "Time scale of dates, which need one.")
        .example("\"UTC\""),
    unit_key<&O::time_unit>("time_unit", "Unit of times that are numbers; left out, `units.time`.")
        .example("\"d\""),
};
// What is read of a table of any kind.
constexpr auto read_keys = polhode::io::joined(
    std::array{word_key<&O::kind>("kind", "", "What its rows are.").required()}, shared);

// The keys of each kind, the shared ones first.
std::deque<std::vector<Key>> all_keys(std::span<const ObservationKind> kinds) {
  std::deque<std::vector<Key>> all;
  for (const ObservationKind& kind : kinds) {
    std::vector<Key>& keys = all.emplace_back(keys_of(std::span<const KindKey<O>>(shared)));
    keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
  }
  return all;
}

std::vector<KindOfTable> rows_of(std::span<const ObservationKind> kinds,
                                 const std::deque<std::vector<Key>>& keys) {
  std::vector<KindOfTable> rows;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    rows.push_back({{{}, kinds[i].name, kinds[i].help}, keys[i], kinds[i].sets});
  return rows;
}

bool state_is_inertial(const KeyValues& at) {
  return state_table(at.file_values())->axes == "inertial";
}

void require_columns(const std::vector<std::string>& columns, std::size_t wanted,
                     const std::vector<std::string>& sigma_columns, std::size_t errors,
                     const KeyValues& at) {
  if (columns.size() != wanted)
    at.refuse("columns", "expected " + std::to_string(wanted) + " columns, the time and " +
                             std::to_string(wanted - 1) + " numbers");
  if (sigma_columns.size() > 1 && sigma_columns.size() != errors)
    at.refuse("sigma_columns", errors == 1 ? "expected one column"
                                           : "expected one column, or " + std::to_string(errors));
}

// Refuses keys of a light curve that do not go together. Its columns and its clock are checked
// before.
void require_light_curve(const Observation& o, const Placed<O>& times, const Placed<L>& table) {
  const L& light = *o.light;
  if (light.session_column.size() > 1) table.refuse<&L::session_column>("expected one column");
  if (!light.sun_columns.empty() && light.sun_columns.size() != 3)
    table.refuse<&L::sun_columns>("expected three columns");
  if (!light.observer_columns.empty() && light.observer_columns.size() != 3)
    table.refuse<&L::observer_columns>("expected three columns");
  if (light.orbit.empty() && !light.observer_orbit.empty())
    table.refuse<&L::observer_orbit>("expected a key orbit as well");
  if (!light.orbit.empty() && light.observer_orbit.empty())
    table.refuse<&L::orbit>("expected a key observer_orbit as well");
  if (!light.orbit.empty())
    table.refuse_any<&L::sun_columns, &L::observer_columns, &L::to_sun, &L::to_observer>(
        "expected none: orbits give the vectors");
  if (!light.orbit.empty() && table.at().units().length() == "1")
    table.refuse<&L::orbit>("expected units.length as well, such as \"au\": light takes its time");
  const bool is_alcdef = light.format == L::Format::alcdef;
  if (!light.sigma && light.sigma_columns.empty() && !is_alcdef)
    times.refuse<&O::kind>(light.format == L::Format::lc
                               ? "expected a key sigma as well: lc has no errors"
                               : "expected a key sigma or sigma_columns as well");
  if (light.format == L::Format::columns) return;
  if (o.time_format != O::TimeFormat::julian)
    table.refuse<&L::format>("expected time_format = \"JD\", which its files have");
  table.refuse_any<&L::sigma_columns, &L::session_column, &L::sun_columns, &L::observer_columns>(
      "expected none: the format has its own columns");
  if (is_alcdef) {
    if (*o.time_scale != ephemeris::TimeScale::UTC)
      times.refuse<&O::time_scale>("expected \"UTC\", as dates of ALCDEF are");
    return;
  }
  if (o.times != light::LightTime::at_body)
    times.refuse<&O::times>("expected \"at-body\", as those of lc are");
  if (!light.orbit.empty()) table.refuse<&L::orbit>("expected none: lc has vectors");
  if (state_is_inertial(table.at()))
    table.refuse<&L::format>(
        "expected axes of the sky in state.axes, since vectors of lc have such");
  if (light.axes && *light.axes != ObservedAxes::ecliptic)
    table.refuse<&L::axes>("expected \"ecliptic-J2000\", as those of lc are");
}

void require_clock(const O& o, const Placed<O>& table, const Placed<L>* light) {
  const bool is_at_observer = o.times == light::LightTime::at_observer;
  const bool is_light = light != nullptr;
  const bool has_orbit = is_light && !o.light->orbit.empty();
  const bool has_vectors = is_light && (!o.light->observer_columns.empty() || o.light->to_observer);
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
    if (is_light) light->refuse<&L::format>(message);
    table.refuse<&O::kind>(message);
  };
  if (is_dated && !o.time_scale)
    refuse_dated(is_light && o.light->format == L::Format::lc
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

}  // namespace

bool is_shared_observation_key(std::string_view name) {
  return std::ranges::any_of(shared, [&](const KindKey<O>& one) { return one.key().path == name; });
}

ObservationRows::ObservationRows(std::span<const ObservationKind> kinds)
    : keys_(all_keys(kinds)), rows_(table_key, kind_key, rows_of(kinds, keys_)) {}

Placed<Observation> placed_observation(const FileValues& file, std::size_t index) {
  return {Table<O>{table_key, read_keys}, file, "observation[" + std::to_string(index) + "]"};
}

Observation observation_of(const FileValues& file, std::size_t index, const Kinds& kinds,
                           const Rotation& rotation) {
  const Placed<O> table = placed_observation(file, index);
  const KeyValues& at = table.at();
  O o = *table;
  o.place = table.place<&O::kind>();
  const ObservationKind* const kind = kinds.observation(o.kind);
  if (kind == nullptr)
    throw std::logic_error("observation: the schema allows a kind without a description: " +
                           o.kind);
  TermUses uses;
  const TermParts parts = parts_of(rotation);
  at.built("kind", [&] {
    kind->made(o, TermContext(at, parts, uses));
    return 0;
  });
  if (!o.light) {
    require_columns(o.rows.columns, o.rows.numbers + 1, o.rows.sigma_columns,
                    o.rows.error_units.size(), at);
    require_clock(o, table, nullptr);
    return o;
  }
  const Placed<L> light = placed_light(file, at.path());
  require_columns(o.light->columns, 2, o.light->sigma_columns, 1, at);
  require_clock(o, table, &light);
  require_state_axes(o.light->axes, at);
  require_light_curve(o, table, light);
  return o;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
