// SPDX-License-Identifier: MIT
// Columns of an output: the table of their groups, and the rows of a run in them.
#include "polhode/output/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/roll_pitch_yaw.hpp"
#include "polhode/system/axes.hpp"
#include "polhode/system/osculation.hpp"
#include "polhode/tables/chart_kind.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {

// The state of a row. A motion that is free in inertial axes is there itself, with the numbers, by
// group, of the charts that are constant along it. A system with a damper is that at the rate of
// the row.
struct RowSample {
  const System& system;
  double initial_energy;
  double t;
  RotorState state;
  Vec3 damper_rate = {};
  const FreeRotation* motion = nullptr;
  std::span<const ChartNumbers> constants = {};
};

namespace detail {

using Numbers = ChartNumbers;

// In which rows a column stands.
enum class Shown { always, on_branch, equatorial, not_equatorial };

struct ColumnSpec {
  std::string_view name;
  Dimension dimension = Dimension::number;
  Shown shown = Shown::always;
  std::size_t place = 0;  // among the numbers of the group
};
struct GroupSpec {
  std::string_view name;
  std::vector<ColumnSpec> columns;
  Numbers (*of_row)(const RowSample&);  // null of a chart
  std::optional<ChartKind> chart;
  bool is_constant = false;  // along a motion that is free in inertial axes
  bool is_date = false;
};
Numbers numbers_of(const GroupSpec& group, const RowSample& row);

// In the order of documents.
class ColumnTable {
 public:
  explicit ColumnTable(std::span<const ChartKind> charts);
  std::span<const GroupSpec> groups() const { return groups_; }
  bool is_constant(std::size_t group) const { return groups_[group].is_constant; }

 private:
  std::vector<GroupSpec> groups_;
};

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

namespace {

using detail::ColumnSpec;
using detail::ColumnTable;
using detail::GroupSpec;
using detail::Numbers;

constexpr std::size_t states_at_a_time = 64;  // of a free motion, in the lanes of the processor

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const std::string_view near = detail::nearest(name, known);
  return near.empty() ? "" : "; did you mean " + std::string(near) + "?";
}

// Made once for the charts that nearly everybody has.
std::shared_ptr<const ColumnTable> table_of(std::span<const ChartKind> charts) {
  static const auto ours = std::make_shared<const ColumnTable>(default_charts());
  const bool are_ours =
      charts.data() == default_charts().data() && charts.size() == default_charts().size();
  return are_ours ? ours : std::make_shared<const ColumnTable>(charts);
}

std::size_t group_index(const ColumnTable& table, const std::string& name,
                        std::span<const ChartKind> charts) {
  const std::span<const GroupSpec> groups = table.groups();
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const GroupSpec& group) { return group.name == name; });
  if (found != groups.end()) return static_cast<std::size_t>(found - groups.begin());
  throw DomainError("RowLayout: unknown column group \"" + name + "\"" +
                    did_you_mean(name, column_group_names(charts)));
}

struct ColumnLocation {
  std::shared_ptr<const ColumnTable> table;
  std::size_t group;
  ColumnSpec column;
};

// f(RowSample) of a sample, with the system at the rate of its damper.
template <class F>
auto of_row(const RowOrigin& origin, const DampedSample& at, const F& f) {
  const auto of = [&](const System& system) {
    return f(RowSample{system, origin.initial_energy, at.t, at.s.rotor, at.s.damper_rate});
  };
  return origin.system.damper() ? of(at_damper_rate(origin.system, at.s.damper_rate))
                                : of(origin.system);
}

ColumnLocation location_of(std::string_view name, std::span<const ChartKind> charts) {
  std::shared_ptr<const ColumnTable> table = table_of(charts);
  for (std::size_t group = 0; group < table->groups().size(); ++group)
    for (const ColumnSpec& column : table->groups()[group].columns)
      if (column.name == name && !table->groups()[group].is_date)
        return {std::move(table), group, column};
  throw DomainError("unknown column \"" + std::string(name) + "\"" +
                    did_you_mean(name, column_names(charts)));
}

bool is_shown(const ColumnSpec& column, Branch branch, const RowReference& reference) {
  using enum detail::Shown;
  switch (column.shown) {
    case on_branch:
      return branch == Branch::in_columns;
    case equatorial:
      return reference.is_equatorial;
    case not_equatorial:
      return !reference.is_equatorial;
    case always:
      break;
  }
  return true;
}

}  // namespace

std::vector<std::string_view> column_group_names(std::span<const ChartKind> charts) {
  std::vector<std::string_view> names;
  const std::shared_ptr<const ColumnTable> table = table_of(charts);
  for (const GroupSpec& group : table->groups()) names.push_back(group.name);
  return names;
}

std::vector<std::string_view> column_names(std::span<const ChartKind> charts) {
  std::vector<std::string_view> names;
  const std::shared_ptr<const ColumnTable> table = table_of(charts);
  for (const GroupSpec& group : table->groups())
    for (const ColumnSpec& column : group.columns)
      if (!group.is_date && std::find(names.begin(), names.end(), column.name) == names.end())
        names.push_back(column.name);
  return names;
}

bool needs_energy(std::string_view group_or_column) {
  const std::string_view names[] = {"energy", "E", "dE"};
  return std::find(std::begin(names), std::end(names), group_or_column) != std::end(names);
}

Dimension column_dimension(std::string_view column, std::span<const ChartKind> charts) {
  return location_of(column, charts).column.dimension;
}

ScalarColumn scalar_column(std::string_view name, const System& system, double initial_energy,
                           std::span<const ChartKind> charts) {
  const ColumnLocation of = location_of(name, charts);
  return {of.column.dimension, [of, system, initial_energy](const DampedSample& at) {
            return of_row(RowOrigin{system, initial_energy}, at, [&](const RowSample& row) {
              return numbers_of(of.table->groups()[of.group], row)[of.column.place];
            });
          }};
}

std::string branch_note(std::string_view group, const FreeRotation& motion,
                        std::span<const ChartKind> charts) {
  const ChartKind* const chart = chart_named(group, charts);
  if (chart == nullptr || chart->from_motion == nullptr || chart->options.empty()) return {};
  const ChartNumbers numbers = chart->from_motion(motion, 0.0);
  std::string note;
  for (std::size_t i = 0; i < chart->options.size(); ++i) {
    const ChartOption& option = chart->options[i];
    const std::string_view word = option_word(option, numbers[chart->variables.size() + i]);
    if (word.empty()) continue;  // says nothing here
    note += (note.empty() ? "" : ", ") + std::string(option.name) + " " + std::string(word);
  }
  return std::string(group) + ": " + note;
}

RowLayout::RowLayout(std::span<const std::string> groups, const Units& units, Branch branch,
                     std::span<const ChartKind> charts, const RowReference& reference)
    : table_(table_of(charts)), units_(units) {
  groups_.push_back({"t", {{"t", units.label(Dimension::time)}}});
  std::vector<std::string_view> taken;
  for (const std::string& name : groups) {
    const std::size_t group = group_index(*table_, name, charts);
    const bool is_date = table_->groups()[group].is_date;
    if (is_date && reference.time_scale.empty())
      throw DomainError("RowLayout: column group \"date\" needs an epoch");
    ColumnGroup shown{name, {}};
    for (const ColumnSpec& column : table_->groups()[group].columns) {
      if (!is_shown(column, branch, reference)) continue;
      if (std::find(taken.begin(), taken.end(), column.name) != taken.end()) continue;
      taken.push_back(column.name);
      shown.columns.push_back({std::string(column.name),
                               is_date ? reference.time_scale : units.label(column.dimension),
                               is_date});
      cells_.push_back({group, column.place, column.dimension});
    }
    if (shown.columns.empty())
      throw DomainError("RowLayout: column group \"" + name + "\" is named twice");
    groups_.push_back(std::move(shown));
  }
  width_ = cells_.size() + 1;
}

void RowLayout::write_row(const RowSample& sample, std::span<double> out) const {
  out[0] = units_.from_core(sample.t, Dimension::time);
  Numbers numbers{};
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (i == 0 || cells_[i - 1].group != cell.group)
      numbers = sample.constants.empty() || !table_->is_constant(cell.group)
                    ? numbers_of(table_->groups()[cell.group], sample)
                    : sample.constants[cell.group];
    out[i + 1] = units_.from_core(numbers[cell.place], cell.dimension);
  }
}

void RowLayout::write_rows(const FreeRotation& motion, std::span<const double> times,
                           std::span<double> out) const {
  const System system(motion.body());
  const RotorState& start = motion.initial_state();
  RowSample sample{system, energy(system, 0.0, start), motion.epoch(), start, {}, &motion, {}};
  std::vector<Numbers> constants(table_->groups().size());
  for (const Cell& cell : cells_)
    if (table_->is_constant(cell.group))
      constants[cell.group] = numbers_of(table_->groups()[cell.group], sample);
  sample.constants = constants;
  std::array<RotorState, states_at_a_time> states;
  for (std::size_t first = 0; first < times.size(); first += states.size()) {
    const std::size_t count = std::min(states.size(), times.size() - first);
    motion.at(times.subspan(first, count), std::span(states).first(count));
    for (std::size_t k = 0; k < count; ++k) {
      sample.t = times[first + k];
      sample.state = states[k];
      write_row(sample, out.subspan((first + k) * width_, width_));
    }
  }
}

void RowLayout::write_rows(const RowOrigin& origin, std::span<const DampedSample> samples,
                           std::span<double> out) const {
  for (std::size_t k = 0; k < samples.size(); ++k)
    of_row(origin, samples[k],
           [&](const RowSample& row) { write_row(row, out.subspan(k * width_, width_)); });
}

}  // namespace v0
}  // namespace polhode
