// SPDX-License-Identifier: MIT
// Sunlight and air on the facets of a body.
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

DirectedPath path_of(nb::handle orbit, const std::string& label, bool reversed,
                     std::vector<SharedFunction>& functions) {
  const AnyPythonOrbit any = orbit_of(orbit, label, functions);
  return {std::visit([&](const auto& o) { return AnyOrbit(label, o); }, any), reversed};
}

std::optional<Shadow> shadow_of(const std::optional<std::string>& shape,
                                std::optional<double> radius, std::optional<double> sun_radius) {
  if (!shape) return std::nullopt;
  if (*shape != "cylinder" && *shape != "cone")
    throw nb::value_error(
        ("SolarPressure: shadow: got '" + *shape + "'; expected 'cylinder', 'cone' or None")
            .c_str());
  if (!radius) throw nb::value_error("SolarPressure: a shadow needs its radius");
  if (*shape == "cylinder") return Shadow::cylinder(*radius);
  if (!sun_radius) throw nb::value_error("SolarPressure: a cone needs sun_radius");
  return Shadow::cone(*radius, *sun_radius);
}

void bind_solar(nb::module_& m) {
  bind_term<"SolarPressure">(
      m, "The torque of sunlight on the facets of a body.",
      "Facets do not shade each other. A torque of time and attitude alone; no energy.",
      [](Making& at, nb::handle_t<Surface> surface, double pressure, double distance,
         nb::handle orbit, nb::handle sun, const std::optional<std::string>& shadow,
         std::optional<double> radius, std::optional<double> sun_radius, bool reversed,
         bool sun_reversed, SpaceAxes axes) {
        const auto& facets = nb::cast<const Surface&>(surface);
        const Sunlight light{pressure, distance};
        const DirectedPath path = path_of(orbit, at.name + ": orbit", reversed, at.functions);
        const std::optional<Shadow> dark = shadow_of(shadow, radius, sun_radius);
        if (!sun.is_none())
          return AnyPerturbation(
              at.name, SolarPressure(facets, light, path,
                                     path_of(sun, at.name + ": sun", sun_reversed, at.functions),
                                     dark, axes));
        if (dark)
          throw nb::value_error(
              "SolarPressure: a shadow needs `sun`: without it the body goes round the Sun itself");
        return AnyPerturbation(at.name, SolarPressure(facets, light, path, axes));
      },
      argument<Surface>("surface", "along the principal axes of the body."),
      argument<double>("pressure",
                       "of sunlight on what absorbs it, at `distance`; 4.54e-6 N/m2 at "
                       "1 au."),
      argument<double>("distance", "that of the pressure."),
      argument<Any>("orbit",
                    "the body as seen from what it goes round: KeplerOrbit, "
                    "PrecessingKeplerOrbit, TurnedKeplerOrbit, TableOrbit or a function t "
                    "-> 3 numbers. Without `sun` that is the Sun."),
      argument<Any>("sun", "the Sun as seen from what the body goes round.", nb::none()),
      argument<std::optional<std::string>>("shadow",
                                           "of what the body goes round: None, 'cylinder' "
                                           "or 'cone', with its `radius`, and for a cone "
                                           "`sun_radius`.",
                                           nb::none()),
      argument<std::optional<double>>("radius", "of what casts the shadow.", nb::none()),
      argument<std::optional<double>>("sun_radius", "of the Sun, for a cone.", nb::none()),
      argument<bool>("reversed",
                     "the orbit is the other way round, such as the centre seen from "
                     "the body.",
                     false),
      argument<bool>("sun_reversed", "the same of `sun`.", false),
      argument<SpaceAxes>("axes", "of the positions: SpaceAxes, or its name.", "inertial"),
      term_name());
}

void bind_drag(nb::module_& m) {
  bind_term<"AtmosphericDrag">(
      m, "The torque of a thin atmosphere on the facets of a body in orbit.",
      "Molecules that are slow against the body; facets do not shade each other.",
      [](Making& at, nb::handle_t<Surface> surface, double density, nb::handle orbit,
         std::optional<double> scale_height, std::optional<double> radius, const Vec3& rotation,
         double exit_speed, bool reversed) {
        if (scale_height.has_value() != radius.has_value())
          throw nb::value_error("AtmosphericDrag: scale_height and radius go together");
        Atmosphere air{.density = density};
        air.rotation = rotation;
        if (radius) {
          air.scale_height = *scale_height;
          air.radius = *radius;
        }
        return AnyPerturbation(
            at.name, AtmosphericDrag(nb::cast<const Surface&>(surface), air,
                                     path_of(orbit, at.name + ": orbit", reversed, at.functions),
                                     exit_speed));
      },
      argument<Surface>("surface", "along the principal axes of the body."),
      argument<double>("density",
                       "of the air, moment / length^5: everywhere, or with "
                       "`scale_height` at the distance `radius` from the centre. "
                       "ValueError where negative."),
      argument<Any>("orbit",
                    "as in SolarPressure, the body as seen from the centre. Its velocity is "
                    "needed: not a function."),
      argument<std::optional<double>>("scale_height", "of the density; None: the same everywhere.",
                                      nb::none()),
      argument<std::optional<double>>("radius", "where the density is as given.", nb::none()),
      argument<Vec3>("rotation",
                     "(3,), angular velocity of the air, in inertial axes, as the orbit "
                     "is.",
                     nb::make_tuple(0.0, 0.0, 0.0)),
      argument<double>("exit_speed",
                       "at which molecules leave a wall that they have taken the "
                       "temperature of.",
                       0.0),
      argument<bool>("reversed", "the orbit is the centre as seen from the body.", false),
      term_name());
}

}  // namespace

void bind_surface_terms(nb::module_& m) {
  bind_solar(m);
  bind_drag(m);
}

}  // namespace polhode::python
