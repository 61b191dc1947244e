// SPDX-License-Identifier: MIT
// FrameMotion: where a reference frame is turned to, and how fast it turns.
//
// Equations   dq_IS/dt = q_IS mu_S / 2.
// Units       mu_S in radians per unit of time.
// Domain      q_IS is a unit quaternion.
// Accuracy    that of the frame.
// Cost        a plain value.
#pragma once

#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {

template <Real T>
struct BasicFrameMotion {
  BasicQuaternion<T> q_IS;
  BasicVec3<T> mu_S;
};
using FrameMotion = BasicFrameMotion<double>;

}  // namespace v0
}  // namespace polhode
