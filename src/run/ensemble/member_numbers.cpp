// SPDX-License-Identifier: MIT
#include "run/ensemble/member_numbers.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "run/ensemble/member_columns.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

bool is_of_event(const ScenarioEnsemble& ensemble, const std::string& column) {
  return std::ranges::any_of(ensemble.events(), [&](const std::string& event) {
    return column == first_time_name(event);
  });
}

// All names, for "did you mean".
std::vector<std::string> known_names(const ScenarioEnsemble& ensemble, bool with_keys) {
  std::vector<std::string> names;
  for (const ColumnGroup& group : ensemble.row_groups())
    for (const Column& column : group.columns)
      if (group.name != "t" && !column.is_date) names.push_back(column.name);
  const std::vector<std::string> keys = ensemble.plan().keys();
  if (with_keys) names.insert(names.end(), keys.begin(), keys.end());
  return names;
}

void require(const ScenarioEnsemble& ensemble, const std::string& path, const std::string& name,
             bool takes_keys) {
  const std::vector<std::string> known = known_names(ensemble, takes_keys);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const Document& file = ensemble.scenario().document;
  const std::vector<std::string_view> words(known.begin(), known.end());
  refuse(file.checked->values, path, file.path,
         std::string(takes_keys ? "expected columns of [output] columns, or keys that vary; "
                                : "expected a column of [output] columns; ") +
             name + " is none" + did_you_mean(name, words));
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

void require_known_columns(const ScenarioEnsemble& ensemble) {
  const Document& file = ensemble.scenario().document;
  const EnsemblePlan& plan = ensemble.plan();
  for (std::size_t i = 0; i < plan.fractions.size(); ++i) {
    const std::string path = "ensemble.fraction[" + std::to_string(i) + "]";
    require(ensemble, path + ".column", plan.fractions[i].column, false);
    if (std::ranges::find(ensemble.events(), plan.fractions[i].name) != ensemble.events().end())
      refuse(file.checked->values, path + ".name", file.path,
             "expected a name of its own, since an event has this one");
    const auto has_this_name = [&](const ColumnGroup& group) {
      return group.name == plan.fractions[i].name ||
             std::ranges::find(group.columns, plan.fractions[i].name, &Column::name) !=
                 group.columns.end();
    };
    if (std::ranges::any_of(ensemble.row_groups(), has_this_name))
      refuse(file.checked->values, path + ".name", file.path,
             "expected a name of its own, since a column has this one");
  }
  for (std::size_t i = 0; i < plan.histograms.size(); ++i)
    for (const EnsembleHistogram::Axis& axis : plan.histograms[i].axes)
      require(ensemble, "ensemble.histogram[" + std::to_string(i) + "].columns", axis.column, true);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
