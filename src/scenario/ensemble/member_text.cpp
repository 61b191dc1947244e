// SPDX-License-Identifier: MIT
// The scenario of a member of an ensemble, as text.
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

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

// Possible TOML places of an element; one of an array may also be in { value = [..], unit = ".." }.
std::vector<std::string> places_of(const Value& value, const std::string& path,
                                   std::size_t element) {
  if (value.key->type == KeyType::number) return {path};
  std::string index = std::to_string(element);
  if (is_matrix(value)) index = std::to_string(element / 3) + "." + std::to_string(element % 3);
  return {path + "." + index, path + ".value." + index};
}

// The text with the fallbacks of arrays, of which some numbers change.
std::string with_fallbacks(std::string text, const Values& values,
                           std::span<const NumberLocation> places) {
  std::set<std::string> written;
  for (const NumberLocation& place : places) {
    const Value& value = value_at(values, place.path);
    if (value.is_explicit || value.key->type == KeyType::number) continue;
    if (!written.insert(place.path).second) continue;
    text = changed_text(
        text, std::vector<ScenarioChange>{{place.path, std::string(value.key->fallback)}});
  }
  return text;
}

std::string with_number(std::string text, const Value& value, const NumberLocation& at,
                        std::size_t element, double number) {
  const auto changed = [&](const std::string& place, const std::string& written) {
    return changed_text(text, std::vector<ScenarioChange>{{place, written}});
  };
  const std::string& unit = value.units[at.index];
  const std::string plain = number_text(number);
  const std::vector<std::string> places = places_of(value, at.path, element);
  try {
    return changed(places.front(), unit.empty() ? plain : "\"" + plain + " " + unit + "\"");
  } catch (const ChangeError&) {
    if (places.size() == 1) throw;
    return changed(places.back(), plain);  // the unit stands behind value
  }
}

// A number that reads back as another one would make another member. Values that are rejected are
// for the run to report.
void require_numbers(const std::string& text, const Document& file,
                     std::span<const NumberLocation> places, std::span<const double> numbers) {
  Diagnostics diagnostics(file.path);
  const ReadFile read = read_values(text, file.kinds->schema(), diagnostics);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto found = read.values.find(places[i].path);
    if (found == read.values.end()) continue;
    const Value& value = value_at(file.checked->values, places[i].path);
    const double expected = to_core(value, places[i].index, numbers[i], file.units);
    for (const std::size_t element : places[i].elements())
      if (found->second.numbers.at(element) != expected)
        throw DomainError(file.name + ": " + key_text(file.checked->values, places[i]) +
                          " has no place in the text of the file");
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
  for (const std::string& key : keys) places.push_back(*number_location(values, key));
  text = with_fallbacks(std::move(text), values, places);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const std::size_t element : places[i].elements())
      text = with_number(std::move(text), value_at(values, places[i].path), places[i], element,
                         numbers[i]);
  require_numbers(text, file, places, numbers);
  return "# Member " + std::to_string(index) + " of " + printable(file.name, 200) + ", " +
         std::to_string(plan.size) + " members, seed " + std::to_string(plan.seed) + "\n" + text;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
