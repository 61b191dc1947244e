// SPDX-License-Identifier: MIT
// Torques on the facets of a surface: solar radiation pressure and atmospheric drag.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/detail/perturb/facet_stream.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/solar_pressure.hpp"

namespace polhode {
inline namespace v0 {

StreamLaw light_law(const Finish& finish) {
  const double absorbed = 1.0 - finish.specular - finish.diffuse;
  return {1.0 - finish.specular, 2.0 * finish.specular,
          2.0 / 3.0 * (finish.diffuse + finish.emitted * absorbed)};
}

StreamLaw molecule_law(const Finish& finish) {
  const double n = finish.normal_accommodation, t = finish.tangential_accommodation;
  return {t, 2.0 - n - t, n};
}

FacetStream::FacetStream(const Surface& surface, StreamLaw (*law)(const Finish&))
    : surface_(surface) {
  rows_.reserve(surface.facets().size());
  for (const SurfaceFacet& f : surface.facets()) {
    const StreamLaw own = law(f.finish);
    rows_.push_back({f.normal, (f.area * own.along) * f.centre, f.area * cross(f.centre, f.normal),
                     own.mirrored, own.normal, f.area, f.area * own.along});
  }
  find_edges();
}

void FacetStream::find_edges() {
  for (Row& row : rows_) {
    const auto known = std::find_if(edges_.begin(), edges_.end(),
                                    [&](const Vec3& n) { return n == row.n || n == -row.n; });
    row.edge = static_cast<std::size_t>(known - edges_.begin());
    row.towards = known == edges_.end() || *known == row.n ? 1.0 : -1.0;
    if (known == edges_.end()) edges_.push_back(row.n);
    if (edges_.size() > most_edges) {
      edges_.clear();
      return;
    }
  }
}

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

namespace {

void require(bool good, const char* what, double x, const char* requirement) {
  if (!good)
    throw DomainError(std::string("AtmosphericDrag: ") + what + " " + detail::number_text(x) +
                      " must be " + requirement);
}

}  // namespace

AtmosphericDrag::AtmosphericDrag(const Surface& surface_B, const Atmosphere& air, DirectedPath path,
                                 double exit_speed)
    : stream_(surface_B, molecule_law), air_(air), path_(std::move(path)), exit_speed_(exit_speed) {
  require(air.density >= 0.0 && std::isfinite(air.density), "density", air.density,
          "at least 0 and finite");
  require(air.radius > 0.0 && std::isfinite(air.radius), "radius", air.radius,
          "positive and finite");
  require(air.scale_height > 0.0, "scale_height", air.scale_height, "positive");
  require(exit_speed >= 0.0 && std::isfinite(exit_speed), "exit_speed", exit_speed,
          "at least 0 and finite");
  for (int i = 0; i < 3; ++i)
    require(std::isfinite(air.rotation[i]), "rotation", air.rotation[i], "finite");
  if (!path_.orbit.supports_velocity())
    throw DomainError("AtmosphericDrag: orbit " + path_.orbit.name() +
                      " must have a velocity: one that takes Dual times");
}

std::vector<double> AtmosphericDrag::switches(const Setting& at) const {
  std::vector<double> values;
  stream_.add_edges(body_from_inertial(at, flow_at(at.t, at.t_rest).from), values);
  return values;
}

AtmosphericDrag::Flow AtmosphericDrag::flow_at(double t, double rest) const {
  Vec3 x = path_.orbit.position(t, rest);
  if (path_.reversed) x = -x;
  return flow_of(x, path_.velocity(t));
}

AtmosphericDrag::Flow AtmosphericDrag::flow_of(const Vec3& x, const Vec3& velocity) const {
  const Vec3 v = velocity - cross(air_.rotation, x);
  const double speed = norm(v);
  const double density = air_.density * std::exp((air_.radius - norm(x)) / air_.scale_height);
  return {(1.0 / speed) * v, speed, density * (speed * speed)};
}

}  // namespace v0
}  // namespace polhode
