// SPDX-License-Identifier: MIT
// The groups of columns of the library, and those of its charts.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/system/axes.hpp"
#include "polhode/system/osculation.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

using enum Dimension;
using Six = std::array<double, 6>;

Six numbers_of(const EulerState& e) { return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi}; }
Six numbers_of(const AndoyerState& a) { return {a.l, a.g, a.h, a.L, a.G, a.H}; }
Six numbers_of(const charts::RotorAxes& a) {
  return {a.figure.I, a.figure.h, a.momentum.I, a.momentum.h, a.rotation.I, a.rotation.h};
}

// Principal axes B to the axes F of the body's tensor; the identity without one.
Vec3 in_body_axes(const RowSample& s, const Vec3& v_B) {
  return rotate(s.system.body().q_FB(), v_B);
}
Quaternion of_body_axes(const RowSample& s, const Quaternion& q) {
  return q * conj(s.system.body().q_FB());
}

Quaternion attitude(const RowSample& s) { return of_body_axes(s, s.state.q); }
Quaternion inertial_attitude(const RowSample& s) {
  return of_body_axes(s, inertial_state(s.system, s.t, s.state).q);
}
Vec3 omega(const RowSample& s) {
  return in_body_axes(s, angular_velocity(s.system, s.t, s.state).inertial);
}
Vec3 inertial_omega(const RowSample& s) {
  const Quaternion q = normalized(inertial_state(s.system, s.t, s.state).q);
  return rotate(q, angular_velocity(s.system, s.t, s.state).inertial);
}
Vec3 relative_omega(const RowSample& s) {
  return in_body_axes(s, angular_velocity(s.system, s.t, s.state).relative);
}
Vec3 convective(const RowSample& s) { return in_body_axes(s, effect(s.system, s.t, s.state).v); }
Vec3 damper(const RowSample& s) { return in_body_axes(s, s.damper_rate); }
Vec3 body_momentum(const RowSample& s) { return in_body_axes(s, s.state.g); }
Six osculating_euler(const RowSample& s) {
  return numbers_of(to_euler(charts::osculating_state(s.system, s.t, s.state)));
}
Six osculating_andoyer_numbers(const RowSample& s) {
  return numbers_of(charts::osculating_andoyer(s.system, s.t, s.state));
}
Six axes(const RowSample& s) { return numbers_of(charts::inertial_axes(s.system, s.t, s.state)); }
Six relative_axes_numbers(const RowSample& s) {
  return numbers_of(charts::relative_axes(s.system, s.t, s.state));
}
std::array<double, 2> energies(const RowSample& s) {
  const double E = polhode::energy(s.system, s.t, s.state);
  return {E, E - s.initial_energy};
}

constexpr double turn = 2.0 * std::numbers::pi;

// Longitude and latitude of the momentum in inertial axes, once for each pair of names.
std::array<double, 4> pole(const RowSample& s) {
  const Vec3 k = inertial_momentum(inertial_state(s.system, s.t, s.state));
  const double across = std::hypot(k.x, k.y);
  const double angle = std::atan2(k.y, k.x);
  const double nowhere = norm(k) > 0.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  const double longitude = nowhere + (angle < 0.0 ? angle + turn : angle);
  const double latitude = nowhere + std::atan2(k.z, across);
  return {longitude, latitude, longitude, latitude};
}

std::array<double, 5> tumbler_numbers(const FreeRotation& motion) {
  const double mode = motion.regime() == Regime::short_axis  ? 1.0
                      : motion.regime() == Regime::long_axis ? -1.0
                                                             : 0.0;
  return {turn / motion.precession_rate_long(), motion.polhode_period(),
          turn / motion.precession_rate_short(), psi_max(motion), mode};
}
std::array<double, 5> tumbler(const RowSample& s) {
  if (s.motion != nullptr) return tumbler_numbers(*s.motion);
  return tumbler_numbers(FreeRotation::short_arc(s.system.body(), s.state, s.t));
}

// A body axis along inertial axes.
Vec3 body_axis(const RowSample& s, const Vec3& axis) {
  const Quaternion q = normalized(inertial_state(s.system, s.t, s.state).q);
  return rotate(of_body_axes(s, q), axis);
}
Vec3 axis1(const RowSample& s) { return body_axis(s, {1.0, 0.0, 0.0}); }
Vec3 axis2(const RowSample& s) { return body_axis(s, {0.0, 1.0, 0.0}); }
Vec3 axis3(const RowSample& s) { return body_axis(s, {0.0, 0.0, 1.0}); }

std::array<double, 3> flight_angles(const RowSample& s) {
  const RollPitchYaw a = roll_pitch_yaw(of_body_axes(s, s.state.q));
  return {a.roll, a.pitch, a.yaw};
}

double row_time(const RowSample& s) { return s.t; }

ColumnKind with_note(ColumnKind kind, std::string_view note) {
  kind.note = note;
  return kind;
}
ColumnKind constant(ColumnKind kind) {
  kind.is_constant = true;
  return kind;
}
ColumnKind of_energy(ColumnKind kind) {
  kind.needs_energy = true;
  return kind;
}
ColumnKind of_damper(ColumnKind kind) {
  kind.needs_damper = true;
  return kind;
}
ColumnKind of_date(ColumnKind kind) {
  kind.is_date = true;
  return kind;
}

// Their order is that of documents.
std::vector<ColumnKind> before_charts() {
  return {
      column_kind("q", "Attitude, body to reference frame, scalar first.",
                  {{"qw", number}, {"qx", number}, {"qy", number}, {"qz", number}}, attitude),
      with_note(column_kind("omega",
                            "**Inertial** angular velocity (of the body relative to inertial "
                            "axes), body components.",
                            {{"w1", rate}, {"w2", rate}, {"w3", rate}}, omega),
                "w1, w2, w3: angular velocity relative to inertial axes, body components"),
      with_note(column_kind("omega_inertial", "The same vector, inertial components.",
                            {{"W1", rate}, {"W2", rate}, {"W3", rate}}, inertial_omega),
                "W1, W2, W3: angular velocity relative to inertial axes, inertial components"),
      column_kind("g", "Angular momentum, body components.",
                  {{"g1", momentum}, {"g2", momentum}, {"g3", momentum}}, body_momentum),
  };
}
std::vector<ColumnKind> relative_kinds() {
  return {
      column_kind("q_inertial", "Attitude, body to inertial axes.",
                  {{"Qw", number}, {"Qx", number}, {"Qy", number}, {"Qz", number}},
                  inertial_attitude),
      with_note(column_kind("omega_rel",
                            "Angular velocity **relative to the reference frame**, body "
                            "components.",
                            {{"w1_rel", rate}, {"w2_rel", rate}, {"w3_rel", rate}}, relative_omega),
                "w1_rel, w2_rel, w3_rel: angular velocity relative to the reference frame, body "
                "components"),
      column_kind("convective",
                  "What frame and perturbations add to `I^-1 g` in the relative rate: the "
                  "convective term, body components.",
                  {{"v1", rate}, {"v2", rate}, {"v3", rate}}, convective),
      column_kind("andoyer_osc",
                  "Andoyer variables that osculate: with the unperturbed formula they give the "
                  "**relative** angular velocity.",
                  {{"l_osc", angle},
                   {"g_osc", angle},
                   {"h_osc", angle},
                   {"L_osc", momentum},
                   {"G_osc", momentum},
                   {"H_osc", momentum}},
                  osculating_andoyer_numbers),
      column_kind("euler_osc", "Euler variables that osculate.",
                  {{"phi_osc", angle},
                   {"theta_osc", angle},
                   {"psi_osc", angle},
                   {"Phi_osc", momentum},
                   {"Theta_osc", momentum},
                   {"Psi_osc", momentum}},
                  osculating_euler),
  };
}
std::vector<ColumnKind> axes_kinds() {
  return {
      column_kind("axes",
                  "Inclination and node of the planes normal to figure axis (body axis 3), angular "
                  "momentum and rotation axis (of the inertial angular velocity), in inertial "
                  "axes.",
                  {{"I_f", angle},
                   {"h_f", angle},
                   {"I_m", angle},
                   {"h_m", angle},
                   {"I_r", angle},
                   {"h_r", angle}},
                  axes),
      column_kind("axes_rel",
                  "The same in the reference frame; the rotation axis is that of the **relative** "
                  "angular velocity.",
                  {{"I_f_rel", angle},
                   {"h_f_rel", angle},
                   {"I_m_rel", angle},
                   {"h_m_rel", angle},
                   {"I_r_rel", angle},
                   {"h_r_rel", angle}},
                  relative_axes_numbers),
      of_damper(column_kind("damper",
                            "Rate of the sphere of a Kane damper relative to the body, body "
                            "components.",
                            {{"s1", rate}, {"s2", rate}, {"s3", rate}}, damper)),
      of_energy(column_kind("energy",
                            "The Hamiltonian, and E - E(0): its error where nothing depends on "
                            "time. Every perturbation must have an energy.",
                            {{"E", Dimension::energy}, {"dE", Dimension::energy}}, energies)),
  };
}
std::vector<ColumnKind> observers_kinds() {
  return {
      constant(with_note(
          column_kind("pole",
                      "Direction of the angular momentum: right ascension and declination with "
                      "`axes = \"equator-J2000\"`, else longitude and latitude in the inertial "
                      "axes, which with `ecliptic-J2000` are ecliptic.",
                      {{"pole_ra", angle, Shown::equatorial},
                       {"pole_dec", angle, Shown::equatorial},
                       {"pole_lon", angle, Shown::not_equatorial},
                       {"pole_lat", angle, Shown::not_equatorial}},
                      pole),
          "pole: direction of the angular momentum in the inertial axes")),
      constant(with_note(
          column_kind("tumbler",
                      "What observers publish: mean period of precession of the long axis, period "
                      "about (LAM) or around (SAM) it, mean period of precession of the short "
                      "axis, largest psi of a SAM; `mode` is 1 in short-axis mode, -1 in long-axis "
                      "mode, 0 in neither.",
                      {{"P_phi", Dimension::time},
                       {"P_psi", Dimension::time},
                       {"P_short", Dimension::time},
                       {"psi_max", angle},
                       {"mode", number}},
                      tumbler),
          "P_phi, P_psi, P_short, psi_max, mode: mean period of precession of the long axis, "
          "period of the polhode, mean period of precession of the short axis, of the free "
          "rotation through the row; mode 1: SAM, -1: LAM")),
      column_kind("axis1", "Direction of body axis 1, components along inertial axes.",
                  {{"axis1_x", number}, {"axis1_y", number}, {"axis1_z", number}}, axis1),
      column_kind("axis2", "The same of body axis 2.",
                  {{"axis2_x", number}, {"axis2_y", number}, {"axis2_z", number}}, axis2),
      column_kind("axis3", "The same of body axis 3.",
                  {{"axis3_x", number}, {"axis3_y", number}, {"axis3_z", number}}, axis3),
      column_kind("roll_pitch_yaw",
                  "Attitude in the reference frame as angles about body axes 1, 2, 3, in the "
                  "sequence 3-2-1 of flight: with `[frame.local-vertical]` those of a satellite.",
                  {{"roll", angle}, {"pitch", angle}, {"yaw", angle}}, flight_angles),
      of_date(with_note(
          column_kind("date", "The date of the row, ISO 8601, in the time scale of `state.epoch`.",
                      {{"date", Dimension::time}}, row_time),
          "date: ISO 8601, in the time scale of the epoch")),
  };
}

// The numbers of a motion that is not free are those of the free motion through the row.
ChartNumbers chart_numbers(const ChartKind& chart, const RowSample& s) {
  const Body& body = s.system.body();
  if (chart.from_motion == nullptr) return chart.from_hub(s.state, {&body, s.t});
  if (s.motion != nullptr) return chart.from_motion(*s.motion, chart.is_constant ? 0.0 : s.t);
  return chart.from_motion(FreeRotation(body, s.state, s.t), s.t);
}

ColumnNumbers chart_columns(const ChartKind& chart, const RowSample& s) {
  static_assert(most_columns == most_chart_numbers);
  const ChartNumbers numbers = to_columns(chart, chart_numbers(chart, s));
  ColumnNumbers ordered = numbers;
  for (std::size_t i = 0; i < chart.column_order.size(); ++i)
    ordered[i] = numbers[chart.column_order[i]];
  return ordered;
}

std::string branch_text(const ChartKind& chart, const FreeRotation& motion) {
  const ChartNumbers numbers = chart.from_motion(motion, 0.0);
  std::string text;
  for (std::size_t i = 0; i < chart.options.size(); ++i) {
    const ChartOption& option = chart.options[i];
    const std::string_view word = option_word(option, numbers[chart.variables.size() + i]);
    if (word.empty()) continue;  // says nothing here
    text += (text.empty() ? "" : ", ") + std::string(option.name) + " " + std::string(word);
  }
  return std::string(chart.name) + ": " + text;
}

ColumnKind kind_of(const ChartKind& chart) {
  ColumnKind kind{.name = chart.name,
                  .help = chart.help,
                  .columns = {},
                  .numbers = [chart](const RowSample& s) { return chart_columns(chart, s); },
                  .is_constant = chart.is_constant};
  for (std::size_t i = 0; i < chart.variables.size(); ++i) {
    const ChartVariable& variable =
        chart.variables[chart.column_order.empty() ? i : chart.column_order[i]];
    kind.columns.emplace_back(variable.column, variable.dimension);
  }
  // constant along a free motion
  const bool of_motions = chart.from_motion != nullptr;
  for (const std::string_view name : branch_columns(chart))
    kind.columns.emplace_back(name, number, of_motions ? Shown::on_branch : Shown::always);
  if (of_motions && !chart.options.empty())
    kind.branch = [chart](const FreeRotation& motion) { return branch_text(chart, motion); };
  return kind;
}

bool has_column(const ColumnKind& kind, std::string_view name) {
  return std::ranges::find(kind.columns, name, &GroupColumn::name) != kind.columns.end();
}

const ColumnKind* group_or_owner(const ColumnKinds& kinds, std::string_view name) {
  const ColumnKind* const group = kinds.group(name);
  return group != nullptr ? group : kinds.of_column(name);
}

}  // namespace
}  // namespace detail

ColumnKinds::ColumnKinds(std::span<const ChartKind> charts, std::vector<ColumnKind> more) {
  std::vector<ColumnKind> all = detail::before_charts();
  for (const ChartKind& chart : charts)
    if (chart.in_scenarios) all.push_back(detail::kind_of(chart));
  for (std::vector<ColumnKind> some :
       {detail::relative_kinds(), detail::axes_kinds(), detail::observers_kinds(), std::move(more)})
    std::ranges::move(some, std::back_inserter(all));
  all_ = std::make_shared<const std::vector<ColumnKind>>(std::move(all));
}

const ColumnKind* ColumnKinds::group(std::string_view name) const {
  const auto found = std::ranges::find(*all_, name, &ColumnKind::name);
  return found == all_->end() ? nullptr : &*found;
}
const ColumnKind* ColumnKinds::of_column(std::string_view name) const {
  const auto found = std::ranges::find_if(*all_, [&](const ColumnKind& kind) {
    return !kind.is_date && detail::has_column(kind, name);
  });
  return found == all_->end() ? nullptr : &*found;
}
bool ColumnKinds::needs_energy(std::string_view group_or_column) const {
  const ColumnKind* const kind = detail::group_or_owner(*this, group_or_column);
  return kind != nullptr && kind->needs_energy;
}
bool ColumnKinds::needs_damper(std::string_view group_or_column) const {
  const ColumnKind* const kind = detail::group_or_owner(*this, group_or_column);
  return kind != nullptr && kind->needs_damper;
}

const ColumnKinds& default_columns() {
  static const ColumnKinds kinds(default_charts());
  return kinds;
}

std::vector<std::string_view> column_group_names(const ColumnKinds& kinds) {
  std::vector<std::string_view> names;
  for (const ColumnKind& kind : kinds.all()) names.push_back(kind.name);
  return names;
}

std::vector<std::string_view> column_names(const ColumnKinds& kinds) {
  std::vector<std::string_view> names;
  for (const ColumnKind& kind : kinds.all())
    for (const GroupColumn& column : kind.columns)
      if (!kind.is_date && std::ranges::find(names, column.name) == names.end())
        names.push_back(column.name);
  return names;
}

Dimension column_dimension(std::string_view column, const ColumnKinds& kinds) {
  const ColumnKind* const kind = kinds.of_column(column);
  if (kind == nullptr)
    throw DomainError("unknown column \"" + std::string(column) + "\"" +
                      detail::did_you_mean(column, column_names(kinds)));
  return std::ranges::find(kind->columns, column, &GroupColumn::name)->dimension;
}

std::string markdown_columns(const ColumnKinds& kinds) {
  std::string text = "| group | columns | what they are |\n|---|---|---|\n";
  for (const ColumnKind& kind : kinds.all()) {
    std::string names;
    for (const GroupColumn& column : kind.columns)
      if (column.shown != Shown::on_branch)
        names += (names.empty() ? "" : ",") + std::string(column.name);
    text +=
        "| `" + std::string(kind.name) + "` | `" + names + "` | " + std::string(kind.help) + " |\n";
  }
  return text;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
