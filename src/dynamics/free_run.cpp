// SPDX-License-Identifier: MIT
#include "dynamics/free_run.hpp"

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/events/event_search.hpp"
#include "dynamics/steppers.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"
#include "polhode/dynamics/free_events.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// The motion as it is seen from the frame.
struct SeenMotion {
  FreeRotation motion;
  System system;

  SystemState seen(double t, const RotorState& s_I) const {
    return system.frame().is_inertial() ? s_I : reference_state(system, t, s_I);
  }
  SystemState at(double t) const { return seen(t, motion.at(t)); }
  // At its epoch the motion is what it was given, without a rounding.
  SystemState first_look(double t) const {
    if (t != motion.epoch()) return at(t);
    const auto& [q, g] = motion.initial_state();
    return seen(t, {normalized(q), g});
  }
};

class FreeStep final : public DenseStep {
 public:
  FreeStep(std::shared_ptr<const SeenMotion> of, double t0, double t1)
      : DenseStep(t0, t1), of_(std::move(of)) {}
  SystemState at(double t) const override { return of_->at(t); }
  // The closed form is vectorised.
  std::size_t samples_at_once() const override { return 64; }
  void samples(std::span<const double> t, std::span<Sample> to) const override {
    std::vector<RotorState> states(t.size());
    of_->motion.at(t, states);
    for (std::size_t k = 0; k < t.size(); ++k) to[k] = {t[k], of_->seen(t[k], states[k])};
  }

 private:
  std::shared_ptr<const SeenMotion> of_;
};

class FreeStepper final : public Stepper {
 public:
  FreeStepper(std::shared_ptr<const SeenMotion> of, double start, const std::vector<Event>& events)
      : of_(std::move(of)), look_(of_->system), events_(events), before_(start), t_(start) {}

  std::string advance(double stop) override {
    before_ = std::exchange(t_, end_of_step(stop));
    return {};
  }
  double time() const override { return t_; }
  SystemState state() const override { return of_->at(t_); }
  std::shared_ptr<const DenseStep> dense(bool) override {
    return std::make_shared<const FreeStep>(of_, before_, t_);
  }
  int intervals() const override { return looks_per_step / 4; }
  Statistics statistics() const override { return {}; }
  void serialize(Archive& bytes) override { bytes.all(before_, t_); }

 private:
  static constexpr int looks_per_step = 64;

  double end_of_step(double stop) const {
    if (events_.empty()) return stop;
    const bool forward = stop >= t_;
    // infinite for a body at rest
    const double reach =
        looks_per_step * time_between_looks(look_, events_, Sample{t_, state()}, forward);
    if (!(reach < std::fabs(stop - t_))) return stop;
    const double end = t_ + (forward ? reach : -reach);
    return end == t_ ? std::nextafter(t_, stop) : end;
  }

  std::shared_ptr<const SeenMotion> of_;
  SystemMotion look_;
  std::vector<Event> events_;
  double before_;
  double t_;
};

auto maker(const BasicProblem<FreeMotion>& problem, const Progress& progress) {
  return [&problem, &progress](bool keep_dense, SampleQueue<SystemState>& samples) {
    const auto& [motion, frame] = problem.system;
    for (const Event& event : problem.events) require_valid(event);
    const auto seen =
        std::make_shared<const SeenMotion>(SeenMotion{motion, System(motion.body(), frame)});
    return std::make_unique<Run<SystemState, SystemWatch>>(
        RunSpan<SystemState>{.initial = {problem.start, problem.initial},
                             .stop = problem.stop,
                             .method = "exact free rotation",
                             .first_look = {problem.start, seen->first_look(problem.start)}},
        SystemWatch(SystemMotion(seen->system), problem.events),
        std::make_unique<FreeStepper>(seen, problem.start, problem.events), keep_dense, samples,
        progress);
  };
}

Trajectory streamed(const BasicProblem<FreeMotion>& problem, const SaveAt& times,
                    const Checkpoint* from, const Streams& streams, const Progress& progress) {
  const FreeRotation& motion = problem.system.motion;
  std::string body;
  const Vec3& I = motion.body().moments();
  for (const double x : {I.x, I.y, I.z, motion.epoch()}) body += number_bytes(x);
  return streamed_run(
      problem, times, from, streams,
      run_features(problem, times,
                   {{"state", state_bytes<RotorState>(motion.initial_state())}, {"body", body}}),
      maker(problem, progress));
}

}  // namespace

BasicProblem<FreeMotion> free_problem(const FreeRotation& motion, const Frame& frame, double start,
                                      double stop, std::vector<Event> events) {
  const SeenMotion seen{motion, System(motion.body(), frame)};
  BasicProblem<FreeMotion> problem{{motion, frame}, seen.at(start), start, stop};
  problem.events = std::move(events);
  return problem;
}

Trajectory integrate(const BasicProblem<FreeMotion>& problem, const Keep& keep,
                     const Progress& progress) {
  return kept_run(problem, keep, maker(problem, progress));
}
Trajectory integrate(const BasicProblem<FreeMotion>& problem, const SaveAt& samples,
                     const Streams& streams, const Progress& progress) {
  return streamed(problem, samples, nullptr, streams, progress);
}
Trajectory resume(const BasicProblem<FreeMotion>& problem, const SaveAt& samples,
                  const Checkpoint& from, const Streams& streams, const Progress& progress) {
  return streamed(problem, samples, &from, streams, progress);
}

}  // namespace detail

FreeEvents free_events(const FreeRotation& motion, const std::vector<Event>& events, double start,
                       double stop, const Frame& frame, const Progress& progress) {
  detail::require_finite_span("free_events", start, stop);
  const Trajectory run =
      detail::integrate(detail::free_problem(motion, frame, start, stop, events),
                        Keep{.samples = SaveAt::times({}), .dense = false}, progress);
  return {run.events(), run.outcome()};
}

}  // namespace v0
}  // namespace polhode
