// SPDX-License-Identifier: MIT
// Attitude as roll, pitch and yaw, the angles of flight.
//
// Equations   q = qz(yaw) qy(pitch) qx(roll): from the frame to the body yaw comes first, about
//             axis 3, then pitch about the new axis 2, then roll about the new axis 1 (3-2-1).
// Units       radians.
// Domain      any attitude. roll and yaw in (-pi, pi], pitch in [-pi/2, pi/2]; where pitch is at
//             its ends yaw is 0 and roll holds both.
// Accuracy    budget roll_pitch_yaw: the angles give the attitude back to rounding, however near to
//             90 degrees pitch is; a rounding of the attitude moves roll and yaw by 1/cos(pitch) of
//             it.
// Errors      none; NaN in, NaN out.
// Cost        three atan2, two hypot.
#pragma once

#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {

struct RollPitchYaw {
  double roll;
  double pitch;
  double yaw;

  bool operator==(const RollPitchYaw&) const = default;
};

RollPitchYaw roll_pitch_yaw(const Quaternion& q);
Quaternion attitude(const RollPitchYaw& angles);

}  // namespace v0
}  // namespace polhode
