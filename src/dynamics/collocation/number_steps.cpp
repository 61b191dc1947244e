// SPDX-License-Identifier: MIT
#include "polhode/dynamics/detail/number_steps.hpp"

#include <utility>

#include "dynamics/collocation/collocation_solver.hpp"
#include "dynamics/collocation/generic_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using Solver = BasicCollocationSolver<GenericStages>;

class Curve final : public NumberCurve {
 public:
  Curve(const Solver::Polynomial& step, std::size_t stages)
      : t_(step.t),
        start_(step.start),
        h_(step.h),
        numbers_(step.rates.size()),
        rates_(numbers_ * stages) {
    for (std::size_t m = 0; m < stages; ++m)
      for (std::size_t n = 0; n < numbers_; ++n) rates_[m * numbers_ + n] = step.rates[n][m];
  }
  double begin() const override { return t_.hi; }
  std::vector<double> at(double t) const override {
    return values_inside(numbers_, rates_.size() / numbers_, start_, h_,
                         (DoubleDouble(t) - t_).hi / h_,
                         [this](std::size_t n, std::size_t m) { return rates_[m * numbers_ + n]; });
  }
  std::size_t bytes() const override { return sizeof(*this) + rates_.capacity() * sizeof(double); }

 private:
  DoubleDouble t_;
  GenericStages::State start_;
  double h_;
  std::size_t numbers_;
  std::vector<double> rates_;  // by degrees
};

class Steps final : public NumberSteps {
 public:
  Steps(std::shared_ptr<const NumberField> field, double start, std::vector<double> y,
        const Collocation& method)
      : solver_(std::move(field), static_cast<std::size_t>(method.stages), widest_instruction_set(),
                start, std::move(y),
                {{method.tolerance, method.step, method.largest_step}, method.step > 0.0}) {}

  StepOutcome advance(double stop) override { return solver_.advance(stop); }
  void limit_steps(double largest) override { solver_.limit_steps(largest); }
  std::string refusal(StepOutcome outcome) const override { return solver_.refusal(outcome); }
  const DoubleDouble& time() const override { return solver_.time(); }
  double trial() const override { return solver_.trial(); }
  std::span<double> numbers() override { return solver_.state().y; }
  std::span<double> carry() override { return solver_.state().carry; }
  std::shared_ptr<const NumberCurve> curve() override {
    return std::make_shared<const Curve>(solver_.refined(), 2 * solver_.stages());
  }
  int intervals() const override { return static_cast<int>(solver_.stages()); }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }
  void serialize(Archive& bytes) override { solver_.serialize(bytes); }

 private:
  Solver solver_;
};

}  // namespace

std::unique_ptr<NumberSteps> collocation_steps(std::shared_ptr<const NumberField> field,
                                               double start, std::vector<double> y,
                                               const Collocation& method) {
  return std::make_unique<Steps>(std::move(field), start, std::move(y), method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
