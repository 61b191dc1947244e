// SPDX-License-Identifier: MIT
// A model moved by Collocation.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "polhode/dynamics/detail/model_field.hpp"
#include "polhode/dynamics/detail/number_steps.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Model M>
class NumbersOfModel final : public NumberField {
 public:
  using Field = ModelField<M, double>;
  using Values = typename Field::Values;

  explicit NumbersOfModel(const M& model) : field_{model} {}

  const Field& field() const { return field_; }
  static Values values(std::span<const double> y) {
    Values v{};
    std::copy_n(y.begin(), v.size(), v.begin());
    return v;
  }

  void rates(const DoubleDouble& t, std::span<const double> y,
             std::span<double> to) const override {
    const Values f = field_(t, values(y));
    std::copy(f.begin(), f.end(), to.begin());
  }
  double error_size(std::span<const double> error, std::span<const double> y,
                    std::span<const double> increment) const override {
    return field_.error_size(values(error), values(y), values(increment));
  }

 private:
  Field field_;
};

template <Model M>
class ModelCollocation final : public BasicStepper<typename M::State> {
 public:
  using State = typename M::State;
  using Numbers = NumbersOfModel<M>;

  ModelCollocation(const M& model, double start, const State& initial, const Collocation& method)
      : numbers_(std::make_shared<const Numbers>(model)),
        steps_{M::name, method.step > 0.0 || !std::isinf(method.largest_step)} {
    const auto y = model.template values<double>(initial);
    solver_ = collocation_steps(numbers_, start, std::vector<double>(y.begin(), y.end()), method);
  }

  std::string advance(double stop) override {
    std::string advice = steps_.advance(*solver_, numbers_->field(), stop);
    if (advice.empty()) settle();
    return advice;
  }
  double time() const override { return solver_->time().hi; }
  State state() const override { return state_of(*numbers_, solver_->numbers()); }
  std::shared_ptr<const BasicDenseStep<State>> dense(bool) override {
    return std::make_shared<const Dense>(numbers_, solver_->curve(),
                                         BasicSample<State>{time(), state()});
  }
  int intervals() const override { return solver_->intervals(); }
  Statistics statistics() const override { return solver_->statistics(); }
  void serialize(Archive& bytes) override { solver_->serialize(bytes); }

 private:
  class Dense final : public BasicDenseStep<State> {
   public:
    Dense(std::shared_ptr<const Numbers> numbers, std::shared_ptr<const NumberCurve> curve,
          const BasicSample<State>& end)
        : BasicDenseStep<State>(curve->begin(), end.t),
          numbers_(std::move(numbers)),
          curve_(std::move(curve)),
          end_(end) {}
    State at(double t) const override {
      return t == this->t1() ? end_.s : state_of(*numbers_, curve_->at(t));
    }
    std::size_t bytes() const override { return sizeof(*this) + curve_->bytes(); }

   private:
    std::shared_ptr<const Numbers> numbers_;
    std::shared_ptr<const NumberCurve> curve_;
    BasicSample<State> end_;
  };

  static State state_of(const Numbers& numbers, std::span<const double> y) {
    return numbers.field().state(Numbers::values(y));
  }
  void settle() {
    CompensatedState<double, std::tuple_size_v<typename Numbers::Values>> s{
        Numbers::values(solver_->numbers()), Numbers::values(solver_->carry())};
    numbers_->field().settle(s);
    std::copy(s.y.begin(), s.y.end(), solver_->numbers().begin());
    std::copy(s.carry.begin(), s.carry.end(), solver_->carry().begin());
  }

  std::shared_ptr<const Numbers> numbers_;
  PlainSteps steps_;
  std::unique_ptr<NumberSteps> solver_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
