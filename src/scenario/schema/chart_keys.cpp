// SPDX-License-Identifier: MIT
// The table of scenario keys: the state of the body at t = 0, of which two forms are written out
// here and the others are charts, and the columns of output. The keys of a format of files are in
// the source of that format.
#include "scenario/detail/chart_keys.hpp"

#include <algorithm>
#include <charconv>
#include <deque>
#include <string>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/output/columns.hpp"
#include "polhode/tables/chart_kind.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

using enum KeyType;
using enum Presence;

constexpr Key state_rows[] = {
    {.path = "state", .presence = required, .help = "Attitude and spin at t = 0, in one chart."},
    {.path = "state.epoch",
     .type = epoch,
     .example = "\"2013-01-05T00:00:00 UTC\"",
     .help =
         "The date of t = 0 with its scale (UTC, TAI, TT, TDB or UT1): an ISO date or "
         "\"JD 2456297.5 TDB\" (of UTC the quasi-JD of ERFA). From it t counts SI seconds of TT "
         "(docs/guide/time-scales.md)."},
    {.path = "state.dut1",
     .type = number,
     .dimension = Dimension::time,
     .example = "\"-0.1 s\"",
     .help = "UT1 - UTC, observed: needed for an epoch in UT1."},
    {.path = "state.axes",
     .type = choice,
     .allowed = "inertial|ecliptic-J2000|equator-J2000",
     .fallback = "\"inertial\"",
     .example = "\"inertial\"",
     .help = "The inertial axes that attitudes refer to."},

    {.path = "state.tumbler",
     .presence = alternative,
     .help = "How observers describe a tumbling body (Kaasalainen 2001, Pravec et al. 2014)."},
    {.path = "state.tumbler.precession_period",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::time,
     .example = "30.56",
     .help = "P_phi: mean period of the long axis about the angular momentum.",
     .range = Range::positive},
    {.path = "state.tumbler.short_axis_period",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::time,
     .example = "27.38",
     .help = "Instead of P_phi: mean period of the short axis about the angular momentum, of which "
             "some papers publish P_phi (docs/guide/tumblers.md).",
     .range = Range::positive},
    {.path = "state.tumbler.rotation_period",
     .type = number,
     .presence = required,
     .dimension = Dimension::time,
     .example = "263",
     .help = "P_psi: period of the motion about (LAM) or oscillation around (SAM) the long axis.",
     .range = Range::positive},
    {.path = "state.tumbler.pole",
     .presence = required,
     .help = "Direction of the angular momentum."},
    {.path = "state.tumbler.pole.longitude",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "250",
     .help = "Ecliptic longitude (J2000); with axes = \"inertial\", longitude in those axes."},
    {.path = "state.tumbler.pole.latitude",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "-75",
     .help = "Latitude that goes with it, from -90 to 90 deg."},
    {.path = "state.tumbler.pole.ra",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "250",
     .help = "Right ascension (J2000); needs axes ecliptic-J2000 or equator-J2000."},
    {.path = "state.tumbler.pole.dec",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::angle,
     .example = "-75",
     .help = "Declination (J2000), from -90 to 90 deg."},
    {.path = "state.tumbler.mode",
     .type = choice,
     .presence = required,
     .allowed = "SAM|LAM",
     .example = "\"SAM\"",
     .help = "Short-axis or long-axis mode."},
    {.path = "state.tumbler.phi0",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "Precession angle at t = 0: about the pole, from the direction due south of it to the "
             "node of the long axis (docs/guide/tumblers.md)."},
    {.path = "state.tumbler.psi0",
     .type = number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "Rotation angle at t = 0, from the plane of long axis and short axis; at most psi_max "
             "in SAM."},
    {.path = "state.tumbler.branch",
     .type = integer,
     .allowed = "1|-1",
     .fallback = "1",
     .example = "1",
     .help = "Sign of cos(theta) at t = 0: which of the two states in SAM, which lobe in LAM."},
    {.path = "state.tumbler.sense",
     .type = integer,
     .allowed = "1|-1",
     .fallback = "1",
     .example = "1",
     .help = "-1 is a SAM with the momentum on the far side of the short axis, psi about 180 deg."},

    {.path = "state.attitude-rate",
     .presence = alternative,
     .help = "An attitude and an angular velocity, or momentum."},
    {.path = "state.attitude-rate.quaternion",
     .type = numbers,
     .presence = alternative,
     .length = 4,
     .example = "[1.0, 0.0, 0.0, 0.0]",
     .help = "[w, x, y, z], body to inertial, scalar first; any length but zero."},
    {.path = "state.attitude-rate.euler",
     .presence = alternative,
     .help = "The attitude as 3-1-3 Euler angles."},
    {.path = "state.attitude-rate.euler.phi",
     .type = number,
     .presence = required,
     .dimension = Dimension::angle,
     .example = "10",
     .help = "First angle, about inertial axis 3."},
    {.path = "state.attitude-rate.euler.theta",
     .type = number,
     .presence = required,
     .dimension = Dimension::angle,
     .example = "20",
     .help = "Second angle, about the line of nodes."},
    {.path = "state.attitude-rate.euler.psi",
     .type = number,
     .presence = required,
     .dimension = Dimension::angle,
     .example = "30",
     .help = "Third angle, about body axis 3."},
    {.path = "state.attitude-rate.omega_body",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::rate,
     .length = 3,
     .example = "[1.0, 20.0, 5.0]",
     .help = "Angular velocity, components along the body axes."},
    {.path = "state.attitude-rate.omega_inertial",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::rate,
     .length = 3,
     .example = "[1.0, 20.0, 5.0]",
     .help = "Angular velocity, components along the inertial axes."},
    {.path = "state.attitude-rate.omega_relative",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::rate,
     .length = 3,
     .example = "[0.0, 0.0, 0.1]",
     .help = "Angular velocity relative to the reference frame, components along the body axes: "
             "zeros are a body at rest in [frame]."},
    {.path = "state.attitude-rate.momentum_body",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::momentum,
     .length = 3,
     .example = "[0.1, 2.0, 0.5]",
     .help = "Angular momentum instead, components along the body axes: exact where omega is not."},
};

constexpr std::string_view written_out = "tumbler|attitude-rate";
constexpr Alternatives alternatives[] = {
    {"state.tumbler", "precession_period|short_axis_period"},
    {"state.tumbler.pole", "longitude+latitude|ra+dec"},
    {"state.attitude-rate", "quaternion|euler"},
    {"state.attitude-rate", "omega_body|omega_inertial|omega_relative|momentum_body"},
};

bool are_integers(std::string_view words) {
  int number = 0;
  return std::from_chars(words.data(), words.data() + words.size(), number).ec == std::errc();
}

bool are_numbers(std::string_view word) {
  double number = 0.0;
  return std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc();
}

std::string in_quotes(std::string_view word) { return '"' + std::string(word) + '"'; }

}  // namespace

StateKeys::StateKeys(std::span<const ChartKind> charts)
    : keys_(std::begin(state_rows), std::end(state_rows)) {
  std::string& sets = words_.emplace_back(written_out);
  for (const ChartKind& chart : charts)
    if (chart.in_scenarios) {
      add(chart);
      sets += "|" + std::string(chart.name);
    }
  alternatives_.push_back({"state", sets});
  alternatives_.insert(alternatives_.end(), std::begin(alternatives), std::end(alternatives));
}

void StateKeys::add(const ChartKind& chart) {
  const std::string table = "state." + std::string(chart.name);
  keys_.push_back(
      {.path = words_.emplace_back(table), .presence = alternative, .help = chart.help});
  for (const ChartVariable& variable : chart.variables)
    keys_.push_back({.path = words_.emplace_back(table + "." + std::string(variable.name)),
                     .type = number,
                     .presence = variable.otherwise.empty() ? required : optional,
                     .dimension = variable.dimension,
                     .fallback = are_numbers(variable.otherwise) ? variable.otherwise : "",
                     .example = variable.example,
                     .help = variable.help,
                     .in_template = !variable.otherwise.empty()});
  for (const ChartOption& option : chart.options) {
    const bool whole = are_integers(option.words);
    const bool is_word = !whole && !option.fallback.empty();
    keys_.push_back(
        {.path = words_.emplace_back(table + "." + std::string(option.name)),
         .type = whole ? integer : choice,
         .allowed = option.words,
         .fallback = is_word ? words_.emplace_back(in_quotes(option.fallback)) : option.fallback,
         .example = option.example,
         .help = option.help});
  }
}

namespace {

constexpr Key output_rows[] = {
    {.path = "output", .fallback = "{}", .help = "What the rows hold."},
    {.path = "output.columns",
     .type = choices,
     .fallback = "[\"q\", \"omega\"]",
     .example = "[\"q\", \"omega\", \"andoyer\"]",
     .help = "Groups of columns after t. A column that two groups share is written once. Kind "
             "obliquity has obliquity, precession, climatic_precession, pericentre, eccentricity, "
             "spin, andoyer, insolation and tides, of which the first three are the default; all "
             "else, and andoyer, is of a rotation."},
};

bool is_among(std::string_view words, std::string_view word) {
  const std::vector<std::string_view> all = separated(words, '|');
  return std::find(all.begin(), all.end(), word) != all.end();
}

}  // namespace

OutputKeys::OutputKeys(std::span<const ChartKind> charts)
    : keys_(std::begin(output_rows), std::end(output_rows)) {
  for (const std::string_view name : column_group_names(charts))
    groups_ += (groups_.empty() ? "" : "|") + std::string(name);
  for (const std::string_view name : spin_column_groups())
    if (!is_among(groups_, name)) groups_ += "|" + std::string(name);
  for (Key& key : keys_)
    if (key.path == "output.columns") key.allowed = groups_;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
