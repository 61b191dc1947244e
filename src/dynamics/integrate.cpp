// SPDX-License-Identifier: MIT
// The forms of integrate for a rotor, and the one place that decides by the system of a problem
// which state is run: with a damper, or without.
#include "polhode/dynamics/integrate.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "dynamics/checked_problem.hpp"
#include "dynamics/events/event_search.hpp"
#include "dynamics/steppers.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"
#include "polhode/dynamics/resume.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// A rotor with a damper seen as the rotor, and a rotor seen as one whose damper rests in the body.
template <MotionState To>
To seen_as(const RotorState& s);
template <MotionState To>
To seen_as(const DampedRotorState& s);
template <>
RotorState seen_as(const DampedRotorState& s) {
  return s.rotor;
}
template <>
DampedRotorState seen_as(const RotorState& s) {
  return {s, {}};
}

// The steps of a stepper of `From`, seen as those of `To`.
template <MotionState To, MotionState From>
class SeenStepper final : public BasicStepper<To> {
  class Dense final : public BasicDenseStep<To> {
   public:
    explicit Dense(std::shared_ptr<const BasicDenseStep<From>> step)
        : BasicDenseStep<To>(step->t0(), step->t1()), step_(std::move(step)) {}
    To at(double t) const override { return seen_as<To>(step_->at(t)); }
    std::size_t bytes() const override { return sizeof(*this) + step_->bytes(); }

   private:
    std::shared_ptr<const BasicDenseStep<From>> step_;
  };

 public:
  explicit SeenStepper(std::unique_ptr<BasicStepper<From>> stepper)
      : stepper_(std::move(stepper)) {}

  std::string advance(double stop) override { return stepper_->advance(stop); }
  double time() const override { return stepper_->time(); }
  To state() const override { return seen_as<To>(stepper_->state()); }
  std::shared_ptr<const BasicDenseStep<To>> dense(bool keep) override {
    return std::make_shared<const Dense>(stepper_->dense(keep));
  }
  std::shared_ptr<const BasicDenseStep<To>> inside() override {
    return std::make_shared<const Dense>(stepper_->inside());
  }
  int intervals() const override { return stepper_->intervals(); }
  Statistics statistics() const override { return stepper_->statistics(); }
  void serialize(Archive& bytes) override { stepper_->serialize(bytes); }

 private:
  std::unique_ptr<BasicStepper<From>> stepper_;
};

// The motion of a system seen as `To`, for the search of events. It does
// not know the rate of a damper that `To` lacks: slopes of event functions are those of a damper
// that rests in the body.
template <MotionState To, class Motion>
class SeenMotion : public Motion {
 public:
  using State = To;
  using Sample = BasicSample<To>;

  using Motion::Motion;
  Sample moved(const Sample& s, double time) const {
    const auto to = Motion::moved(own(s), time);
    return {to.t, seen_as<To>(to.s)};
  }
  double turning_rate(const Sample& s, bool forward) const {
    return Motion::turning_rate(own(s), forward);
  }

 private:
  static typename Motion::Sample own(const Sample& s) {
    return {s.t, seen_as<typename Motion::State>(s.s)};
  }
};

// The motion of a system whose state is `Own`.
template <MotionState Own>
using SystemMotion =
    std::conditional_t<std::is_same_v<Own, DampedRotorState>, DamperMotion, RotorMotion>;
template <MotionState S, MotionState Own>
using MotionSeen =
    std::conditional_t<std::is_same_v<S, Own>, SystemMotion<Own>, SeenMotion<S, SystemMotion<Own>>>;

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

// The method in words, and the terms that it has to ask for one stage after the other.
std::string method_text_for(const System& system, const Method& method) {
  std::string text = method_text(method);
  if (!std::holds_alternative<Collocation>(method)) return text;
  for (const AnyPerturbation& term : system.terms())
    if (!term.is_asked_together()) text += ", \"" + term.name() + "\" stage by stage";
  return text;
}

template <MotionState S, MotionState Own>
std::unique_ptr<BasicStepper<S>> system_stepper(const BasicProblem<System, S>& p) {
  if constexpr (std::is_same_v<S, Own>) {
    return make_stepper(p);
  } else {
    return std::make_unique<SeenStepper<S, Own>>(make_stepper(BasicProblem<System, Own>{
        p.system, seen_as<Own>(p.initial), p.start, p.stop, p.method, {}, p.continues}));
  }
}

// The run of a problem of a System whose state is `Own`.
template <MotionState Own, MotionState S>
auto system_maker(const BasicProblem<System, S>& problem, const Progress& progress) {
  return [&problem, &progress](bool keep_dense, SampleQueue<S>& samples) {
    using Motion = MotionSeen<S, Own>;
    const BasicProblem<System, S> p = checked(problem);
    return std::make_unique<Run<S, EventWatch<Motion>>>(
        RunSpan<S>{.initial = {p.start, p.initial},
                   .stop = p.stop,
                   .method = method_text_for(p.system, p.method),
                   .first_look = first_look(problem, p),
                   .continues = p.continues},
        EventWatch<Motion>(Motion(p.system), p.events), system_stepper<S, Own>(p), keep_dense,
        samples, progress);
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

// run(make) by the state that the system has.
template <MotionState S, class Go>
BasicTrajectory<S> dispatched(const BasicProblem<System, S>& problem, const Progress& progress,
                              const Go& run) {
  return problem.system.damper() ? run(detail::system_maker<DampedRotorState>(problem, progress))
                                 : run(detail::system_maker<RotorState>(problem, progress));
}

template <MotionState S>
BasicTrajectory<S> kept(const BasicProblem<System, S>& problem, const Keep& keep,
                        const Progress& progress) {
  return dispatched(problem, progress,
                    [&](const auto& make) { return detail::kept_run(problem, keep, make); });
}

template <MotionState S>
BasicTrajectory<S> into_sink(const BasicProblem<System, S>& problem, const SaveAt& times,
                             const BasicSampleSink<S>& sink, const Progress& progress) {
  return dispatched(problem, progress,
                    [&](const auto& make) { return detail::run_into(problem, times, sink, make); });
}

template <MotionState S>
BasicTrajectory<S> streamed(const BasicProblem<System, S>& problem, const SaveAt& times,
                            const Checkpoint* from, const BasicStreams<S>& streams,
                            const Progress& progress) {
  return dispatched(problem, progress, [&](const auto& make) {
    return detail::streamed_run(problem, times, from, streams,
                                detail::system_features(problem, times), make);
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
