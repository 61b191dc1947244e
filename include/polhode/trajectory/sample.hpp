// SPDX-License-Identifier: MIT
// Samples of a run, the steps between them and the events met, for any state.
//
// Units       those of the run.
// Domain      a MotionState is a value that visits its own numbers: each_number(s, visit) calls
//             visit(double&) for every one of them, always in the same order, and is found where
//             the type is. A checkpoint keeps these numbers, so that they must be all of the state.
// Cost        a sample of a system is 88 bytes.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "polhode/system/system_state.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
