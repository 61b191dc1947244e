// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "drag".
#include <optional>
#include <string>

#include "polhode/perturb/atmospheric_drag.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

enum class PathOf { body, attractor };

struct Arguments {
  std::string orbit;
  PathOf orbit_of;
  double density;
  std::optional<double> density_radius;
  std::optional<double> scale_height;
  double air_rate;
  Vec3 air_pole;
  double exit_speed;
};

constexpr KindKey<Arguments> keys[] = {
    orbit_key<&Arguments::orbit>(),
    orbit_of_key<&Arguments::orbit_of, PathOf::body, PathOf::attractor>(),
    quantity_key<&Arguments::density>(
        "density", Dimension::density,
        "Density of the air: everywhere, or with scale_height at density_radius.")
        .required()
        .example("\"1e-12 kg/m3\"")
        .not_negative(),
    quantity_key<&Arguments::density_radius>(
        "density_radius", Dimension::length,
        "The distance from the centre at which the air has that density.")
        .example("\"6778 km\"")
        .positive(),
    quantity_key<&Arguments::scale_height>("scale_height", Dimension::length,
                                           "The height over which the density falls by a factor e.")
        .example("\"60 km\"")
        .positive(),
    quantity_key<&Arguments::air_rate>("air_rate", Dimension::rate,
                                       "The rate at which the air turns; 0 if it does not.")
        .required()
        .example("\"360.9856 deg/d\""),
    quantity_key<&Arguments::air_pole>(
        "air_pole", Dimension::number,
        "The axis about which it turns, in inertial axes; its length plays no part.")
        .otherwise("[0, 0, 1]")
        .example("[0.0, 0.0, 1.0]"),
    quantity_key<&Arguments::exit_speed>(
        "exit_speed", Dimension::speed,
        "The speed at which molecules leave a wall that they have taken the temperature of.")
        .otherwise("0")
        .example("\"500 m/s\"")
        .not_negative(),
};

Atmosphere air_of(const Arguments& a, const TermContext& at) {
  if (a.air_rate != 0.0) require_pole(at, "air_pole");
  const double length = norm(a.air_pole);
  if (!(length > 0.0)) at.refuse("air_pole", "expected a vector that has a direction");
  Atmosphere air{.density = a.density};
  air.rotation = (a.air_rate / length) * a.air_pole;
  if (a.scale_height) {
    if (!a.density_radius) at.refuse("scale_height", "expected a key density_radius as well");
    air.scale_height = *a.scale_height;
    air.radius = *a.density_radius;
  } else if (a.density_radius) {
    at.refuse("density_radius", "expected a key scale_height as well");
  }
  return air;
}

MadeTerms made(const Arguments& a, const TermContext& at) {
  const Surface& surface = at.surface();
  const Atmosphere air = air_of(a, at);
  const ScenarioOrbit& orbit = at.orbit("orbit");
  return AnyPerturbation(
      at.name("drag on " + std::to_string(surface.facets().size()) + " facets, orbit " +
              orbit.name),
      AtmosphericDrag(surface, air, {any_orbit(orbit), a.orbit_of == PathOf::attractor},
                      a.exit_speed));
}

}  // namespace

PerturbationKind drag_kind() {
  PerturbationKind kind = perturbation_kind<Arguments>(
      "drag", "Air on the facets of [[surface]], a free molecular flow.", keys, made,
      {{"schaaf1961",
        "Schaaf, S. A., Chambre, P. L. (1961). Flow of Rarefied Gases. Princeton University "
        "Press.",
        "the force of free molecules on a facet"}});
  kind.on_surface = true;
  kind.needs_velocity = true;
  kind.class_name = "AtmosphericDrag";
  kind.equations = "Molecules that are slow against the body; facets do not shade each other.";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
