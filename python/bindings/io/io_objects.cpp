// SPDX-License-Identifier: MIT
// What moves the body of a scenario, as the objects that Python's own constructors make: they tell
// what they are, compare and pickle.
#include <cmath>
#include <stdexcept>

#include "io/io_parts.hpp"
#include "motion/frame_value.hpp"
#include "motion/system_value.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/higher_gravity.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/oblate_gravity.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/tidal_torque.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/system/system.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

nb::object core(const char* name) { return nb::module_::import_("polhode._core").attr(name); }

nb::object torque(const ConstantTorque& term, const std::string& name) {
  const nb::object type = core("ConstantTorque");
  const nb::tuple u = tuple_of(term.torque());
  if (!term.space_axes()) return type.attr("in_body")(u, "name"_a = name);
  return type.attr("in_space")(u, nb::cast(*term.space_axes()), "name"_a = name);
}

nb::object damping(const LinearDamping& term, const Body& body, const std::string& name) {
  const Mat3& D = term.matrix();
  bool diagonal = true;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) diagonal = diagonal && (i == k || D(i, k) == 0.0);
  const nb::object type = core("LinearDamping");
  if (diagonal) return type(tuple_of({D(0, 0), D(1, 1), D(2, 2)}), "name"_a = name);
  return type(rows_of(D), nb::cast(body), "name"_a = name);
}

nb::object torque_table(const TorqueTable& term, const std::string& name) {
  nb::list times, torques;
  for (const TorqueRow& row : term.rows()) {
    times.append(row.t);
    torques.append(tuple_of(row.torque));
  }
  const TorqueTable::Rules& rules = term.rules();
  const nb::object axes = rules.axes ? nb::cast(*rules.axes) : nb::none();
  return core("TorqueTable")(times, torques, nb::cast(rules.between), nb::cast(rules.outside), axes,
                             name);
}

// Null where it is of another type.
template <class O>
nb::object orbit_of_type(const AnyOrbit& orbit) {
  if (const O* found = orbit.target<O>()) return nb::cast(*found);
  return {};
}
nb::object orbit_object(const AnyOrbit& orbit) {
  for (const auto made : {orbit_of_type<KeplerOrbit>, orbit_of_type<PrecessingKeplerOrbit>,
                          orbit_of_type<TurnedKeplerOrbit>, orbit_of_type<TableOrbit>})
    if (const nb::object found = made(orbit); found.is_valid()) return found;
  throw std::logic_error("orbit " + orbit.name() + " of a scenario: its type has no class");
}

nb::object pressure(const SolarPressure& term, const std::string& name) {
  nb::object sun = nb::none(), shadow = nb::none(), radius = nb::none(), sun_radius = nb::none();
  if (term.sun()) sun = orbit_object(term.sun()->orbit);
  if (const std::optional<Shadow>& dark = term.shadow()) {
    const bool cone = dark->shape() == ShadowShape::cone;
    shadow = nb::str(cone ? "cone" : "cylinder");
    radius = nb::float_(dark->radius());
    if (cone) sun_radius = nb::float_(dark->sun_radius());
  }
  return core("SolarPressure")(nb::cast(term.surface()), term.light().pressure,
                               term.light().distance, orbit_object(term.path().orbit), sun, shadow,
                               radius, sun_radius, term.path().reversed,
                               term.sun() && term.sun()->reversed, nb::cast(term.axes()), name);
}

nb::object drag(const AtmosphericDrag& term, const std::string& name) {
  const Atmosphere& air = term.air();
  nb::object height = nb::none(), radius = nb::none();
  if (std::isfinite(air.scale_height)) {
    height = nb::float_(air.scale_height);
    radius = nb::float_(air.radius);
  }
  return core("AtmosphericDrag")(
      nb::cast(term.surface()), air.density, orbit_object(term.path().orbit), height, radius,
      tuple_of(air.rotation), term.exit_speed(), term.path().reversed, name);
}

// Null where the term follows no orbit of type O.
template <class O>
nb::object term_along(const AnyPerturbation& term) {
  using Field = FieldAlongOrbit<O, DipoleField>;
  const std::string& name = term.name();
  const auto orbit = [](const auto& t) { return nb::cast(t.orbit()); };
  if (const auto* t = term.target<GravityGradient<O>>())
    return core("GravityGradient")(t->gm(), orbit(*t), nb::cast(t->axes()), name);
  if (const auto* t = term.target<HigherGravity<O>>())
    return core("HigherGravity")(t->gm(), orbit(*t), nb::cast(t->moments()),
                                 nb::cast(t->orbit_of()), nb::cast(t->axes()), name);
  if (const auto* t = term.target<OblateGravity<O>>())
    return core("OblateGravity")(t->gm(), orbit(*t), nb::cast(t->oblateness()), nb::cast(t->axes()),
                                 name);
  if (const auto* t = term.target<TidalTorque<O>>())
    return core("TidalTorque")(t->gm(), t->mass(), orbit(*t), nb::cast(t->tidal_body()), name);
  if (const auto* t = term.target<ResidualDipole<Field>>())
    return core("ResidualDipole")(tuple_of(t->moment()), nb::cast(t->field().source()),
                                  orbit(t->field()), name);
  if (const auto* t = term.target<EddyCurrents<Field>>())
    return core("EddyCurrents")(rows_of(t->tensor()), nb::cast(t->field().source()),
                                orbit(t->field()), t->rate() == FieldRate::along_orbit, name);
  return {};
}

nb::object term_object(const Scenario& scenario, const AnyPerturbation& term) {
  for (const auto made : {term_along<KeplerOrbit>, term_along<PrecessingKeplerOrbit>,
                          term_along<TurnedKeplerOrbit>, term_along<TableOrbit>})
    if (const nb::object found = made(term); found.is_valid()) return found;
  const std::string& name = term.name();
  if (const auto* t = term.target<ConstantTorque>()) return torque(*t, name);
  if (const auto* t = term.target<LinearDamping>())
    return damping(*t, scenario.rotation().body, name);
  if (const auto* t = term.target<TorqueTable>()) return torque_table(*t, name);
  if (const auto* t = term.target<SolarPressure>()) return pressure(*t, name);
  if (const auto* t = term.target<AtmosphericDrag>()) return drag(*t, name);
  if (const auto* t = term.target<InternalDamping>())
    return core("InternalDamping")(tuple_of(t->coefficients()), name, t->grows_with_momentum());
  return nb::cast(PythonTerm(term));
}

nb::object frame_object(const Scenario& scenario) {
  const nb::object type = core("Frame");
  if (scenario.rotation().frame.is_inertial()) return type.attr("inertial")();
  if (scenario.rotation().precession)
    return type.attr("precessing")(tuple_of(scenario.rotation().precession->axis),
                                   scenario.rotation().precession->rate,
                                   scenario.rotation().precession->epoch);
  return nb::cast(PythonFrame(scenario.rotation().frame));
}

nb::object system_object(const Scenario& scenario) {
  nb::list terms;
  for (const AnyPerturbation& term : scenario.rotation().terms)
    terms.append(term_object(scenario, term));
  return core("System")(nb::cast(scenario.rotation().body), frame_object(scenario), terms,
                        scenario.rotation().damper);
}

nb::dict orbits_of(const Scenario& scenario) {
  nb::dict orbits;
  for (const ScenarioOrbit& orbit : scenario.rotation().orbits)
    std::visit([&](const auto& motion) { orbits[orbit.name.c_str()] = nb::cast(motion); },
               orbit.motion);
  return orbits;
}

}  // namespace

void bind_objects(nb::class_<Scenario>& scenario) {
  scenario.def_prop_ro("frame", frame_object)
      .def_prop_ro("system", system_object)
      .def_prop_ro("orbits", orbits_of);
}

}  // namespace polhode::python
