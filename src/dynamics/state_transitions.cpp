// SPDX-License-Identifier: MIT
#include <string>
#include <utility>

#include "dynamics/checked_problem.hpp"
#include "dynamics/sample_times.hpp"
#include "dynamics/sampled_run.hpp"
#include "dynamics/transition/transition_steppers.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using Stepper = detail::BasicStepper<TransitionState>;

void require_terms(const Problem& problem) {
  for (const AnyPerturbation& term : problem.system.terms())
    if (!term.supports_any_real())
      throw DomainError("state_transitions: term \"" + term.name() +
                        "\" works on double alone: write it as a template on the number type");
}

struct StepperOf {
  const Problem& problem;

  std::unique_ptr<Stepper> operator()(const Adaptive& method) const {
    if (method.tolerance < 1e-15)
      throw DomainError("state_transitions: tolerance " + detail::number_text(method.tolerance) +
                        " must be from 1e-15: derivatives are carried in double");
    return detail::transition_stepper(problem, method);
  }
  std::unique_ptr<Stepper> operator()(const Splitting& method) const {
    return detail::transition_stepper(problem, method);
  }
  // The motion is the same to the tolerance; its variational equations need no constants.
  std::unique_ptr<Stepper> operator()(const VariationOfConstants& method) const {
    return (*this)(Adaptive{.tolerance = method.tolerance, .largest_step = method.largest_step});
  }
};

}  // namespace

std::vector<TransitionSample> state_transitions(const Problem& problem, const SaveAt& samples,
                                                const Progress& progress) {
  require_terms(problem);
  const Problem checked =
      detail::checked_problem("state_transitions", problem, detail::DamperState::refused);
  const std::vector<double> times = detail::sample_times("state_transitions", checked, samples);
  const BasicTrajectory<TransitionState> run = detail::sampled_run(
      std::visit(StepperOf{checked}, checked.method), method_text(checked.method), times, progress);
  if (!run.outcome().ok()) throw DomainError("state_transitions: " + run.outcome().advice);
  std::vector<TransitionSample> rows;
  for (const BasicSample<TransitionState>& at : run.samples())
    rows.push_back({at.t, at.s.rotor, at.s.transition});
  return rows;
}

}  // namespace v0
}  // namespace polhode
