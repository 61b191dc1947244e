// SPDX-License-Identifier: MIT
// A spin state in free rotation at many times, with derivatives by every parameter of it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "polhode/fit/spin_fit.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// The free rotation of a state, in principal axes and units of Izz.
FreeRotation free_rotation_of(const SpinState& s);
// The state that it has come to at t.
SpinState spin_at(const SpinState& s, double t);

// dtheta_F at t0; w_F; Ixx, Iyy, Ixy, Iyz, Ixz over Izz.
inline constexpr std::size_t spin_parameters = 11;
inline constexpr std::size_t first_rate = 3, first_ratio = 6, first_product = 8;

struct MotionPoint {
  Quaternion q;  // F to inertial
  Vec3 w_F;
  // By each parameter: the rotation vector of the attitude in body axes F, and the change of w_F.
  std::array<Vec3, spin_parameters> turn;
  std::array<Vec3, spin_parameters> rate;
};

// Free rotation. False where the state is none that a body may have, or derivatives are not
// numbers. Derivatives of products and of principal axes that turn with them: only where asked.
struct Asked {
  bool derivatives = false;
  bool products = false;
};
bool free_motion(const SpinState& s, const std::vector<double>& times, Asked asked,
                 std::vector<MotionPoint>& points);

// d ln / d parameter of the mean rate of precession of axis 1 of the arc, and of the period of the
// polhode; NaN where the motion is a degenerate one.
struct RateDerivatives {
  std::array<double, spin_parameters> precession, period;
};
RateDerivatives rate_derivatives(const SpinState& s);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
