// SPDX-License-Identifier: MIT
#include "scenario/prepared_base.hpp"

#include "scenario/value_reader.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::vector<NumberLocation> places_of(const Values& values, std::span<const std::string> keys) {
  std::vector<NumberLocation> places;
  for (const std::string& key : keys) places.push_back(*number_location(values, key));
  return places;
}

std::vector<std::string> paths_of(const std::vector<NumberLocation>& places) {
  std::vector<std::string> paths;
  for (const NumberLocation& place : places) paths.push_back(place.path);
  return paths;
}

}  // namespace

PreparedBase::PreparedBase(const Scenario& scenario, std::span<const std::string> keys)
    : scenario_(scenario), places_(places_of(scenario.document.checked->values, keys)) {
  const Document& of = scenario.document;
  remake_ =
      kind_of(of.checked->values)
          .prepare({of.checked->values, of.units, scenario.output, of.path}, paths_of(places_));
}

Experiment PreparedBase::experiment(std::span<const double> numbers) const {
  Values values = scenario_.document.checked->values;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Value& value = values.find(places_[i].path)->second;
    value.numbers[places_[i].index] =
        scenario_.document.units.to_core(numbers[i], value.key->dimension);
    value.shown = number_text(numbers[i]);
    value.is_explicit = true;
  }
  return remake_(values);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
