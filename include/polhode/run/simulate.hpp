// SPDX-License-Identifier: MIT
// Simulation: what the observations of a scenario of kind "fit" would be at the times of [time],
// with noise, in files that its fit reads.
//
// Equations   attitudes q exp(dtheta / 2) with dtheta normal about the body axes; directions turned
//             by two normal angles across them; rates plus normal numbers; fluxes of the ellipsoid
//             or mesh of [light], each relative session as parts of its mean, plus normal numbers.
// Units       those of each [[observation]].
// Domain      any rotation that runs, perturbations included, relative to inertial axes. Noise
//             depends on simulate.seed, the places of table and row, and nothing else.
// Accuracy    that of the motion; numbers are written with all their digits.
// Errors      DomainError without [time]; ScenarioError for columns without names and for errors
//             that are columns. write_simulation: DomainError for a file that is there, and
//             OutputError.
// Cost        that of the run and a microsecond a row.
#pragma once

#include <string>
#include <vector>

#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/fit/snapshots.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// What the rows of one [[observation]] would be, in core units.
fit::Snapshots simulated(const Scenario& scenario, std::size_t table);
// The same of a table of light curves: its sessions, with vectors along the axes of the state.
std::vector<light::LightCurve> simulated_light(const Scenario& scenario, std::size_t table);

// Writes the file of each [[observation]] below a folder, as PATH.part until it is complete.
// Returns their paths. A file that is there stays unless it may be replaced.
std::vector<std::string> write_simulation(const Scenario& scenario, const std::string& folder,
                                          bool may_replace = false);

}  // namespace io
}  // namespace v0
}  // namespace polhode
