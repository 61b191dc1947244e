// SPDX-License-Identifier: MIT
#include "run/ensemble/lockstep.hpp"

#include <exception>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/dynamics/integrate_many.hpp"
#include "polhode/error.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// What would have been thrown by the run alone.
std::string refusal_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const DomainError& error) {
    return error.what();
  }
}

}  // namespace

bool goes_in_lockstep(const Experiment& experiment) {
  const Rotation* const rotation = std::get_if<Rotation>(&experiment);
  if (rotation == nullptr || rotation->damper || has_events(*rotation)) return false;
  const std::optional<Method> method = propagation_method(*rotation);
  return method && std::holds_alternative<Collocation>(*method) && (*rotation->time)[0] == 0.0;
}

void run_in_lockstep(std::span<const LockstepMember> members, const RowLayout& layout,
                     const Progress& progress) {
  std::vector<DampedProblem> problems;
  std::vector<const LockstepMember*> going;
  for (const LockstepMember& one : members) try {
      problems.push_back(rotor_problem(*one.rotation));
      going.push_back(&one);
    } catch (const DomainError& error) {
      one.member->failure = error.what();
    }
  if (going.empty()) return;
  const Keep keep{.samples = going[0]->rotation->time, .dense = false};
  integrate_many(
      problems.size(),
      std::function<DampedProblem(std::size_t)>([&](std::size_t k) { return problems[k]; }), keep,
      [&](std::size_t k, const DampedBodyRun& run) {
        EnsembleMember& member = *going[k]->member;
        if (!run.trajectory) {
          member.failure = refusal_of(run.thrown);
          return;
        }
        const std::span<const DampedSample> samples = run.trajectory->samples();
        const RowOrigin origin{problems[k].system, initial_energy(problems[k])};
        member.rows.resize(samples.size() * layout.width());
        layout.write_rows(origin, samples, member.rows);
        if (!run.trajectory->outcome().ok()) member.failure = run.trajectory->outcome().advice;
      },
      progress);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
