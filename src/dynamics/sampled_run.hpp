// SPDX-License-Identifier: MIT
// A run into memory, of states without events: derivatives and deviations of a motion. Its steps
// end at its samples if a method knows such a state only at the ends of its steps.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/dynamics/detail/run.hpp"
#include "polhode/dynamics/method.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline bool steps_to_samples(const Method& method) {
  return std::holds_alternative<Adaptive>(method);
}

// The stepper is at the start; times run from there in the direction of the run.
template <MotionState S>
BasicTrajectory<S> sampled_run(std::unique_ptr<BasicStepper<S>> stepper, std::string method,
                               const std::vector<double>& times, const Progress& progress,
                               bool ends_at_samples) {
  std::vector<BasicSample<S>> kept;
  const BasicSampleSink<S> into_memory = [&kept](std::span<const BasicSample<S>> block) {
    kept.insert(kept.end(), block.begin(), block.end());
  };
  const BasicSample<S> initial{stepper->time(), stepper->state()};
  const double stop = times.empty() ? initial.t : times.back();
  SampleQueue<S> samples(initial.t, stop, SaveAt::times(times), into_memory);
  Run<S, NoEvents<S>> run(RunSpan<S>{.initial = initial,
                                     .stop = stop,
                                     .method = std::move(method),
                                     .first_look = initial,
                                     .ends_at_samples = ends_at_samples},
                          {}, std::move(stepper), false, samples, progress);
  typename BasicTrajectory<S>::Parts parts = run.result();
  parts.samples = std::move(kept);
  return BasicTrajectory<S>(std::move(parts));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
