// SPDX-License-Identifier: MIT
#include "polhode/perturb/tidal_torque.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

double tidal_strength(double gm, double mass, const TidalBody& of) {
  const auto require = [](bool good, const char* what, double x, const char* needed) {
    if (!good || !std::isfinite(x))
      throw DomainError(std::string("TidalTorque: ") + what + " " + number_text(x) + " must be " +
                        needed + " and finite");
  };
  require(gm > 0.0, "gm", gm, "positive");
  require(mass > 0.0, "mass", mass, "positive");
  require(of.radius > 0.0, "radius", of.radius, "positive");
  require(of.k2 >= 0.0, "k2", of.k2, ">= 0");
  require(of.lag >= 0.0, "lag", of.lag, ">= 0");
  return 3.0 * of.k2 * gm * mass * std::pow(of.radius, 5) * of.lag;
}

void require_velocity(const AnyOrbit& orbit) {
  if (!orbit.supports_velocity())
    throw DomainError("TidalTorque: orbit \"" + orbit.name() + "\" must have a velocity");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
