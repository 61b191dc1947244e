// SPDX-License-Identifier: MIT
// InternalDamping: friction inside the body. It takes energy and no angular momentum, so that the
// spin goes over to the axis of the largest moment.
//
// Equations   v = k g x w, w = I^-1 g, u = 0: dg/dt = g x (w + v) turns g in the body and keeps it
//             in space, and dT/dt = -(g x w).k(g x w) <= 0 for T = (1/2) g.I^-1 g. k is a number, a
//             diagonal in principal axes, or a number times |g|. For I = (A, A, C) and a number k
//             the angle J from axis 3 to g obeys tan J = tan J0 exp(-k (C - A) G^2 t / (A C)).
//             A sphere of moment J_d in a cavity with the friction c (torque per rate), where it
//             can follow, is k = J_d^2 / c I^-2. A material: k in proportion to |g|, so that a
//             small wobble about the axis of the largest moment falls by e in mu Q / (rho K3^2 R^2
//             w^3), the time of Burns and Safronov (1973).
// Units       k in 1 / momentum (v in rad per time).
// Domain      k >= 0, any state. I^-1 g + v is the angular velocity, as for every term; g is all of
//             the momentum, what moves inside included.
// Accuracy    a few roundings.
// Errors      DomainError for a negative coefficient; for a wobble of a body without an axis of
//             largest moment.
// Cost        some 20 flops.
#pragma once

#include <optional>

#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

// A material and its size, in the units of the system: mu / (rho R^2 w^2) is a pure number.
struct DampedMaterial {
  double rigidity;        // mu, a pressure
  double quality_factor;  // Q
  double density;         // rho
  double radius;          // R, the mean one
  double shape_factor =
      0.1;  // K3^2: about 0.1 for elongated bodies, 0.01 for nearly spherical ones
};

// v = k (g x w), k a number along each axis.
struct InternalDampingLaw {
  static constexpr bool adds_rate = true;
  static constexpr bool in_library = true;

  Vec3 k;
  bool grows;  // k with |g|

  bool operator==(const InternalDampingLaw&) const = default;

  template <Number T>
  struct OfTime {};
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>&, const BasicPose<T>& at) const {
    const BasicVec3<T>& I = at.moments;
    const BasicVec3<T>& g = at.s.g;
    // not g x w: what is equal in I would cancel
    const T x = (I.y - I.z) / (I.y * I.z), y = (I.z - I.x) / (I.z * I.x),
            z = (I.x - I.y) / (I.x * I.y);
    BasicVec3<T> v{T(k.x) * (x * (g.y * g.z)), T(k.y) * (y * (g.z * g.x)),
                   T(k.z) * (z * (g.x * g.y))};
    if (grows) v = norm(g) * v;
    return {v, {}};
  }
};

class InternalDamping {
 public:
  using Law = InternalDampingLaw;

  // v = k (g x w).
  explicit InternalDamping(double k);
  // v_i = k_i (g x w)_i in principal axes; or with |g| k_i, where k grows with the momentum.
  explicit InternalDamping(const Vec3& k_B, bool grows = false);

  // A constant k with which a small wobble about the axis of the largest moment falls by e in
  // `time`, at the momentum `momentum`. For three different moments: the mean over the wobble.
  static InternalDamping of_wobble(const Body& body, double time, double momentum);
  static InternalDamping of_material(const Body& body, const DampedMaterial& material);

  const Vec3& coefficients() const { return law_.k; }
  // Whether k is to be multiplied by |g|.
  bool grows_with_momentum() const { return law_.grows; }

  const Law& law() const { return law_; }
  template <Real T>
  static Law::OfTime<T> of_time(const BasicSetting<T>&) {
    return {};
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law_.effect(of_time(at), pose_of(at));
  }

 private:
  Law law_;
};

// mu Q / (rho K3^2 R^2 w^3).
double wobble_time(const DampedMaterial& material, double rate);

// LinearDamping: viscous friction against inertial axes, a torque proportional to the rate.
//
// Equations   u = -D w, w = I^-1 g the inertial angular velocity. Its own flow is g(h) = exp(-h D
//             I^-1) g; for a full D through the symmetric matrix I^-1/2 D I^-1/2.
// Units       D in torque per rate.
// Domain      D in principal body axes: diagonal with entries >= 0, or symmetric (to 8 eps of its
//             largest entry) and non-negative definite (to as much). Any h of either sign.
// Accuracy    a few roundings of g, for flows too.
// Errors      DomainError for a matrix that is not finite, not symmetric, or would drive the body.
// Cost        effect some 10 flops; flow three exponentials. For a full D the constructor solves
//             one eigenvalue problem for its body; the flow of another body solves its own.

// u = -D I^-1 g, along the axes or as a full matrix.
struct LinearDampingLaw {
  static constexpr bool adds_rate = false;
  static constexpr bool in_library = true;

  Mat3 D;
  bool diagonal;

  bool operator==(const LinearDampingLaw&) const = default;

  template <Number T>
  struct OfTime {};
  template <Number T>
  BasicEffect<T> effect(const OfTime<T>&, const BasicPose<T>& at) const {
    const BasicVec3<T>& I = at.moments;
    const BasicVec3<T> w{at.s.g.x / I.x, at.s.g.y / I.y, at.s.g.z / I.z};
    if (diagonal) return {{}, {T(-D(0, 0)) * w.x, T(-D(1, 1)) * w.y, T(-D(2, 2)) * w.z}};
    const auto row = [&](int i) {
      return -(T(D(i, 0)) * w.x + T(D(i, 1)) * w.y + T(D(i, 2)) * w.z);
    };
    return {{}, {row(0), row(1), row(2)}};
  }
};

class LinearDamping {
 public:
  using Law = LinearDampingLaw;

  // The same D about every axis: u = -d w.
  explicit LinearDamping(double d);
  // Diagonal in principal axes.
  explicit LinearDamping(const Vec3& diagonal_B);
  // `body` is the one to which the term will be applied.
  LinearDamping(const Mat3& D_B, const Body& body);

  const Mat3& matrix() const { return D_; }

  Law law() const { return {D_, !modes_}; }
  template <Real T>
  static Law::OfTime<T> of_time(const BasicSetting<T>&) {
    return {};
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law().effect(of_time(at), pose_of(at));
  }
  RotorState flow(const Setting& at, double h) const;

 private:
  // D I^-1 = to_g diag(rate) from_g
  struct Modes {
    Vec3 moments;
    Mat3 to_g;
    Mat3 from_g;
    Vec3 rate;
  };
  static Modes modes_of(const Mat3& D, const Vec3& moments);

  Mat3 D_;
  std::optional<Modes> modes_;  // none: diagonal
};

}  // namespace v0
}  // namespace polhode
