// SPDX-License-Identifier: MIT
// The stepper of Adaptive, for every field: the equations of motion as an ode sees them, an array
// of numbers and its rates.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "polhode/detail/ode/adaptive_runge_kutta.hpp"
#include "polhode/detail/ode/verner98.hpp"
#include "polhode/dynamics/detail/stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A `Field` has the types Number, Values (an array of them) and State, and says
//   Values operator()(const DoubleDouble& t, const Values& y) const   the rates
//   State state(const Values& y) const                                what y stands for
//   double error_size(error, y, increment) const                      of a step, all three Values
//   void settle(CompensatedState<Number, N>& s) const                 after a step: invariants
template <class Field>
using FieldState =
    CompensatedState<typename Field::Number, std::tuple_size_v<typename Field::Values>>;

template <class Field>
struct FieldErrorSize {
  std::shared_ptr<const Field> field;
  double operator()(const typename Field::Values& error, const typename Field::Values& y,
                    const typename Field::Values& increment) const {
    return field->error_size(error, y, increment);
  }
};

// The state inside a step is that of a shorter step: of the order of the method, and nothing is
// kept but where the step began. `Rates` are those of the field, as they were in that step.
template <class Field, class Rates>
class ShorterStep final : public BasicDenseStep<typename Field::State> {
 public:
  using State = typename Field::State;

  ShorterStep(Rates rates, const DoubleDouble& t0, const FieldState<Field>& start,
              const BasicSample<State>& end)
      : BasicDenseStep<State>(t0.hi, end.t),
        rates_(std::move(rates)),
        t0_(t0),
        start_(start),
        end_(end) {}

  State at(double t) const override {
    if (t == this->t1()) return end_.s;
    const double h = (DoubleDouble(t) - t0_).hi;
    const typename Field::Values rate = rates_(t0_, start_.y);
    FieldState<Field> state = start_;
    state.add(runge_kutta_step<Verner98>(rates_, t0_, start_.y, rate, h).increment);
    return rates_.field->state(state.y);
  }

  std::size_t bytes() const override { return sizeof(*this); }

 private:
  Rates rates_;
  DoubleDouble t0_;
  FieldState<Field> start_;
  BasicSample<State> end_;
};

// `Steps` makes one step of the solver:
//   auto rates(std::shared_ptr<const Field>) const     a callable with a member `field`
//   std::string advance(solver, field, stop)           empty, or why no step was made
//   void serialize(Archive&, rates)                    what it and the rates keep between steps
template <class Field, class Steps>
class AdaptiveStepper final : public BasicStepper<typename Field::State> {
 public:
  using State = typename Field::State;
  using Values = typename Field::Values;
  using Rates = decltype(std::declval<const Steps&>().rates(std::shared_ptr<const Field>()));

  AdaptiveStepper(std::shared_ptr<const Field> field, Steps steps, double start, const Values& y,
                  const StepControl& control)
      : field_(std::move(field)),
        steps_(std::move(steps)),
        solver_(steps_.rates(field_), {field_}, start, y, control),
        begin_(start),
        start_(solver_.state()),
        tolerance_(control.tolerance) {}

  std::string advance(double stop) override {
    const DoubleDouble begin = solver_.time();
    const FieldState<Field> start = solver_.state();
    std::string advice = steps_.advance(solver_, *field_, stop);
    if (!advice.empty()) return advice;
    begin_ = begin;
    start_ = start;
    field_->settle(solver_.state());
    return advice;
  }
  double time() const override { return solver_.time().hi; }
  State state() const override { return field_->state(solver_.state().y); }
  std::shared_ptr<const BasicDenseStep<State>> dense(bool) override {
    return std::make_shared<const ShorterStep<Field, Rates>>(solver_.field(), begin_, start_,
                                                             BasicSample<State>{time(), state()});
  }
  // A step of order 9 is half a radian of the fastest motion at 1e-12, whatever causes it.
  int intervals() const override {
    return static_cast<int>(std::ceil(std::pow(tolerance_ / 1e-12, 1.0 / 9.0)));
  }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }
  void serialize(Archive& bytes) override {
    solver_.serialize(bytes);
    bytes.all(begin_, start_.y, start_.carry);
    steps_.serialize(bytes, solver_.field());
  }

 private:
  std::shared_ptr<const Field> field_;
  Steps steps_;
  AdaptiveRungeKutta<Verner98, typename Field::Number, std::tuple_size_v<Values>, Rates,
                     FieldErrorSize<Field>>
      solver_;
  DoubleDouble begin_;  // of the step made last
  FieldState<Field> start_;
  double tolerance_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
