// SPDX-License-Identifier: MIT
// Derivatives of the terms at a setting along one direction. All six directions at once are those
// of RotorEquations<Tangent>.
#pragma once

#include "polhode/math/dual.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

// A direction in the tangent of the hub: q -> q exp(turn / 2), g -> g + momentum.
struct HubDirection {
  Vec3 turn;
  Vec3 momentum;
};

// A setting that moves along a direction: the derivatives by it are those of the first variable.
inline BasicSetting<Tangent> moving_along(const Setting& at, const HubDirection& d) {
  const Vec3 half = 0.5 * d.turn;
  const Quaternion dq = at.s.q * Quaternion{0.0, half.x, half.y, half.z};
  const auto moving = [](double x, double dx) { return Tangent(x, {dx}); };
  const BasicRotorState<Tangent> s{{moving(at.s.q.w, dq.w), moving(at.s.q.x, dq.x),
                                    moving(at.s.q.y, dq.y), moving(at.s.q.z, dq.z)},
                                   {moving(at.s.g.x, d.momentum.x), moving(at.s.g.y, d.momentum.y),
                                    moving(at.s.g.z, d.momentum.z)}};
  const Quaternion& q = at.q_IS;
  const BasicQuaternion<Tangent> q_IS{Tangent(q.w), Tangent(q.x), Tangent(q.y), Tangent(q.z)};
  return {at.body, Tangent(at.t), s, q_IS, Tangent(at.t_rest)};
}

inline Vec3 value_of(const BasicVec3<Tangent>& v) { return {v.x.value, v.y.value, v.z.value}; }
inline Vec3 slope_of(const BasicVec3<Tangent>& v) {
  return {v.x.derivative[0], v.y.derivative[0], v.z.derivative[0]};
}

}  // namespace v0
}  // namespace polhode
