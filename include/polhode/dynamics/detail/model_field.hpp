// SPDX-License-Identifier: MIT
// A model as the steppers and the watch for events see it.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "polhode/dynamics/detail/adaptive_stepper.hpp"
#include "polhode/dynamics/model.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Why a step of a model could not be made.
std::string model_failure_text(std::string_view name, double t, double h, StepOutcome outcome);

template <Model M, Real T>
struct ModelField {
  using Number = T;
  using Values = ValuesOf<M, T>;
  using State = typename M::State;

  M model;

  Values operator()(const DoubleDouble& t, const Values& y) const { return model.rates(t, y); }
  State state(const Values& y) const { return model.state(y); }
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    return model.error_size(error, y, increment);
  }
  void settle(CompensatedState<T, std::tuple_size_v<Values>>& s) const {
    if constexpr (requires { model.settle(s); }) model.settle(s);
  }
};

// Steps of rates that are smooth everywhere.
template <class Field>
struct PlainRates {
  std::shared_ptr<const Field> field;
  typename Field::Values operator()(const DoubleDouble& t, const typename Field::Values& y) const {
    return (*field)(t, y);
  }
};

struct PlainSteps {
  std::string_view name;  // of the model
  // The method gives the largest step: the time scale of the model is not asked for.
  bool method_limits;

  template <class Field>
  PlainRates<Field> rates(std::shared_ptr<const Field> field) const {
    return {std::move(field)};
  }
  template <class Solver, class Field>
  std::string advance(Solver& solver, const Field& field, double stop) const {
    if constexpr (requires { field.model.time_scale(stop); })
      if (!method_limits) solver.limit_steps(field.model.time_scale(solver.time().hi));
    const StepOutcome outcome = solver.advance(stop);
    if (outcome == StepOutcome::made) return {};
    if constexpr (requires { solver.refusal(outcome); })
      if (std::string own = solver.refusal(outcome); !own.empty()) return own;
    return model_failure_text(name, solver.time().hi, solver.trial(), outcome);
  }
  template <class Rates>
  void serialize(Archive&, Rates&) const {}
};

template <Model M>
class ModelMotion {
 public:
  using State = typename M::State;

  explicit ModelMotion(M model) : model_(std::move(model)) {}

  BasicSample<State> moved(const BasicSample<State>& s, double time) const {
    ++evaluations_;
    auto y = model_.template values<double>(s.s);
    const auto rates = model_.rates(DoubleDouble(s.t), y);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] + time * rates[i];
    return {s.t + time, model_.state(y)};
  }
  double turning_rate(const BasicSample<State>& s, bool) const {
    if constexpr (requires { model_.turning_rate(s.t, s.s); })
      return model_.turning_rate(s.t, s.s);
    else
      return 0.0;
  }
  static State near(const State& to, const State& s) {
    if constexpr (requires { M::near(to, s); })
      return M::near(to, s);
    else
      return s;
  }
  std::int64_t evaluations() const { return evaluations_; }
  void serialize(Archive& bytes) { bytes(evaluations_); }

 private:
  M model_;
  mutable std::int64_t evaluations_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
