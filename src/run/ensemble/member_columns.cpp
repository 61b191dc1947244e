// SPDX-License-Identifier: MIT
// Numbers of a member of an ensemble: first times of events, indicators of chaos, and names.
#include "run/ensemble/member_columns.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> events_of(const Rotation& rotation) {
  std::vector<std::string> names;
  for (const ScenarioEvent& event : rotation.events) names.push_back(event.name);
  return names;
}
std::vector<std::string> events_of(const Obliquity&) { return {}; }
std::vector<std::string> events_of(const CustomExperiment& own) {
  std::vector<std::string> names;  // each once
  for (const std::string& name : own.event_names)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

bool runs_backwards(const Scenario& scenario) {
  const SaveAt& rows = *row_times(scenario);
  return rows[rows.size() - 1] < rows[0];
}

}  // namespace

std::string first_time_name(const std::string& event) { return event + "_first"; }

MemberColumns::MemberColumns(const Scenario& scenario)
    : events_(std::visit([](const auto& of) { return events_of(of); }, scenario.experiment)),
      indicators_(scenario.ensemble->indicators),
      units_(scenario.units()),
      run_width_(row_width(polhode::io::row_groups(scenario))),
      backwards_(runs_backwards(scenario)) {}

std::vector<ColumnGroup> MemberColumns::groups() const {
  std::vector<ColumnGroup> groups;
  for (const std::string& event : events_) {
    const std::string name = first_time_name(event);
    groups.push_back({name, {{name, units_.time()}}});
  }
  if (indicators_.empty()) return groups;
  ColumnGroup chaos{"chaos", {}};
  for (const EnsembleIndicator one : indicators_)
    chaos.columns.push_back(one == EnsembleIndicator::lyapunov
                                ? Column{"lyapunov", "1/" + units_.time()}
                                : Column{"mean_megno", "1"});
  groups.push_back(std::move(chaos));
  return groups;
}

std::vector<double> MemberColumns::first_times(std::span<const RunEvent> met) const {
  std::vector<double> first(events_.size(), no_value);
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const auto event = std::find_if(met.begin(), met.end(),
                                    [&](const RunEvent& one) { return one.name == events_[i]; });
    if (event != met.end()) first[i] = units_.from_core(event->t, Dimension::time);
  }
  return first;
}

// At each of these times, one row after the other.
std::vector<double> MemberColumns::indicators(const Rotation& rotation, std::vector<double> times,
                                              const Progress& progress,
                                              EnsembleMember& member) const {
  const std::size_t size = times.size() * indicators_.size();
  const double stop = times.empty() ? 0.0 : times.back();
  if (stop == 0.0) return std::vector<double>(size, 0.0);
  std::vector<double> all;
  try {
    Problem problem = rotor_problem(rotation);
    problem.stop = stop;
    const analysis::ChaosIndicator found =
        analysis::chaos_indicator(problem, SaveAt::times(std::move(times)), {}, progress);
    for (const analysis::ChaosSample& at : found.samples)
      for (const EnsembleIndicator one : indicators_)
        all.push_back(one == EnsembleIndicator::lyapunov ? at.lyapunov : at.mean_megno);
    if (!found.outcome.ok()) member.failure = found.outcome.advice;
  } catch (const DomainError& error) {
    member.failure = error.what();
  }
  all.resize(size, no_value);
  return all;
}

void MemberColumns::add(const Experiment& experiment, const RunReport& report,
                        const Progress& progress, EnsembleMember& member) const {
  if (is_empty()) return;
  const std::vector<double> of_run = std::exchange(member.rows, {});
  const std::size_t rows = of_run.size() / run_width_;
  const std::vector<double> first = first_times(report.events);
  std::vector<double> chaos(rows * indicators_.size(), no_value);
  if (!indicators_.empty() && member.failure.empty()) {
    const auto& rotation = std::get<Rotation>(experiment);
    std::vector<double> times;
    for (std::size_t k = 0; k < rows; ++k) {
      const auto at = static_cast<std::int64_t>(k);
      const double t = at < rotation.time->size() ? (*rotation.time)[at] : report.outcome.t;
      const bool is_own = units_.from_core(t, Dimension::time) == of_run[k * run_width_];
      times.push_back(is_own ? t : report.outcome.t);  // of the event that ended it
    }
    chaos = indicators(rotation, std::move(times), progress, member);
  }
  member.rows.reserve(rows * (run_width_ + first.size() + indicators_.size()));
  const auto add_part = [&](const std::vector<double>& all, std::size_t row, std::size_t width) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(row * width);
    member.rows.insert(member.rows.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  };
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = of_run[k * run_width_];
    add_part(of_run, k, run_width_);
    // the last row has those up to the end of the run, which may lie behind it
    for (const double event : first)
      member.rows.push_back(k + 1 == rows || (backwards_ ? event >= t : event <= t) ? event
                                                                                    : no_value);
    add_part(chaos, k, indicators_.size());
  }
}

namespace {

bool is_of_event(const ScenarioEnsemble& ensemble, const std::string& column) {
  return std::ranges::any_of(ensemble.events(), [&](const std::string& event) {
    return column == first_time_name(event);
  });
}

}  // namespace

std::optional<MemberNumber> member_number(const ScenarioEnsemble& ensemble,
                                          const std::string& name) {
  using enum MemberNumber::From;
  const std::string angle = ensemble.scenario().units().label(Dimension::angle);
  std::size_t place = 0;
  for (const ColumnGroup& group : ensemble.row_groups())
    for (const Column& column : group.columns) {
      if (column.name == name && place > 0 && !column.is_date)
        return MemberNumber{is_of_event(ensemble, name) ? event : row, place, column,
                            column.unit == angle};
      ++place;
    }
  const std::vector<std::string> keys = ensemble.plan().keys(), units = ensemble.plan().units();
  const auto key = std::find(keys.begin(), keys.end(), name);
  if (key == keys.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(key - keys.begin());
  return MemberNumber{drawn, index, {name, units[index]}, false};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
