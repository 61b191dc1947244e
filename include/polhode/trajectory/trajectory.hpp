// SPDX-License-Identifier: MIT
// In this header: sample, trajectory, progress.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/system/system.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

// Samples of a run, the steps between them and the events met, for any state.
//
// Units       those of the run.
// Domain      a MotionState is a value that visits its own numbers: each_number(s, visit) calls
//             visit(double&) for every one of them, always in the same order, and is found where
//             the type is. A checkpoint keeps these numbers, so that they must be all of the state.
// Cost        a sample of a system is 88 bytes.

template <class S>
concept MotionState = std::semiregular<S> && std::equality_comparable<S> &&
                      requires(S& s, void (*visit)(double&)) { each_number(s, visit); };

template <MotionState S>
struct BasicSample {
  double t;
  S s;  // of a system: q normalised

  constexpr bool operator==(const BasicSample&) const = default;
};
using Sample = BasicSample<SystemState>;

// Where a run puts its samples, block by block, in order of time.
template <MotionState S>
using BasicSampleSink = std::function<void(std::span<const BasicSample<S>>)>;
using SampleSink = BasicSampleSink<SystemState>;

// A crossing that an event function met.
template <MotionState S>
struct BasicEventRecord {
  std::string name;
  double t;
  S s;
  int direction;  // +1: rising through zero, -1: falling, 0: touching it

  bool operator==(const BasicEventRecord&) const = default;
};
using EventRecord = BasicEventRecord<SystemState>;

// The state inside one step, t0 to t1 (t1 < t0 backwards): as accurate as the method is.
template <MotionState S>
class BasicDenseStep {
 public:
  BasicDenseStep(double t0, double t1) : t0_(t0), t1_(t1) {}
  virtual ~BasicDenseStep() = default;
  virtual S at(double t) const = 0;
  // The number of times at which one call of samples() is cheapest per sample.
  virtual std::size_t samples_at_once() const { return 1; }
  // At several times; both have the same size.
  virtual void samples(std::span<const double> t, std::span<BasicSample<S>> to) const {
    for (std::size_t k = 0; k < t.size(); ++k) to[k] = {t[k], at(t[k])};
  }
  // That it takes in memory.
  virtual std::size_t bytes() const { return 256; }
  BasicSample<S> sample(double t) const { return {t, at(t)}; }
  double t0() const { return t0_; }
  double t1() const { return t1_; }

 private:
  double t0_;
  double t1_;
};
using DenseStep = BasicDenseStep<SystemState>;

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

// Progress: how far a run has come, reported while it goes on. A caller watches a long run by it,
// and stops it: what it throws ends the run.
//
// Units       the unit of time of the run.
// Domain      called with the time reached, in the order of the run: after every step of a method,
//             and after every sample inside a step; by a run of rows without steps, after every
//             block. Not called at the start. Empty: nobody watches.
// Errors      what it throws passes through unchanged, after the samples so far have been pushed.
// Cost        its own, and that of a call: a few ns a step. One that looks at a clock does so every
//             so many calls.

using Progress = std::function<void(double t)>;

}  // namespace v0
}  // namespace polhode
