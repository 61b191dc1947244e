// SPDX-License-Identifier: MIT
// The stepper of Collocation for a state of a System, whatever its stages are.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/adaptive/adaptive_stepper.hpp"
#include "dynamics/adaptive/switching_step.hpp"
#include "dynamics/collocation/collocation_solver.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The step that a collocation has made, as a curve on which edges are searched: its polynomial for
// the search, and that of twice as many stages as the truth.
template <class Solver>
class CollocationCurve final : public SwitchCurve {
 public:
  CollocationCurve(Solver& solver, const typename Solver::Savepoint&, const SwitchWatch& switches)
      : solver_(solver), switches_(switches) {}

  std::vector<double> along(double x) const override {
    return values(solver_.last(), solver_.stages(), x);
  }
  double truly(std::size_t which, double x) const override {
    return values(solver_.refined(), 2 * solver_.stages(), x)[which];
  }
  double rounding(std::size_t which) const override { return switches_.rounding(which); }

 private:
  std::vector<double> values(const typename Solver::Polynomial& step, std::size_t stages,
                             double x) const {
    const auto& field = *solver_.field().field;
    if (x == 1.0) return switches_.values(solver_.time(), field.rotor(solver_.state().y));
    return switches_.values(step.t + x * step.h, field.rotor(step.at(stages, x)));
  }

  Solver& solver_;
  const SwitchWatch& switches_;
};

template <class Stages>
struct CurveOf<BasicCollocationSolver<Stages>> {
  using Type = CollocationCurve<BasicCollocationSolver<Stages>>;
};

// The polynomial of a step, as small as it can be kept.
template <class Stages>
class CollocationDense final : public BasicDenseStep<typename Stages::Field::State> {
 public:
  using Field = typename Stages::Field;
  using State = typename Field::State;

  CollocationDense(std::shared_ptr<const Field> field, const StepPolynomial<Stages>& step,
                   std::size_t stages, const BasicSample<State>& end)
      : BasicDenseStep<State>(step.t.hi, end.t),
        field_(std::move(field)),
        t_(step.t),
        start_(step.start),
        h_(step.h),
        numbers_(step.rates.size()),
        rates_(numbers_ * stages),
        end_(end) {
    for (std::size_t m = 0; m < stages; ++m)
      for (std::size_t n = 0; n < numbers_; ++n) rates_[m * numbers_ + n] = step.rates[n][m];
  }

  State at(double t) const override {
    if (t == this->t1()) return end_.s;
    const double x = (DoubleDouble(t) - t_).hi / h_;
    return field_->state(
        values_inside(numbers_, rates_.size() / numbers_, start_, h_, x,
                      [this](std::size_t n, std::size_t m) { return rates_[m * numbers_ + n]; }));
  }

  std::size_t bytes() const override { return sizeof(*this) + rates_.capacity() * sizeof(double); }

 private:
  std::shared_ptr<const Field> field_;
  DoubleDouble t_;
  typename Stages::State start_;
  double h_;
  std::size_t numbers_;
  std::vector<double> rates_;
  BasicSample<State> end_;
};

inline CollocationControl collocation_control(const System& system, double start,
                                              const Collocation& method) {
  if (method.step > 0.0) return {{method.tolerance, method.step}, true};
  return {step_control(system, start,
                       {.tolerance = method.tolerance, .largest_step = method.largest_step})};
}

template <class Stages>
class CollocationStepper final : public BasicStepper<typename Stages::Field::State> {
 public:
  using Field = typename Stages::Field;
  using State = typename Field::State;
  using Solver = BasicCollocationSolver<Stages>;

  CollocationStepper(std::shared_ptr<const Field> field, SwitchingSteps steps, double start,
                     const typename Stages::Values& y, const Collocation& method,
                     const CollocationControl& control)
      : field_(field),
        steps_(std::move(steps)),
        solver_(std::move(field), static_cast<std::size_t>(method.stages), widest_instruction_set(),
                start, y, control) {}

  std::string advance(double stop) override {
    std::string advice = steps_.advance(solver_, *field_, stop);
    // no norm of q is restored: the method keeps it
    if constexpr (requires { field_->rescale(solver_.state()); })
      if (advice.empty()) field_->rescale(solver_.state());
    return advice;
  }
  double time() const override { return solver_.time().hi; }
  State state() const override { return field_->state(solver_.state().y); }
  std::shared_ptr<const BasicDenseStep<State>> dense(bool) override {
    return std::make_shared<const CollocationDense<Stages>>(
        field_, solver_.refined(), 2 * solver_.stages(), BasicSample<State>{time(), state()});
  }
  // As many as the polynomial has degrees: terms may act faster than the body turns.
  int intervals() const override { return static_cast<int>(solver_.stages()); }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }
  void serialize(Archive& bytes) override {
    solver_.serialize(bytes);
    steps_.serialize(bytes, solver_.field());
  }

 private:
  std::shared_ptr<const Field> field_;
  SwitchingSteps steps_;
  Solver solver_;
};

// For a field of a System, from its numbers at a time. `jumps`: see SwitchWatch.
template <class Stages>
std::unique_ptr<BasicStepper<typename Stages::Field::State>> collocation_stepper(
    std::shared_ptr<const typename Stages::Field> field, double start,
    const typename Stages::Values& y, const Collocation& method, const char* jumps = nullptr) {
  const System& system = field->system();
  return std::make_unique<CollocationStepper<Stages>>(
      std::move(field), SwitchingSteps(system, jumps), start, y, method,
      collocation_control(system, start, method));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
