// SPDX-License-Identifier: MIT
// An ensemble of a scenario: its members, their numbers, and the scenario of each as text.
#include "polhode/run/ensemble.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/run/detail/run_state.hpp"
#include "polhode/run/run.hpp"
#include "run/ensemble/member_columns.hpp"
#include "scenario/prepared_base.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// Where a number may stand in TOML: that of an array also in { value = [..], unit = ".." }.
std::vector<std::string> places_of(const Value& value, const NumberLocation& at) {
  const std::string index = std::to_string(at.index);
  if (value.key->type == KeyType::number) return {at.path};
  if (value.numbers.size() == 9) {
    const std::string of_row = std::to_string(at.index / 3) + "." + std::to_string(at.index % 3);
    return {at.path + "." + of_row, at.path + ".value." + of_row};
  }
  return {at.path + "." + index, at.path + ".value." + index};
}

// The text with a number at a key; what a fallback has said so far is written out.
std::string with_number(std::string text, const Value& value, const NumberLocation& at,
                        double number) {
  const std::string& unit = value.units[at.index];
  const std::string plain = number_text(number);
  if (!value.is_explicit && value.key->type != KeyType::number)
    text = changed_text(text,
                        std::vector<ScenarioChange>{{at.path, std::string(value.key->fallback)}});
  const std::vector<std::string> places = places_of(value, at);
  for (const std::string& place : places) {
    const bool bare = unit.empty() || &place != &places.front();  // the unit stands behind value
    const std::string written = bare ? plain : "\"" + plain + " " + unit + "\"";
    try {
      return changed_text(text, std::vector<ScenarioChange>{{place, written}});
    } catch (const ChangeError&) {
      if (&place == &places.back()) throw;
    }
  }
  return text;
}

const Value& value_in(const Scenario& scenario, const NumberLocation& at) {
  return scenario.document.checked->values.find(at.path)->second;
}

// DomainError for an index that no member has.
void require_member(const ScenarioEnsemble& ensemble, std::int64_t index) {
  if (index >= 0 && index < ensemble.size()) return;
  throw DomainError(ensemble.scenario().document.name + ": got member " + std::to_string(index) +
                    "; expected 0 to " + std::to_string(ensemble.size() - 1));
}

// The text of a scenario with [ensemble], with the numbers of a member in place of its own and
// without the table. DomainError if the text cannot be changed so that it holds them.
std::string member_text(const Scenario& scenario, std::int64_t index) {
  const EnsemblePlan& plan = *scenario.ensemble;
  const std::vector<std::string> keys = plan.keys();
  const std::vector<double> numbers = plan.numbers(index);
  const Values& values = scenario.document.checked->values;
  std::string text =
      changed_text(scenario.document.text, std::vector<ScenarioChange>{{"ensemble", ""}});
  std::vector<NumberLocation> places;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    places.push_back(*number_location(values, keys[i]));
    text = with_number(std::move(text), value_in(scenario, places[i]), places[i], numbers[i]);
  }
  // A number that reads back as another one would make another member.
  const Scenario made = scenario_from_text(text, scenario.document.path, *scenario.document.kinds);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Value& was = value_in(scenario, places[i]);
    const std::string& unit = was.units[places[i].index];
    const Units& units = scenario.document.units;
    const double core = unit.empty() ? units.to_core(numbers[i], was.key->dimension)
                                     : units.to_core(numbers[i], unit, was.key->dimension);
    if (value_in(made, places[i]).numbers[places[i].index] != core)
      throw DomainError(scenario.document.name + ": member " + std::to_string(index) + ": " +
                        keys[i] + " has no place in the text of the file");
  }
  return "# Member " + std::to_string(index) + " of " + printable(scenario.document.name, 200) +
         ", " + std::to_string(plan.size) + " members, seed " + std::to_string(plan.seed) + "\n" +
         text;
}

}  // namespace
}  // namespace detail

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
        base(scenario, keys),
        added(scenario),
        groups(polhode::row_groups(scenario)) {
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
  detail::PreparedBase base;
  detail::MemberColumns added;
  std::vector<ColumnGroup> groups;
  // Members whose motion has a closed form.
  std::optional<RowLayout> layout;
  std::vector<double> times;
};

ScenarioEnsemble::ScenarioEnsemble(Scenario scenario)
    : parts_(std::make_unique<Parts>(with_ensemble(std::move(scenario)))) {
  detail::require_known_columns(*this);
}

ScenarioEnsemble::ScenarioEnsemble(std::string_view text, const std::string& name,
                                   const Kinds& kinds)
    : ScenarioEnsemble(scenario_from_text(text, name, kinds)) {}

ScenarioEnsemble::~ScenarioEnsemble() = default;

const Scenario& ScenarioEnsemble::scenario() const { return parts_->scenario; }
const std::vector<ColumnGroup>& ScenarioEnsemble::row_groups() const { return parts_->groups; }
const std::vector<std::string>& ScenarioEnsemble::events() const { return parts_->added.events(); }

EnsembleMember ScenarioEnsemble::member(std::int64_t index, const Progress& progress) const {
  detail::require_member(*this, index);
  EnsembleMember member{plan().numbers(index), {}, {}};
  try {
    parts_->run(parts_->base.experiment(member.drawn), progress, member);
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
  detail::require_member(*this, index);
  return detail::member_text(scenario(), index);
}

}  // namespace v0
}  // namespace polhode
