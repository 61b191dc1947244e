// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "solar-pressure".
#include "polhode/perturb/solar_pressure.hpp"

#include <optional>
#include <string>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

enum class PathOf { body, attractor };
enum class SunPathOf { sun, attractor };
enum class Shape { none, cylinder, cone };

struct Arguments {
  std::string orbit;
  PathOf orbit_of;
  std::optional<std::string> sun;
  SunPathOf sun_orbit_of;
  double pressure;
  double pressure_distance;
  Shape shadow;
  std::optional<double> shadow_radius;
  std::optional<double> sun_radius;
  SpaceAxes axes;
};

constexpr KindKey<Arguments> keys[] = {
    orbit_key<&Arguments::orbit>(),
    orbit_of_key<&Arguments::orbit_of, PathOf::body, PathOf::attractor>(),
    name_key<&Arguments::sun>(
        "sun",
        "The name of a table [orbit.NAME] that ties the Sun to what the body goes round; left out, "
        "the body goes round the Sun itself.")
        .example("\"sun\""),
    choice_key<&Arguments::sun_orbit_of, SunPathOf::sun, SunPathOf::attractor>(
        "sun_orbit_of", "sun|attractor",
        "Whose path that orbit is: the Sun's as seen from what the body goes round, or the "
        "reverse.")
        .otherwise("\"sun\""),
    quantity_key<&Arguments::pressure>(
        "pressure", Dimension::pressure,
        "Pressure of sunlight on what absorbs it, at pressure_distance; 4.54e-6 N/m2 at 1 au.")
        .required()
        .example("\"4.54e-6 N/m2\"")
        .positive(),
    quantity_key<&Arguments::pressure_distance>(
        "pressure_distance", Dimension::length,
        "The distance from the Sun at which it has that pressure.")
        .required()
        .example("\"1 au\"")
        .positive(),
    choice_key<&Arguments::shadow, Shape::none, Shape::cylinder, Shape::cone>(
        "shadow", "none|cylinder|cone",
        "The shadow of what the body goes round: a cylinder along the direction from the body to "
        "the Sun, or umbra and penumbra.")
        .otherwise("\"none\"")
        .example("\"cone\""),
    quantity_key<&Arguments::shadow_radius>("shadow_radius", Dimension::length,
                                            "The radius of what throws the shadow.")
        .example("\"6378 km\"")
        .positive(),
    quantity_key<&Arguments::sun_radius>("sun_radius", Dimension::length,
                                         "The radius of the Sun, for a shadow that is a cone.")
        .example("\"695700 km\"")
        .positive(),
    axes_key<&Arguments::axes>(),
};

std::optional<Shadow> shadow_of(const Arguments& a, const TermContext& at) {
  if (a.shadow == Shape::none) return std::nullopt;
  if (!a.sun)
    at.refuse("shadow",
              "expected a key sun as well: without it the body goes round the Sun itself");
  if (!a.shadow_radius) at.refuse("shadow", "expected a key shadow_radius as well");
  if (a.shadow == Shape::cylinder) return Shadow::cylinder(*a.shadow_radius);
  if (!a.sun_radius) at.refuse("shadow", "expected a key sun_radius as well");
  return Shadow::cone(*a.shadow_radius, *a.sun_radius);
}

MadeTerms made(const Arguments& a, const TermContext& at) {
  const Surface& surface = at.surface();
  const ScenarioOrbit& orbit = at.orbit("orbit");
  const Sunlight light{a.pressure, a.pressure_distance};
  const std::optional<Shadow> shadow = shadow_of(a, at);
  const DirectedPath path{any_orbit(orbit), a.orbit_of == PathOf::attractor};
  const std::string text = "solar pressure on " + std::to_string(surface.facets().size()) +
                           " facets, orbit " + orbit.name;
  if (!a.sun) return AnyPerturbation(at.name(text), SolarPressure(surface, light, path, a.axes));
  const ScenarioOrbit& sun = at.orbit("sun");
  DirectedPath sun_path{any_orbit(sun), a.sun_orbit_of == SunPathOf::attractor};
  const std::string shape = a.shadow == Shape::none   ? ""
                            : a.shadow == Shape::cone ? ", shadow cone"
                                                      : ", shadow cylinder";
  return AnyPerturbation(at.name(text + ", Sun " + sun.name + shape),
                         SolarPressure(surface, light, path, std::move(sun_path), shadow, a.axes));
}

}  // namespace

PerturbationKind solar_pressure_kind() {
  PerturbationKind kind = perturbation_kind<Arguments>(
      "solar-pressure", "Sunlight on the facets of [[surface]], in the shadow or out of it.", keys,
      made,
      {{"wertz1978",
        "Wertz, J. R. (ed.) (1978). Spacecraft Attitude Determination and Control. Reidel, "
        "Dordrecht.",
        "the force of sunlight on a facet"},
       {"montenbruck2000", "Montenbruck, O., Gill, E. (2000). Satellite Orbits. Springer, Berlin.",
        "umbra and penumbra"}});
  kind.on_surface = true;
  kind.equations =
      "Facets do not shade each other. A torque of time and attitude alone; no energy.";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
