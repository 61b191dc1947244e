// SPDX-License-Identifier: MIT
// The forms of integrate for a System.
#include "polhode/dynamics/integrate.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <variant>

#include "dynamics/checked_problem.hpp"
#include "dynamics/events/event_search.hpp"
#include "dynamics/steppers.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

Problem checked(const Problem& problem) {
  Problem result = checked_problem("integrate", problem, DamperState::carried);
  for (const Event& event : result.events) require_valid(event);
  return result;
}

Sample first_look(const Problem& given, const Problem& checked) {
  const Quaternion& q = given.initial.q;
  const double excess = (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z) - 1.0;
  const bool is_normal = std::abs(excess) <= 8.0 * std::numeric_limits<double>::epsilon();
  return {checked.start, is_normal ? given.initial : checked.initial};
}

// The method in words, and the terms that it has to ask for one stage after the other.
std::string method_text_for(const System& system, const Method& method) {
  std::string text = method_text(method);
  if (!std::holds_alternative<Collocation>(method)) return text;
  for (const AnyPerturbation& term : system.terms())
    if (!term.is_asked_together()) text += ", \"" + term.name() + "\" stage by stage";
  return text;
}

auto maker(const Problem& problem, const Progress& progress) {
  return [&problem, &progress](bool keep_dense, SampleQueue<SystemState>& samples) {
    const Problem p = checked(problem);
    return std::make_unique<Run<SystemState, SystemWatch>>(
        RunSpan<SystemState>{.initial = {p.start, p.initial},
                             .stop = p.stop,
                             .method = method_text_for(p.system, p.method),
                             .first_look = first_look(problem, p),
                             .continues = p.continues},
        SystemWatch(SystemMotion(p.system), p.events), make_stepper(p), keep_dense, samples,
        progress);
  };
}

Features features(const Problem& problem, const SaveAt& times) {
  const Problem p = checked(problem);
  const auto bytes_of = [](auto... x) {
    Archive bytes;
    bytes.all(x...);
    return bytes.bytes();
  };
  std::string terms;
  for (const AnyPerturbation& term : p.system.terms()) terms += bytes_of(term.name());
  const std::optional<KaneDamper>& damper = p.system.damper();
  return run_features(
      p, times,
      {{"state", state_bytes<RotorState>(p.initial)},
       {"body", bytes_of(p.system.body().moments())},
       {"terms", terms},
       {"damper", damper ? bytes_of(damper->moment(), damper->friction()) : std::string()},
       {"damper_rate", bytes_of(p.initial.damper_rate)}});
}

Trajectory streamed(const Problem& problem, const SaveAt& times, const Checkpoint* from,
                    const Streams& streams, const Progress& progress) {
  return streamed_run(problem, times, from, streams, features(problem, times),
                      maker(problem, progress));
}

}  // namespace
}  // namespace detail

Trajectory integrate(const Problem& problem, const Keep& keep, const Progress& progress) {
  return detail::kept_run(problem, keep, detail::maker(problem, progress));
}
Trajectory integrate(const Problem& problem, const SaveAt& samples, const SampleSink& sink,
                     const Progress& progress) {
  return detail::run_into(problem, samples, sink, detail::maker(problem, progress));
}
Trajectory integrate(const Problem& problem, const SaveAt& samples, const Streams& streams,
                     const Progress& progress) {
  return detail::streamed(problem, samples, nullptr, streams, progress);
}
Trajectory resume(const Problem& problem, const SaveAt& samples, const Checkpoint& from,
                  const Streams& streams, const Progress& progress) {
  return detail::streamed(problem, samples, &from, streams, progress);
}

}  // namespace v0
}  // namespace polhode
