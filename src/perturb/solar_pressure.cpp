// SPDX-License-Identifier: MIT
#include "polhode/perturb/solar_pressure.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "math/detail/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

void require_positive(const std::string& what, double x) {
  if (!(x > 0.0) || !std::isfinite(x))
    throw DomainError(what + " " + detail::number_text(x) + " must be positive and finite");
}

}  // namespace

Shadow Shadow::cylinder(double radius) {
  require_positive("Shadow: radius", radius);
  return {ShadowShape::cylinder, radius, 0.0};
}

Shadow Shadow::cone(double radius, double sun_radius) {
  require_positive("Shadow: radius", radius);
  require_positive("Shadow: sun_radius", sun_radius);
  return {ShadowShape::cone, radius, sun_radius};
}

SolarPressure::SolarPressure(const Surface& surface_B, const Sunlight& light, DirectedPath path,
                             SpaceAxes axes)
    : stream_(surface_B, light_law), light_(light), path_(std::move(path)), axes_(axes) {
  require_positive("SolarPressure: pressure", light.pressure);
  require_positive("SolarPressure: distance", light.distance);
}

SolarPressure::SolarPressure(const Surface& surface_B, const Sunlight& light, DirectedPath path,
                             DirectedPath sun, std::optional<Shadow> shadow, SpaceAxes axes)
    : SolarPressure(surface_B, light, std::move(path), axes) {
  sun_ = std::move(sun);
  shadow_ = shadow;
}

}  // namespace v0
}  // namespace polhode
