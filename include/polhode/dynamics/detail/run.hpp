// SPDX-License-Identifier: MIT
// The loop: one run of any state by any method. Steps, and what they leave behind.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polhode/dynamics/detail/run_span.hpp"
#include "polhode/dynamics/detail/sample_queue.hpp"
#include "polhode/dynamics/detail/stepper.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What a checkpoint says of its problem, in front of the numbers: a name and bytes. Two problems
// that differ are recognised by the first that does.
using Features = std::vector<std::pair<std::string, std::string>>;

// Of a run, whatever moves. The bytes of its method, events and times.
std::string event_bytes(const std::string& name, Crossing crossing, bool stops, double period,
                        double interval);
std::string method_bytes(const Method& method);
std::string times_bytes(const SaveAt& times);
std::string number_bytes(double x);
template <MotionState S>
std::string state_bytes(S s) {
  Archive bytes;
  bytes(s);
  return bytes.bytes();
}

Checkpoint made_checkpoint(const Features& features, double t, const std::string& state);
// The numbers behind the features. DomainError where these are of another problem, saying which.
Archive opened_checkpoint(const Checkpoint& from, const Features& features);

// Why a run ends whose steps are too many for the memory that it may take.
std::string full_text(double most_bytes, double t);

// Judges by the mean of many steps in a row whether a run will end.
class EndJudge {
 public:
  explicit EndJudge(double t) : t_(t) {}
  // Empty, or why it will not: `steps` have been made up to t.
  std::string judged(double t, double stop, std::int64_t steps);
  void serialize(Archive& bytes) { bytes.all(t_, steps_); }

 private:
  double t_;  // where it was seen last
  std::int64_t steps_ = 0;
};

template <MotionState S, class Watch>
class Run {
 public:
  using Sample = BasicSample<S>;
  using Dense = BasicDenseStep<S>;
  using Parts = typename BasicTrajectory<S>::Parts;

  Run(RunSpan<S> span, Watch watch, std::unique_ptr<BasicStepper<S>> stepper, bool keep_dense,
      SampleQueue<S>& samples, const Progress& progress)
      : span_(std::move(span)),
        keep_dense_(keep_dense),
        samples_(samples),
        progress_(progress),
        inside_progress_(progress),
        watch_(std::move(watch)),
        stepper_(std::move(stepper)),
        judge_(span_.initial.t) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  // What it emits in addition to samples, and what a checkpoint of it says of its problem.
  void connect(const BasicStreams<S>& streams, Features features) {
    streams_ = &streams;
    if (streams.steps_to_last_sample) last_sample_ = samples_.last_due();
    features_ = std::move(features);
    if (!streams.checkpoint_due) return;
    inside_progress_ = [this](double t) {
      offer_checkpoint(t);
      if (progress_) progress_(t);
    };
  }

  // It fails where what it keeps in memory is more.
  void limit_memory(double most_bytes) { most_bytes_ = most_bytes; }

  // Goes on where a checkpoint was made.
  void restore(const Checkpoint& from) {
    Archive bytes = opened_checkpoint(from, features_);
    serialize(bytes);
    if (!bytes.is_done())
      throw DomainError(
          "resume: the checkpoint is of another problem: it holds more numbers than a run of this "
          "one");
    continued_ = true;
  }

  Parts result() {
    try {
      bool goes_on = begin();
      while (goes_on) goes_on = stepped(stepper_->advance(next_stop()));
    } catch (...) {
      samples_.flush();
      throw;
    }
    return finished();
  }

  // The same step by step. Whether there is a step to make:
  bool begin() {
    parts_.initial = span_.initial;
    parts_.method = span_.method;
    if (!continued_) {
      parts_.outcome.t = span_.initial.t;
      end_ = span_.initial;
      samples_.begin(parts_.initial);
      watch_.begin(span_.first_look, !span_.continues);
      if (refused()) return false;
    }
    const std::shared_ptr<const Dense> dense = inside_step_ ? stepper_->dense(false) : nullptr;
    if (inside_step_ && !samples_of_step(dense.get())) return false;
    if (!at_stop()) return true;
    if (samples_.is_unordered()) samples_of_step(stepper_->dense(false).get());  // no step is made
    return false;
  }
  // where to, at the farthest,
  double next_stop() {
    if (span_.ends_at_samples) return samples_.next(span_.stop);
    const double t = stepper_->time();
    if (last_sample_ && (span_.initial.t <= span_.stop ? t >= *last_sample_ : t <= *last_sample_))
      last_sample_.reset();
    return last_sample_.value_or(span_.stop);
  }
  // and after the stepper has made it, or has said why not, whether there is another.
  bool stepped(const std::string& advice) {
    if (!advice.empty()) {
      keep(watch_.finish().records);
      fail(advice);
      return false;
    }
    return looked_at() && !at_stop();
  }
  Parts finished() {
    samples_.flush();
    parts_.statistics = stepper_->statistics();
    parts_.statistics.evaluations += watch_.evaluations();
    if (streams_ != nullptr && streams_->end) streams_->end(end_);
    return std::move(parts_);
  }

 private:
  bool at_stop() {
    if (stepper_->time() != span_.stop) return false;
    end_events();
    return true;
  }

  // The step made last. Whether the run goes on.
  bool looked_at() {
    Sample end = end_of_step();
    std::shared_ptr<const Dense> dense;
    if (keep_dense_ || watch_.watches() || samples_.wants_dense(end.t))
      dense = stepper_->dense(keep_dense_);
    stopped_ = false;
    if (watch_.watches()) {
      const auto found = watch_.search(*stepper_->inside(), *dense, end, stepper_->intervals());
      keep(found.records);
      stopped_ = found.stops;
      if (!stopped_ && refused()) return ended_at_last_look(dense);
      if (stopped_) end = {found.records.back().t, found.records.back().s};
    }
    if (keep_dense_) parts_.dense.push_back(dense);
    bytes_ += static_cast<double>((keep_dense_ ? dense->bytes() + sizeof(dense) : 0) +
                                  (samples_.keeps_every_step() ? sizeof(Sample) : 0));
    end_ = end;
    return samples_of_step(dense.get());
  }

  // An event is not known beyond its last look: the run ends there.
  bool ended_at_last_look(const std::shared_ptr<const Dense>& step) {
    const double t = watch_.reached();
    if (t == step->t0()) return false;
    if (keep_dense_) parts_.dense.push_back(step);
    end_ = step->sample(t);
    samples_.step(step.get(), end_, {});
    parts_.outcome.t = t;
    return false;
  }

  // Where every sample is the end of a step, other steps need not say their state.
  Sample end_of_step() const {
    const double t = stepper_->time();
    if (span_.ends_at_samples && !samples_.is_due(t)) return {t, {}};
    return {t, stepper_->state()};
  }

  // Zeros at the stop itself.
  void end_events() {
    const auto found = watch_.finish();
    keep(found.records);
    if (found.stops) parts_.outcome.status = Outcome::Status::stopped_by_event;
  }

  // A step may hold many samples: a checkpoint may be made among them. Whether the run goes on.
  bool samples_of_step(const Dense* dense) {
    inside_step_ = true;
    samples_.step(dense, end_, inside_progress_);
    inside_step_ = false;
    if (stopped_) {
      samples_.last(end_);
      parts_.outcome.status = Outcome::Status::stopped_by_event;
    }
    parts_.outcome.t = end_.t;
    const bool goes_on = !stopped_ && !endless() && !is_full();
    if (goes_on && end_.t != span_.stop) offer_checkpoint(end_.t);
    if (progress_) progress_(end_.t);
    return goes_on;
  }

  void keep(const std::vector<BasicEventRecord<S>>& found) {
    if (streams_ != nullptr && streams_->events) {
      for (const auto& event : found) streams_->events(event);
    } else {
      parts_.events.insert(parts_.events.end(), found.begin(), found.end());
    }
  }

  void serialize(Archive& bytes) {
    bytes.all(parts_.outcome.t, parts_.events, inside_step_, stopped_, end_);
    judge_.serialize(bytes);
    stepper_->serialize(bytes);
    watch_.serialize(bytes);
    samples_.serialize(bytes);
  }

  void offer_checkpoint(double t) {
    if (streams_ == nullptr || !streams_->checkpoint_due || !streams_->checkpoint_due(t)) return;
    Archive state;
    serialize(state);
    if (streams_->checkpoint) streams_->checkpoint(made_checkpoint(features_, t, state.bytes()));
  }

  bool endless() {
    const std::string advice =
        judge_.judged(parts_.outcome.t, span_.stop, stepper_->statistics().steps);
    if (!advice.empty()) fail(advice);
    return !advice.empty();
  }

  bool is_full() {
    if (!(bytes_ > most_bytes_) || end_.t == span_.stop) return false;
    fail(full_text(most_bytes_, end_.t));
    return true;
  }

  bool refused() {
    if (watch_.refusal().empty()) return false;
    fail(watch_.refusal());
    return true;
  }

  void fail(const std::string& advice) {
    parts_.outcome.status = Outcome::Status::failed;
    parts_.outcome.advice = advice;
  }

  RunSpan<S> span_;
  bool keep_dense_;
  SampleQueue<S>& samples_;
  const Progress& progress_;
  Progress inside_progress_;  // of samples inside a step
  Watch watch_;
  std::unique_ptr<BasicStepper<S>> stepper_;
  Parts parts_{};
  const BasicStreams<S>* streams_ = nullptr;
  Features features_;
  bool continued_ = false;
  std::optional<double> last_sample_;  // at which a step is to end
  double bytes_ = 0.0, most_bytes_ = std::numeric_limits<double>::infinity();
  // The step made last, while its samples are pushed.
  bool inside_step_ = false;
  bool stopped_ = false;  // by an event, at
  Sample end_{};
  EndJudge judge_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
