// SPDX-License-Identifier: MIT
// What models of a spin axis share.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "polhode/secular/spin_axis.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

struct SpinModel {
  using State = SpinAxis;
  using Values = std::array<double, 3>;

  template <class T>
    requires std::is_same_v<T, double>
  Values values(const SpinAxis& axis) const {
    return {axis.s.x, axis.s.y, axis.s.z};
  }
  SpinAxis state(const Values& y) const { return spin_axis({y[0], y[1], y[2]}); }
  SpinAxis started(const SpinAxis& axis) const { return spin_axis(axis.s); }
  double error_size(const Values& error, const Values&, const Values&) const {
    return std::hypot(error[0], error[1], error[2]);
  }
};

// s turned by an angle about the unit vector n, of length 1 to rounding.
SpinAxis turned(const SpinAxis& axis, const Vec3& n, double angle);

}  // namespace detail

}  // namespace secular
}  // namespace v0
}  // namespace polhode
