// SPDX-License-Identifier: MIT
// Gauge freedom of orbits: equations of motion of Delaunay's and Keplerian elements of a satellite
// in the canonical gauge, the osculating gauge or any other.
//
// Equations   as element_rates.hpp, for orbits. Elements C are those of a Kepler orbit with the
//             position r of the satellite and a velocity u of its own: dr/dt = u + Phi
//             [SA (104) to (106)]. Canonical elements have Phi = dH'/dp - mu x r, so that u = p;
//             osculating elements have Phi = 0; a function Phi(C, t) gives any other. With
//             B = d(r, u)/dC: dC/dt = B^-1 (dr/dt, du/dt), du/dt = d(u + Phi)/dt - dPhi/dt -
//             dPhi/dC dC/dt.
//             All vectors are along the frame S, and inclination and node refer to its plane.
// Units       as satellite_system.hpp; angles in radians; Phi a velocity; rates per time.
// Domain      bound orbits. Delaunay: l, g, h, L, G, H, with L = sqrt(gm a) > 0, G = L sqrt(1 -
//             e^2), H = G cos i. Keplerian: a, e, i, Omega, omega, M.
// Accuracy    budgets orbital_* in tests/budgets.hpp, away from e = 0 and i = 0, pi.
// Errors      DomainError for an orbit that is not bound, for rates at e = 0 and i = 0, pi, where
//             they do not exist, for a Phi whose linear system is singular, and if Newton's method
//             does not converge.
// Cost        the perturbation with its derivatives and 6 x 6 derivatives of a Kepler orbit.
#pragma once

#include <array>

#include "polhode/system/element_rates.hpp"
#include "polhode/system/satellite_system.hpp"

namespace polhode {
inline namespace v0 {

enum class OrbitalSet { delaunay, keplerian };
using OrbitalElements = std::array<double, 6>;  // in the order above

// dC/dt at time t [SA (104), "(96), footnote"].
OrbitalElements element_rates(const SatelliteSystem& system, double t,
                              const OrbitalElements& elements, OrbitalSet set,
                              const Gauge& gauge = Gauge::canonical());

// The canonical state (r, p) of a satellite with these elements [SA (96)].
SatelliteState element_state(const SatelliteSystem& system, double t,
                             const OrbitalElements& elements, OrbitalSet set,
                             const Gauge& gauge = Gauge::canonical());

// The elements of a canonical state [SA (96)].
OrbitalElements elements_of_state(const SatelliteSystem& system, double t,
                                  const SatelliteState& canonical, OrbitalSet set,
                                  const Gauge& gauge = Gauge::canonical());

// dr/dt less the velocity of the Kepler orbit.
Vec3 element_convective_term(const SatelliteSystem& system, double t,
                             const OrbitalElements& elements, OrbitalSet set,
                             const Gauge& gauge = Gauge::canonical());

}  // namespace v0
}  // namespace polhode
