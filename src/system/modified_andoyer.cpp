// SPDX-License-Identifier: MIT
#include "polhode/system/modified_andoyer.hpp"

#include <cmath>
#include <limits>

#include "polhode/free/free_rotation.hpp"
#include "system/detail/tangent.hpp"

namespace polhode {
inline namespace v0 {

AndoyerState modified_andoyer(const Body& body, double t0, double t, const RotorState& s) {
  return to_andoyer(FreeRotation(body, s, t).at(t0));
}

RotorState from_modified_andoyer(const Body& body, double t0, double t, const AndoyerState& C) {
  return FreeRotation(body, to_rotor(C), t0).at(t);
}

AndoyerRates modified_andoyer_rates(const System& system, double t0, double t,
                                    const RotorState& s) {
  const FreeRotation motion(system.body(), s, t);
  const std::array<double, 6> at_epoch =
      detail::product(motion.state_transition(t0), perturbation_rates(system, t, s));
  CanonicalRates z =
      detail::product(inverse_chart_jacobian({CanonicalSet::andoyer}, motion.at(t0)), at_epoch);
  for (double& rate : z)
    if (!std::isfinite(rate)) rate = std::numeric_limits<double>::quiet_NaN();
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}

}  // namespace v0
}  // namespace polhode
