// SPDX-License-Identifier: MIT
#include "polhode/dynamics/integrate.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "dynamics/detail/checked_problem.hpp"
#include "dynamics/detail/event_watch.hpp"
#include "dynamics/detail/sample_queue.hpp"
#include "dynamics/detail/stepper.hpp"
#include "math/detail/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;

// A run that has settled at steps so short that this many would be needed does not end: 1e12 steps
// of a microsecond are twelve days.
constexpr double most_steps = 1e12;
constexpr std::int64_t settled = 1000;  // steps: the first ones may be short

Problem checked(const Problem& problem) {
  Problem result = detail::checked_problem("integrate", problem);
  for (const Event& event : result.events)
    if (!event.function)
      throw DomainError("integrate: event \"" + event.name + "\" must have a function");
  return result;
}

// One run: steps, and what they leave behind.
class Run {
 public:
  Run(const Problem& problem, bool keep_dense, detail::SampleQueue& samples,
      const Progress& progress)
      : problem_(checked(problem)),
        keep_dense_(keep_dense),
        samples_(samples),
        progress_(progress),
        watch_(problem_.events),
        stepper_(std::visit([&](const auto& m) { return detail::make_stepper(problem_, m); },
                            problem_.method)) {}

  Trajectory::Parts result() {
    parts_.initial = {problem_.start, problem_.initial};
    parts_.method = method_text(problem_.method);
    parts_.outcome.t = problem_.start;
    try {
      samples_.begin(parts_.initial);
      watch_.begin(problem_.start, problem_.initial);
      if (refused(problem_.start)) return finished();
      while (stepper_->time() != problem_.stop && step()) {
      }
    } catch (...) {
      samples_.flush();
      throw;
    }
    return finished();
  }

 private:
  // Whether the run goes on.
  bool step() {
    const std::string advice = stepper_->advance(problem_.stop);
    if (!advice.empty()) {
      fail(advice);
      return false;
    }
    Sample end{stepper_->time(), stepper_->state()};
    const bool crossed = watch_.crossed(end.t, end.s);
    if (refused(parts_.outcome.t)) return false;
    std::shared_ptr<const DenseStep> dense;
    if (keep_dense_ || crossed || samples_.wants_dense(end.t)) dense = stepper_->dense(keep_dense_);
    if (keep_dense_) parts_.dense.push_back(dense);
    bool stopped = false;
    if (crossed) {
      const detail::EventWatch::Found found = watch_.found(*dense, end.s);
      parts_.events.insert(parts_.events.end(), found.records.begin(), found.records.end());
      stopped = found.stops;
      if (stopped) end = {found.records.back().t, found.records.back().s};
    }
    samples_.step(dense.get(), end, progress_);
    if (stopped) {
      samples_.last(end);
      parts_.outcome.status = Outcome::Status::stopped_by_event;
    }
    const double made = std::abs(end.t - parts_.outcome.t);
    parts_.outcome.t = end.t;
    if (progress_) progress_(end.t);
    return !stopped && !endless(made);
  }

  bool endless(double made) {
    const double left = std::abs(problem_.stop - parts_.outcome.t);
    if (stepper_->statistics().steps < settled || !(left > most_steps * made)) return false;
    fail("at t = " + number_text(parts_.outcome.t) + " a step is " + number_text(made) +
         ", so that the end would take " +
         number_text(std::pow(10.0, std::floor(std::log10(left / made)))) +
         " of them and more: is the rotation, an orbit or a torque that fast? Try a shorter run");
    return true;
  }

  bool refused(double t) {
    if (watch_.nan_event().empty()) return false;
    fail("event \"" + watch_.nan_event() + "\" is NaN after t = " + number_text(t) +
         ": mend its function, or leave it out");
    return true;
  }

  void fail(const std::string& advice) {
    parts_.outcome.status = Outcome::Status::failed;
    parts_.outcome.advice = advice;
  }

  Trajectory::Parts finished() {
    samples_.flush();
    parts_.statistics = stepper_->statistics();
    return std::move(parts_);
  }

  Problem problem_;
  bool keep_dense_;
  detail::SampleQueue& samples_;
  const Progress& progress_;
  detail::EventWatch watch_;
  std::unique_ptr<detail::Stepper> stepper_;
  Trajectory::Parts parts_{};
};

}  // namespace

Trajectory integrate(const Problem& problem, const Keep& keep, const Progress& progress) {
  std::vector<Sample> kept;
  const SampleSink into_memory = [&kept](std::span<const Sample> block) {
    kept.insert(kept.end(), block.begin(), block.end());
  };
  detail::SampleQueue samples(problem.start, problem.stop, keep.samples, into_memory);
  Trajectory::Parts parts = Run(problem, keep.dense, samples, progress).result();
  parts.samples = std::move(kept);
  return Trajectory(std::move(parts));
}

Trajectory integrate(const Problem& problem, const SaveAt& times, const SampleSink& sink,
                     const Progress& progress) {
  detail::SampleQueue samples(problem.start, problem.stop, times, sink);
  return Trajectory(Run(problem, false, samples, progress).result());
}

}  // namespace v0
}  // namespace polhode
