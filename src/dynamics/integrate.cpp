// SPDX-License-Identifier: MIT
// The forms of integrate for a rotor, and the one place that decides by the system of a problem
// which state is run: with a damper, or without.
#include "polhode/dynamics/integrate.hpp"

#include <utility>

#include "dynamics/shown_as.hpp"
#include "dynamics/system_run.hpp"

namespace polhode {
inline namespace v0 {

template class BasicTrajectory<DampedRotorState>;

namespace {

using detail::kept_run;
using detail::problem_of;
using detail::run_into;
using detail::shown_run;
using detail::streamed_run;
using detail::system_features;
using detail::system_maker;

template <class S>
constexpr bool has_rate = std::is_same_v<S, DampedRotorState>;

// `run(problem)` of the state that the system has, shown as S; `convert<From>()` makes what else it
// takes. A rate without a damper is refused before.
template <MotionState S, class Own, class Other>
BasicTrajectory<S> dispatched(const BasicProblem<System, S>& problem, const Own& own,
                              const Other& other) {
  using Else = std::conditional_t<has_rate<S>, RotorState, DampedRotorState>;
  if (problem.system.damper().has_value() == has_rate<S>) return own(problem);
  if constexpr (has_rate<S>)
    detail::checked_problem("integrate", problem, detail::DamperState::carried);
  return shown_run<S>(other(problem_of<Else>(problem)));
}

template <MotionState S>
BasicTrajectory<S> kept(const BasicProblem<System, S>& problem, const Keep& keep,
                        const Progress& progress) {
  const auto run = [&](const auto& p) { return kept_run(p, keep, system_maker(p, progress)); };
  return dispatched(problem, run, run);
}

template <MotionState S>
BasicTrajectory<S> into_sink(const BasicProblem<System, S>& problem, const SaveAt& times,
                             const BasicSampleSink<S>& sink, const Progress& progress) {
  const auto run = [&](const auto& p, const auto& into) {
    return run_into(p, times, into, system_maker(p, progress));
  };
  return dispatched(
      problem, [&](const auto& p) { return run(p, sink); },
      [&]<class From>(const BasicProblem<System, From>& p) {
        return run(p, detail::sink_into<From>(sink));
      });
}

template <MotionState S>
BasicTrajectory<S> streamed(const BasicProblem<System, S>& problem, const SaveAt& times,
                            const Checkpoint* from, const BasicStreams<S>& streams,
                            const Progress& progress) {
  const auto run = [&](const auto& p, const auto& into) {
    return streamed_run(p, times, from, into, system_features(p, times), system_maker(p, progress));
  };
  return dispatched(
      problem, [&](const auto& p) { return run(p, streams); },
      [&]<class From>(const BasicProblem<System, From>& p) {
        return run(p, detail::streams_into<From>(streams));
      });
}

}  // namespace

Trajectory integrate(const Problem& problem, const Keep& keep, const Progress& progress) {
  return kept(problem, keep, progress);
}
Trajectory integrate(const Problem& problem, const SaveAt& samples, const SampleSink& sink,
                     const Progress& progress) {
  return into_sink(problem, samples, sink, progress);
}
Trajectory integrate(const Problem& problem, const SaveAt& samples, const Streams& streams,
                     const Progress& progress) {
  return streamed(problem, samples, nullptr, streams, progress);
}
Trajectory resume(const Problem& problem, const SaveAt& samples, const Checkpoint& from,
                  const Streams& streams, const Progress& progress) {
  return streamed(problem, samples, &from, streams, progress);
}

template <>
DampedTrajectory integrate(const DampedProblem& problem, const Keep& keep,
                           const Progress& progress) {
  return kept(problem, keep, progress);
}
template <>
DampedTrajectory integrate(const DampedProblem& problem, const SaveAt& samples,
                           const DampedSampleSink& sink, const Progress& progress) {
  return into_sink(problem, samples, sink, progress);
}
template <>
DampedTrajectory integrate(const DampedProblem& problem, const SaveAt& samples,
                           const DampedStreams& streams, const Progress& progress) {
  return streamed(problem, samples, nullptr, streams, progress);
}
template <>
DampedTrajectory resume(const DampedProblem& problem, const SaveAt& samples, const Checkpoint& from,
                        const DampedStreams& streams, const Progress& progress) {
  return streamed(problem, samples, &from, streams, progress);
}

}  // namespace v0
}  // namespace polhode
