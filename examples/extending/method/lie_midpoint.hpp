// SPDX-License-Identifier: MIT
// A method of your own: the explicit midpoint rule on the rotation group. The attitude turns by the
// angular velocity in the middle of the step, about an axis fixed in the body, so that it remains a
// rotation without being pulled back.
#pragma once

#include <cmath>

#include "polhode/dynamics/custom_method.hpp"

// q after a turn by the vector `by`, body axes.
inline polhode::Quaternion turned(const polhode::Quaternion& q, const polhode::Vec3& by) {
  const double angle = norm(by);
  const double s = angle > 0.0 ? std::sin(0.5 * angle) / angle : 0.5;
  return q * polhode::Quaternion{std::cos(0.5 * angle), s * by.x, s * by.y, s * by.z};
}

// The state at t + h from s, with the rates of `middle` at `at`.
inline polhode::RotorState moved(const polhode::System& system, const polhode::RotorState& s,
                                 double at, const polhode::RotorState& middle, double h) {
  const polhode::Vec3 w = angular_velocity(system, at, middle).relative;
  const polhode::Vec3 torque = rotor_rates(system, at, middle).g;
  return {turned(s.q, h * w), s.g + h * torque};
}

inline polhode::RotorState lie_midpoint(const polhode::System& system, double t,
                                        const polhode::RotorState& s, double h) {
  const polhode::RotorState middle = moved(system, s, t, s, 0.5 * h);
  return moved(system, s, t + 0.5 * h, middle, h);
}
