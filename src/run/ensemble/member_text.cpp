// SPDX-License-Identifier: MIT
#include "run/ensemble/member_text.hpp"

#include <vector>

#include "polhode/error.hpp"
#include "scenario/number_location.hpp"
#include "scenario/value_reader.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

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

}  // namespace

void require_member(const ScenarioEnsemble& ensemble, std::int64_t index) {
  if (index >= 0 && index < ensemble.size()) return;
  throw DomainError(ensemble.scenario().document.name + ": got member " + std::to_string(index) +
                    "; expected 0 to " + std::to_string(ensemble.size() - 1));
}

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
