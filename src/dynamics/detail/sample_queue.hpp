// SPDX-License-Identifier: MIT
// The samples of a run: which times are due in a step, gathered into blocks for a sink.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dynamics/detail/state_bytes.hpp"
#include "polhode/trajectory/progress.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class SampleQueue {
 public:
  // Without times: the start, and the end of every step. DomainError for times that do not run from
  // start towards stop.
  SampleQueue(double start, double stop, std::optional<SaveAt> times, const SampleSink& sink);

  // A sample at the start, if one is due.
  void begin(const Sample& initial);
  // Whether a sample may be due elsewhere than at t, the end of the step.
  bool wants_dense(double t) const;
  // Samples due up to `end`; those not at it come from the step, each a step itself.
  void step(const DenseStep* dense, const Sample& end, const Progress& progress);
  // One more sample where an event has stopped the run, unless it is there.
  void last(const Sample& end);
  void flush();
  // Which sample is next, and those that wait for their block to fill.
  void transfer(StateBytes& bytes) { bytes.all(next_, latest_, block_); }

 private:
  bool is_before(double a, double b) const { return forward_ ? a < b : a > b; }
  // Up to where samples are due in a step that ends at t.
  double reach(double t) const { return t == stop_ ? reach_of_stop_ : t; }
  double due() const { return (*times_)[next_]; }
  bool is_done() const { return next_ == times_->size(); }
  void push(const Sample& sample);

  bool forward_;
  double stop_;
  double reach_of_stop_;  // beyond it: SaveAt keeps a row that rounding puts there
  std::optional<SaveAt> times_;
  const SampleSink& sink_;
  std::int64_t next_ = 0;
  std::vector<Sample> block_;
  std::optional<double> latest_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
