// SPDX-License-Identifier: MIT
#include "scenario/prepared_base.hpp"

#include <utility>

#include "scenario/values.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::vector<NumberLocation> locations_of(const Values& values, std::span<const std::string> keys) {
  std::vector<NumberLocation> locations;
  for (const std::string& key : keys) locations.push_back(*number_location(values, key));
  return locations;
}

std::vector<std::string> paths_of(const std::vector<NumberLocation>& locations) {
  std::vector<std::string> paths;
  for (const NumberLocation& location : locations) paths.push_back(location.path);
  return paths;
}

}  // namespace

PreparedBase::PreparedBase(const Scenario& scenario, std::span<const std::string> keys)
    : scenario_(scenario), locations_(locations_of(scenario.document.checked->values, keys)) {
  const Document& of = scenario.document;
  remake_ = of.checked->made->prepare(
      {{of.checked->values, of.units, of.path}, *of.kinds, scenario.output}, paths_of(locations_));
}

std::unique_ptr<Values> PreparedBase::taken() const {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!free_.empty()) {
      std::unique_ptr<Values> values = std::move(free_.back());
      free_.pop_back();
      return values;
    }
  }
  return std::make_unique<Values>(scenario_.document.checked->values);
}

Experiment PreparedBase::experiment(std::span<const double> numbers) const {
  std::unique_ptr<Values> values = taken();
  for (std::size_t i = 0; i < locations_.size(); ++i) {
    Value& value = values->find(locations_[i].path)->second;
    const std::string& unit = value.units[locations_[i].index];
    const double number = to_core(value, locations_[i].index, numbers[i], scenario_.document.units);
    for (const std::size_t element : locations_[i].elements()) value.numbers[element] = number;
    value.shown = number_text(numbers[i]) + (unit.empty() ? "" : " " + unit);
    value.is_explicit = true;
  }
  Experiment made = remake_(*values);
  const std::lock_guard<std::mutex> lock(mutex_);
  free_.push_back(std::move(values));
  return made;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
