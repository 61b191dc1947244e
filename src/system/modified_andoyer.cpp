// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include "polhode/free/free_rotation.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "polhode/system/osculation.hpp"

namespace polhode {
inline namespace v0 {
namespace charts {

AndoyerState modified_andoyer(const Body& body, double t, const RotorState& s, double t0) {
  return to_andoyer(FreeRotation(body, s, t).at(t0));
}

RotorState from_modified_andoyer(const Body& body, double t, const AndoyerState& C, double t0) {
  return FreeRotation(body, to_rotor(C), t0).at(t);
}

rates::AndoyerRates modified_andoyer_rates(const System& system, double t, const RotorState& s,
                                           double t0) {
  const FreeRotation motion(system.body(), s, t);
  const rates::HubRates added = rates::perturbation_rates(system, t, s);
  const std::array<double, 6> now = {added.theta.x, added.theta.y, added.theta.z,
                                     added.g.x,     added.g.y,     added.g.z};
  const std::array<double, 6> at_epoch = motion.state_transition(t0) * now;
  rates::CanonicalRates z =
      inverse_chart_jacobian(motion.at(t0), {CanonicalSet::andoyer}) * at_epoch;
  for (double& rate : z)
    if (!std::isfinite(rate)) rate = std::numeric_limits<double>::quiet_NaN();
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}

}  // namespace charts
}  // namespace v0
}  // namespace polhode
