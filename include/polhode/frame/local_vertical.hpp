// SPDX-License-Identifier: MIT
// The frame of the local vertical of an orbit (LVLH): what roll, pitch and yaw of a satellite refer
// to.
//
// Equations   axis 3 points to the centre, axis 2 against the normal of the orbit, axis 1 = 2 x 3
//             towards the motion: LVLH_ROTATING of the SANA registry that CCSDS 502.0-B-3 names.
//             q_IS = Rz(node) Rx(i) Rz(u) (1, -1, -1, 1) / 2, u the argument of latitude; of a
//             table the shortest turn to its normal in place of Rz(node) Rx(i).
// Units       those of the orbit.
// Domain      any ellipse or hyperbola. Of an orbit that precesses the plane is that of its
//             elements at the time, not that of position and velocity; of a table it is the latter,
//             from first to last row, less than half a turn apart. Other authors call axes
//             LVLH whose first points away from the centre.
// Accuracy    that of the position: budget local_vertical_axes. q_IS does not change its sign from
//             one turn to the next; mu is its derivative by dual numbers.
// Errors      DomainError for a table of order 2, whose path has no curvature between rows; NaN
//             outside a table.
// Cost        two positions of the orbit; of a table some 2 us, and making the frame walks all
//             rows, 0.33 s for a million.
#pragma once

#include "polhode/frame/frame.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/precessing_kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/orbit/turned_kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {

Frame local_vertical_frame(const KeplerOrbit& orbit);
Frame local_vertical_frame(const PrecessingKeplerOrbit& orbit);
Frame local_vertical_frame(const TurnedKeplerOrbit& orbit);
Frame local_vertical_frame(const TableOrbit& orbit);

}  // namespace v0
}  // namespace polhode
