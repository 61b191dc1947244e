// SPDX-License-Identifier: MIT
// The three axes of a rotating body, figure, angular momentum and rotation, as inclination and node
// of the planes they stand on.
//
// Equations   an axis of direction (sI sh, -sI ch, cI) is normal to a plane of inclination I and
//             node h: I = atan2(hypot(x, y), z), h = atan2(x, -y). Figure: b3, so (I, h) = (theta,
//             phi), the equator's. Momentum: cos I = H/G [SA (84)]. Rotation (I_r, h_r): the
//             angular velocity, which differs between inertial axes and a moving frame by mu
//             [SA (124)].
// Units       radians.
// Domain      any state. I in [0, pi], h in (-pi, pi]; I = 0, pi: h = 0. A vector of length 0 (no
//             momentum, no rotation) has no axis: NaN. The momentum is the canonical one of the
//             hub.
// Accuracy    a few roundings of the vector; h loses 1/sin I.
// Errors      what a term throws passes through.
// Cost        the terms and three atan2 per axis.
#pragma once

#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace charts {

struct AxisAngles {
  double I;  // inclination of the plane normal to the axis
  double h;  // its node

  constexpr bool operator==(const AxisAngles&) const = default;
};

// Of a vector, in the axes of its components.
AxisAngles axis_angles(const Vec3& axis);

struct RotorAxes {
  AxisAngles figure;
  AxisAngles momentum;
  AxisAngles rotation;

  constexpr bool operator==(const RotorAxes&) const = default;
};

// In inertial axes, with the rotation axis of w_IB [SA (84), (124)].
RotorAxes inertial_axes(const System& system, double t, const RotorState& s);
// In the axes of the reference frame S, with the rotation axis of w_SB [SA (84), (124)].
RotorAxes relative_axes(const System& system, double t, const RotorState& s);

}  // namespace charts
}  // namespace v0
}  // namespace polhode
