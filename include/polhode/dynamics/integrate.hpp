// SPDX-License-Identifier: MIT
// integrate: one function for every method and every state.
//
// Equations   those of System; of the method.
// Units       those of the system.
// Domain      any state with a non-zero quaternion, from `start` to `stop` in either direction.
//             Samples outside the span are left out, but for a last one that rounding alone puts
//             beyond `stop`. A sample at `stop` is the end of the last step; others come from the
//             dense output. A damper moves from the rate in the initial state. For models of your
//             own: polhode/dynamics/integrate_model.hpp.
// Accuracy    docs/guide/which-propagator.md.
// Errors      DomainError for an invalid problem (NaN, a method out of range, a splitting of a
//             term without a flow, a damper with a method that does not move its state). A run
//             that cannot go on (NaN, a step too small) ends with Outcome::failed and a sentence;
//             samples so far are kept. What a user's callable or `progress` throws passes through
//             after the samples so far have been pushed.
// Cost        docs/guide/which-propagator.md.
#pragma once

#include <concepts>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "polhode/dynamics/model.hpp"
#include "polhode/dynamics/problem.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {

Trajectory integrate(const Problem& problem, const Keep& keep = {}, const Progress& progress = {});

// The same with samples pushed block by block into a sink: constant memory. The trajectory returned
// has no samples and no dense output.
Trajectory integrate(const Problem& problem, const SaveAt& samples, const SampleSink& sink,
                     const Progress& progress = {});

// The same of a model of your own.
template <class M>
concept Integrable = Model<M> || FrozenModel<M>;

template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const Keep& keep = {},
                                             const Progress& progress = {});
template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const SaveAt& samples,
                                             const BasicSampleSink<typename M::State>& sink,
                                             const Progress& progress = {});

// A state with the derivative of its hub tangent (dtheta_B, dg_B) by that of the initial state.
struct TransitionSample {
  double t;
  RotorState s;
  Matrix6 transition;
};

// The state transition matrix along a run. Adaptive: by the variational equations (dual numbers);
// VariationOfConstants: by those of Adaptive at its tolerance; Collocation and Splitting (terms
// that are kicks): the derivative of the method's own steps; those of a splitting are symplectic.
// Every term must be a template on the number type, and there is no damper. A run that cannot go on
// is a DomainError here.
std::vector<TransitionSample> state_transitions(const Problem& problem, const SaveAt& samples,
                                                const Progress& progress = {});

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

// Receivers of the results of a run as it goes: memory does not grow with its length.
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
  // Called last, with the sample at which the run ended.
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

// integrate_many: the runs of many bodies, one after the other.
//
// Equations   those of integrate.
// Units       those of each system.
// Domain      any problems of a rotor. integrate_body may be called from several threads, for
//             example by ordered_parallel_for (polhode/ensemble/executor.hpp).
// Accuracy    the bits of integrate for each.
// Errors      a body that fails leaves the others as they are. A run that cannot go on has a
//             trajectory whose outcome says so, as from integrate. An invalid problem, or one whose
//             term throws, has none, and `error` names the body, the time and the cause. What
//             `problem`, `done` and `progress` throw passes through.
// Cost        that of integrate for each.

struct BodyRun {
  std::optional<Trajectory> trajectory;
  std::string error;          // why there is none
  std::exception_ptr thrown;  // and what was thrown
};

// One of them. `error` calls it by its index. `progress` is called after every step.
BodyRun integrate_body(std::size_t index, const Problem& problem, const Keep& keep,
                       const Progress& progress = {});

// Integrates the problems with indices below `count`, in order. `problem` is called for each before
// its run, and `done` gets the run when it has ended.
void integrate_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, BodyRun)>& done,
                    const Progress& progress = {});

// All of them, in the order of the problems.
std::vector<BodyRun> integrate_many(std::span<const Problem> problems, const Keep& keep = {});

}  // namespace v0
}  // namespace polhode
