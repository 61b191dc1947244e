// SPDX-License-Identifier: MIT
// Terms whose torque begins and ends like a fractional power of the time.
#pragma once

#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/solar_pressure.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Sunlight in a penumbra grows with the power 3/2 of the time since its edge. Other terms of the
// library are smooth on both sides of their edges.
inline bool fades_at_edges(const AnyPerturbation& term) {
  const auto* light = term.target<SolarPressure>();
  return light != nullptr && light->shadow() && light->shadow()->shape() == ShadowShape::cone;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
