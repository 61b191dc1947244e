// SPDX-License-Identifier: MIT
// The kinds of [orbit.NAME]: for each a function that makes the orbit from the values of a file.
// Their keys are in schema_orbits.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario_parts.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct OrbitContext {
  const OrbitsContext& file;
  const std::string& path;  // "orbit.moon"
  OrbitUses& uses;

  const Values& values() const { return file.values; }
  const std::string& name() const { return file.name; }
  std::string key(const char* own) const { return path + "." + own; }
};

// What a run of the file goes through: t = 0 and all its rows.
struct TimeSpan {
  double first = 0.0;
  double last = 0.0;
};
std::optional<TimeSpan> run_span(const OrbitContext& at);

// The gm of the table, where it has one.
std::optional<double> own_gm(const OrbitContext& at);
// The axes that its own key names, else those of the state; both inertial or both of J2000.
const std::string& orbit_axes(const OrbitContext& at);

// How far beyond its rows a table is used, since times have their rounding: numbers that of their
// unit; of dates, nine digits of a Julian date are 0.04 ms, and clocks of TT and TDB show the same
// date up to 1.7 ms apart.
double overhang_of(const OrbitContext& at, const std::vector<double>& times, bool dates);

// Refuses a table that does not cover the run, at the place of `key`.
void require_cover(const OrbitContext& at, const char* key, const TableOrbit& orbit);

// An orbit whose elements are along those axes, as simple as it is.
ScenarioOrbit precessing_orbit(const OrbitContext& at, const PrecessingKeplerOrbit& orbit);

ScenarioOrbit kepler_orbit(const OrbitContext& at);
ScenarioOrbit state_orbit(const OrbitContext& at);
ScenarioOrbit table_orbit(const OrbitContext& at);
ScenarioOrbit ephemeris_orbit(const OrbitContext& at);
// The table in an Orbit Ephemeris Message, in core units and the axes of the state.
ScenarioOrbit oem_orbit(const OrbitContext& at, const std::string& path, int order);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
