// SPDX-License-Identifier: MIT
#include "run/ensemble/ensemble_origin.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "polhode/run/run.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t longest_text = 1000;

std::vector<std::string> notes_of(const ScenarioEnsemble& ensemble) {
  const EnsemblePlan& plan = ensemble.plan();
  std::vector<std::string> notes = {"ensemble: " + std::to_string(plan.size) + " members, seed " +
                                    std::to_string(plan.seed) + ", chunks of " +
                                    std::to_string(plan.chunk)};
  for (const EnsembleVaried& one : plan.varied) {
    std::string keys;
    for (const std::string& key : one.keys) keys += (keys.empty() ? "" : ", ") + key;
    notes.push_back("varied: " + keys + ": " + printable(one.text, longest_text));
  }
  return notes;
}

// A note of a branch, constant along a free motion, is of the file's own.
void add_branches(const Scenario& scenario, std::vector<std::string>& notes) {
  const std::size_t own = notes.size();
  for (const std::string& group : scenario.output.columns)
    if (chart_named(group, scenario.document.kinds->charts()) != nullptr &&
        std::any_of(notes.begin(), notes.begin() + static_cast<std::ptrdiff_t>(own),
                    [&](const std::string& note) { return note.starts_with(group + ": "); }))
      notes.push_back("the branch of " + group +
                      " is that of the file's own run; those of members may be others");
}

}  // namespace

std::vector<ColumnGroup> row_groups_of(const ScenarioEnsemble& ensemble) {
  std::vector<ColumnGroup> groups = {{"member", {{"member", "1"}}}};
  const std::vector<std::string> keys = ensemble.plan().keys(), units = ensemble.plan().units();
  if (ensemble.plan().keep == EnsembleKeep::final)
    for (std::size_t i = 0; i < keys.size(); ++i)
      groups.push_back({keys[i], {{keys[i], units[i]}}});
  const std::vector<ColumnGroup>& rows = ensemble.row_groups();
  groups.insert(groups.end(), rows.begin(), rows.end());
  return groups;
}

Provenance provenance_of(const ScenarioEnsemble& ensemble, const StatisticsFrame* frame) {
  Provenance origin = provenance(ensemble.scenario());
  std::vector<std::string> notes = notes_of(ensemble);
  add_branches(ensemble.scenario(), origin.notes);
  if (frame != nullptr)
    for (std::string& note : frame->notes()) notes.push_back(std::move(note));
  origin.notes.insert(origin.notes.end(), notes.begin(), notes.end());
  return origin;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
