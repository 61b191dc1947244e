// SPDX-License-Identifier: MIT
// The run of whatever integrate() moves, a rotor or a model of any state: from t = 0 to the first
// row, then along the rows into the sinks and on to `stop`; watched, kept and continued.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/run/detail/row_writer.hpp"
#include "polhode/run/detail/run_state.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// What an experiment says of its motion.
template <class M>
struct RowsOfMotion {
  using State = typename M::State;

  BasicProblem<M> from_zero;  // its events are looked for from the first row on
  const SaveAt& rows;
  // Numbers of the columns for each sample, one row after the other.
  std::function<void(std::span<const BasicSample<State>>, std::span<double>)> write;
};

template <MotionState S>
struct IntegratedEnd {
  RunReport report;
  std::optional<BasicSample<S>> latest;  // where it ended; none where it did not get to the rows
};

template <class M>
class IntegratedRun {
 public:
  using S = typename M::State;

  IntegratedRun(const RowsOfMotion<M>& motion, RowWriter& writer, const RunControl& control)
      : motion_(motion), writer_(writer), control_(control) {
    if (control.motion == nullptr) return;
    std::string integration;
    serialize(*control.motion, integration);
    from_.emplace(std::move(integration));
  }

  IntegratedEnd<S> run() {
    if (!among_rows_) {
      go_to_first_row();
      if (!report_.outcome.ok()) return {std::move(report_), std::nullopt};
    }
    go_along_rows();
    return {std::move(report_), latest_};
  }

 private:
  // `integration`: the bytes of a Checkpoint.
  void serialize(Archive& bytes, std::string& integration) {
    bytes.all(among_rows_, before_, first_);
    bytes.rest(integration);
  }

  void go_to_first_row() {
    BasicProblem<M> lead_in = motion_.from_zero;
    lead_in.events = {};
    lead_in.stop = motion_.rows[0];
    BasicSample<S> there{lead_in.stop, lead_in.initial};
    if (lead_in.start != lead_in.stop)
      integrate_on(lead_in, SaveAt::times({lead_in.stop}),
                   [&](std::span<const BasicSample<S>> samples) { there = samples.back(); });
    first_ = {lead_in.stop, there.s};
    before_ = report_.statistics;
    among_rows_ = true;
    from_.reset();
  }

  void go_along_rows() {
    report_.statistics = before_;
    BasicProblem<M> along = motion_.from_zero;
    along.start = motion_.rows[0];
    along.stop = motion_.rows.end();
    along.initial = first_.s;
    const BasicTrajectory<S> trajectory =
        integrate_on(along, motion_.rows, [&](std::span<const BasicSample<S>> samples) {
          writer_.push(samples.size(),
                       [&](std::span<double> numbers) { motion_.write(samples, numbers); });
        });
    for (const BasicEventRecord<S>& event : trajectory.events())
      report_.events.push_back(run_event(event));
  }

  BasicTrajectory<S> integrate_on(const BasicProblem<M>& problem, const SaveAt& times,
                                  BasicSampleSink<S> samples) {
    BasicStreams<S> streams{std::move(samples), {}, control_.due};
    streams.steps_to_last_sample = true;  // rows do not depend on what comes behind them
    streams.end = [this](const BasicSample<S>& at) { latest_ = at; };
    if (control_.event)
      streams.events = [this](const BasicEventRecord<S>& event) {
        control_.event(run_event(event));
      };
    streams.checkpoint = [this](const Checkpoint& now) {
      control_.keep({now.t(), writer_.rows()}, [&](Archive& bytes) {
        std::string integration = now.bytes();
        serialize(bytes, integration);
      });
    };
    BasicTrajectory<S> trajectory = from_
                                        ? resume(problem, times, *from_, streams, control_.progress)
                                        : integrate(problem, times, streams, control_.progress);
    report_.outcome = trajectory.outcome();
    report_.statistics.steps += trajectory.statistics().steps;
    report_.statistics.rejected += trajectory.statistics().rejected;
    report_.statistics.evaluations += trajectory.statistics().evaluations;
    return trajectory;
  }

  RunEvent run_event(const BasicEventRecord<S>& event) const {
    std::vector<double> row(control_.events_have_rows ? writer_.width() : 0);
    const BasicSample<S> there{event.t, event.s};
    if (!row.empty()) motion_.write({&there, 1}, row);
    return event_of(event, std::move(row));
  }

  const RowsOfMotion<M>& motion_;
  RowWriter& writer_;
  const RunControl& control_;
  bool among_rows_ = false;  // or on the way to the first
  Statistics before_{};      // of the way to the first row
  BasicSample<S> first_{};   // where the rows start
  std::optional<Checkpoint> from_;
  std::optional<BasicSample<S>> latest_;
  RunReport report_;
};

template <class M>
IntegratedEnd<typename M::State> integrated_run(const RowsOfMotion<M>& motion, RowWriter& writer,
                                                const RunControl& control) {
  return IntegratedRun<M>(motion, writer, control).run();
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
