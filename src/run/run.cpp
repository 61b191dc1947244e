// SPDX-License-Identifier: MIT
#include "polhode/run/run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dynamics/free_run.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"
#include "polhode/run/detail/integrated_run.hpp"
#include "polhode/run/detail/row_writer.hpp"
#include "polhode/run/detail/rows_maker.hpp"
#include "polhode/run/detail/run_state.hpp"
#include "run/detail/experiments.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::completed;
using detail::RowWriter;
using detail::RunControl;

bool is_free(const Rotation& rotation) { return !propagation_method(rotation).has_value(); }
// Free and in inertial axes: the elements of the motion are constant.
bool has_constants(const Rotation& rotation) {
  return is_free(rotation) && rotation.frame.is_inertial();
}

const ColumnKinds& columns_of(const Scenario& scenario) {
  return scenario.document.kinds->columns();
}

// What the numbers of a group do not say themselves: it is constant along the motion.
std::vector<std::string> branch_notes(const Rotation& rotation, const Scenario& scenario) {
  std::vector<std::string> notes;
  if (!has_constants(rotation)) return notes;
  const FreeRotation& motion = free_rotation(rotation);
  for (const std::string& group : scenario.output.columns)
    if (const ColumnKind* const kind = columns_of(scenario).group(group);
        kind != nullptr && kind->branch)
      notes.push_back(kind->branch(motion));
  return notes;
}

// Angles are compared modulo a turn: the jump of a column at +-pi is no crossing.
std::vector<Event> events_of(const Scenario& scenario, const System& system, double energy_0) {
  std::vector<Event> events;
  for (const ScenarioEvent& wanted : scenario.rotation().events) {
    const ScalarColumn column =
        scalar_column(wanted.column, system, energy_0, columns_of(scenario));
    const double turn = column.dimension == Dimension::angle ? 2.0 * std::numbers::pi : 0.0;
    events.push_back({wanted.name,
                      [value = column.value, target = wanted.value, turn](const Sample& at) {
                        const double x = value(at) - target;
                        return turn > 0.0 ? std::remainder(x, turn) : x;
                      },
                      wanted.crossing, wanted.stops, turn, wanted.interval});
  }
  return events;
}

// The closed form, in inertial axes; a moving frame is applied to each state afterwards.
RunReport run_free(const Scenario& scenario, const RowLayout& layout, RowWriter& writer,
                   const RunControl& control) {
  const Rotation& rotation = scenario.rotation();
  const Problem problem = rotor_problem(rotation);
  const bool is_inertial = rotation.frame.is_inertial();
  const FreeRotation motion =
      is_inertial
          ? free_rotation(rotation)
          : FreeRotation(rotation.body, inertial_state(problem.system, 0.0, problem.initial));
  const RowOrigin origin{problem.system, initial_energy(problem)};
  const SaveAt& rows = *rotation.time;
  const auto write = [&](std::span<const Sample> samples, std::span<double> numbers) {
    if (is_inertial) return layout.write_rows(motion, samples, numbers);
    layout.write_rows(origin, samples, numbers);
  };
  const detail::RowsOfMotion<polhode::detail::FreeMotion> free{
      polhode::detail::free_problem(motion, rotation.frame, rows[0], rows.end(),
                                    events_of(scenario, problem.system, origin.initial_energy)),
      rows, write};
  RunReport report = detail::integrated_run(free, writer, control).report;
  report.statistics = {};  // looks for events are no steps
  return report;
}

RunReport run_integrated(const Scenario& scenario, const RowLayout& layout, RowWriter& writer,
                         const RunControl& control) {
  const Rotation& rotation = scenario.rotation();
  Problem problem = rotor_problem(rotation);
  const System& system = problem.system;
  const double energy_0 = initial_energy(problem);
  problem.events = events_of(scenario, system, energy_0);
  const auto write = [&](std::span<const Sample> samples, std::span<double> numbers) {
    layout.write_rows(RowOrigin{system, energy_0}, samples, numbers);
  };
  const detail::RowsOfMotion<System> motion{problem, *rotation.time, write};
  auto [report, last] = detail::integrated_run(motion, writer, control);
  report.end = last;
  if (last && system.has_energy()) {
    const auto& [t, end] = *last;
    report.energy_change = energy(at_damper_rate(system, end.damper_rate), t, end) - energy_0;
  }
  return report;
}

// Which angular velocity, pole and periods the written columns are, in the order of documents.
std::vector<std::string> column_notes(const Scenario& scenario) {
  std::vector<std::string> notes;
  for (const ColumnKind& kind : columns_of(scenario).all())
    if (!kind.note.empty() &&
        std::ranges::find(scenario.output.columns, kind.name) != scenario.output.columns.end())
      notes.emplace_back(kind.note);
  return notes;
}

}  // namespace

void detail::add_facts(const Rotation& rotation, RunFacts& facts) {
  facts.epoch = rotation.epoch;
  facts.axes = rotation.axes;
  facts.moving_frame = !rotation.frame.is_inertial();
  facts.rate = norm(angular_velocity(rotation.body, initial_state(rotation)));
}

RowLayout detail::row_layout(const Rotation& rotation, const Scenario& scenario) {
  return RowLayout(scenario.output.columns, scenario.units(),
                   has_constants(rotation) ? Branch::in_notes : Branch::in_columns,
                   columns_of(scenario),
                   {.is_equatorial = rotation.axes == "equator-J2000",
                    .time_scale = std::string(detail::scale_of_epoch(rotation.epoch))});
}

std::string detail::propagation_text(const Rotation& rotation, const Units& units) {
  const std::optional<Method> method = propagation_method(rotation);
  if (!method)
    return rotation.frame.is_inertial() ? "exact free rotation"
                                        : "exact free rotation, seen from the moving frame";
  return method_in_units(*method, units) +
         (rotation.method ? "" : " (chosen: the file names no method)");
}

std::vector<std::string> detail::notes_of(const Rotation& rotation, const Scenario& scenario) {
  std::vector<std::string> notes;
  const std::string since = rotation.epoch.empty() ? "the epoch" : rotation.epoch;
  notes.push_back("t counts from " + since + "; axes: " + rotation.axes);
  if (!rotation.frame.is_inertial())
    notes.push_back("attitudes and elements refer to the moving frame: " + rotation.frame_text +
                    "; q_inertial and axes to inertial axes");
  for (std::string& note : column_notes(scenario)) notes.push_back(std::move(note));
  const Quaternion& q = rotation.body.q_FB();
  if (!(q == Quaternion{}))
    notes.push_back(
        "q, g and the body components of vectors refer to the axes of the tensor, charts to "
        "principal axes, q_FB = [" +
        polhode::detail::number_text(q.w) + ", " + polhode::detail::number_text(q.x) + ", " +
        polhode::detail::number_text(q.y) + ", " + polhode::detail::number_text(q.z) + "]");
  for (const AnyPerturbation& term : rotation.terms)
    notes.push_back("perturbation: " + term.name());
  if (rotation.damper) notes.push_back("perturbation: Kane damper");
  for (std::string& note : file_notes(scenario)) notes.push_back(std::move(note));
  notes.push_back("method: " + propagation_text(rotation, scenario.units()));
  for (std::string& note : branch_notes(rotation, scenario)) notes.push_back(std::move(note));
  return notes;
}

std::vector<ColumnGroup> detail::row_groups(const Rotation& rotation, const Scenario& scenario) {
  return row_layout(rotation, scenario).groups();
}

RunReport detail::rows_of(const Rotation& rotation, const Scenario& scenario,
                          std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control) {
  const RowLayout layout = row_layout(rotation, scenario);
  RowWriter writer(layout.width(), sinks, control.rows);
  return completed(is_free(rotation) ? run_free(scenario, layout, writer, control)
                                     : run_integrated(scenario, layout, writer, control),
                   writer);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
