// SPDX-License-Identifier: MIT
// The scenario of a member of an ensemble, as text.
#include "polhode/error.hpp"
#include "scenario/ensemble/ensemble_plan.hpp"
#include "scenario/number_location.hpp"
#include "text/number_text.hpp"
#include "text/value_access.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Possible TOML places of a number; one of an array may also be in { value = [..], unit = ".." }.
std::vector<std::string> places_of(const Value& value, const NumberLocation& at) {
  if (value.key->type == KeyType::number) return {at.path};
  std::string index = std::to_string(at.index);
  if (value.numbers.size() == 9)
    index = std::to_string(at.index / 3) + "." + std::to_string(at.index % 3);
  return {at.path + "." + index, at.path + ".value." + index};
}

// The text with a number at a key; what a fallback has said so far is written out.
std::string with_number(std::string text, const Value& value, const NumberLocation& at,
                        double number) {
  const auto changed = [&](const std::string& place, const std::string& written) {
    return changed_text(text, std::vector<ScenarioChange>{{place, written}});
  };
  const std::string& unit = value.units[at.index];
  const std::string plain = number_text(number);
  if (!value.is_explicit && value.key->type != KeyType::number)
    text = changed(at.path, std::string(value.key->fallback));
  const std::vector<std::string> places = places_of(value, at);
  try {
    return changed(places.front(), unit.empty() ? plain : "\"" + plain + " " + unit + "\"");
  } catch (const ChangeError&) {
    if (places.size() == 1) throw;
    return changed(places.back(), plain);  // the unit stands behind value
  }
}

}  // namespace

std::string member_text(const Scenario& scenario, std::int64_t index) {
  const Document& file = scenario.document;
  const EnsemblePlan& plan = *scenario.ensemble;
  const std::vector<std::string> keys = plan.keys();
  const std::vector<double> numbers = plan.numbers(index);
  const Values& values = file.checked->values;
  std::string text = changed_text(file.text, std::vector<ScenarioChange>{{"ensemble", ""}});
  std::vector<NumberLocation> places;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    places.push_back(*number_location(values, keys[i]));
    text = with_number(std::move(text), value_at(values, places[i].path), places[i], numbers[i]);
  }
  // A number that reads back as another one would make another member.
  const Scenario made = scenario_from_text(text, file.path, *file.kinds);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto& [path, place] = places[i];
    if (value_at(made.document.checked->values, path).numbers[place] !=
        to_core(value_at(values, path), place, numbers[i], file.units))
      throw DomainError(file.name + ": member " + std::to_string(index) + ": " + keys[i] +
                        " has no place in the text of the file");
  }
  return "# Member " + std::to_string(index) + " of " + printable(file.name, 200) + ", " +
         std::to_string(plan.size) + " members, seed " + std::to_string(plan.seed) + "\n" + text;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
