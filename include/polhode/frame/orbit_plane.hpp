// SPDX-License-Identifier: MIT
// The frame of the plane of an orbit at each time (of date): what a rotation is told in that keeps
// to an orbit whose plane moves.
//
// Equations   axis 3 is the normal of the plane. Axis 1 is the ascending node on inertial axes 1
//             and 2, q_IS = Rz(node) Rx(i); or, without a node, where the shortest turn from axis 3
//             of inertial axes to the normal brings axis 1, q_IS = (1 + n_3, -n_2, n_1, 0) /
//             sqrt(2 (1 + n_3)).
// Units       those of the orbit.
// Domain      of elements the plane is theirs, of a table that of position and velocity at the
//             time, with all its terms of short period. The node needs an inclination: at i = 0 and
//             180 degrees it is NaN, and next to them it runs. The shortest turn serves for all
//             but 180 degrees, but keeps a small turn about the normal of its own.
// Accuracy    that of the plane. mu is the derivative of q_IS by dual numbers: budget orbit_plane_*
//             against differences. Of a table it takes the second derivative between rows.
// Errors      DomainError for a table of order 2, whose path has no curvature between rows; NaN
//             outside a table.
// Cost        of a table some 2 us a time, of elements 0.2 us. Making the frame of a table by its
//             node walks all rows, 0.16 s for a million.
#pragma once

#include "polhode/frame/frame.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/precessing_kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/orbit/turned_kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {

enum class PlaneOrigin { node, shortest_turn };

Frame orbit_plane_frame(const KeplerOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);
Frame orbit_plane_frame(const PrecessingKeplerOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);
Frame orbit_plane_frame(const TurnedKeplerOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);
Frame orbit_plane_frame(const TableOrbit& orbit, PlaneOrigin origin = PlaneOrigin::node);

}  // namespace v0
}  // namespace polhode
