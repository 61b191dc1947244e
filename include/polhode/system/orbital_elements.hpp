// SPDX-License-Identifier: MIT
// Gauge freedom of orbits: equations of motion of Delaunay's and Kepler's elements of a satellite,
// be they canonical, osculating or of any other gauge.
//
// Equations   as element_rates.hpp, for orbits. Elements C are those of a Kepler orbit with the
//             position r of the satellite and a velocity u of its own: dr/dt = u + Phi
//             [SA (84) to (96)]. Canonical elements have Phi = dH'/dp - mu x r, so that u = p;
//             osculating elements have Phi = 0; Phi(C, t) of the user makes any other. With
//             B = d(r, u)/dC: dC/dt = B^-1 (dr/dt, du/dt), du/dt = d(u + Phi)/dt - dPhi/dt -
//             dPhi/dC dC/dt.
//             All vectors are along the frame S, and inclination and node refer to its plane.
// Units       as satellite_system.hpp; angles in radians.
// Domain      bound orbits. Delaunay: l, g, h, L, G, H, with L = sqrt(gm a), G = L sqrt(1 - e^2),
//             H = G cos i. Keplerian: a, e, i, Omega, omega, M.
// Accuracy    budget orbital_elements in tests/budgets.hpp, away from e = 0 and i = 0, pi.
// Errors      DomainError for an orbit that is not bound, at e = 0 and i = 0, pi, where the
//             elements do not exist, and for a Phi whose linear system is singular.
// Cost        the perturbation with its derivatives and 6 x 6 derivatives of a Kepler orbit.
#pragma once

#include <array>

#include "polhode/system/element_rates.hpp"
#include "polhode/system/satellite_system.hpp"

namespace polhode {
inline namespace v0 {

enum class OrbitalSet { delaunay, keplerian };
using OrbitalElements = std::array<double, 6>;  // in the order above

// dC/dt at time t.
OrbitalElements element_rates(OrbitalSet set, const SatelliteSystem& system, double t,
                              const OrbitalElements& elements,
                              const Gauge& gauge = Gauge::canonical());

// The canonical state (r, p) of a satellite with these elements.
SatelliteState element_state(OrbitalSet set, const SatelliteSystem& system, double t,
                             const OrbitalElements& elements,
                             const Gauge& gauge = Gauge::canonical());

// The elements of a canonical state.
OrbitalElements elements_of_state(OrbitalSet set, const SatelliteSystem& system, double t,
                                  const SatelliteState& canonical,
                                  const Gauge& gauge = Gauge::canonical());

// dr/dt less the velocity of the Kepler orbit.
Vec3 element_convective_term(OrbitalSet set, const SatelliteSystem& system, double t,
                             const OrbitalElements& elements,
                             const Gauge& gauge = Gauge::canonical());

}  // namespace v0
}  // namespace polhode
