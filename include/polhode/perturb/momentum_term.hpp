// SPDX-License-Identifier: MIT
// MomentumTerm: an energy that is linear in the angular momentum, H' = a . g, such as that of a
// moving frame or of a rotor of constant speed; its own motion is a rotation.
//
// Equations   v = dH'/dg = a. Along body axes u = 0: by itself the term rotates the body by a h,
//             with dg/dt = g x a. Along axes in space u = a x g: body and momentum rotate together
//             [SA (107), (118): a moving frame has a = -mu].
// Units       a in rad per time.
// Domain      a(t): any function of time, generic or on double, that returns a vector. Splitting
//             evaluates it at the time of its step.
// Accuracy    a few roundings; the flow is exact for a constant a.
// Errors      what the function throws passes through.
// Cost        the function and one rotation.
#pragma once

#include <cmath>
#include <concepts>
#include <optional>
#include <utility>

#include "polhode/math/quaternion.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

template <class F>
class MomentumTerm {
 public:
  // `axes` are those of a; without them, body axes.
  explicit MomentumTerm(F a, std::optional<SpaceAxes> axes = {}) : a_(std::move(a)), axes_(axes) {}

  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    return dot(in_body(at), at.s.g);
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const BasicVec3<T> v = in_body(at);
    return {v, axes_ ? cross(v, at.s.g) : BasicVec3<T>{}};
  }
  RotorState flow(const Setting& at, double h) const {
    const Vec3 angle = h * along(at);
    const Quaternion turn = rotation(angle);
    if (axes_) return {turn * at.s.q, at.s.g};
    return {at.s.q * turn, rotate(conj(turn), at.s.g)};
  }

 private:
  // Along the axes of S, or of the body.
  template <Real T>
  BasicVec3<T> along(const BasicSetting<T>& at) const {
    BasicVec3<T> a;
    if constexpr (requires(const F& f, const T& t) {
                    { f(t) } -> std::same_as<BasicVec3<T>>;
                  }) {
      a = a_(at.t);
    } else {
      const Vec3 x = a_(to_double(at.t));
      a = {T(x.x), T(x.y), T(x.z)};
    }
    return axes_ ? reference_from_space(at, *axes_, a) : a;
  }
  template <Real T>
  BasicVec3<T> in_body(const BasicSetting<T>& at) const {
    return axes_ ? body_from_reference(at, along(at)) : along(at);
  }
  static Quaternion rotation(const Vec3& angle) {
    const double size = norm(angle);
    const double half_sinc = size > 0.0 ? std::sin(0.5 * size) / size : 0.5;
    return {std::cos(0.5 * size), half_sinc * angle.x, half_sinc * angle.y, half_sinc * angle.z};
  }

  F a_;
  std::optional<SpaceAxes> axes_;
};

}  // namespace v0
}  // namespace polhode
