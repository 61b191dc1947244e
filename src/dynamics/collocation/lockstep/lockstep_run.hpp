// SPDX-License-Identifier: MIT
// The run of one body of a lockstep: what integrate makes of it, step by step.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/collocation/lockstep/many_steps.hpp"
#include "dynamics/collocation/lockstep/stepper_in_parts.hpp"
#include "dynamics/system_run.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class LockstepRun {
 public:
  // By Collocation, without a damper.
  LockstepRun(const Problem& problem, const Keep& keep)
      : into_memory_([this](std::span<const Sample> block) {
          kept_.insert(kept_.end(), block.begin(), block.end());
        }),
        samples_(problem.start, problem.stop, keep.samples, into_memory_),
        checked_(checked(problem)) {
    auto stepper = make_stepper_in_parts(checked_, std::get<Collocation>(checked_.method));
    stepper_ = stepper.get();
    stepper_->tried().put_off_guesses();
    run_ =
        run_by<RotorState>(problem, checked_, std::move(stepper), keep.dense, samples_, progress_);
    run_->limit_memory(keep.most_bytes);
    goes_on_ = run_->begin() && begins();
  }
  LockstepRun(const LockstepRun&) = delete;
  LockstepRun& operator=(const LockstepRun&) = delete;

  bool goes_on() const { return goes_on_; }
  double time() const { return stepper_->time(); }
  // What it tries, while it goes on.
  BodyStep tried() { return {&stepper_->tried(), stepper_->judge()}; }
  void solved(const SweepJudge& judge) {
    const std::optional<std::string> step = stepper_->solved(judge);
    if (step) goes_on_ = run_->stepped(*step) && begins();
  }
  Trajectory trajectory() {
    Trajectory::Parts parts = run_->finished();
    parts.samples = std::move(kept_);
    return Trajectory(std::move(parts));
  }

 private:
  // The next step, if there is one.
  bool begins() {
    const std::string refused = stepper_->begin(run_->next_stop());
    return refused.empty() || run_->stepped(refused);
  }

  std::vector<Sample> kept_;
  SampleSink into_memory_;
  SampleQueue<RotorState> samples_;
  Progress progress_;
  Problem checked_;
  StepperInParts* stepper_;  // of run_
  std::unique_ptr<SystemRun<RotorState>> run_;
  bool goes_on_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
