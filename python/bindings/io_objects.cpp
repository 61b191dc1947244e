// SPDX-License-Identifier: MIT
// What moves the body of a scenario, as the objects that Python's own constructors make: they tell
// what they are, compare and pickle.
#include "frame_value.hpp"
#include "io_parts.hpp"
#include "orbit_value.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/system/system.hpp"
#include "system_value.hpp"
#include "term_value.hpp"

namespace polhode::python {

namespace {

nb::object core(const char* name) { return nb::module_::import_("polhode._core").attr(name); }
nb::tuple tuple_of(const Vec3& v) { return nb::make_tuple(v.x, v.y, v.z); }

template <class O>
nb::object gravity_gradient(const GravityGradient<O>& term, const std::string& name) {
  return core("GravityGradient")(term.gm(), nb::cast(term.orbit()), nb::cast(term.axes()), name);
}

nb::object torque(const ConstantTorque& term, const std::string& name) {
  const nb::object type = core("ConstantTorque");
  const nb::tuple u = tuple_of(term.torque());
  if (!term.space_axes()) return type.attr("in_body")(u, nb::arg("name") = name);
  return type.attr("in_space")(u, nb::cast(*term.space_axes()), nb::arg("name") = name);
}

nb::object damping(const LinearDamping& term, const Body& body, const std::string& name) {
  const Mat3& D = term.matrix();
  bool diagonal = true;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) diagonal = diagonal && (i == k || D(i, k) == 0.0);
  const nb::object type = core("LinearDamping");
  if (diagonal) return type(tuple_of({D(0, 0), D(1, 1), D(2, 2)}), nb::arg("name") = name);
  const nb::tuple rows = nb::make_tuple(tuple_of(D.row[0]), tuple_of(D.row[1]), tuple_of(D.row[2]));
  return type(rows, nb::cast(body), nb::arg("name") = name);
}

// Null where the term is no magnetic torque along an orbit of type O.
template <class O>
nb::object magnetic(const AnyPerturbation& term) {
  using Field = FieldAlongOrbit<O, DipoleField>;
  if (const auto* magnet = term.target<ResidualDipole<Field>>())
    return core("ResidualDipole")(tuple_of(magnet->moment()), nb::cast(magnet->field().source()),
                                  nb::cast(magnet->field().orbit()), term.name());
  if (const auto* eddy = term.target<EddyCurrents<Field>>()) {
    const Mat3& M = eddy->tensor();
    return core("EddyCurrents")(
        nb::make_tuple(tuple_of(M.row[0]), tuple_of(M.row[1]), tuple_of(M.row[2])),
        nb::cast(eddy->field().source()), nb::cast(eddy->field().orbit()),
        eddy->rate() == FieldRate::along_orbit, term.name());
  }
  return {};
}

nb::object term_object(const Scenario& scenario, const AnyPerturbation& term) {
  if (const nb::object fixed = magnetic<KeplerOrbit>(term); fixed.is_valid()) return fixed;
  if (const nb::object moving = magnetic<PrecessingKeplerOrbit>(term); moving.is_valid())
    return moving;
  if (const auto* fixed = term.target<GravityGradient<KeplerOrbit>>())
    return gravity_gradient(*fixed, term.name());
  if (const auto* moving = term.target<GravityGradient<PrecessingKeplerOrbit>>())
    return gravity_gradient(*moving, term.name());
  if (const auto* tabulated = term.target<GravityGradient<TableOrbit>>())
    return gravity_gradient(*tabulated, term.name());
  if (const auto* constant = term.target<ConstantTorque>()) return torque(*constant, term.name());
  if (const auto* viscous = term.target<LinearDamping>())
    return damping(*viscous, scenario.body, term.name());
  return nb::cast(PythonTerm(term));
}

nb::object frame_object(const Scenario& scenario) {
  const nb::object type = core("Frame");
  if (scenario.frame.is_inertial()) return type.attr("inertial")();
  if (scenario.precession)
    return type.attr("precessing")(tuple_of(scenario.precession->axis), scenario.precession->rate,
                                   scenario.precession->epoch);
  return nb::cast(PythonFrame(scenario.frame));
}

nb::object system_object(const Scenario& scenario) {
  nb::list terms;
  for (const AnyPerturbation& term : scenario.terms) terms.append(term_object(scenario, term));
  return core("System")(nb::cast(scenario.body), frame_object(scenario), terms);
}

nb::dict orbits_of(const Scenario& scenario) {
  nb::dict orbits;
  for (const ScenarioOrbit& orbit : scenario.orbits)
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
