// SPDX-License-Identifier: MIT
// The stepper of Adaptive, of a field with a damper or without. Each is made in a source of its
// own: beside the other, the compiler takes less of the inner loop in line.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/detail/adaptive_field.hpp"
#include "dynamics/detail/smooth_step.hpp"
#include "dynamics/detail/step_control.hpp"
#include "dynamics/detail/stepper.hpp"
#include "polhode/ode/adaptive_runge_kutta.hpp"
#include "polhode/ode/verner98.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::unique_ptr<Stepper> make_damper_stepper(const Problem& problem, const Adaptive& method);

template <class Field>
using State = CompensatedState<typename Field::Number, std::tuple_size_v<typename Field::Values>>;

// The state inside a step is that of a shorter step: of the order of the method, and nothing is
// kept but where the step began.
template <class Field>
class ShorterStep final : public DenseStep {
 public:
  ShorterStep(SmoothField<Field> field, const DoubleDouble& t0, const State<Field>& start,
              const Sample& end)
      : DenseStep(t0.hi, end.t), field_(std::move(field)), t0_(t0), start_(start), end_(end) {}

  RotorState at(double t) const override { return sample(t).s; }
  Sample sample(double t) const override {
    if (t == t1()) return end_;
    const double h = (DoubleDouble(t) - t0_).hi;
    const typename Field::Values rate = field_(t0_, start_.y);
    State<Field> state = start_;
    state.add(runge_kutta_step<Verner98>(field_, t0_, start_.y, rate, h).increment);
    return {t, rounded(state.y), damper_rate_of(*field_.field, state.y)};
  }

 private:
  SmoothField<Field> field_;
  DoubleDouble t0_;
  State<Field> start_;
  Sample end_;
};

template <class Field>
class AdaptiveStepper final : public Stepper {
  using T = typename Field::Number;
  using Values = typename Field::Values;

 public:
  AdaptiveStepper(const Problem& problem, const Adaptive& method)
      : field_(std::make_shared<const Field>(problem.system)),
        breakpoints_(problem.system),
        switches_(problem.system),
        solver_({field_}, error_size(*field_), problem.start,
                start_values(*field_, widened(problem.initial), problem.damper_rate),
                step_control(problem, method)),
        begin_(problem.start),
        start_(solver_.state()),
        tolerance_(method.tolerance) {}

  std::string advance(double stop) override {
    const DoubleDouble begin = solver_.time();
    const State<Field> start = solver_.state();
    const std::string advice = smooth_step(solver_, *field_, breakpoints_, switches_, stop);
    if (!advice.empty()) return advice;
    begin_ = begin;
    start_ = start;
    restore_norm(solver_.state());
    return {};
  }
  double time() const override { return solver_.time().hi; }
  RotorState state() const override { return rounded(solver_.state().y); }
  Vec3 damper_rate() const override { return damper_rate_of(*field_, solver_.state().y); }
  std::shared_ptr<const DenseStep> dense(bool) override {
    return std::make_shared<const ShorterStep<Field>>(solver_.field(), begin_, start_,
                                                      Sample{time(), state(), damper_rate()});
  }
  // A step of order 9 is half a radian of the fastest motion at 1e-12, whatever causes it.
  int intervals() const override {
    return static_cast<int>(std::ceil(std::pow(tolerance_ / 1e-12, 1.0 / 9.0)));
  }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }
  void transfer(StateBytes& bytes) override {
    solver_.transfer(bytes);
    SmoothStretch& stretch = solver_.field().stretch;  // of the step made last
    bytes.all(begin_, start_.y, start_.carry, stretch.from, stretch.to);
    switches_.transfer(bytes);
    switches_.transfer(bytes, solver_.field().sides);
  }

 private:
  static BasicRotorState<T> widened(const RotorState& s) {
    const BasicQuaternion<T> q{T(s.q.w), T(s.q.x), T(s.q.y), T(s.q.z)};
    return {normalized(q), {T(s.g.x), T(s.g.y), T(s.g.z)}};
  }

  std::shared_ptr<const Field> field_;
  Breakpoints breakpoints_;
  SwitchWatch switches_;
  AdaptiveRungeKutta<Verner98, T, std::tuple_size_v<Values>, SmoothField<Field>,
                     decltype(error_size(std::declval<const Field&>()))>
      solver_;
  DoubleDouble begin_;  // of the step made last
  State<Field> start_;
  double tolerance_;
};

template <template <class> class Field>
std::unique_ptr<Stepper> stepper_of(const Problem& problem, const Adaptive& method) {
  if (method.precision == Precision::compensated)
    return std::make_unique<AdaptiveStepper<Field<double>>>(problem, method);
  return std::make_unique<AdaptiveStepper<Field<DoubleDouble>>>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
