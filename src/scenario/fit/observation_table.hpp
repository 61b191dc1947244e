// SPDX-License-Identifier: MIT
// One table [[observation]] where its file is read or written: what its numbers are in core units.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

constexpr double modified_zero = 2400000.5;  // of modified Julian dates

// Table `index` of a file, and the keys of a light curve at a path. Throw a ScenarioError at the
// place of what is wrong, as those below.
Placed<Observation> placed_observation(const FileValues& file, std::size_t index);
Placed<LightObservation> placed_light(const FileValues& file, const std::string& path);
Observation observation_of(const FileValues& file, std::size_t index, const Kinds& kinds,
                           const Rotation& rotation);

// The orbit that a key of a light curve names.
template <auto key>
const ScenarioOrbit& named_orbit(const Rotation& rotation, const Placed<LightObservation>& table) {
  const KeyValues& at = table.at();
  return orbit_named(rotation.orbits, at.values(), at.key_path(table.name<key>()), at.file());
}

// One table, and what its numbers are in core units.
struct ObservationTable {
  const Scenario& scenario;
  const Observation& of;
  Placed<Observation> place;
  double time_unit = 1.0;
  std::optional<Clock> clock = std::nullopt;

  double light_time() const {
    return of.times == light::LightTime::at_observer ? of.light_time.value_or(0.0) : 0.0;
  }
};

ObservationTable observation_table(const Scenario& scenario, std::size_t index);

// A time of its own clock as its file has it: a number in its unit, or a date.
std::string clock_text(const ObservationTable& of, double t);

// Of a table of this kind, added to what was read.
void read_light_curves(const ObservationTable& of, std::size_t index, ReadObservations& all);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
