// SPDX-License-Identifier: MIT
// ConstantTorque: a torque whose components are constant in body axes or in space.
//
// Equations   u = the given vector, or what the attitude makes of it in body components. It has no
//             energy: neither is the gradient of a function of the attitude.
// Units       momentum per time.
// Domain      any finite vector.
// Accuracy    exact in body axes; one rotation in space.
// Errors      DomainError for a component that is not finite.
// Cost        none; some 60 flops.
#pragma once

#include <optional>

#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

class ConstantTorque {
 public:
  static constexpr bool kick = true;

  static ConstantTorque in_body(const Vec3& u_B);
  static ConstantTorque in_space(const Vec3& u, SpaceAxes axes = SpaceAxes::inertial);

  // Its components, along axes that are empty where they are those of the body.
  const Vec3& torque() const { return u_; }
  const std::optional<SpaceAxes>& space_axes() const { return axes_; }

  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const BasicVec3<T> u{T(u_.x), T(u_.y), T(u_.z)};
    return {{}, axes_ ? body_from_space(at, *axes_, u) : u};
  }

 private:
  ConstantTorque(const Vec3& u, std::optional<SpaceAxes> axes);

  Vec3 u_;
  std::optional<SpaceAxes> axes_;  // none: body axes
};

}  // namespace v0
}  // namespace polhode
