// SPDX-License-Identifier: MIT
// A member of an ensemble alone, into files.
#include <memory>
#include <utility>
#include <vector>

#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/kept_outputs.hpp"

namespace polhode {
inline namespace v0 {

// Opened when the rows are there: a member that cannot be leaves no file.
MemberReport write_member(const ScenarioEnsemble& ensemble, std::int64_t index,
                          const std::vector<std::string>& outputs, RunBegin begin,
                          const BeginWords& words) {
  const Document& file = ensemble.scenario().document;
  const Scenario alone = scenario_from_text(ensemble.member_text(index), file.path, *file.kinds);
  const Provenance origin = provenance(alone);
  const std::vector<ColumnGroup>& groups = ensemble.row_groups();
  detail::KeptSetup setup =
      detail::setup_of_tables({"run", "runs the member anew"}, alone, groups, outputs);
  setup.begin = begin;
  setup.words = words;
  detail::KeptOutputs kept(std::move(setup), origin);
  if (kept.is_complete()) return {.was_complete = true};
  const EnsembleMember member = ensemble.member(index);
  kept.with_remedy([&] {
    const std::vector<std::unique_ptr<Sink>> sinks =
        detail::opened_tables(kept, alone, groups, origin);
    for (const std::unique_ptr<Sink>& sink : sinks) {
      sink->push(member.rows);
      if (member.failure.empty()) sink->finish();
    }
    kept.forget();  // which asks the sinks
  });
  return {.failure = member.failure};
}

}  // namespace v0
}  // namespace polhode
