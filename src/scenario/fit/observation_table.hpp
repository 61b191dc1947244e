// SPDX-License-Identifier: MIT
// One table [[observation]] where its file is read or written: what its numbers are in core units.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "polhode/math/quaternion.hpp"
#include "polhode/scenario/fit_plan.hpp"
#include "polhode/scenario/key_values.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/clock.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr double modified_zero = 2400000.5;  // of modified Julian dates

// One table, and what its numbers are in core units.
struct ObservationTable {
  const Scenario& scenario;
  const Observation& of;
  KeyValues keys;
  double time_unit = 1.0;
  double value_unit = 1.0;
  std::optional<Clock> clock = std::nullopt;
  Quaternion to_state;  // from its axes to those of the state

  double light_time() const {
    return of.times == LightTime::at_observer ? of.light_time.value_or(0.0) : 0.0;
  }
  // Whether points of a light curve have light times of their own, by their vectors to the
  // observer.
  bool has_own_light_times() const {
    return of.times == LightTime::at_observer && of.orbit.empty() && !of.light_time;
  }
};

// "observation[0]"
std::string observation_path(std::size_t table);
// `path` must outlive the table.
ObservationTable observation_table(const Scenario& scenario, std::size_t index,
                                   const std::string& path);

// A time of its own clock as its file has it: a number in its unit, or a date.
std::string clock_text(const ObservationTable& of, double t);

// Of a table of this kind, added to what was read.
void read_light_curves(const ObservationTable& of, std::size_t index, ReadObservations& all);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
