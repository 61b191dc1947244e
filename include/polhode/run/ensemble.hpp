// SPDX-License-Identifier: MIT
// ScenarioEnsemble: a scenario with a table [ensemble]: the runs of its members, of which each can
// be asked for alone, in any order.
//
// Equations   those of the scenario; of what is drawn those of Draws (polhode/ensemble/draws.hpp).
// Units       those of the scenario; drawn numbers in the units that their keys have in it.
// Domain      any kind of experiment with [time]. A member is the scenario with its numbers; which
//             numbers these are depends on the seed and its index alone. Rows of a member that an
//             event stops end there. Behind the columns of its run they have one for each event:
//             EVENT_first, when it first happened, NaN before and where it has not; and the
//             indicators of chaos that the plan asks for.
// Accuracy    that of the method. What rows have of the run is that of a run of member_text(k), to
//             the last bit.
// Errors      ScenarioError for what is no ensemble. A member that cannot be (a chart refuses its
//             numbers) or cannot go on says why. DomainError for an index outside.
// Cost        its run, and some 20 us to make the experiment again: text is not read twice, and
//             tables, meshes and files are those of the scenario unless a number below them varies.
//             The rows of exact free rotation are evaluated together.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/trajectory/progress.hpp"

namespace polhode {
inline namespace v0 {

struct EnsembleMember {
  std::vector<double> drawn;  // at the keys of the plan
  std::vector<double> rows;   // one after the other, up to where it ended
  std::string failure;        // empty: it did not
};

class ScenarioEnsemble {
 public:
  // `name` stands for the file in messages and outputs.
  ScenarioEnsemble(std::string_view text, const std::string& name,
                   const Kinds& kinds = default_kinds());
  explicit ScenarioEnsemble(Scenario scenario);
  ~ScenarioEnsemble();
  ScenarioEnsemble(const ScenarioEnsemble&) = delete;
  ScenarioEnsemble& operator=(const ScenarioEnsemble&) = delete;

  const Scenario& scenario() const;
  const EnsemblePlan& plan() const { return *scenario().ensemble; }
  std::int64_t size() const { return plan().size; }
  // The columns of the rows of a member, t first.
  const std::vector<ColumnGroup>& row_groups() const;
  // The names of the events that have a column, in its order.
  const std::vector<std::string>& events() const;

  // From any thread. What `progress` throws passes through.
  EnsembleMember member(std::int64_t index, const Progress& progress = {}) const;
  // Members begin to end - 1.
  std::vector<EnsembleMember> members(std::int64_t begin, std::int64_t end,
                                      const Progress& progress = {}) const;
  // Of the scenario as it stands; nothing is drawn.
  EnsembleMember base(const Progress& progress = {}) const;
  // The text of the scenario with the numbers of a member, without its [ensemble].
  std::string member_text(std::int64_t index) const;
  // The scenario of this text, complete: it can be run, mapped and changed.
  Scenario member_scenario(std::int64_t index) const;
  // The same for a caller that has the text.
  Scenario member_scenario(std::int64_t index, std::string member_text) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace v0
}  // namespace polhode
