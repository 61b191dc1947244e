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

#include "dynamics/events/event_search.hpp"
#include "polhode/dynamics/resume.hpp"
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
namespace {

using detail::completed;
using detail::RowWriter;
using detail::RunControl;

constexpr std::int64_t rows_per_block = 1024;

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
class FreeRun {
 public:
  FreeRun(const Scenario& scenario, const RowLayout& layout, RowWriter& writer,
          const RunControl& control)
      : rotation_(scenario.rotation()),
        layout_(layout),
        writer_(writer),
        control_(control),
        problem_(rotor_problem(rotation_)),
        system_(problem_.system),
        motion_(rotation_.frame.is_inertial()
                    ? free_rotation(rotation_)
                    : FreeRotation(rotation_.body, inertial_state(system_, 0.0, problem_.initial))),
        origin_{system_, initial_energy(problem_)},
        rows_(*rotation_.time) {
    report_.outcome.t = rows_.end();
    if (rotation_.events.empty()) return;
    search_.emplace(motion_, rotation_.frame, events_of(scenario, system_, origin_.initial_energy),
                    rows_[0]);
    if (control.motion != nullptr) search_->serialize(*control.motion);
  }

  RunReport report() {
    while (writer_.rows() < rows_.size() && goes_on()) {
      const std::int64_t first = writer_.rows();
      const std::int64_t last = std::min(rows_.size(), first + rows_per_block);
      if (!events_until(rows_[last - 1])) break;
      write(first, last);
      if (last < rows_.size()) offer_state(rows_[last - 1]);
      if (control_.progress) control_.progress(rows_[last - 1]);
    }
    if (goes_on() && events_until(rows_.end()) && search_) keep(search_->finish());
    return std::move(report_);
  }

 private:
  bool goes_on() const { return report_.outcome.status == Outcome::Status::completed; }

  void write(std::int64_t first, std::int64_t last) {
    std::vector<double> times;
    for (std::int64_t k = first; k < last; ++k) times.push_back(rows_[k]);
    write(times);
  }
  void write(std::span<const double> times) {
    if (rotation_.frame.is_inertial())
      return writer_.push(times.size(), [&](std::span<double> numbers) {
        layout_.write_rows(motion_, times, numbers);
      });
    std::vector<Sample> samples;
    for (const double t : times) samples.push_back({t, reference_state(system_, t, motion_.at(t))});
    writer_.push(samples.size(),
                 [&](std::span<double> numbers) { layout_.write_rows(origin_, samples, numbers); });
  }

  // Events up to there; whether the run goes on.
  bool events_until(double t) {
    if (!search_) return true;
    for (;;) {
      if (!search_->refusal().empty()) {
        report_.outcome = {Outcome::Status::failed, search_->t(), search_->refusal()};
        write(times_until(search_->t()));
        return false;
      }
      if (search_->t() == t) return true;
      keep(search_->advance(t));
      if (!goes_on()) {
        write_to_the_end();
        return false;
      }
      if (search_->t() == t || !search_->refusal().empty()) continue;
      offer_state(search_->t());
      if (control_.progress) control_.progress(search_->t());
    }
  }

  void keep(const detail::SystemWatch::Found& found) {
    for (const EventRecord& record : found.records) {
      RunEvent event = run_event(record);
      if (control_.event) {
        control_.event(event);
      } else {
        report_.events.push_back(std::move(event));
      }
    }
    if (found.stops)
      report_.outcome = {Outcome::Status::stopped_by_event, found.records.back().t, {}};
  }

  RunEvent run_event(const EventRecord& record) const {
    std::vector<double> row(control_.events_have_rows ? layout_.width() : 0);
    const Sample there{record.t, record.s};
    if (!row.empty() && rotation_.frame.is_inertial()) {
      layout_.write_rows(motion_, {&there.t, 1}, row);
    } else if (!row.empty()) {
      layout_.write_rows(origin_, {&there, 1}, row);
    }
    return event_of(record, std::move(row));
  }

  // Of rows not yet written.
  std::vector<double> times_until(double end) const {
    const bool forward = rows_[0] <= rows_.end();
    std::vector<double> times;
    for (std::int64_t k = writer_.rows(); k < rows_.size(); ++k) {
      const double t = rows_[k];
      if (forward ? t > end : t < end) break;
      times.push_back(t);
    }
    return times;
  }

  // Rows before the event that has stopped the run, and one more there.
  void write_to_the_end() {
    const double end = report_.outcome.t;
    std::vector<double> times = times_until(end);
    const double latest =
        !times.empty() ? times.back() : rows_[std::max<std::int64_t>(writer_.rows() - 1, 0)];
    if (latest != end || (times.empty() && writer_.rows() == 0)) times.push_back(end);
    write(times);
  }

  void offer_state(double t) {
    if (!control_.due || !control_.due(t)) return;
    control_.keep({t, writer_.rows()}, [this](Archive& bytes) {
      if (search_) search_->serialize(bytes);
    });
  }

  const Rotation& rotation_;
  const RowLayout& layout_;
  RowWriter& writer_;
  const RunControl& control_;
  Problem problem_;
  const System& system_;
  FreeRotation motion_;
  RowOrigin origin_;
  const SaveAt& rows_;
  std::optional<detail::FreeEventSearch> search_;
  RunReport report_;
};

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
        detail::number_text(q.w) + ", " + detail::number_text(q.x) + ", " +
        detail::number_text(q.y) + ", " + detail::number_text(q.z) + "]");
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
  return completed(is_free(rotation) ? FreeRun(scenario, layout, writer, control).report()
                                     : run_integrated(scenario, layout, writer, control),
                   writer);
}

}  // namespace v0
}  // namespace polhode
