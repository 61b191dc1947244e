// SPDX-License-Identifier: MIT
// Sunlight and air on the facets of a body.
#include "interface/choice.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "terms/term_binding.hpp"

namespace polhode::python {

namespace {

struct SolarPressureTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct AtmosphericDragTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};

DirectedPath path_of(nb::handle orbit, const std::string& label, bool reversed,
                     std::vector<SharedFunction>& functions) {
  const AnyPythonOrbit any = orbit_of(orbit, label, functions);
  return {std::visit([&](const auto& o) { return AnyOrbit(label, o); }, any), reversed};
}

std::optional<Shadow> shadow_of(nb::handle shadow, nb::handle radius, nb::handle sun_radius) {
  if (shadow.is_none()) return std::nullopt;
  const std::string shape = nb::cast<std::string>(shadow);
  if (shape != "cylinder" && shape != "cone")
    throw nb::value_error(
        ("SolarPressure: shadow: got '" + shape + "'; expected 'cylinder', 'cone' or None")
            .c_str());
  if (radius.is_none()) throw nb::value_error("SolarPressure: a shadow needs its radius");
  if (shape == "cylinder") return Shadow::cylinder(number(radius, "radius"));
  if (sun_radius.is_none()) throw nb::value_error("SolarPressure: a cone needs sun_radius");
  return Shadow::cone(number(radius, "radius"), number(sun_radius, "sun_radius"));
}

void bind_solar(nb::module_& m) {
  using C = SolarPressureTerm;
  nb::class_<C, PythonTerm> c(m, "SolarPressure",
                              R"(The torque of sunlight on the facets of a body.

Parameters
----------
surface : Surface along the principal axes of the body.
pressure, distance : of sunlight on what absorbs it, at one distance; 4.54e-6 N/m2 at 1 au.
orbit : the body as seen from what it goes round: KeplerOrbit, PrecessingKeplerOrbit,
    TurnedKeplerOrbit, TableOrbit or a function t -> 3 numbers. Without `sun` that is the Sun.
sun : the Sun as seen from what the body goes round.
shadow : of what the body goes round: None, 'cylinder' or 'cone', with its `radius`, and for a cone
    `sun_radius`.
reversed, sun_reversed : the orbit is the other way round, such as the centre seen from the body.
axes : of the positions: SpaceAxes, or its name.
name : stands in messages.

Facets do not shade each other. A torque of time and attitude alone; no energy.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
      "__init__",
      [](C* self, const Surface& surface, double pressure, double distance, Any orbit, Any sun,
         Text shadow, Typed<"float"> radius, Typed<"float"> sun_radius, bool reversed,
         bool sun_reversed, OneOf<SpaceAxes> axes, Text name) {
        const std::string own = name_of(name, "SolarPressure");
        const auto of = choice<SpaceAxes>(axes, "axes");
        std::vector<SharedFunction> functions;
        const DirectedPath path = path_of(orbit, own + ": orbit", reversed, functions);
        const std::optional<Shadow> dark = shadow_of(shadow, radius, sun_radius);
        if (sun.is_none() && dark)
          throw nb::value_error(
              "SolarPressure: a shadow needs `sun`: without it the body goes "
              "round the Sun itself");
        const Sunlight light{pressure, distance};
        const AnyPerturbation term =
            sun.is_none()
                ? AnyPerturbation(own, SolarPressure(surface, light, path, of))
                : AnyPerturbation(
                      own, SolarPressure(surface, light, path,
                                         path_of(sun, own + ": sun", sun_reversed, functions), dark,
                                         of));
        new (self)
            C(term, recipe_of("",
                              {"surface", "pressure", "distance", "orbit", "sun", "shadow",
                               "radius", "sun_radius", "reversed", "sun_reversed", "axes", "name"},
                              nb::make_tuple(surface, pressure, distance, orbit, sun, shadow,
                                             radius, sun_radius, reversed, sun_reversed, of, name),
                              std::move(functions)));
      },
      "surface"_a, "pressure"_a, "distance"_a, "orbit"_a, "sun"_a = nb::none(),
      "shadow"_a = nb::none(), "radius"_a = nb::none(), "sun_radius"_a = nb::none(),
      "reversed"_a = false, "sun_reversed"_a = false, "axes"_a = "inertial", "name"_a = nb::none());
  c.def_prop_ro("surface", given<0, "Surface">, "What the light falls on.");
  def_term<C>(c);
}

void bind_drag(nb::module_& m) {
  using C = AtmosphericDragTerm;
  nb::class_<C, PythonTerm> c(m, "AtmosphericDrag",
                              R"(The torque of a thin atmosphere on the facets of a body in orbit.

Parameters
----------
surface : Surface along the principal axes of the body.
density : of the air, moment / length^5: everywhere, or with `scale_height` at the distance
    `radius` from the centre. ValueError where negative.
orbit : as in SolarPressure, the body as seen from the centre. Its velocity is needed: not a
    function.
scale_height, radius : of the density; None: the same everywhere.
rotation : (3,), angular velocity of the air, in inertial axes, as the orbit is.
exit_speed : at which molecules leave a wall that they have taken the temperature of.
reversed : the orbit is the centre as seen from the body.
name : stands in messages.

Molecules that are slow against the body; facets do not shade each other.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
      "__init__",
      [](C* self, const Surface& surface, double density, Any orbit, Typed<"float"> scale_height,
         Typed<"float"> radius, ArrayLike rotation, double exit_speed, bool reversed, Text name) {
        const std::string own = name_of(name, "AtmosphericDrag");
        std::vector<SharedFunction> functions;
        Atmosphere air{.density = density};
        air.rotation = vec3(rotation, "rotation");
        if (scale_height.is_none() != radius.is_none())
          throw nb::value_error("AtmosphericDrag: scale_height and radius go together");
        if (!radius.is_none()) {
          air.scale_height = number(scale_height, "scale_height");
          air.radius = number(radius, "radius");
        }
        const AnyPerturbation term(
            own, AtmosphericDrag(surface, air, path_of(orbit, own + ": orbit", reversed, functions),
                                 exit_speed));
        new (self)
            C(term, recipe_of("",
                              {"surface", "density", "orbit", "scale_height", "radius", "rotation",
                               "exit_speed", "reversed", "name"},
                              nb::make_tuple(surface, density, orbit, scale_height, radius,
                                             tuple_of(air.rotation), exit_speed, reversed, name),
                              std::move(functions)));
      },
      "surface"_a, "density"_a, "orbit"_a, "scale_height"_a = nb::none(), "radius"_a = nb::none(),
      "rotation"_a = nb::make_tuple(0.0, 0.0, 0.0), "exit_speed"_a = 0.0, "reversed"_a = false,
      "name"_a = nb::none());
  c.def_prop_ro("surface", given<0, "Surface">, "What the air meets.");
  def_term<C>(c);
}

}  // namespace

void bind_surface_terms(nb::module_& m) {
  bind_solar(m);
  bind_drag(m);
}

}  // namespace polhode::python
