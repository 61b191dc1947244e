// SPDX-License-Identifier: MIT
// The Lie transform of a gravity gradient: which terms it takes, and what it refuses.
#pragma once

#include "polhode/secular/gravity_gradient_theory.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "secular/rotation_harmonics.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What is asked for, and the actions to expand about.
struct GravityGradientRequest {
  Body body;
  double gm;
  KeplerOrbit orbit;
  SadovState at;
  GravityGradientOptions options;
};
void require_valid(const GravityGradientRequest& request);

struct GravityGradientTransform {
  LieTransform<ActionTaylor> transform;
  std::size_t term_count;  // of the gravity gradient
  double largest_angle;    // by which a term of the first order moves an angle, rad
  double left_out;         // of the mean rates, rad per rad of rotation
};
// In the variables I_l, I_g, I_h and k, and the angles phi_l, phi_g, phi_h and M. k counts orders.
GravityGradientTransform transformed(const GravityGradientRequest& request);
Truncation gradient_orders(int order);

// What GravityGradientTheory says when it refuses.
[[noreturn]] void refuse_theory(const std::string& why);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
