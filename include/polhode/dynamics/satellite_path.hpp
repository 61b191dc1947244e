// SPDX-License-Identifier: MIT
// satellite_path(): the motion of a SatelliteSystem with dense output.
//
// Equations   satellite_rates of polhode/system/satellite_system.hpp.
// Units       those of the system.
// Domain      `stop` on either side of `start`.
// Accuracy    that of the method; budget orbital_motion in tests/budgets.hpp.
// Errors      as integrate; a path that reaches the planet's centre ends with an outcome. What
//             `progress` throws ends the run and passes through.
// Cost        that of integrate.
#pragma once

#include "polhode/dynamics/method.hpp"
#include "polhode/system/satellite_system.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace satellites {

inline constexpr Collocation default_path_method{.tolerance = 1e-15};

BasicTrajectory<SatelliteState> satellite_path(const SatelliteSystem& system,
                                               const SatelliteState& state, double start,
                                               double stop,
                                               const Method& method = default_path_method,
                                               const Progress& progress = {});

}  // namespace satellites
}  // namespace v0
}  // namespace polhode
