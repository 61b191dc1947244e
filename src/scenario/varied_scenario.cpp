// SPDX-License-Identifier: MIT
#include "polhode/detail/scenario/varied_scenario.hpp"

#include <cstddef>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "scenario/number_location.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/values.hpp"
#include "text/number_text.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

std::string changed(std::string_view text, const std::string& key, const std::string& value) {
  return changed_text(text, std::vector<ScenarioChange>{{key, value}});
}

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
    text = changed(text, place.path, std::string(value.key->fallback));
  }
  return text;
}

std::string with_number(const std::string& text, const Value& value, const NumberLocation& at,
                        std::size_t element, double number) {
  const std::string& unit = value.units[at.index];
  const std::string plain = polhode::detail::number_text(number);
  const std::vector<std::string> places = places_of(value, at.path, element);
  try {
    return changed(text, places.front(), unit.empty() ? plain : "\"" + plain + " " + unit + "\"");
  } catch (const ChangeError&) {
    if (places.size() == 1) throw;
    return changed(text, places.back(), plain);  // the unit stands behind value
  }
}

// A number that reads back as another one would make another scenario. Values that are rejected are
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
}  // namespace detail

using detail::NumberLocation;
using detail::Value;
using detail::Values;

struct VariedScenario::Parts {
  Parts(const Scenario& of, std::span<const std::string> keys) : scenario(of) {
    for (const std::string& key : keys) {
      locations.push_back(*detail::number_location(values(), key));
      paths.push_back(locations.back().path);
    }
  }

  const Document& file() const { return scenario.document; }
  const Values& values() const { return file().checked->values; }

  std::unique_ptr<Values> taken() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!free.empty()) {
        std::unique_ptr<Values> own = std::move(free.back());
        free.pop_back();
        return own;
      }
    }
    return std::make_unique<Values>(values());
  }

  void put(Values& own, std::span<const double> numbers) const {
    for (std::size_t i = 0; i < locations.size(); ++i) {
      Value& value = own.find(locations[i].path)->second;
      const std::string& unit = value.units[locations[i].index];
      const double number = detail::to_core(value, locations[i].index, numbers[i], file().units);
      for (const std::size_t element : locations[i].elements()) value.numbers[element] = number;
      value.shown = polhode::detail::number_text(numbers[i]) + (unit.empty() ? "" : " " + unit);
      value.is_explicit = true;
    }
  }

  const Scenario& scenario;
  std::vector<NumberLocation> locations;
  std::vector<std::string> paths;
  // Copies of the values, one for each thread at a time. Every cell sets the same of their numbers,
  // so that what the cell before has left does not matter.
  std::mutex mutex;
  std::vector<std::unique_ptr<Values>> free;
};

VariedScenario::VariedScenario(const Scenario& scenario, std::span<const std::string> keys)
    : parts_(std::make_unique<Parts>(scenario, keys)) {}

VariedScenario::~VariedScenario() = default;

Experiment VariedScenario::experiment(std::span<const double> numbers) const {
  std::unique_ptr<Values> values = parts_->taken();
  parts_->put(*values, numbers);
  const Document& of = parts_->file();
  Experiment made = of.checked->made->remake(
      {{*values, of.units, of.path}, *of.kinds, parts_->scenario.output}, parts_->paths);
  const std::lock_guard<std::mutex> lock(parts_->mutex);
  parts_->free.push_back(std::move(values));
  return made;
}

std::string VariedScenario::text(std::span<const double> numbers) const {
  const Values& values = parts_->values();
  const std::vector<NumberLocation>& places = parts_->locations;
  std::string text = detail::changed(parts_->file().text, "ensemble", "");
  text = detail::with_fallbacks(std::move(text), values, places);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const std::size_t element : places[i].elements())
      text = detail::with_number(text, detail::value_at(values, places[i].path), places[i], element,
                                 numbers[i]);
  detail::require_numbers(text, parts_->file(), places, numbers);
  return text;
}

Scenario VariedScenario::scenario(std::span<const double> numbers, std::string text) const {
  Experiment experiment = this->experiment(numbers);
  Document document = parts_->file();
  const std::shared_ptr<const detail::MadeExperiment> base = document.checked->made;
  detail::ReadFile read = detail::read_file(text, document.path, *document.kinds);
  document.text = std::move(text);
  return detail::scenario_of(std::move(document), std::move(read), [&](const detail::KindContext&) {
    return detail::MadeExperiment{std::move(experiment),
                                  [base, own = parts_->paths](const detail::KindContext& at,
                                                              std::span<const std::string> paths) {
                                    std::vector<std::string> all = own;
                                    all.insert(all.end(), paths.begin(), paths.end());
                                    return base->remake(at, all);
                                  }};
  });
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
