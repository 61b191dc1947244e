// SPDX-License-Identifier: MIT
// resume: a run of integrate that was stopped goes on, and ends in the same bits.
//
// Equations   those of the method. A Checkpoint holds what a step depends on: the state with what
//             its sums have lost to rounding, time in two parts, the next step and what controls
//             it, the epoch of the constants, on which side of zero every event function was, the
//             samples that have not been pushed yet.
// Units       those of the problem.
// Domain      between two steps of any method, or two samples of a step. resume wants the problem
//             and the times that the checkpoint was made with; functions (terms, events) cannot be
//             compared. Bits are those of the straight run for the same build of the library.
// Accuracy    exact: every double is kept as its bits.
// Errors      DomainError for bytes that are no checkpoint, were damaged, or are of another
//             problem, saying what differs. Otherwise as integrate. What a stream throws passes
//             through.
// Cost        a microsecond per checkpoint, 88 bytes per sample that waits: at most 1024 of them.
#pragma once

#include <functional>
#include <string>

#include "polhode/dynamics/integrate.hpp"

namespace polhode {
inline namespace v0 {

// A run between two steps or samples. Its bytes may be kept in a file.
class Checkpoint {
 public:
  explicit Checkpoint(std::string bytes);

  const std::string& bytes() const { return bytes_; }
  double t() const { return t_; }  // where the run stood

  bool operator==(const Checkpoint&) const = default;

 private:
  std::string bytes_;
  double t_;
};

// What a run gives out while it goes on: memory does not grow with its length.
template <MotionState S>
struct BasicStreams {
  BasicSampleSink<S> samples;
  // Empty: the trajectory returned has them.
  std::function<void(const BasicEventRecord<S>&)> events = {};
  // Asked after every step, and every sample inside one, with its time; where the answer is yes,
  // `checkpoint` is called. What that throws ends the run, which can go on from there.
  std::function<bool(double t)> checkpoint_due = {};
  std::function<void(const Checkpoint&)> checkpoint = {};
  // A step ends at the last sample, whatever comes behind it.
  bool steps_to_last_sample = false;
  // Where the run has ended, after all else.
  std::function<void(const BasicSample<S>&)> end = {};
};
using Streams = BasicStreams<SystemState>;

Trajectory integrate(const Problem& problem, const SaveAt& samples, const Streams& streams,
                     const Progress& progress = {});

// The rest of that run: what is pushed before and after a checkpoint, one behind the other, is what
// the straight run pushes. Statistics and outcome are those of the whole.
Trajectory resume(const Problem& problem, const SaveAt& samples, const Checkpoint& from,
                  const Streams& streams, const Progress& progress = {});

// The same of a model of your own.
template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const SaveAt& samples,
                                             const BasicStreams<typename M::State>& streams,
                                             const Progress& progress = {});
template <Integrable M>
BasicTrajectory<typename M::State> resume(const BasicProblem<M>& problem, const SaveAt& samples,
                                          const Checkpoint& from,
                                          const BasicStreams<typename M::State>& streams,
                                          const Progress& progress = {});

}  // namespace v0
}  // namespace polhode
