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

// A torque that is known at a time, along body axes or along those of the reference frame.
struct GivenTorqueLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  bool in_body;

  constexpr bool operator==(const GivenTorqueLaw&) const = default;

  template <Number T>
  struct OfTime {
    BasicVec3<T> u;
  };
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>& given, const BasicPose<T>& at) const {
    return {{}, in_body ? given.u : body_from_reference(at, given.u)};
  }
};

class ConstantTorque {
 public:
  static constexpr bool kick = true;
  using Law = GivenTorqueLaw;

  static ConstantTorque in_body(const Vec3& u_B);
  static ConstantTorque in_space(const Vec3& u, SpaceAxes axes = SpaceAxes::inertial);

  // Its components, along axes that are empty where they are those of the body.
  const Vec3& torque() const { return u_; }
  const std::optional<SpaceAxes>& space_axes() const { return axes_; }

  Law law() const { return {!axes_}; }
  template <Real T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    const BasicVec3<T> u{T(u_.x), T(u_.y), T(u_.z)};
    return {axes_ ? reference_from_space(at, *axes_, u) : u};
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law().effect(of_time(at), pose_of(at));
  }

 private:
  ConstantTorque(const Vec3& u, std::optional<SpaceAxes> axes);

  Vec3 u_;
  std::optional<SpaceAxes> axes_;  // none: body axes
};

}  // namespace v0
}  // namespace polhode
