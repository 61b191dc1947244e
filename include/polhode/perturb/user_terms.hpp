// SPDX-License-Identifier: MIT
// Terms that the user writes: any Hamiltonian H'(t, state), any torque u(t, state).
//
// Equations   a Hamiltonian's effect is v = dH'/dg, u = -dH'/d(theta_B) by dual numbers, so that it
//             cannot be inconsistent with its energy [SA (107)].
// Units       time, momentum and energy in those of the system; a torque in body components.
// Domain      H is a generic callable: auto H(const auto& t, const BasicRotorState<T>& s), s =
//             {q_SB, g_B} in the reference frame. It may depend on q through q/|q| or through
//             products of two components; |q| = 1 holds to first order in the derivatives. A torque
//             is a callable on double, or generic like H: then double-double runs and state
//             transition matrices work too. A torque that jumps where one of its switching
//             functions is zero (Switching) is a callable of (t, s, sides): it takes `sides[i]`, +1
//             or -1, for the sign of function i, so that it is smooth at the jump from either side.
//             A step may be longer than a jump that no function names, and then steps
//             over it: give `time_scale`, that in which the torque comes and goes, or a
//             largest_step.
// Accuracy    a few roundings of H.
// Errors      none of its own; what the callable throws passes through.
// Cost        H on Dual<T, 6>: about seven times H.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

template <class F>
class HamiltonianTerm {
 public:
  explicit HamiltonianTerm(F H) : H_(std::move(H)) {}

  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    return H_(at.t, at.s);
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    using D = Dual<T, 6>;
    const D H = H_(D(at.t), with_variables(at.s));
    return {{H.derivative[3], H.derivative[4], H.derivative[5]},
            {-H.derivative[0], -H.derivative[1], -H.derivative[2]}};
  }

 private:
  F H_;
};

template <class F>
class TorqueTerm {
 public:
  explicit TorqueTerm(F torque, double time_scale = std::numeric_limits<double>::infinity())
      : torque_(std::move(torque)), time_scale_(time_scale) {}

  double time_scale() const { return time_scale_; }

  template <Real T>
    requires std::same_as<std::invoke_result_t<const F&, const T&, const BasicRotorState<T>&>,
                          BasicVec3<T>>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return {{}, torque_(at.t, at.s)};
  }

 private:
  F torque_;
  double time_scale_;
};

// `switches` is a callable of (double t, const RotorState& s) that returns a std::vector<double>,
// always of one size; the last argument of `torque` is a std::span<const double> of as many sides.
template <class F, class S>
class SwitchedTorqueTerm {
 public:
  SwitchedTorqueTerm(F torque, S switches,
                     double time_scale = std::numeric_limits<double>::infinity())
      : torque_(std::move(torque)), switches_(std::move(switches)), time_scale_(time_scale) {}

  double time_scale() const { return time_scale_; }
  std::vector<double> switches(const Setting& at) const { return switches_(at.t, at.s); }

  template <Real T>
    requires std::same_as<std::invoke_result_t<const F&, const T&, const BasicRotorState<T>&,
                                               std::span<const double>>,
                          BasicVec3<T>>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    if (!at.sides.empty()) return {{}, torque_(at.t, at.s, at.sides)};
    std::vector<double> sides = switches_(to_double(at.t), rounded(at.s));
    for (double& value : sides) value = side_of(value);
    return {{}, torque_(at.t, at.s, std::span<const double>(sides))};
  }

 private:
  template <Real T>
  static RotorState rounded(const BasicRotorState<T>& s) {
    const auto f = [](const T& x) { return to_double(x); };
    return {{f(s.q.w), f(s.q.x), f(s.q.y), f(s.q.z)}, {f(s.g.x), f(s.g.y), f(s.g.z)}};
  }

  F torque_;
  S switches_;
  double time_scale_;
};

// MomentumTerm: an energy that is linear in the angular momentum, H' = a . g, such as that of a
// moving frame or of a rotor of constant speed; its own motion is a rotation.
//
// Equations   v = dH'/dg = a. Along body axes u = 0: by itself the term rotates the body by a h,
//             with dg/dt = g x a. Along axes in space u = a x g: body and momentum rotate together
//             [SA (107), (118): a moving frame has a = -mu].
// Units       a in rad per time.
// Domain      a(t): any function of time, generic or on double, that returns a vector. Runs in
//             double-double need a generic one. Splitting evaluates it at the time of its step.
// Accuracy    a few roundings; the flow is exact for a constant a.
// Errors      what the function throws passes through.
// Cost        the function and one rotation.

// A function of time on T.
template <class F, class T>
concept RateOn = requires(const F& a, const T& t) {
  { a(t) } -> std::same_as<BasicVec3<T>>;
};

template <class F>
class MomentumTerm {
 public:
  // `axes` are those of a; without them, body axes.
  explicit MomentumTerm(F a, std::optional<SpaceAxes> axes = {}) : a_(std::move(a)), axes_(axes) {}

  template <Real T>
    requires(RateOn<F, T> || derivative_order<T> > 0)
  T energy(const BasicSetting<T>& at) const {
    return dot(in_body(at), at.s.g);
  }
  template <Real T>
    requires(RateOn<F, T> || derivative_order<T> > 0)
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
    if constexpr (RateOn<F, T>) {
      a = a_(at.t);
    } else {  // no variable moves the time
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
