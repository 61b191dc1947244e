// SPDX-License-Identifier: MIT
// Rates of canonical variables under a system, and the Andoyer variables of a moving frame.
#include "polhode/system/canonical_rates.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "polhode/math/vector.hpp"
#include "polhode/rotor/body.hpp"
#include "system/gauge.hpp"

namespace polhode {
inline namespace v0 {
namespace rates {

namespace {

constexpr CanonicalChart euler_chart{CanonicalSet::euler};
constexpr CanonicalChart andoyer_chart{CanonicalSet::andoyer};

// B^-1 x; NaN where a row of B^-1 is not finite, that is where the variable does not exist, and for
// G = |g| where g = 0.
CanonicalRates charted(const CanonicalChart& chart, const RotorState& s, const HubRates& x) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CanonicalRates z = inverse_chart_jacobian(s, chart) * polhode::detail::tangent(x.theta, x.g);
  for (double& rate : z)
    if (!std::isfinite(rate)) rate = none;
  if (s.g == Vec3{} && chart.set != CanonicalSet::euler)
    z[chart.set == CanonicalSet::andoyer ? 4 : 3] = none;
  return z;
}

}  // namespace

HubRates hub_rates(const System& system, double t, const RotorState& s) {
  const HubRates added = perturbation_rates(system, t, s);
  const Vec3 w = angular_velocity(system.body(), s);
  return {w + added.theta, cross(s.g, w) + added.g};
}

HubRates perturbation_rates(const System& system, double t, const RotorState& s) {
  const FrameMotion frame = system.frame().at(t);
  const Setting at{system.body(), t, {normalized(s.q), s.g}, frame.q_IS};
  const Effect terms = terms_effect(system, at);
  // not g x (v - mu) + (u + g x mu): cancels
  return {terms.v - body_from_reference(at, frame.mu_S), cross(s.g, terms.v) + terms.u};
}

CanonicalRates canonical_rates(const System& system, double t, const RotorState& s,
                               const CanonicalChart& chart) {
  return charted(chart, s, hub_rates(system, t, s));
}

CanonicalRates perturbation_rates(const System& system, double t, const RotorState& s,
                                  const CanonicalChart& chart) {
  return charted(chart, s, perturbation_rates(system, t, s));
}

AndoyerRates andoyer_rates(const System& system, double t, const RotorState& s) {
  const CanonicalRates z = canonical_rates(system, t, s, andoyer_chart);
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}

EulerPhaseRates euler_phase_rates(const System& system, double t, const RotorState& s) {
  const CanonicalRates z = canonical_rates(system, t, s, euler_chart);
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}

std::array<double, 3> convective_term(const System& system, double t, const RotorState& s,
                                      const CanonicalChart& chart) {
  const CanonicalRates z = perturbation_rates(system, t, s, chart);
  return {z[0], z[1], z[2]};
}

}  // namespace rates
}  // namespace v0
}  // namespace polhode
