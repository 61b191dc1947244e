// SPDX-License-Identifier: MIT
#include "polhode/perturb/gravity_gradient.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_gravity(double gm) {
  if (!(gm > 0.0) || !std::isfinite(gm))
    throw DomainError("GravityGradient: gm " + number_text(gm) + " must be positive and finite");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
