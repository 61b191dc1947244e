// SPDX-License-Identifier: MIT
#include "polhode/perturb/atmospheric_drag.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
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
