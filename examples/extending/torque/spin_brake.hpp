// SPDX-License-Identifier: MIT
// A torque of your own: a brake about one axis of the body, in proportion to the rate about it as
// long as that is small, and of a limited size.
#pragma once

#include <cmath>

#include "polhode/perturb/effect.hpp"

class SpinBrake {
 public:
  SpinBrake(const polhode::Vec3& axis, double damping, double limit)
      : axis_((1.0 / norm(axis)) * axis), damping_(damping), limit_(limit) {}

  // What the term does: nothing to the angular velocity, and a torque. A template on the number
  // type, so that derivatives and double-double work too.
  template <polhode::Real T>
  polhode::BasicEffect<T> effect(const polhode::BasicSetting<T>& at) const {
    using std::tanh;
    const polhode::Vec3& I = at.body.moments();
    const polhode::BasicVec3<T>& g = at.s.g;
    const polhode::BasicVec3<T> axis{T(axis_.x), T(axis_.y), T(axis_.z)};
    const T rate = axis.x * (g.x / I.x) + axis.y * (g.y / I.y) + axis.z * (g.z / I.z);
    const T torque = -(T(limit_) * tanh(T(damping_ / limit_) * rate));
    return {{}, torque * axis};
  }

 private:
  polhode::Vec3 axis_;
  double damping_;
  double limit_;
};
