// SPDX-License-Identifier: MIT
// The kinds that polhode has of [frame.NAME], [method], [orbit.NAME], [[perturbation]],
// [[observation]] and of experiments. A new one is a source in a folder of kinds/, a line here and
// one in kinds.cpp.
#pragma once

#include <string>
#include <vector>

#include "polhode/scenario/experiment_kind.hpp"
#include "polhode/scenario/frame_kind.hpp"
#include "polhode/scenario/method_kind.hpp"
#include "polhode/scenario/observation_kind.hpp"
#include "polhode/scenario/orbit_kind.hpp"
#include "polhode/scenario/perturbation_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

FrameKind precessing_kind();
FrameKind orbit_plane_kind();
FrameKind local_vertical_kind();

MethodKind adaptive_kind();
MethodKind collocation_kind();
MethodKind splitting_kind();
MethodKind variation_of_constants_kind();

PerturbationKind gravity_gradient_kind();
PerturbationKind constant_torque_kind();
PerturbationKind damping_kind();
PerturbationKind tide_kind();
PerturbationKind internal_damping_kind();
PerturbationKind anelastic_damping_kind();
PerturbationKind torque_table_kind();
PerturbationKind solar_pressure_kind();
PerturbationKind drag_kind();
PerturbationKind residual_dipole_kind();
PerturbationKind eddy_currents_kind();
PerturbationKind kane_damper_kind();

OrbitKind kepler_kind();
OrbitKind state_kind();
OrbitKind table_kind();
OrbitKind ephemeris_kind();

// How far beyond its rows a table is used, since times have their rounding: numbers that of their
// unit; of dates, nine digits of a Julian date are 0.04 ms, and clocks of TT and TDB show the same
// date up to 1.7 ms apart.
double overhang_of(const OrbitContext& at, const std::vector<double>& times, bool dates);

// An orbit whose elements are along these axes, as simple as it is.
ScenarioOrbit precessing_orbit(const OrbitContext& at, const std::string& axes,
                               const PrecessingKeplerOrbit& orbit);

// The table in an Orbit Ephemeris Message, which the key `file` names, in core units and the axes
// of the state.
ScenarioOrbit oem_orbit(const OrbitContext& at, const std::string& file, std::optional<double> gm,
                        int order);

ExperimentKind nutation_kind();

ObservationKind attitude_kind();
ObservationKind direction_kind();
ObservationKind rate_kind();
ObservationKind light_curve_kind();

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
