// SPDX-License-Identifier: MIT
#include "output/detail/column_table.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/roll_pitch_yaw.hpp"
#include "polhode/system/axes.hpp"
#include "polhode/system/osculation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum Dimension;

Numbers numbers_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Numbers numbers_of(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }
Numbers numbers_of(const EulerState& e) { return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi}; }
Numbers numbers_of(const AndoyerState& a) { return {a.l, a.g, a.h, a.L, a.G, a.H}; }
Numbers numbers_of(const RotorAxes& a) {
  return {a.figure.I, a.figure.h, a.momentum.I, a.momentum.h, a.rotation.I, a.rotation.h};
}

// Principal axes B to the axes F of the body's tensor; the identity without one.
Vec3 in_body_axes(const RowSample& s, const Vec3& v_B) {
  return rotate(s.system.body().q_FB(), v_B);
}
Quaternion of_body_axes(const RowSample& s, const Quaternion& q) {
  return q * conj(s.system.body().q_FB());
}

Numbers attitude_numbers(const RowSample& s) { return numbers_of(of_body_axes(s, s.state.q)); }
Numbers inertial_attitude_numbers(const RowSample& s) {
  return numbers_of(of_body_axes(s, inertial_state(s.system, s.t, s.state).q));
}
Numbers omega_numbers(const RowSample& s) {
  return numbers_of(in_body_axes(s, angular_velocity(s.system, s.t, s.state).inertial));
}
Numbers inertial_omega_numbers(const RowSample& s) {
  const Quaternion q = normalized(inertial_state(s.system, s.t, s.state).q);
  return numbers_of(rotate(q, angular_velocity(s.system, s.t, s.state).inertial));
}
Numbers relative_omega_numbers(const RowSample& s) {
  return numbers_of(in_body_axes(s, angular_velocity(s.system, s.t, s.state).relative));
}
Numbers convective_numbers(const RowSample& s) {
  return numbers_of(in_body_axes(s, effect(s.system, s.t, s.state).v));
}
Numbers damper_numbers(const RowSample& s) { return numbers_of(in_body_axes(s, s.damper_rate)); }
Numbers momentum_numbers(const RowSample& s) { return numbers_of(in_body_axes(s, s.state.g)); }
Numbers osculating_euler_numbers(const RowSample& s) {
  return numbers_of(to_euler(osculating_state(s.system, s.t, s.state)));
}
Numbers osculating_andoyer_numbers(const RowSample& s) {
  return numbers_of(osculating_andoyer(s.system, s.t, s.state));
}
Numbers axes_numbers(const RowSample& s) {
  return numbers_of(inertial_axes(s.system, s.t, s.state));
}
Numbers relative_axes_numbers(const RowSample& s) {
  return numbers_of(relative_axes(s.system, s.t, s.state));
}
Numbers energy_numbers(const RowSample& s) {
  const double E = polhode::energy(s.system, s.t, s.state);
  return {E, E - s.initial_energy};
}

constexpr double turn = 2.0 * std::numbers::pi;

// Longitude and latitude of the momentum in inertial axes, once for each pair of names.
Numbers pole_numbers(const RowSample& s) {
  const Vec3 k = inertial_momentum(inertial_state(s.system, s.t, s.state));
  const double across = std::hypot(k.x, k.y);
  const double angle = std::atan2(k.y, k.x);
  const double nowhere = norm(k) > 0.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  const double longitude = nowhere + (angle < 0.0 ? angle + turn : angle);
  const double latitude = nowhere + std::atan2(k.z, across);
  return {longitude, latitude, longitude, latitude};
}

Numbers tumbler_numbers(const FreeRotation& motion) {
  const double mode = motion.regime() == Regime::short_axis  ? 1.0
                      : motion.regime() == Regime::long_axis ? -1.0
                                                             : 0.0;
  return {turn / motion.precession_rate_long(), motion.polhode_period(),
          turn / motion.precession_rate_short(), psi_max(motion), mode};
}
Numbers tumbler_numbers(const RowSample& s) {
  if (s.motion != nullptr) return tumbler_numbers(*s.motion);
  return tumbler_numbers(FreeRotation::short_arc(s.system.body(), s.state, s.t));
}

// A body axis along inertial axes.
Numbers axis_numbers(const RowSample& s, const Vec3& axis) {
  const Quaternion q = normalized(inertial_state(s.system, s.t, s.state).q);
  return numbers_of(rotate(of_body_axes(s, q), axis));
}
Numbers axis1_numbers(const RowSample& s) { return axis_numbers(s, {1.0, 0.0, 0.0}); }
Numbers axis2_numbers(const RowSample& s) { return axis_numbers(s, {0.0, 1.0, 0.0}); }
Numbers axis3_numbers(const RowSample& s) { return axis_numbers(s, {0.0, 0.0, 1.0}); }

Numbers flight_numbers(const RowSample& s) {
  const RollPitchYaw a = roll_pitch_yaw(of_body_axes(s, s.state.q));
  return {a.roll, a.pitch, a.yaw};
}

Numbers time_numbers(const RowSample& s) { return {s.t}; }

// The numbers of a motion that is not free are those of the free motion through the row.
Numbers chart_numbers(const ChartKind& chart, const RowSample& s) {
  const Body& body = s.system.body();
  if (chart.from_motion == nullptr) return chart.from_hub(s.state, {&body, s.t});
  if (s.motion != nullptr) return chart.from_motion(*s.motion, chart.is_constant ? 0.0 : s.t);
  return chart.from_motion(FreeRotation(body, s.state, s.t), s.t);
}

// A group that is no chart.
constexpr std::size_t widest_group = 6;
struct OwnGroup {
  std::string_view name;
  std::array<ColumnSpec, widest_group> columns;  // an empty name ends them
  Numbers (*of_row)(const RowSample&);
  bool is_constant = false;
  bool is_date = false;
};

constexpr OwnGroup before_charts[] = {
    {"q", {{{"qw"}, {"qx"}, {"qy"}, {"qz"}}}, attitude_numbers},
    {"omega", {{{"w1", rate}, {"w2", rate}, {"w3", rate}}}, omega_numbers},
    {"omega_inertial", {{{"W1", rate}, {"W2", rate}, {"W3", rate}}}, inertial_omega_numbers},
    {"g", {{{"g1", momentum}, {"g2", momentum}, {"g3", momentum}}}, momentum_numbers},
};
constexpr OwnGroup behind_charts[] = {
    {"q_inertial", {{{"Qw"}, {"Qx"}, {"Qy"}, {"Qz"}}}, inertial_attitude_numbers},
    {"omega_rel", {{{"w1_rel", rate}, {"w2_rel", rate}, {"w3_rel", rate}}}, relative_omega_numbers},
    {"convective", {{{"v1", rate}, {"v2", rate}, {"v3", rate}}}, convective_numbers},
    {"andoyer_osc",
     {{{"l_osc", angle},
       {"g_osc", angle},
       {"h_osc", angle},
       {"L_osc", momentum},
       {"G_osc", momentum},
       {"H_osc", momentum}}},
     osculating_andoyer_numbers},
    {"euler_osc",
     {{{"phi_osc", angle},
       {"theta_osc", angle},
       {"psi_osc", angle},
       {"Phi_osc", momentum},
       {"Theta_osc", momentum},
       {"Psi_osc", momentum}}},
     osculating_euler_numbers},
    {"axes",
     {{{"I_f", angle},
       {"h_f", angle},
       {"I_m", angle},
       {"h_m", angle},
       {"I_r", angle},
       {"h_r", angle}}},
     axes_numbers},
    {"axes_rel",
     {{{"I_f_rel", angle},
       {"h_f_rel", angle},
       {"I_m_rel", angle},
       {"h_m_rel", angle},
       {"I_r_rel", angle},
       {"h_r_rel", angle}}},
     relative_axes_numbers},
    {"damper", {{{"s1", rate}, {"s2", rate}, {"s3", rate}}}, damper_numbers},
    {"energy", {{{"E", Dimension::energy}, {"dE", Dimension::energy}}}, energy_numbers},
    {"pole",
     {{{"pole_ra", angle, Shown::equatorial},
       {"pole_dec", angle, Shown::equatorial},
       {"pole_lon", angle, Shown::not_equatorial},
       {"pole_lat", angle, Shown::not_equatorial}}},
     pole_numbers,
     true},
    {"tumbler",
     {{{"P_phi", Dimension::time},
       {"P_psi", Dimension::time},
       {"P_short", Dimension::time},
       {"psi_max", angle},
       {"mode"}}},
     tumbler_numbers,
     true},
    {"axis1", {{{"axis1_x"}, {"axis1_y"}, {"axis1_z"}}}, axis1_numbers},
    {"axis2", {{{"axis2_x"}, {"axis2_y"}, {"axis2_z"}}}, axis2_numbers},
    {"axis3", {{{"axis3_x"}, {"axis3_y"}, {"axis3_z"}}}, axis3_numbers},
    {"roll_pitch_yaw", {{{"roll", angle}, {"pitch", angle}, {"yaw", angle}}}, flight_numbers},
    {"date", {{{"date", Dimension::time}}}, time_numbers, false, true},
};

GroupSpec group_of(const OwnGroup& own) {
  GroupSpec group{own.name, {}, own.of_row, std::nullopt, own.is_constant, own.is_date};
  for (const ColumnSpec& column : own.columns) {
    if (column.name.empty()) break;
    group.columns.push_back(column);
    group.columns.back().place = group.columns.size() - 1;
  }
  return group;
}

GroupSpec group_of(const ChartKind& chart) {
  GroupSpec group{chart.name, {}, nullptr, chart, chart.is_constant};
  const std::size_t own = chart.variables.size();
  for (std::size_t i = 0; i < own; ++i) {
    const std::size_t place = chart.column_order.empty() ? i : chart.column_order[i];
    const ChartVariable& variable = chart.variables[place];
    group.columns.push_back({variable.column, variable.dimension, Shown::always, place});
  }
  // constant along a free motion
  const Shown shown = chart.from_motion != nullptr ? Shown::on_branch : Shown::always;
  for (const std::string_view name : branch_columns(chart))
    group.columns.push_back({name, Dimension::number, shown, group.columns.size()});
  return group;
}

}  // namespace

Numbers numbers_of(const GroupSpec& group, const RowSample& row) {
  return group.chart ? to_columns(*group.chart, chart_numbers(*group.chart, row))
                     : group.of_row(row);
}

ColumnTable::ColumnTable(std::span<const ChartKind> charts) {
  for (const OwnGroup& own : before_charts) groups_.push_back(group_of(own));
  for (const ChartKind& chart : charts)
    if (chart.in_scenarios) groups_.push_back(group_of(chart));
  for (const OwnGroup& own : behind_charts) groups_.push_back(group_of(own));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
