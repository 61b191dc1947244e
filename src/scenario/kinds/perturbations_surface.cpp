// SPDX-License-Identifier: MIT
// From the values of a file to its surfaces, and to sunlight and air on them.
#include <utility>

#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "scenario/detail/perturbation_kinds.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

Finish finish_of(const Values& values, const std::string& path, const std::string& name) {
  const auto fraction = [&](const char* own) {
    const std::string key = path + "." + own;
    const double x = number(values, key);
    if (!(x >= 0.0 && x <= 1.0)) refuse(values, key, name, "expected a fraction from 0 to 1");
    return x;
  };
  if (fraction("specular") + fraction("diffuse") > 1.0)
    refuse(values, path + ".diffuse", name, "expected at most 1 together with specular");
  return {.specular = fraction("specular"),
          .diffuse = fraction("diffuse"),
          .emitted = fraction("emitted"),
          .normal_accommodation = fraction("normal_accommodation"),
          .tangential_accommodation = fraction("tangential_accommodation")};
}

Surface mesh_surface(const Rotation& rotation, const Values& values, const std::string& path,
                     const std::string& name) {
  if (is_explicit(values, path + ".sides"))
    refuse(values, path + ".sides", name, "expected no sides together with a shape");
  Vec3 centre;
  if (has(values, path + ".centre_of_mass"))
    centre = vector(values, path + ".centre_of_mass");
  else if (rotation.shape)
    centre = rotation.shape->inside.centre;
  const FacetShape mesh = mesh_of(values, path, name);
  return built(values, path + ".shape", name,
               [&] { return Surface::of_shape(mesh, centre, finish_of(values, path, name)); });
}

Surface plate_surface(const Values& values, const std::string& path, const std::string& name) {
  for (const char* own : {".scale", ".centre_of_mass"})
    if (has(values, path + own)) refuse(values, path + own, name, "expected a key shape as well");
  const Vec3 normal = vector(values, path + ".normal");
  const double area = number(values, path + ".area");
  if (!(norm(normal) > 0.0))
    refuse(values, path + ".normal", name, "expected a vector that has a direction");
  if (!(area > 0.0)) refuse(values, path + ".area", name, "expected a positive area");
  const bool both_sides = value_at(values, path + ".sides").whole == 2;
  return built(values, path + ".position", name, [&] {
    return Surface::of_plate(vector(values, path + ".position"), normal, area,
                             finish_of(values, path, name), both_sides);
  });
}

const Surface& surface_at(const TermContext& at) {
  const Surface* const surface = at.surface();
  if (surface == nullptr)
    refuse(at.values, at.key("kind"), at.name,
           "expected a table [[surface]], since it acts on facets");
  return *surface;
}

DirectedPath path_at(const TermContext& at) {
  return {any_orbit(orbit_at(at)), word(at.values, at.key("orbit_of")) == "attractor"};
}

double length_at(const TermContext& at, const char* own, const char* with) {
  if (!has(at.values, at.key(own)))
    refuse(at.values, at.key(with), at.name, std::string("expected a key ") + own + " as well");
  const double x = number(at.values, at.key(own));
  if (!(x > 0.0)) refuse(at.values, at.key(own), at.name, "expected a positive length");
  return x;
}

std::optional<Shadow> shadow_at(const TermContext& at) {
  const std::string& shape = word(at.values, at.key("shadow"));
  if (shape == "none") return std::nullopt;
  if (!has(at.values, at.key("sun")))
    refuse(at.values, at.key("shadow"), at.name,
           "expected a key sun as well: without it the body goes round the Sun itself");
  const double radius = length_at(at, "shadow_radius", "shadow");
  if (shape == "cylinder") return Shadow::cylinder(radius);
  return Shadow::cone(radius, length_at(at, "sun_radius", "shadow"));
}

Vec3 air_rotation(const TermContext& at) {
  const double rate = number(at.values, at.key("air_rate"));
  const Vec3 pole = vector(at.values, at.key("air_pole"));
  const double length = norm(pole);
  if (!(length > 0.0))
    refuse(at.values, at.key("air_pole"), at.name, "expected a vector that has a direction");
  return (rate / length) * pole;
}

}  // namespace

std::shared_ptr<const Surface> surface_of(const Rotation& rotation, const Values& values,
                                          const std::string& name) {
  std::vector<Surface> parts;
  for (const std::string& path : array_paths(values, "surface"))
    parts.push_back(has(values, path + ".shape") ? mesh_surface(rotation, values, path, name)
                                                 : plate_surface(values, path, name));
  if (parts.empty()) return nullptr;
  const Surface all = joined(parts);
  const Quaternion& q_FB = rotation.q_file;
  return std::make_shared<const Surface>(q_FB == Quaternion{} ? all : all.along(q_FB));
}

AnyPerturbation solar_pressure_term(const TermContext& at) {
  const Surface& surface = surface_at(at);
  const ScenarioOrbit& orbit = orbit_at(at);
  const Sunlight light{number(at.values, at.key("pressure")),
                       length_at(at, "pressure_distance", "pressure_distance")};
  if (!(light.pressure > 0.0))
    refuse(at.values, at.key("pressure"), at.name, "expected a positive pressure");
  const std::optional<Shadow> shadow = shadow_at(at);
  const std::string text = "solar pressure on " + std::to_string(surface.facets().size()) +
                           " facets, orbit " + orbit.name;
  if (!has(at.values, at.key("sun"))) return {text, SolarPressure(surface, light, path_at(at))};
  const ScenarioOrbit& sun = at.orbit("sun");
  DirectedPath sun_path{any_orbit(sun), word(at.values, at.key("sun_orbit_of")) == "attractor"};
  return {
      text + ", Sun " + sun.name +
          (shadow ? (shadow->shape() == ShadowShape::cone ? ", shadow cone" : ", shadow cylinder")
                  : ""),
      SolarPressure(surface, light, path_at(at), std::move(sun_path), shadow)};
}

AnyPerturbation drag_term(const TermContext& at) {
  const Surface& surface = surface_at(at);
  Atmosphere air{.density = number(at.values, at.key("density"))};
  if (!(air.density >= 0.0))
    refuse(at.values, at.key("density"), at.name, "expected a density that is not negative");
  air.rotation = air_rotation(at);
  if (has(at.values, at.key("scale_height"))) {
    air.scale_height = length_at(at, "scale_height", "scale_height");
    air.radius = length_at(at, "density_radius", "scale_height");
  } else if (has(at.values, at.key("density_radius"))) {
    refuse(at.values, at.key("density_radius"), at.name, "expected a key scale_height as well");
  }
  const double exit_speed = number(at.values, at.key("exit_speed"));
  if (!(exit_speed >= 0.0))
    refuse(at.values, at.key("exit_speed"), at.name, "expected a speed that is not negative");
  return {
      "drag on " + std::to_string(surface.facets().size()) + " facets, orbit " + orbit_at(at).name,
      AtmosphericDrag(surface, air, path_at(at), exit_speed)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
