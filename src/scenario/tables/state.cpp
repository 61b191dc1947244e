// SPDX-License-Identifier: MIT
#include "scenario/tables/state.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "polhode/rotor/attitude.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::array keys_of_state = {
    epoch_key<&StateTable::epoch>(
        "epoch",
        "The date of t = 0 with its scale (UTC, TAI, TT, TDB or UT1): an ISO date or "
        "\"JD 2456297.5 TDB\" (of UTC the quasi-JD of ERFA). From it t counts SI seconds of TT "
        "(docs/guide/time-scales.md).")
        .example("\"2013-01-05T00:00:00 UTC\""),
    quantity_key<&StateTable::dut1>("dut1", Dimension::time,
                                    "UT1 - UTC, observed: needed for an epoch in UT1.")
        .example("\"-0.1 s\""),
    word_key<&StateTable::axes>("axes", "inertial|ecliptic-J2000|equator-J2000",
                                "The inertial axes that attitudes refer to.")
        .otherwise("\"inertial\""),
};
constexpr Table<StateTable> state_description = {
    {.path = "state",
     .presence = Presence::required,
     .help = "Attitude and spin at t = 0, in one chart."},
    keys_of_state};

struct TumblerTable {
  std::optional<double> precession_period, short_axis_period;
  double rotation_period = 0.0;
  bool pole = false;
  std::optional<double> longitude, latitude, ra, dec;
  Regime mode = Regime::short_axis;
  double phi0 = 0.0, psi0 = 0.0;
  int branch = 1, sense = 1;
};

template <auto member>
consteval KindKey<TumblerTable> period_key(std::string_view name, std::string_view help) {
  return quantity_key<member>(name, Dimension::time, help).positive();
}
template <auto member>
consteval KindKey<TumblerTable> angle_key(std::string_view name, std::string_view help) {
  return quantity_key<member>(name, Dimension::angle, help);
}

constexpr std::array keys_of_tumbler = {
    period_key<&TumblerTable::precession_period>(
        "precession_period", "P_phi: mean period of the long axis about the angular momentum.")
        .alternative()
        .example("30.56"),
    period_key<&TumblerTable::short_axis_period>(
        "short_axis_period",
        "Instead of P_phi: mean period of the short axis about the angular momentum, of which some "
        "papers publish P_phi (docs/guide/tumblers.md).")
        .alternative()
        .example("27.38"),
    period_key<&TumblerTable::rotation_period>(
        "rotation_period",
        "P_psi: period of the motion about (LAM) or oscillation around (SAM) the long axis.")
        .required()
        .example("263"),
    table_key<&TumblerTable::pole>("pole", "Direction of the angular momentum.").required(),
    angle_key<&TumblerTable::longitude>(
        "pole.longitude",
        "Ecliptic longitude (J2000); with axes = \"inertial\", longitude in those axes.")
        .alternative()
        .example("250"),
    angle_key<&TumblerTable::latitude>("pole.latitude",
                                       "Latitude that goes with it, from -90 to 90 deg.")
        .alternative()
        .example("-75"),
    angle_key<&TumblerTable::ra>(
        "pole.ra", "Right ascension (J2000); needs axes ecliptic-J2000 or equator-J2000.")
        .alternative()
        .example("250"),
    angle_key<&TumblerTable::dec>("pole.dec", "Declination (J2000), from -90 to 90 deg.")
        .alternative()
        .example("-75"),
    choice_key<&TumblerTable::mode, Regime::short_axis, Regime::long_axis>(
        "mode", "SAM|LAM", "Short-axis or long-axis mode.")
        .required()
        .example("\"SAM\""),
    angle_key<&TumblerTable::phi0>(
        "phi0",
        "Precession angle at t = 0: about the pole, from the direction due south of it to the node "
        "of the long axis (docs/guide/tumblers.md).")
        .otherwise("0"),
    angle_key<&TumblerTable::psi0>(
        "psi0",
        "Rotation angle at t = 0, from the plane of long axis and short axis; at most psi_max in "
        "SAM.")
        .otherwise("0"),
    integer_key<&TumblerTable::branch>(
        "branch", "Sign of cos(theta) at t = 0: which of the two states in SAM, which lobe in LAM.")
        .one_of("1|-1")
        .otherwise("1"),
    integer_key<&TumblerTable::sense>(
        "sense",
        "-1 is a SAM with the momentum on the far side of the short axis, psi about 180 deg.")
        .one_of("1|-1")
        .otherwise("1"),
};
constexpr Alternatives sets_of_tumbler[] = {
    {"state.tumbler", "precession_period|short_axis_period"},
    {"state.tumbler.pole", "longitude+latitude|ra+dec"}};
constexpr Table<TumblerTable> tumbler_description = {
    {.path = "state.tumbler",
     .presence = Presence::alternative,
     .help = "How observers describe a tumbling body (Kaasalainen 2001, Pravec et al. 2014)."},
    keys_of_tumbler,
    sets_of_tumbler};

struct AttitudeRateTable {
  std::optional<std::array<double, 4>> quaternion;
  bool euler = false;
  double phi = 0.0, theta = 0.0, psi = 0.0;
  std::optional<Vec3> omega_body, omega_inertial, omega_relative, momentum_body;
};

constexpr std::array keys_of_attitude_rate = {
    quantity_key<&AttitudeRateTable::quaternion>(
        "quaternion", Dimension::number,
        "[w, x, y, z], body to inertial, scalar first; any length but zero.")
        .alternative()
        .example("[1.0, 0.0, 0.0, 0.0]"),
    table_key<&AttitudeRateTable::euler>("euler", "The attitude as 3-1-3 Euler angles.")
        .alternative(),
    quantity_key<&AttitudeRateTable::phi>("euler.phi", Dimension::angle,
                                          "First angle, about inertial axis 3.")
        .required()
        .example("10"),
    quantity_key<&AttitudeRateTable::theta>("euler.theta", Dimension::angle,
                                            "Second angle, about the line of nodes.")
        .required()
        .example("20"),
    quantity_key<&AttitudeRateTable::psi>("euler.psi", Dimension::angle,
                                          "Third angle, about body axis 3.")
        .required()
        .example("30"),
    quantity_key<&AttitudeRateTable::omega_body>(
        "omega_body", Dimension::rate, "Angular velocity, components along the body axes.")
        .alternative()
        .example("[1.0, 20.0, 5.0]"),
    quantity_key<&AttitudeRateTable::omega_inertial>(
        "omega_inertial", Dimension::rate, "Angular velocity, components along the inertial axes.")
        .alternative()
        .example("[1.0, 20.0, 5.0]"),
    quantity_key<&AttitudeRateTable::omega_relative>(
        "omega_relative", Dimension::rate,
        "Angular velocity relative to the reference frame, components along the body axes: zeros "
        "are a body at rest in [frame].")
        .alternative()
        .example("[0.0, 0.0, 0.1]"),
    quantity_key<&AttitudeRateTable::momentum_body>(
        "momentum_body", Dimension::momentum,
        "Angular momentum instead, components along the body axes: exact where omega is not.")
        .alternative()
        .example("[0.1, 2.0, 0.5]"),
};
constexpr Alternatives sets_of_attitude_rate[] = {
    {"state.attitude-rate", "quaternion|euler"},
    {"state.attitude-rate", "omega_body|omega_inertial|omega_relative|momentum_body"}};
constexpr Table<AttitudeRateTable> attitude_rate_description = {
    {.path = "state.attitude-rate",
     .presence = Presence::alternative,
     .help = "An attitude and an angular velocity, or momentum."},
    keys_of_attitude_rate,
    sets_of_attitude_rate};

// The forms that are no charts.
constexpr std::string_view own_forms[] = {"tumbler", "attitude-rate"};

bool are_integers(std::string_view words) {
  int number = 0;
  return std::from_chars(words.data(), words.data() + words.size(), number).ec == std::errc();
}

bool is_number(std::string_view word) {
  double number = 0.0;
  return std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc();
}

// "state.andoyer"
std::string path_of(std::string_view form) { return "state." + std::string(form); }

}  // namespace

Placed<StateTable> state_table(const FileValues& file) { return {state_description, file}; }

StateRows::StateRows(std::span<const ChartKind> charts)
    : TableRows(state_description, tumbler_description, attitude_rate_description) {
  std::string forms;
  for (const std::string_view form : own_forms)
    forms += (forms.empty() ? "" : "|") + std::string(form);
  for (const ChartKind& chart : charts) {
    if (!chart.in_scenarios) continue;
    add_chart(chart);
    forms += "|" + std::string(chart.name);
  }
  add_set({"state", own(std::move(forms))});
}

void StateRows::add_chart(const ChartKind& chart) {
  std::vector<Key> keys;
  for (const ChartVariable& variable : chart.variables)
    keys.push_back(
        {.path = variable.name,
         .type = KeyType::number,
         .presence = variable.otherwise.empty() ? Presence::required : Presence::optional,
         .dimension = variable.dimension,
         .fallback = is_number(variable.otherwise) ? variable.otherwise : "",
         .example = variable.example,
         .help = variable.help,
         .in_template = !variable.otherwise.empty()});
  for (const ChartOption& option : chart.options) {
    const bool whole = are_integers(option.words);
    const bool is_word = !whole && !option.fallback.empty();
    keys.push_back(
        {.path = option.name,
         .type = whole ? KeyType::integer : KeyType::choice,
         .allowed = option.words,
         .fallback = is_word ? own('"' + std::string(option.fallback) + '"') : option.fallback,
         .example = option.example,
         .help = option.help});
  }
  add({.path = own(path_of(chart.name)), .presence = Presence::alternative, .help = chart.help},
      keys);
}

namespace {

Vec3 direction(double longitude, double latitude) {
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}

// The pole in the axes of the state. Ecliptic and equator of J2000 share axis 1, the equinox.
Vec3 pole_of(const Placed<TumblerTable>& table, const std::string& axes) {
  const auto in_axes = [&]<auto longitude, auto latitude>(bool equatorial) {
    if (std::fabs(*((*table).*latitude)) > 0.5 * std::numbers::pi * (1.0 + 1e-15))
      table.refuse<latitude>("expected an angle from -90 to 90 deg");
    if (equatorial && axes == "inertial")
      table.refuse<latitude>("ra and dec need axes = \"ecliptic-J2000\" or \"equator-J2000\"");
    const Vec3 p = direction(*((*table).*longitude), *((*table).*latitude));
    if (axes == "inertial" || equatorial == (axes == "equator-J2000")) return p;
    return equatorial ? ecliptic_from_equator(p) : equator_from_ecliptic(p);
  };
  return table->ra ? in_axes.template operator()<&TumblerTable::ra, &TumblerTable::dec>(true)
                   : in_axes.template operator()<&TumblerTable::longitude, &TumblerTable::latitude>(
                         false);
}

// P_phi of the long axis, which may be given by that of the short one.
double precession_period_of(const Placed<TumblerTable>& table) {
  if (table->precession_period) return *table->precession_period;
  return table.built<&TumblerTable::short_axis_period>([&] {
    const double given = *table->short_axis_period;
    if (!(given < table->rotation_period))
      throw DomainError(
          "expected a period shorter than rotation_period: the short axis goes round faster than "
          "the long one, by a turn in that time");
    return long_axis_period(given, table->rotation_period);
  });
}

TumblerState tumbler_of(const FileValues& file) {
  const Placed<TumblerTable> table(tumbler_description, file);
  const double precession = precession_period_of(table);
  return {.precession_period = precession,
          .rotation_period = table->rotation_period,
          .pole = pole_of(table, state_table(file)->axes),
          .mode = table->mode,
          .phi0 = table->phi0,
          .psi0 = table->psi0,
          .branch = table->branch,
          .sense = table->sense};
}

// True if the description has a state; the caller reports why not.
bool has_state(const Body& body, const TumblerState& s) {
  try {
    static_cast<void>(to_rotor(body, s));
    return true;
  } catch (const DomainError&) {
    return false;
  }
}

AttitudeRate attitude_rate_of(const FileValues& file) {
  const Placed<AttitudeRateTable> table(attitude_rate_description, file);
  const auto attitude_of = [&]() -> Quaternion {
    if (!table->quaternion) return attitude(EulerAngles{table->phi, table->theta, table->psi});
    return table.built<&AttitudeRateTable::quaternion>([&] {
      const auto& [w, x, y, z] = *table->quaternion;
      return unit_quaternion(w, x, y, z);
    });
  };
  using enum AttitudeRate::Given;
  if (table->omega_body) return {attitude_of(), *table->omega_body, omega_body};
  if (table->omega_inertial) return {attitude_of(), *table->omega_inertial, omega_inertial};
  if (table->omega_relative) return {attitude_of(), *table->omega_relative, omega_relative};
  return {attitude_of(), *table->momentum_body, momentum_body};
}

// Integers stand for themselves, words for their places in the list.
double option_of(const KeyValues& table, const ChartOption& option) {
  if (!table.has(option.name)) return std::numeric_limits<double>::quiet_NaN();
  return are_integers(option.words) ? static_cast<double>(table.integer(option.name))
                                    : option_number(option, table.word(option.name));
}

ChartState chart_state_of(const KeyValues& table, const ChartKind& chart, const Body& body) {
  ChartState state{chart, {}};
  std::size_t place = 0;
  for (const ChartVariable& variable : chart.variables)
    state.numbers[place++] =
        table.number(table.has(variable.name) ? variable.name : variable.otherwise);
  for (const ChartOption& option : chart.options) state.numbers[place++] = option_of(table, option);
  state.numbers = polhode::io::completed(chart, state.numbers, {&body});
  // what needs a body is seen when all else is there: see RotationBuilder::made
  if (!chart.needs_body) static_cast<void>(chart.to_hub(state.numbers, {nullptr}));
  return state;
}

}  // namespace

std::string state_form(const FileValues& file, std::span<const ChartKind> charts) {
  for (const std::string_view form : own_forms)
    if (has(file.values, path_of(form))) return std::string(form);
  for (const ChartKind& chart : charts)
    if (has(file.values, path_of(chart.name))) return std::string(chart.name);
  return {};
}

InitialState state_of(const FileValues& file, const std::string& form,
                      std::span<const ChartKind> charts, const Body& body) {
  if (form == "tumbler") return tumbler_of(file);
  if (form == "attitude-rate") return attitude_rate_of(file);
  const ChartKind* const chart = chart_named(form, charts);
  if (chart == nullptr)
    throw std::logic_error("state: the schema allows a chart without a description: " + form);
  const KeyValues table(file.values, file.units, path_of(form), file.name);
  return built(file.values, table.path(), file.name,
               [&] { return chart_state_of(table, *chart, body); });
}

// The library reports this as well, but in radians.
void require_angles(const FileValues& file, const Body& body, const TumblerState& state) {
  if (state.mode != Regime::short_axis || state.psi0 == 0.0 || has_state(body, state)) return;
  const Placed<TumblerTable> table(tumbler_description, file);
  TumblerState at_rest = state;
  at_rest.psi0 = 0.0;
  const double limit =
      table.built([&] { return psi_max(FreeRotation(body, to_rotor(body, at_rest))); });
  if (std::fabs(state.psi0) > limit * (1.0 + 1e-15))
    table.refuse<&TumblerTable::psi0>(
        "expected at most psi_max = " +
        polhode::detail::number_text(file.units.from_core(limit, Dimension::angle)) + " " +
        file.units.angle() + " on either side");
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
