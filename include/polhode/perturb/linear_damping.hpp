// SPDX-License-Identifier: MIT
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
#pragma once

#include <optional>

#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

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
