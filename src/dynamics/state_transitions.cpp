// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include "dynamics/detail/checked_problem.hpp"
#include "dynamics/detail/finite.hpp"
#include "dynamics/detail/sample_times.hpp"
#include "dynamics/detail/smooth_step.hpp"
#include "dynamics/detail/splitting_map.hpp"
#include "dynamics/detail/step_control.hpp"
#include "dynamics/detail/step_jumps.hpp"
#include "free/hub_tangent.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;

void require_terms(const Problem& problem) {
  for (const AnyPerturbation& term : problem.system.terms())
    if (!term.supports_any_real())
      throw DomainError("state_transitions: term \"" + term.name() +
                        "\" works on double alone: write it as a template on the number type");
}

TransitionSample sample_at(double t, const detail::RotorValues<Tangent>& y) {
  BasicRotorState<Tangent> s = detail::rotor_state<Tangent>(y);
  s.q = normalized(s.q);
  return {t,
          {{s.q.w.value, s.q.x.value, s.q.y.value, s.q.z.value},
           {s.g.x.value, s.g.y.value, s.g.z.value}},
          detail::hub_tangent(s)};
}

void require_finite(double t, const RotorState& s) {
  if (detail::is_finite(s.g) && std::isfinite(s.q.w + s.q.x + s.q.y + s.q.z)) return;
  throw DomainError("state_transitions: the state is not finite at t = " + number_text(t) +
                    ": take a smaller step, or see whether a term is finite there");
}

constexpr const char* unknown_jump = "its transition matrix is not known; take differences of runs";

// By the variational equations, which are those of a dual state.
struct Transitions {
  const Problem& problem;
  const std::vector<double>& times;
  const Progress& progress;

  void tell(double t) const {
    if (progress) progress(t);
  }

  std::vector<TransitionSample> operator()(const Adaptive& method) const {
    if (method.tolerance < 1e-15)
      throw DomainError("state_transitions: tolerance " + number_text(method.tolerance) +
                        " must be from 1e-15: derivatives are carried in double");
    const detail::Breakpoints breakpoints(problem.system);
    detail::SwitchWatch switches(problem.system, unknown_jump);
    using Field = detail::RotorField<Tangent>;
    AdaptiveRungeKutta<Verner98, Tangent, 7, detail::SmoothField<Field>, detail::RotorErrorSize>
        solver({std::make_shared<const Field>(problem.system)}, {}, problem.start,
               detail::rotor_values<Tangent>(with_variables(problem.initial)),
               detail::step_control(problem, method));
    std::vector<TransitionSample> rows;
    for (const double t : times) {
      while (solver.time() != DoubleDouble(t)) {
        const std::string advice =
            detail::smooth_step(solver, *solver.field().field, breakpoints, switches, t);
        if (!advice.empty()) throw DomainError("state_transitions: " + advice);
        tell(solver.time().hi);
      }
      rows.push_back(sample_at(t, solver.state().y));
    }
    return rows;
  }

  // The derivative of what the splitting does, step by step: symplectic as the method is.
  std::vector<TransitionSample> operator()(const Splitting& method) const {
    const detail::SplittingMap map(problem.system, method.scheme);
    detail::SplittingState now = map.start(problem.start, problem.initial);
    const double step = std::copysign(method.step, problem.stop - problem.start);
    Matrix6 transition = Matrix6::identity();
    detail::StepJumps jumps(problem.system, unknown_jump);
    const auto stepped = [&](double h) {
      const detail::SplittingState next = map.stepped(now, h);
      require_finite(next.t.hi, map.state(next));
      return next;
    };
    const auto require_none = [](const std::string& jump) {
      if (!jump.empty()) throw DomainError("state_transitions: " + jump);
    };
    std::vector<TransitionSample> rows;
    for (const double t : times) {
      const auto rest = [&] { return (t - now.t.hi) - now.t.lo; };
      while (std::abs(rest()) > std::abs(step)) {  // what is left is a part of a step, not kept
        if (now.t.hi + step == now.t.hi)
          throw DomainError("state_transitions: step " + number_text(method.step) +
                            " is below the rounding of t = " + number_text(now.t.hi));
        const detail::SplittingState next = stepped(step);
        require_none(jumps.seen(map, now, step, next));
        transition = map.step_transition(now, step) * transition;
        now = next;
        tell(now.t.hi);
      }
      const detail::SplittingState there = stepped(rest());
      require_none(jumps.seen_in_part(map, now, rest(), there));
      rows.push_back({t, map.state(there), map.step_transition(now, rest()) * transition});
      tell(t);
    }
    return rows;
  }

  // The motion is the same to the tolerance; its variational equations need no constants.
  std::vector<TransitionSample> operator()(const VariationOfConstants& method) const {
    return (*this)(Adaptive{.tolerance = method.tolerance, .largest_step = method.largest_step});
  }
};

}  // namespace

std::vector<TransitionSample> state_transitions(const Problem& problem, const SaveAt& samples,
                                                const Progress& progress) {
  require_terms(problem);
  const Problem checked = detail::checked_problem("state_transitions", problem);
  const std::vector<double> times = detail::sample_times("state_transitions", checked, samples);
  return std::visit(Transitions{checked, times, progress}, checked.method);
}

}  // namespace v0
}  // namespace polhode
