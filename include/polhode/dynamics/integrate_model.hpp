// SPDX-License-Identifier: MIT
// integrate and resume for models of your own: the loop of polhode/dynamics/integrate.hpp, made for
// the state of the model where this header is included.
//
// Equations   those of the model: polhode/dynamics/model.hpp.
// Units       those of the model.
// Domain      a BasicProblem of a Model, by Adaptive or Collocation, and by Splitting where it can
//             be frozen; otherwise as integrate and resume.
// Accuracy    that of the method.
// Errors      as integrate and resume.
// Cost        as integrate; the compiler makes the loop for each model.
#pragma once

#include "polhode/dynamics/detail/model_run.hpp"

namespace polhode {
inline namespace v0 {
template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const Keep& keep,
                                             const Progress& progress) {
  return detail::kept_run(problem, keep, detail::maker_of(problem, progress));
}

template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const SaveAt& times,
                                             const BasicSampleSink<typename M::State>& sink,
                                             const Progress& progress) {
  return detail::run_into(problem, times, sink, detail::maker_of(problem, progress));
}

template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const SaveAt& times,
                                             const BasicStreams<typename M::State>& streams,
                                             const Progress& progress) {
  return detail::streamed_run(problem, times, nullptr, streams,
                              detail::run_features(problem, times, detail::model_features(problem)),
                              detail::maker_of(problem, progress));
}

template <Integrable M>
BasicTrajectory<typename M::State> resume(const BasicProblem<M>& problem, const SaveAt& times,
                                          const Checkpoint& from,
                                          const BasicStreams<typename M::State>& streams,
                                          const Progress& progress) {
  return detail::streamed_run(problem, times, &from, streams,
                              detail::run_features(problem, times, detail::model_features(problem)),
                              detail::maker_of(problem, progress));
}

}  // namespace v0
}  // namespace polhode
