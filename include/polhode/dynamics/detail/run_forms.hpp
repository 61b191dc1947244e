// SPDX-License-Identifier: MIT
// What the forms of integrate share, whatever moves: samples into memory, into a sink, or streamed
// with checkpoints. `make(keep_dense, samples)` makes the Run.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/dynamics/detail/run.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// DomainError for times that are not finite, naming `function`.
void require_finite_span(const std::string& function, double start, double stop);

template <class M, class Make, MotionState S = typename M::State>
BasicTrajectory<S> kept_run(const BasicProblem<M>& problem, const Keep& keep, const Make& make) {
  std::vector<BasicSample<S>> kept;
  const BasicSampleSink<S> into_memory = [&kept](std::span<const BasicSample<S>> block) {
    kept.insert(kept.end(), block.begin(), block.end());
  };
  SampleQueue<S> samples(problem.start, problem.stop, keep.samples, into_memory);
  const auto run = make(keep.dense, samples);
  run->limit_memory(keep.most_bytes);
  typename BasicTrajectory<S>::Parts parts = run->result();
  parts.samples = std::move(kept);
  return BasicTrajectory<S>(std::move(parts));
}

template <class M, class Make, MotionState S = typename M::State>
BasicTrajectory<S> run_into(const BasicProblem<M>& problem, const SaveAt& times,
                            const BasicSampleSink<typename M::State>& sink, const Make& make) {
  SampleQueue<S> samples(problem.start, problem.stop, times, sink);
  return BasicTrajectory<S>(make(false, samples)->result());
}

template <class M, class Make, MotionState S = typename M::State>
BasicTrajectory<S> streamed_run(const BasicProblem<M>& problem, const SaveAt& times,
                                const Checkpoint* from,
                                const BasicStreams<typename M::State>& streams, Features features,
                                const Make& make) {
  const BasicSampleSink<S> nowhere = [](std::span<const BasicSample<S>>) {};
  SampleQueue<S> samples(
      problem.start, problem.stop, times, streams.samples ? streams.samples : nowhere,
      requires { M::allows_any_order; });
  const auto run = make(false, samples);
  run->connect(streams, std::move(features));
  if (from != nullptr) run->restore(*from);
  return BasicTrajectory<S>(run->result());
}

// `moving`: those of what moves, and of its state.
template <class M>
Features run_features(const BasicProblem<M>& problem, const SaveAt& times, Features moving) {
  std::string events;
  for (const auto& e : problem.events)
    events += event_bytes(e.name, e.crossing, e.stops, e.period, e.interval);
  Features all{{"start", number_bytes(problem.start)}, {"stop", number_bytes(problem.stop)}};
  for (auto& feature : moving) all.push_back(std::move(feature));
  all.emplace_back("continues", number_bytes(problem.continues ? 1.0 : 0.0));
  all.emplace_back("method", method_bytes(problem.method));
  all.emplace_back("events", events);
  all.emplace_back("sample times", times_bytes(times));
  return all;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
