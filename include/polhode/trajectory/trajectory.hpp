// SPDX-License-Identifier: MIT
// Trajectory: what a run leaves in memory. Samples at the times asked for, the events met, how the
// run ended, what it cost, and the state at any time between.
//
// Equations   none: between its samples a trajectory is the dense output of the method.
// Units       those of the run.
// Domain      at(t) for t from start() to stop(), where the run really ended. Empty runs have the
//             initial state alone.
// Accuracy    that of the method; at(t) has the order of the method.
// Errors      at(t) throws DomainError outside the span, or when the run kept no dense output.
// Cost        a sample is 88 bytes; dense output keeps some hundred bytes per step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

struct Sample {
  double t;
  RotorState s;  // q normalised
  // Rate of a damper relative to the body, body axes; zero without one.
  Vec3 damper_rate = {};

  constexpr bool operator==(const Sample&) const = default;
};

// Where a run puts its samples, block by block, in order of time.
using SampleSink = std::function<void(std::span<const Sample>)>;

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
  std::int64_t evaluations = 0;  // of the perturbation terms, all together once
};

// A crossing that an event function met.
struct EventRecord {
  std::string name;
  double t;
  RotorState s;
  int direction;  // +1: rising through zero, -1: falling, 0: touching it
  Vec3 damper_rate = {};
};

// The state inside one step, t0 to t1 (t1 < t0 backwards).
class DenseStep {
 public:
  DenseStep(double t0, double t1) : t0_(t0), t1_(t1) {}
  virtual ~DenseStep() = default;
  virtual RotorState at(double t) const = 0;
  // With the rate of a damper.
  virtual Sample sample(double t) const { return {t, at(t)}; }
  double t0() const { return t0_; }
  double t1() const { return t1_; }

 private:
  double t0_;
  double t1_;
};

class Trajectory {
 public:
  struct Parts {
    Sample initial;
    std::vector<Sample> samples;
    std::vector<EventRecord> events;
    Outcome outcome;
    Statistics statistics;
    std::string method;                                   // in words: provenance
    std::vector<std::shared_ptr<const DenseStep>> dense;  // in order; empty: none kept
  };
  explicit Trajectory(Parts parts) : parts_(std::move(parts)) {}

  const std::vector<Sample>& samples() const& { return parts_.samples; }
  std::vector<Sample> samples() && { return std::move(parts_.samples); }
  const std::vector<EventRecord>& events() const { return parts_.events; }
  const Outcome& outcome() const { return parts_.outcome; }
  const Statistics& statistics() const { return parts_.statistics; }
  const std::string& method() const { return parts_.method; }
  double start() const { return parts_.initial.t; }
  double stop() const { return parts_.outcome.t; }
  // Whether at(t) has an answer between the samples.
  bool has_dense() const { return !parts_.dense.empty(); }

  RotorState at(double t) const { return sample(t).s; }
  Sample sample(double t) const;

 private:
  Parts parts_;
};

}  // namespace v0
}  // namespace polhode
