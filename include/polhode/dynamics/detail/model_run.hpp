// SPDX-License-Identifier: MIT
// The run of a model.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/dynamics/detail/event_watch.hpp"
#include "polhode/dynamics/detail/frozen_time_splitting.hpp"
#include "polhode/dynamics/detail/model_collocation.hpp"
#include "polhode/dynamics/detail/model_field.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where neither Collocation nor Splitting moves a model: Adaptive, in a precision that it works in.
// DomainError for other methods and precisions.
const Adaptive& adaptive_method(std::string_view model, const Method& method, bool has_wide,
                                bool has_frozen);
// Of a model that has no rates.
[[noreturn]] void refuse_all_but_splitting(std::string_view model);
void refuse_events(std::string_view model, std::size_t count);
// Whether two lists of numbers are equal but for a few roundings of the largest.
bool equal_but_for_rounding(const std::vector<double>& a, const std::vector<double>& b);

template <MotionState S>
std::vector<double> numbers_of(S s) {
  std::vector<double> numbers;
  each_number(s, [&numbers](double& x) { numbers.push_back(x); });
  return numbers;
}

template <class M, class S>
S started_state(const M& model, const S& s) {
  if constexpr (requires { model.started(s); })
    return model.started(s);
  else
    return s;
}

template <Real T, class M, MotionState S = typename M::State>
std::unique_ptr<BasicStepper<S>> model_stepper(const BasicProblem<M>& problem, const S& initial,
                                               const Adaptive& method) {
  using Field = ModelField<M, T>;
  return std::make_unique<AdaptiveStepper<Field, PlainSteps>>(
      std::make_shared<const Field>(problem.system),
      PlainSteps{M::name, !std::isinf(method.largest_step)}, problem.start,
      problem.system.template values<T>(initial),
      StepControl{method.tolerance, method.first_step, method.largest_step});
}

template <class M, MotionState S = typename M::State>
std::unique_ptr<BasicStepper<S>> stepper_of_model(const BasicProblem<M>& problem,
                                                  const S& initial) {
  if constexpr (FrozenModel<M>)
    if (const Splitting* const method = method_of_frozen_models(problem.method))
      return std::make_unique<FixedStepper<FrozenTimeSplitting<M>>>(
          FrozenTimeSplitting<M>{problem.system, splitting_coefficients(method->scheme, false)},
          TimedState<S>{problem.start, initial}, method->step);
  if constexpr (!Model<M>) {
    refuse_all_but_splitting(M::name);
  } else {
    if (const auto* const method = std::get_if<Collocation>(&problem.method))
      return std::make_unique<ModelCollocation<M>>(problem.system, problem.start, initial, *method);
    constexpr bool has_wide = ModelOn<M, DoubleDouble>;
    const Adaptive& method = adaptive_method(M::name, problem.method, has_wide, FrozenModel<M>);
    if constexpr (has_wide)
      if (method.precision == Precision::double_double)
        return model_stepper<DoubleDouble>(problem, initial, method);
    return model_stepper<double>(problem, initial, method);
  }
}

template <class M, MotionState S = typename M::State>
auto watch_of(const BasicProblem<M>& problem) {
  if constexpr (Model<M>) {
    return EventWatch<ModelMotion<M>>(ModelMotion<M>(problem.system), problem.events);
  } else {
    refuse_events(M::name, problem.events.size());
    return NoEvents<S>();
  }
}

template <class M, MotionState S = typename M::State>
auto model_run(const BasicProblem<M>& problem, bool keep_dense, SampleQueue<S>& samples,
               const Progress& progress) {
  require_finite_span("integrate", problem.start, problem.stop);
  require_valid(problem.method);
  for (const BasicEvent<S>& event : problem.events) require_valid(event);
  const S initial = started_state(problem.system, problem.initial);
  std::unique_ptr<BasicStepper<S>> stepper = stepper_of_model(problem, initial);
  const bool was_normal = equal_but_for_rounding(numbers_of(initial), numbers_of(problem.initial));
  auto watch = watch_of(problem);
  return std::make_unique<Run<S, decltype(watch)>>(
      RunSpan<S>{.initial = {problem.start, initial},
                 .stop = problem.stop,
                 .method = method_text(problem.method),
                 .first_look = {problem.start, was_normal ? problem.initial : initial},
                 .continues = problem.continues},
      std::move(watch), std::move(stepper), keep_dense, samples, progress);
}

// What makes the run of a problem.
template <class M, MotionState S = typename M::State>
auto maker_of(const BasicProblem<M>& problem, const Progress& progress) {
  return [&problem, &progress](bool keep_dense, SampleQueue<S>& samples) {
    return model_run(problem, keep_dense, samples, progress);
  };
}

template <class M, MotionState S = typename M::State>
Features model_features(const BasicProblem<M>& problem) {
  std::string parameters;
  if constexpr (requires { problem.system.parameters(); })
    for (const double x : problem.system.parameters()) parameters += number_bytes(x);
  return {{"model", std::string(std::string_view(M::name))},
          {"parameters", parameters},
          {"state", state_bytes(started_state(problem.system, problem.initial))}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
