// SPDX-License-Identifier: MIT
// The run of a problem of a System: of a rotor, or of a rotor with its damper.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "dynamics/checked_problem.hpp"
#include "dynamics/events/term_motion.hpp"
#include "dynamics/steppers.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline RotorMotion motion_of(const Problem& p) { return RotorMotion(p.system); }
inline DamperMotion motion_of(const DampedProblem& p) { return DamperMotion(p.system); }

template <MotionState S>
BasicProblem<System, S> checked(const BasicProblem<System, S>& problem) {
  BasicProblem<System, S> result = checked_problem("integrate", problem, DamperState::carried);
  for (const BasicEvent<S>& event : result.events) require_valid(event);
  return result;
}

template <MotionState S>
BasicSample<S> first_look(const BasicProblem<System, S>& given,
                          const BasicProblem<System, S>& checked) {
  const Quaternion& q = rotor_of(given.initial).q;
  const double excess = (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z) - 1.0;
  const bool is_normal = std::abs(excess) <= 8.0 * std::numeric_limits<double>::epsilon();
  return {checked.start, is_normal ? given.initial : checked.initial};
}

template <MotionState S>
using SystemWatch = EventWatch<decltype(motion_of(std::declval<BasicProblem<System, S>>()))>;
template <MotionState S>
using SystemRun = Run<S, SystemWatch<S>>;

// The method in words, and the terms that it has to ask for one stage after the other.
inline std::string method_text_for(const System& system, const Method& method) {
  std::string text = method_text(method);
  if (!std::holds_alternative<Collocation>(method)) return text;
  for (const AnyPerturbation& term : system.terms())
    if (!term.is_asked_together()) text += ", \"" + term.name() + "\" stage by stage";
  return text;
}

template <MotionState S>
std::unique_ptr<SystemRun<S>> system_run(const BasicProblem<System, S>& problem, bool keep_dense,
                                         SampleQueue<S>& samples, const Progress& progress) {
  const BasicProblem<System, S> p = checked(problem);
  return std::make_unique<SystemRun<S>>(RunSpan<S>{.initial = {p.start, p.initial},
                                                   .stop = p.stop,
                                                   .method = method_text_for(p.system, p.method),
                                                   .first_look = first_look(problem, p),
                                                   .continues = p.continues},
                                        SystemWatch<S>(motion_of(p), p.events), make_stepper(p),
                                        keep_dense, samples, progress);
}

// What makes it.
template <MotionState S>
auto system_maker(const BasicProblem<System, S>& problem, const Progress& progress) {
  return [&problem, &progress](bool keep_dense, SampleQueue<S>& samples) {
    return system_run(problem, keep_dense, samples, progress);
  };
}

template <MotionState S>
Features system_features(const BasicProblem<System, S>& problem, const SaveAt& times) {
  const BasicProblem<System, S> p = checked(problem);
  const auto bytes_of = [](auto... x) {
    StateBytes bytes;
    bytes.all(x...);
    return bytes.bytes();
  };
  std::string terms;
  for (const AnyPerturbation& term : p.system.terms()) terms += bytes_of(term.name());
  const std::optional<KaneDamper>& damper = p.system.damper();
  Features moving{
      {"state", state_bytes(rotor_of(p.initial))},
      {"body", bytes_of(p.system.body().moments())},
      {"terms", terms},
      {"damper", damper ? bytes_of(damper->moment(), damper->friction()) : std::string()}};
  if constexpr (std::is_same_v<S, DampedRotorState>)
    moving.emplace_back("damper_rate", bytes_of(p.initial.damper_rate));
  return run_features(p, times, std::move(moving));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
