// SPDX-License-Identifier: MIT
// The forms of integrate for a rotor, and the one place that decides by the system of a problem
// which state is run: with a damper, or without.
#include "polhode/dynamics/integrate.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "dynamics/checked_problem.hpp"
#include "dynamics/events/event_search.hpp"
#include "dynamics/steppers.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"
#include "polhode/dynamics/resume.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// A run of one state shown as that of another: of a rotor with a damper as that of the rotor, and
// of a rotor as that of one whose damper rests in the body.
template <MotionState To, MotionState From>
To shown(const From& s);
template <>
RotorState shown(const DampedRotorState& s) {
  return s.rotor;
}
template <>
DampedRotorState shown(const RotorState& s) {
  return {s, {}};
}

template <MotionState To, MotionState From>
BasicSample<To> shown_sample(const BasicSample<From>& at) {
  return {at.t, shown<To>(at.s)};
}
template <MotionState To, MotionState From>
BasicEventRecord<To> shown_event(const BasicEventRecord<From>& e) {
  return {e.name, e.t, shown<To>(e.s), e.direction};
}

// The problem whose run is shown.
template <MotionState From, MotionState To>
BasicProblem<System, From> problem_of(const BasicProblem<System, To>& p) {
  BasicProblem<System, From> result{
      p.system, shown<From>(p.initial), p.start, p.stop, p.method, {}, p.continues};
  for (const BasicEvent<To>& e : p.events) {
    BasicEventFunction<From> function;
    if (e.function)
      function = [f = e.function](const BasicSample<From>& at) { return f(shown_sample<To>(at)); };
    result.events.push_back(
        {e.name, std::move(function), e.crossing, e.stops, e.period, e.interval});
  }
  return result;
}

template <MotionState From, MotionState To>
BasicSampleSink<From> sink_into(const BasicSampleSink<To>& sink) {
  return [sink](std::span<const BasicSample<From>> block) {
    std::vector<BasicSample<To>> rows;
    rows.reserve(block.size());
    for (const BasicSample<From>& at : block) rows.push_back(shown_sample<To>(at));
    sink(rows);
  };
}

template <MotionState From, MotionState To>
BasicStreams<From> streams_into(const BasicStreams<To>& streams) {
  BasicStreams<From> result{
      {}, {}, streams.checkpoint_due, streams.checkpoint, streams.steps_to_last_sample, {}};
  if (streams.samples) result.samples = sink_into<From>(streams.samples);
  if (streams.events)
    result.events = [events = streams.events](const BasicEventRecord<From>& e) {
      events(shown_event<To>(e));
    };
  if (streams.end)
    result.end = [end = streams.end](const BasicSample<From>& at) { end(shown_sample<To>(at)); };
  return result;
}

template <MotionState To, MotionState From>
class ShownStep final : public BasicDenseStep<To> {
 public:
  explicit ShownStep(std::shared_ptr<const BasicDenseStep<From>> step)
      : BasicDenseStep<To>(step->t0(), step->t1()), step_(std::move(step)) {}
  To at(double t) const override { return shown<To>(step_->at(t)); }
  std::size_t bytes() const override { return sizeof(*this) + step_->bytes(); }

 private:
  std::shared_ptr<const BasicDenseStep<From>> step_;
};

template <MotionState To, MotionState From>
BasicTrajectory<To> shown_run(BasicTrajectory<From> run) {
  typename BasicTrajectory<From>::Parts parts = std::move(run).parts();
  typename BasicTrajectory<To>::Parts result{.initial = shown_sample<To>(parts.initial),
                                             .samples = {},
                                             .events = {},
                                             .outcome = std::move(parts.outcome),
                                             .statistics = parts.statistics,
                                             .method = std::move(parts.method),
                                             .dense = {}};
  result.samples.reserve(parts.samples.size());
  for (const BasicSample<From>& at : parts.samples) result.samples.push_back(shown_sample<To>(at));
  for (const auto& event : parts.events) result.events.push_back(shown_event<To>(event));
  for (auto& step : parts.dense)
    result.dense.push_back(std::make_shared<const ShownStep<To, From>>(std::move(step)));
  return BasicTrajectory<To>(std::move(result));
}

// The run of a problem of a System: of a rotor, or of a rotor with its damper.
RotorMotion motion_of(const Problem& p) { return RotorMotion(p.system); }
DamperMotion motion_of(const DampedProblem& p) { return DamperMotion(p.system); }

template <MotionState S>
BasicProblem<System, S> checked(const BasicProblem<System, S>& problem) {
  BasicProblem<System, S> result = checked_problem("integrate", problem, DamperState::carried);
  for (const BasicEvent<S>& event : result.events) require_valid(event);
  return result;
}

template <MotionState S>
BasicSample<S> first_look(const BasicProblem<System, S>& given,
                          const BasicProblem<System, S>& checked) {
  const Quaternion& q = rotor_of(given.initial).q;
  const double excess = (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z) - 1.0;
  const bool is_normal = std::abs(excess) <= 8.0 * std::numeric_limits<double>::epsilon();
  return {checked.start, is_normal ? given.initial : checked.initial};
}

template <MotionState S>
using SystemWatch = EventWatch<decltype(motion_of(std::declval<BasicProblem<System, S>>()))>;
template <MotionState S>
using SystemRun = Run<S, SystemWatch<S>>;

// The method in words, and the terms that it has to ask for one stage after the other.
std::string method_text_for(const System& system, const Method& method) {
  std::string text = method_text(method);
  if (!std::holds_alternative<Collocation>(method)) return text;
  for (const AnyPerturbation& term : system.terms())
    if (!term.is_asked_together()) text += ", \"" + term.name() + "\" stage by stage";
  return text;
}

template <MotionState S>
std::unique_ptr<SystemRun<S>> system_run(const BasicProblem<System, S>& problem, bool keep_dense,
                                         SampleQueue<S>& samples, const Progress& progress) {
  const BasicProblem<System, S> p = checked(problem);
  return std::make_unique<SystemRun<S>>(RunSpan<S>{.initial = {p.start, p.initial},
                                                   .stop = p.stop,
                                                   .method = method_text_for(p.system, p.method),
                                                   .first_look = first_look(problem, p),
                                                   .continues = p.continues},
                                        SystemWatch<S>(motion_of(p), p.events), make_stepper(p),
                                        keep_dense, samples, progress);
}

template <MotionState S>
auto system_maker(const BasicProblem<System, S>& problem, const Progress& progress) {
  return [&problem, &progress](bool keep_dense, SampleQueue<S>& samples) {
    return system_run(problem, keep_dense, samples, progress);
  };
}

template <MotionState S>
Features system_features(const BasicProblem<System, S>& problem, const SaveAt& times) {
  const BasicProblem<System, S> p = checked(problem);
  const auto bytes_of = [](auto... x) {
    Archive bytes;
    bytes.all(x...);
    return bytes.bytes();
  };
  std::string terms;
  for (const AnyPerturbation& term : p.system.terms()) terms += bytes_of(term.name());
  const std::optional<KaneDamper>& damper = p.system.damper();
  Features moving{
      {"state", state_bytes(rotor_of(p.initial))},
      {"body", bytes_of(p.system.body().moments())},
      {"terms", terms},
      {"damper", damper ? bytes_of(damper->moment(), damper->friction()) : std::string()}};
  if constexpr (std::is_same_v<S, DampedRotorState>)
    moving.emplace_back("damper_rate", bytes_of(p.initial.damper_rate));
  return run_features(p, times, std::move(moving));
}

}  // namespace
}  // namespace detail

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
