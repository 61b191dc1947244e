// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/adaptive/smooth_stepper.hpp"
#include "dynamics/collocation/collocation_curve.hpp"
#include "dynamics/collocation/lockstep/stepper_in_parts.hpp"
#include "dynamics/steppers.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// The polynomial of a step, as small as it can be kept.
class CollocationDense final : public DenseStep {
 public:
  CollocationDense(const StepPolynomial& step, std::size_t stages, double t1, const RotorState& end)
      : DenseStep(step.t.hi, t1),
        t_(step.t),
        start_(step.start),
        h_(step.h),
        rates_(stages),
        end_(end) {
    for (std::size_t m = 0; m < stages; ++m)
      for (std::size_t n = 0; n < 7; ++n) rates_[m][n] = step.rates[n][m];
  }

  RotorState at(double t) const override {
    if (t == t1()) return end_;
    const double x = (DoubleDouble(t) - t_).hi / h_;
    return RotorStages::Field::state(
        values_inside(rates_.size(), start_, h_, x,
                      [this](std::size_t n, std::size_t m) { return rates_[m][n]; }));
  }

 private:
  DoubleDouble t_;
  RotorStages::State start_;
  double h_;
  std::vector<std::array<double, 7>> rates_;
  RotorState end_;
};

CollocationControl control_of(const Problem& problem, const Collocation& method) {
  if (method.step > 0.0) return {{method.tolerance, method.step}, true};
  return {step_control(problem.system, problem.start,
                       {.tolerance = method.tolerance, .largest_step = method.largest_step})};
}

class CollocationStepper final : public StepperInParts {
 public:
  CollocationStepper(const Problem& problem, const Collocation& method)
      : field_(std::make_shared<const RotorStages::Field>(problem.system)),
        steps_(problem.system),
        solver_(field_, static_cast<std::size_t>(method.stages), widest_instruction_set(),
                problem.start, RotorStages::Field::start(problem.initial),
                control_of(problem, method)) {}

  std::string advance(double stop) override { return steps_.advance(solver_, *field_, stop); }
  std::string begin(double stop) override {
    step_.emplace(steps_.step(solver_, *field_, stop));
    std::string refused = step_->begin();
    if (refused.empty()) solver_.begin(step_->end());
    return refused;
  }
  RotorStages& tried() override { return solver_.tried(); }
  SweepJudge judge() const override { return SweepJudge(solver_.enough()); }
  std::optional<std::string> solved(const SweepJudge& judge) override {
    const std::optional<StepOutcome> outcome = solver_.solved(judge);
    if (!outcome) return std::nullopt;
    std::optional<std::string> last = step_->tried(*outcome);
    if (!last) solver_.begin(step_->end());
    return last;
  }
  double time() const override { return solver_.time().hi; }
  RotorState state() const override { return field_->state(solver_.state().y); }
  std::shared_ptr<const DenseStep> dense(bool) override {
    return std::make_shared<const CollocationDense>(solver_.refined(), 2 * solver_.stages(), time(),
                                                    state());
  }
  // As many as the polynomial has degrees: terms may act faster than the body turns.
  int intervals() const override { return static_cast<int>(solver_.stages()); }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }
  void transfer(StateBytes& bytes) override {
    solver_.transfer(bytes);
    steps_.transfer(bytes, solver_.field());
  }

 private:
  std::shared_ptr<const RotorStages::Field> field_;
  SmoothSteps steps_;
  CollocationSolver solver_;
  std::optional<SmoothStep<CollocationSolver, RotorStages::Field>> step_;  // made in parts
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Collocation& method) {
  return make_stepper_in_parts(problem, method);
}

std::unique_ptr<StepperInParts> make_stepper_in_parts(const Problem& problem,
                                                      const Collocation& method) {
  require_valid(method);
  return std::make_unique<CollocationStepper>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
