// SPDX-License-Identifier: MIT

#include "dynamics/checked_problem.hpp"
#include "dynamics/sampled_run.hpp"
#include "dynamics/transition/transition_steppers.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

void require_terms(const Problem& problem) {
  for (const AnyPerturbation& term : problem.system.terms())
    if (!term.supports_any_real())
      throw DomainError("state_transitions: term \"" + term.name() +
                        "\" works on double alone: write it as a template on the number type");
}

}  // namespace

std::vector<TransitionSample> state_transitions(const Problem& problem, const SaveAt& samples,
                                                const Progress& progress) {
  require_terms(problem);
  Problem checked =
      detail::checked_problem("state_transitions", problem, detail::DamperState::refused);
  const std::vector<double> times = detail::sample_times("state_transitions", checked, samples);
  checked.method = detail::derivative_method("state_transitions", "derivatives", checked.method);
  const BasicTrajectory<TransitionState> run =
      detail::sampled_run(detail::transition_stepper(checked), method_text(checked.method), times,
                          progress, detail::steps_to_samples(checked.method));
  if (!run.outcome().ok()) throw DomainError("state_transitions: " + run.outcome().advice);
  std::vector<TransitionSample> rows;
  for (const BasicSample<TransitionState>& at : run.samples())
    rows.push_back({at.t, at.s.rotor, at.s.extra});
  return rows;
}

}  // namespace v0
}  // namespace polhode
