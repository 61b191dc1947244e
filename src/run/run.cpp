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

#include "dynamics/events/free_event_search.hpp"
#include "polhode/dynamics/resume.hpp"
#include "polhode/error.hpp"
#include "run/detail/experiment_parts.hpp"
#include "run/detail/run_state.hpp"
#include "scenario/scenario_parts.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::RunControl;
using detail::RunState;

constexpr std::int64_t rows_per_block = 1024;

bool is_free(const Rotation& rotation) { return !propagation_method(rotation).has_value(); }
// Free and in inertial axes: the elements of the motion are constant.
bool has_constants(const Rotation& rotation) {
  return is_free(rotation) && rotation.frame.is_inertial();
}

// What the numbers of a group do not say themselves: it is constant along the motion.
std::vector<std::string> branch_notes(const Rotation& rotation, const OutputPlan& output) {
  std::vector<std::string> notes;
  if (!has_constants(rotation)) return notes;
  const FreeRotation motion = free_rotation(rotation);
  for (const std::string& group : output.columns)
    if (std::string note = branch_note(group, motion); !note.empty())
      notes.push_back(std::move(note));
  return notes;
}

// Rows, as they come, to every sink.
class RowWriter {
 public:
  RowWriter(const RowLayout& layout, std::span<const std::unique_ptr<Sink>> sinks,
            std::int64_t rows)
      : layout_(layout), sinks_(sinks), rows_(rows) {}

  void push(const FreeRotation& motion, std::span<const double> times) {
    numbers_.resize(times.size() * layout_.width());
    layout_.write_rows(motion, times, numbers_);
    send(times.size());
  }
  void push(const RowOrigin& origin, std::span<const DampedSample> samples) {
    numbers_.resize(samples.size() * layout_.width());
    layout_.write_rows(origin, samples, numbers_);
    send(samples.size());
  }
  void finish() {
    for (const std::unique_ptr<Sink>& sink : sinks_) sink->finish();
  }
  std::int64_t rows() const { return rows_; }

 private:
  void send(std::size_t rows) {
    for (const std::unique_ptr<Sink>& sink : sinks_) sink->push(numbers_);
    rows_ += static_cast<std::int64_t>(rows);
  }

  const RowLayout& layout_;
  std::span<const std::unique_ptr<Sink>> sinks_;
  std::vector<double> numbers_;
  std::int64_t rows_;
};

// Angles are compared modulo a turn: the jump of a column at +-pi is no crossing.
template <MotionState S>
std::vector<BasicEvent<S>> events_of(const Rotation& rotation, const System& system,
                                     double energy_0) {
  std::vector<BasicEvent<S>> events;
  for (const ScenarioEvent& wanted : rotation.events) {
    const ScalarColumn column = scalar_column(wanted.column, system, energy_0);
    const double turn = column.dimension == Dimension::angle ? 2.0 * std::numbers::pi : 0.0;
    events.push_back(
        {wanted.name,
         [value = column.value, target = wanted.value, turn](const BasicSample<S>& at) {
           const double x = value({at.t, damped(at.s)}) - target;
           return turn > 0.0 ? std::remainder(x, turn) : x;
         },
         wanted.crossing, wanted.stops, turn, wanted.interval});
  }
  return events;
}

// The closed form, in inertial axes; a moving frame is applied to each state afterwards.
class FreeRun {
 public:
  FreeRun(const Rotation& rotation, RowWriter& writer, const RunControl& control)
      : rotation_(rotation),
        writer_(writer),
        control_(control),
        problem_(rotor_problem(rotation)),
        system_(problem_.system),
        motion_(rotation.frame.is_inertial()
                    ? free_rotation(rotation)
                    : FreeRotation(rotation.body,
                                   inertial_state(system_, 0.0, problem_.initial.rotor))),
        origin_{system_, detail::initial_energy(problem_)},
        rows_(*rotation.time) {
    report_.outcome.t = rows_[rows_.size() - 1];
    if (rotation.events.empty()) return;
    search_.emplace(motion_, rotation.frame,
                    events_of<RotorState>(rotation, system_, origin_.initial_energy), rows_[0]);
    if (control.from == nullptr) return;
    StateBytes bytes(control.from->integration);
    search_->transfer(bytes);
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
    if (search_ && goes_on()) keep(search_->finish());
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
    if (rotation_.frame.is_inertial()) return writer_.push(motion_, times);
    std::vector<DampedSample> samples;
    for (const double t : times)
      samples.push_back({t, damped(reference_state(system_, t, motion_.at(t)))});
    writer_.push(origin_, samples);
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

  void keep(const detail::RotorWatch::Found& found) {
    for (const EventRecord& record : found.records) {
      const DampedEventRecord event{record.name, record.t, damped(record.s), record.direction};
      if (control_.event) {
        control_.event(event);
      } else {
        report_.events.push_back(event);
      }
    }
    if (found.stops)
      report_.outcome = {Outcome::Status::stopped_by_event, found.records.back().t, {}};
  }

  // Of rows not yet written.
  std::vector<double> times_until(double end) const {
    const bool forward = rows_[0] <= rows_[rows_.size() - 1];
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
    RunState state;
    state.stage = RunState::free;
    state.t = t;
    state.pushed = writer_.rows();
    if (search_) {
      StateBytes bytes;
      search_->transfer(bytes);
      state.integration = bytes.bytes();
    }
    control_.keep(state);
  }

  const Rotation& rotation_;
  RowWriter& writer_;
  const RunControl& control_;
  DampedProblem problem_;
  const System& system_;
  FreeRotation motion_;
  RowOrigin origin_;
  const SaveAt& rows_;
  std::optional<detail::FreeEventSearch> search_;
  RunReport report_;
};

void add(Statistics& sum, const Statistics& more) {
  sum.steps += more.steps;
  sum.rejected += more.rejected;
  sum.evaluations += more.evaluations;
}

// What integrate gives out of a stage of the run; `state` becomes that of each checkpoint.
DampedStreams streams_of(const RunControl& control, RunState& state, const RowWriter& writer,
                         DampedSampleSink samples) {
  DampedStreams streams{std::move(samples), control.event, control.due, {}};
  streams.checkpoint = [&](const Checkpoint& now) {
    state.t = now.t();
    state.pushed = writer.rows();
    state.integration = now.bytes();
    control.keep(state);
  };
  return streams;
}

DampedTrajectory integrated(const DampedProblem& problem, const SaveAt& times, const RunState* from,
                            const DampedStreams& streams, const Progress& progress) {
  return from == nullptr ? integrate(problem, times, streams, progress)
                         : resume(problem, times, Checkpoint(from->integration), streams, progress);
}

// The state at the first row, from that at t = 0.
DampedSample at_first_row(const DampedProblem& from_zero, RunReport& report,
                          const RowWriter& writer, const RunControl& control) {
  DampedSample there{from_zero.stop, from_zero.initial};
  if (from_zero.start == from_zero.stop) return there;
  RunState state;
  const DampedStreams streams =
      streams_of(control, state, writer,
                 [&](std::span<const DampedSample> samples) { there = samples.back(); });
  const DampedTrajectory lead_in = integrated(from_zero, SaveAt::times({from_zero.stop}),
                                              control.from, streams, control.progress);
  report.outcome = lead_in.outcome();
  add(report.statistics, lead_in.statistics());
  return there;
}

RunReport run_integrated(const Rotation& rotation, RowWriter& writer, const RunControl& control) {
  RunReport report;
  const DampedProblem from_zero = rotor_problem(rotation);
  const System& system = from_zero.system;
  const double energy_0 = detail::initial_energy(from_zero);
  const SaveAt& rows = *rotation.time;
  const double first = rows[0];
  const bool among_rows = control.from != nullptr && control.from->stage == RunState::rows;
  RunState state;
  if (among_rows) {
    state = *control.from;
    report.statistics = state.before;
  } else {
    DampedProblem lead_in = from_zero;
    lead_in.stop = first;
    const DampedSample start = at_first_row(lead_in, report, writer, control);
    if (!report.outcome.ok()) return report;
    state.first = state.latest = {first, start.s};
  }
  state.stage = RunState::rows;
  state.before = report.statistics;

  const RowOrigin origin{system, energy_0};
  const DampedStreams streams =
      streams_of(control, state, writer, [&](std::span<const DampedSample> samples) {
        writer.push(origin, samples);
        state.latest = samples.back();
      });
  DampedProblem among_these = from_zero;
  among_these.start = first;
  among_these.initial = state.first.s;
  among_these.events = events_of<DampedRotorState>(rotation, system, energy_0);
  const DampedTrajectory trajectory =
      integrated(among_these, rows, among_rows ? control.from : nullptr, streams, control.progress);
  report.outcome = trajectory.outcome();
  report.events = trajectory.events();
  add(report.statistics, trajectory.statistics());
  if (system.has_energy()) {
    const auto& [t, end] = state.latest;
    report.energy_change = energy(at_damper_rate(system, end.damper_rate), t, end.rotor) - energy_0;
  }
  return report;
}

// Which angular velocity the written columns are.
std::vector<std::string> rate_notes(const Scenario& scenario) {
  constexpr std::pair<std::string_view, std::string_view> rates[] = {
      {"omega", "w1, w2, w3: angular velocity relative to inertial axes, body components"},
      {"omega_inertial",
       "W1, W2, W3: angular velocity relative to inertial axes, inertial components"},
      {"omega_rel",
       "w1_rel, w2_rel, w3_rel: angular velocity relative to the reference frame, body "
       "components"}};
  std::vector<std::string> notes;
  for (const auto& [group, note] : rates)
    if (std::ranges::find(scenario.output.columns, group) != scenario.output.columns.end())
      notes.emplace_back(note);
  return notes;
}

}  // namespace

RunFacts detail::run_facts(const Rotation& rotation, const Scenario& scenario) {
  RunFacts result{
      .name = scenario.document.title.empty() ? scenario.document.name : scenario.document.title,
      .epoch = rotation.epoch,
      .axes = rotation.axes,
      .moving_frame = !rotation.frame.is_inertial(),
      .seconds = Units("s").to_core(1.0, scenario.units().time(), Dimension::time)};
  if (!rotation.time) return result;
  const SaveAt& rows = *rotation.time;
  const auto time = [&](std::int64_t k) {
    return scenario.units().from_core(rows[k], Dimension::time);
  };
  result.first = time(0);
  result.last = time(rows.size() - 1);
  result.rising = rows.is_list() || rows.size() < 2 || rows[0] < rows[1];
  for (std::int64_t k = 1; rows.is_list() && result.rising && k < rows.size(); ++k)
    result.rising = rows[k - 1] < rows[k];
  return result;
}

RowLayout detail::row_layout(const Rotation& rotation, const Scenario& scenario) {
  return RowLayout(scenario.output.columns, scenario.units(),
                   has_constants(rotation) ? Branch::in_notes : Branch::in_columns);
}

std::optional<FreeRotation> detail::constant_motion(const Rotation& rotation) {
  return has_constants(rotation) ? std::optional(free_rotation(rotation)) : std::nullopt;
}

std::string detail::propagation_text(const Rotation& rotation, const Units& units) {
  const std::optional<Method> method = propagation_method(rotation);
  if (!method)
    return rotation.frame.is_inertial() ? "exact free rotation"
                                        : "exact free rotation, seen from the moving frame";
  const bool has_step = std::holds_alternative<Splitting>(*method);  // the last word
  return method_text(*method) + (has_step ? " " + units.time() : "") +
         (rotation.method ? "" : " (chosen: the file names no method)");
}

std::vector<std::string> detail::notes_of(const Rotation& rotation, const Scenario& scenario) {
  std::vector<std::string> notes;
  const std::string since = rotation.epoch.empty() ? "the epoch" : rotation.epoch;
  notes.push_back("t counts from " + since + "; axes: " + rotation.axes);
  if (!rotation.frame.is_inertial())
    notes.push_back("attitudes and elements refer to the moving frame: " + rotation.frame_text +
                    "; q_inertial and axes to inertial axes");
  for (std::string& note : rate_notes(scenario)) notes.push_back(std::move(note));
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
  for (const ScenarioFile& file : scenario.document.files)
    notes.push_back("file " + file_note(file));
  notes.push_back("method: " + propagation_text(rotation, scenario.units()));
  for (std::string& note : branch_notes(rotation, scenario.output))
    notes.push_back(std::move(note));
  return notes;
}

RunReport detail::rows_of(const Rotation& rotation, const RowLayout& layout,
                          std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control) {
  RowWriter writer(layout, sinks, control.from == nullptr ? 0 : control.from->pushed);
  RunReport report;
  if (is_free(rotation)) {
    report = FreeRun(rotation, writer, control).report();
  } else {
    report = run_integrated(rotation, writer, control);
  }
  report.rows = writer.rows();
  report.events_met = static_cast<std::int64_t>(report.events.size());
  if (report.outcome.ok()) writer.finish();
  return report;
}

}  // namespace v0
}  // namespace polhode
