// SPDX-License-Identifier: MIT
#include "dynamics/collocation/collocation_stepper.hpp"

#include <optional>

#include "dynamics/collocation/lockstep/stepper_in_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

class RotorCollocation final : public CollocationStepper<RotorStages, StepperInParts> {
 public:
  using CollocationStepper::CollocationStepper;

  std::string begin(double stop) override {
    step_.emplace(steps_.step(solver_, *field_, stop));
    std::string refused = step_->begin();
    if (refused.empty()) solver_.begin(step_->end());
    return refused;
  }
  RotorStages& tried() override { return solver_.tried(); }
  SweepJudge judge() const override { return judge_of<RotorStages>(solver_.enough()); }
  std::optional<std::string> solved(const SweepJudge& judge) override {
    const std::optional<StepOutcome> outcome = solver_.solved(judge);
    if (!outcome) return std::nullopt;
    std::optional<std::string> last = step_->tried(*outcome);
    if (!last) solver_.begin(step_->end());
    return last;
  }

 private:
  std::optional<SmoothStep<Solver, Field>> step_;  // that is made in parts
};

}  // namespace

std::unique_ptr<StepperInParts> make_stepper_in_parts(const Problem& problem,
                                                      const Collocation& method) {
  require_valid(method);
  return std::make_unique<RotorCollocation>(
      std::make_shared<const RotorStages::Field>(problem.system), SmoothSteps(problem.system),
      problem.start, RotorStages::Field::start(problem.initial), method,
      collocation_control(problem.system, problem.start, method));
}

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Collocation& method) {
  return make_stepper_in_parts(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
