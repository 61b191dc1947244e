// SPDX-License-Identifier: MIT
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/detail/scenario/varied_scenario.hpp"
#include "polhode/error.hpp"
#include "polhode/run/detail/run_state.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/run.hpp"
#include "run/ensemble/member_columns.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr std::int64_t most_times = 1'000'000;  // that are held

// Rows in memory.
class RowSink : public Sink {
 public:
  explicit RowSink(std::vector<double>& rows) : rows_(rows) {}
  void push(std::span<const double> rows) override {
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }
  void finish() override {}

 private:
  std::vector<double>& rows_;
};

// DomainError for an index that no member has.
void require_member(const ScenarioEnsemble& ensemble, std::int64_t index) {
  if (index >= 0 && index < ensemble.size()) return;
  throw DomainError(ensemble.scenario().document.name + ": got member " + std::to_string(index) +
                    "; expected 0 to " + std::to_string(ensemble.size() - 1));
}

Scenario with_ensemble(Scenario scenario) {
  if (!scenario.ensemble)
    throw ScenarioError(
        scenario.document.path +
        ": ensemble: got nothing; expected a table [ensemble] with tables [[ensemble.vary]]");
  return scenario;
}

// Exact free rotation in inertial axes without events: all rows at a time.
bool is_closed_form(const Experiment& experiment) {
  const Rotation* const rotation = std::get_if<Rotation>(&experiment);
  return rotation != nullptr && !propagation_method(*rotation) && !has_events(*rotation) &&
         rotation->frame.is_inertial();
}

}  // namespace

struct ScenarioEnsemble::Parts {
  explicit Parts(Scenario read)
      : scenario(std::move(read)),
        keys(scenario.ensemble->keys()),
        varied(scenario, keys),
        added(scenario),
        groups(io::row_groups(scenario)) {
    for (ColumnGroup& group : added.groups()) groups.push_back(std::move(group));
    const SaveAt& rows = *row_times(scenario);
    if (!is_closed_form(scenario.experiment) || rows.size() > most_times) return;
    layout.emplace(row_layout(scenario));
    for (std::int64_t k = 0; k < rows.size(); ++k) times.push_back(rows[k]);
  }

  // Of an experiment like that of the scenario.
  void run(const Experiment& experiment, const Progress& progress, EnsembleMember& member) const {
    if (!times.empty() && is_closed_form(experiment)) {
      member.rows.resize(times.size() * layout->width());
      layout->write_rows(free_rotation(std::get<Rotation>(experiment)), times, member.rows);
      added.add(experiment, {}, progress, member);
      return;
    }
    const Scenario own{scenario.document, experiment, scenario.output};
    std::unique_ptr<Sink> sink = std::make_unique<RowSink>(member.rows);
    RunReport report;
    try {
      report = detail::run_rows(own, {&sink, 1}, {.progress = progress});
      if (!report.outcome.ok()) member.failure = report.outcome.advice;
    } catch (const DomainError& error) {
      member.failure = error.what();
    }
    added.add(experiment, report, progress, member);
  }

  Scenario scenario;
  std::vector<std::string> keys;
  VariedScenario varied;
  detail::MemberColumns added;
  std::vector<ColumnGroup> groups;
  // Members whose motion has a closed form.
  std::optional<RowLayout> layout;
  std::vector<double> times;
};

ScenarioEnsemble::ScenarioEnsemble(Scenario scenario)
    : parts_(std::make_unique<Parts>(with_ensemble(std::move(scenario)))) {
  require_ensemble_columns(parts_->scenario, row_groups(), events());
}

ScenarioEnsemble::ScenarioEnsemble(std::string_view text, const std::string& name,
                                   const Kinds& kinds)
    : ScenarioEnsemble(scenario_from_text(text, name, kinds)) {}

ScenarioEnsemble::~ScenarioEnsemble() = default;

const Scenario& ScenarioEnsemble::scenario() const { return parts_->scenario; }
const std::vector<ColumnGroup>& ScenarioEnsemble::row_groups() const { return parts_->groups; }
const std::vector<std::string>& ScenarioEnsemble::events() const { return parts_->added.events(); }

EnsembleMember ScenarioEnsemble::member(std::int64_t index, const Progress& progress) const {
  require_member(*this, index);
  EnsembleMember member{plan().numbers(index), {}, {}};
  try {
    parts_->run(parts_->varied.experiment(member.drawn), progress, member);
  } catch (const DomainError& error) {
    member.failure = error.what();
  }
  return member;
}

std::vector<EnsembleMember> ScenarioEnsemble::members(std::int64_t begin, std::int64_t end,
                                                      const Progress& progress) const {
  std::vector<EnsembleMember> all;
  for (std::int64_t index = begin; index < end; ++index) all.push_back(member(index, progress));
  return all;
}

EnsembleMember ScenarioEnsemble::base(const Progress& progress) const {
  EnsembleMember member;
  try {
    parts_->run(scenario().experiment, progress, member);
  } catch (const DomainError& error) {
    member.failure = error.what();
  }
  return member;
}

std::string ScenarioEnsemble::member_text(std::int64_t index) const {
  require_member(*this, index);
  return "# Member " + std::to_string(index) + " of " +
         detail::printable(scenario().document.name, 200) + ", " + std::to_string(size()) +
         " members, seed " + std::to_string(plan().seed) + "\n" +
         parts_->varied.text(plan().numbers(index));
}

Scenario ScenarioEnsemble::member_scenario(std::int64_t index) const {
  return member_scenario(index, member_text(index));
}

Scenario ScenarioEnsemble::member_scenario(std::int64_t index, std::string text) const {
  require_member(*this, index);
  return parts_->varied.scenario(plan().numbers(index), std::move(text));
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
