// SPDX-License-Identifier: MIT
// Our kinds of [orbit.NAME], one source each in kinds/orbits/, and what they share.
#pragma once

#include <string>
#include <vector>

#include "polhode/scenario/orbit_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

OrbitKind kepler_kind();
OrbitKind state_kind();
OrbitKind table_kind();
OrbitKind ephemeris_kind();

// The axes that its own key names, else those of the state; both inertial or both of J2000.
const std::string& orbit_axes(const OrbitContext& at);

// How far beyond its rows a table is used, since times have their rounding: numbers that of their
// unit; of dates, nine digits of a Julian date are 0.04 ms, and clocks of TT and TDB show the same
// date up to 1.7 ms apart.
double overhang_of(const OrbitContext& at, const std::vector<double>& times, bool dates);

// An orbit whose elements are along those axes, as simple as it is.
ScenarioOrbit precessing_orbit(const OrbitContext& at, const PrecessingKeplerOrbit& orbit);

// The table in an Orbit Ephemeris Message, in core units and the axes of the state.
ScenarioOrbit oem_orbit(const OrbitContext& at, const std::string& path, int order);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
