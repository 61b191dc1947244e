// SPDX-License-Identifier: MIT
#include "polhode/perturb/solar_pressure.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

void require_positive_value(const std::string& what, double x) {
  if (!(x > 0.0) || !std::isfinite(x))
    throw DomainError(what + " " + detail::number_text(x) + " must be positive and finite");
}

}  // namespace

Shadow Shadow::cylinder(double radius) {
  require_positive_value("Shadow: radius", radius);
  return {ShadowShape::cylinder, radius, 0.0};
}

Shadow Shadow::cone(double radius, double sun_radius) {
  require_positive_value("Shadow: radius", radius);
  require_positive_value("Shadow: sun_radius", sun_radius);
  return {ShadowShape::cone, radius, sun_radius};
}

std::vector<double> Shadow::borders(const Vec3& to_sun, const Vec3& to_body) const {
  const double sun = norm(to_sun), away = norm(to_body);
  const Vec3 s = (1.0 / sun) * to_sun;
  const double ahead = dot(s, to_body);
  if (shape_ == ShadowShape::cylinder) {
    // |across|^2 on the far side and |away|^2 on the near one: smooth where they meet
    const double square = ahead > 0.0 ? dot(cross(s, to_body), cross(s, to_body)) : away * away;
    return {square / (radius_ * radius_) - 1.0};
  }
  if (!(sun_radius_ < sun) || !(radius_ < away)) return {1.0, 1.0};
  const double a = std::asin(sun_radius_ / sun), b = std::asin(radius_ / away);
  const double c = std::atan2(norm(cross(s, to_body)), ahead);
  // squares: c itself has a kink where the centres meet, and its dip there is no parabola
  return {c * c - (a + b) * (a + b), c * c - (a - b) * (a - b)};
}

std::vector<double> SolarPressure::switches(const Setting& at) const {
  const Vec3 from_centre = path_.position(at);
  const Vec3 to_sun = sun_ ? sun_->position(at) - from_centre : -from_centre;
  std::vector<double> values;
  if (sun_ && shadow_) values = shadow_->borders(to_sun, -from_centre);
  stream_.add_edges(body_from_space(at, axes_, (1.0 / norm(to_sun)) * to_sun), values);
  return values;
}

SolarPressure::SolarPressure(const Surface& surface_B, const Sunlight& light, DirectedPath path,
                             SpaceAxes axes)
    : stream_(surface_B, light_law), light_(light), path_(std::move(path)), axes_(axes) {
  require_positive_value("SolarPressure: pressure", light.pressure);
  require_positive_value("SolarPressure: distance", light.distance);
}

SolarPressure::SolarPressure(const Surface& surface_B, const Sunlight& light, DirectedPath path,
                             DirectedPath sun, std::optional<Shadow> shadow, SpaceAxes axes)
    : SolarPressure(surface_B, light, std::move(path), axes) {
  sun_ = std::move(sun);
  shadow_ = shadow;
}

}  // namespace v0
}  // namespace polhode
