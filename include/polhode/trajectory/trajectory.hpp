// SPDX-License-Identifier: MIT
// Trajectory: what a run of any state leaves in memory. Samples at the times asked for, the events
// met, how the run ended, what it cost, and the state at any time between.
//
// Equations   none: between its samples a trajectory is the dense output of the method.
// Units       those of the run.
// Domain      at(t) for t from start() to stop(), where the run really ended. Empty runs have the
//             initial state alone.
// Accuracy    that of the method; at(t) has the order of the method.
// Errors      at(t) throws DomainError outside the span, or when the run kept no dense output.
// Cost        a sample of a system is 88 bytes; dense output keeps some hundred bytes per step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "polhode/trajectory/sample.hpp"

namespace polhode {
inline namespace v0 {

// How a run ended. Only `completed` reached the end asked for.
struct Outcome {
  enum class Status { completed, stopped_by_event, failed };
  Status status = Status::completed;
  double t = 0.0;      // where it ended
  std::string advice;  // one sentence when it failed: what happened, and what to try

  bool ok() const { return status != Status::failed; }
};

struct Statistics {
  std::int64_t steps = 0;        // accepted
  std::int64_t rejected = 0;     // tried and repeated with a smaller step
  std::int64_t evaluations = 0;  // of the perturbation terms, all together once; for events too
};

// DomainError unless t is between start and stop, either of which may be the larger.
void require_inside(double t, double start, double stop);
// DomainError: there is no dense output.
[[noreturn]] void no_dense_output();

template <MotionState S>
class BasicTrajectory {
 public:
  using State = S;

  struct Parts {
    BasicSample<S> initial;
    std::vector<BasicSample<S>> samples;
    std::vector<BasicEventRecord<S>> events;
    Outcome outcome;
    Statistics statistics;
    std::string method;                                           // in words: provenance
    std::vector<std::shared_ptr<const BasicDenseStep<S>>> dense;  // in order; empty: none kept
  };
  explicit BasicTrajectory(Parts parts) : parts_(std::move(parts)) {}

  const std::vector<BasicSample<S>>& samples() const& { return parts_.samples; }
  std::vector<BasicSample<S>> samples() && { return std::move(parts_.samples); }
  const std::vector<BasicEventRecord<S>>& events() const { return parts_.events; }
  const Outcome& outcome() const { return parts_.outcome; }
  const Statistics& statistics() const { return parts_.statistics; }
  const std::string& method() const { return parts_.method; }
  double start() const { return parts_.initial.t; }
  double stop() const { return parts_.outcome.t; }
  // Whether at(t) has an answer between the samples.
  bool has_dense() const { return !parts_.dense.empty(); }

  S at(double t) const { return sample(t).s; }
  BasicSample<S> sample(double t) const {
    require_inside(t, start(), stop());
    if (t == start()) return parts_.initial;
    if (parts_.dense.empty()) no_dense_output();
    const bool forward = start() <= stop();
    // the first step that ends at t or beyond it
    const auto step = std::partition_point(
        parts_.dense.begin(), parts_.dense.end(),
        [&](const auto& piece) { return forward ? piece->t1() < t : piece->t1() > t; });
    return (step == parts_.dense.end() ? parts_.dense.back() : *step)->sample(t);
  }

  // All that it holds, to make another of.
  Parts parts() && { return std::move(parts_); }

 private:
  Parts parts_;
};
using Trajectory = BasicTrajectory<SystemState>;

extern template class BasicTrajectory<SystemState>;

}  // namespace v0
}  // namespace polhode
