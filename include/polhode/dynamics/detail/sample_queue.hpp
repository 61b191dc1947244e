// SPDX-License-Identifier: MIT
// The samples of a run: which times are due in a step, gathered into blocks for a sink.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The times that are due, one after the other.
class DueTimes {
 public:
  // DomainError for times that do not run from start towards stop, unless any order is allowed:
  // then all of them are within the one step of the run.
  DueTimes(double start, double stop, std::optional<SaveAt> times, bool allows_any_order);

  bool is_given() const { return times_.has_value(); }
  bool is_done() const { return !times_ || next_ == times_->size(); }
  // Unless it is done.
  double due() const { return due_; }
  // Whether the next one is within a step that ends at t.
  bool is_due(double t) const {
    return !is_done() && (is_unordered_ || !is_before(reach(t), due()));
  }
  bool is_unordered() const { return is_unordered_; }
  // Whether one may be due elsewhere than at t, the end of the step.
  bool wants_dense(double t) const { return !is_done() && (t == stop_ || is_before(due(), t)); }
  // The last one that a run to `stop` passes, if any is left.
  std::optional<double> last() const;
  void pass() {
    ++next_;
    find_due();
  }
  bool is_before(double a, double b) const { return forward_ ? a < b : a > b; }
  void serialize(Archive& bytes) {
    bytes(next_);
    find_due();
  }

 private:
  void find_due() {
    if (!is_done()) due_ = (*times_)[next_];
  }
  // Up to where samples are due in a step that ends at t.
  double reach(double t) const { return t == stop_ ? reach_of_stop_ : t; }

  bool forward_;
  double stop_;
  double reach_of_stop_;  // beyond it: SaveAt keeps a row that rounding puts there
  std::optional<SaveAt> times_;
  std::int64_t next_ = 0;
  bool is_unordered_ = false;
  double due_ = 0.0;  // the time of sample next_, since SaveAt computes it at every call
};

template <MotionState S>
class SampleQueue {
 public:
  // Without times: the start, and the end of every step.
  SampleQueue(double start, double stop, std::optional<SaveAt> times,
              const BasicSampleSink<S>& sink, bool allows_any_order = false)
      : times_(start, stop, std::move(times), allows_any_order), sink_(sink) {
    block_.reserve(samples_per_block);
  }

  // A sample at the start, if one is due.
  void begin(const BasicSample<S>& initial) {
    if (!times_.is_given()) return push(initial);
    for (; !times_.is_done() && times_.due() == initial.t; times_.pass()) push(initial);
  }
  bool wants_dense(double t) const { return times_.wants_dense(t); }
  bool is_unordered() const { return times_.is_unordered(); }
  bool keeps_every_step() const { return !times_.is_given(); }
  // Whether the end of a step, at t, is a sample or has some behind it.
  bool is_due(double t) const { return !times_.is_given() || times_.is_due(t); }
  // The sample that is due next, `stop` where there is none.
  double next(double stop) const { return times_.is_done() ? stop : times_.due(); }
  // The last one, if any is left before `stop`.
  std::optional<double> last_due() const { return times_.last(); }
  // Pushes the samples due up to `end`; those before it come from the dense step.
  void step(const BasicDenseStep<S>* dense, const BasicSample<S>& end, const Progress& progress) {
    if (!times_.is_given()) return push(end);
    while (times_.is_due(end.t)) {
      if (times_.due() == end.t) {
        push(end);
        times_.pass();
        continue;
      }
      const std::size_t room =
          std::min(dense->samples_at_once(), samples_per_block - block_.size());
      due_.clear();
      for (; due_.size() < room && times_.is_due(end.t) && times_.due() != end.t; times_.pass())
        due_.push_back(times_.due());
      found_.resize(due_.size());
      dense->samples(due_, found_);
      for (const BasicSample<S>& sample : found_) push(sample);
      if (progress && times_.is_before(due_.back(), end.t)) progress(due_.back());
    }
  }
  // One more sample where an event has stopped the run, unless it is there.
  void last(const BasicSample<S>& end) {
    if (!latest_ || times_.is_before(*latest_, end.t)) push(end);
  }
  void flush() {
    if (block_.empty()) return;
    // emptied first: a sink that throws must not get the same samples again
    const std::vector<BasicSample<S>> full = std::exchange(block_, {});
    block_.reserve(samples_per_block);
    sink_(full);
  }
  // Which sample is next, and those that wait for their block to fill.
  void serialize(Archive& bytes) {
    times_.serialize(bytes);
    bytes.all(latest_, block_);
  }

 private:
  static constexpr std::size_t samples_per_block = 1024;

  void push(const BasicSample<S>& sample) {
    latest_ = sample.t;
    block_.push_back(sample);
    if (block_.size() == samples_per_block) flush();
  }

  DueTimes times_;
  const BasicSampleSink<S>& sink_;
  std::vector<BasicSample<S>> block_;
  std::optional<double> latest_;
  // Buffers of step(), members so that their memory is reused.
  std::vector<double> due_;
  std::vector<BasicSample<S>> found_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
