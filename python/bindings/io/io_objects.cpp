// SPDX-License-Identifier: MIT
// What moves the body of a scenario, as the objects that Python's own constructors make: they tell
// what they are, compare and pickle.
#include <stdexcept>
#include <type_traits>

#include "io/io_parts.hpp"
#include "motion/frame_value.hpp"
#include "motion/system_value.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/system/system.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

nb::object core(const char* name) { return nb::module_::import_("polhode._core").attr(name); }

nb::dict orbits_of(const io::Scenario& scenario) {
  nb::dict orbits;
  for (const io::ScenarioOrbit& orbit : scenario.rotation().orbits)
    orbits[orbit.name.c_str()] = orbit_object(orbit);
  return orbits;
}

// Of the class of its kind, from what its table says.
nb::object term_object(const io::Rotation& rotation, const io::PerturbationKind& kind,
                       const TermClass& of, const std::vector<io::KeyValue>& values,
                       const std::string& name, const nb::dict& orbits) {
  nb::dict arguments;
  const auto orbit = [&](const std::string& of_name) -> nb::object {
    return nb::object(orbits[of_name.c_str()]);
  };
  for (const TermArgument& a : of.arguments) {
    if (a.name == "surface") arguments["surface"] = nb::cast(*rotation.surface);
    if (a.name == "body") arguments["body"] = nb::cast(rotation.body);
    if (a.name == "name") arguments["name"] = nb::str(name.c_str());
    for (const io::KeyValue& value : values)
      if (!a.key.empty() && value.key == a.name)
        for (const io::Key& key : kind.keys)
          if (key.path == a.name) arguments[a.name.c_str()] = python_value(key, value, orbit);
  }
  return of.type(**arguments);
}

nb::list term_objects(const io::Scenario& scenario) {
  const io::Rotation& rotation = scenario.rotation();
  const nb::dict orbits = orbits_of(scenario);
  nb::list all;
  std::size_t first = 0;
  for (std::size_t i = 0; i < rotation.kinds.size(); ++i) {
    const auto& [count, values] = rotation.arguments[i];
    const TermClass* const of = class_of_kind(rotation.kinds[i]);
    const auto add_plain = [&] {
      for (std::size_t k = first; k < first + count; ++k)
        all.append(nb::cast(PythonTerm(rotation.terms[k])));
    };
    if (of == nullptr || values == nullptr) {
      add_plain();
    } else {
      try {
        all.append(term_object(rotation, *scenario.document.kinds->perturbation(rotation.kinds[i]),
                               *of, *values, rotation.terms[first].name(), orbits));
      } catch (const nb::python_error& error) {  // its function asks for more than a program has
        if (!error.matches(PyExc_Exception)) throw;
        add_plain();
      }
    }
    first += count;
  }
  return all;
}

nb::object frame_object(const io::Scenario& scenario) {
  const nb::object type = core("Frame");
  if (scenario.rotation().frame.is_inertial()) return type.attr("inertial")();
  if (scenario.rotation().precession)
    return type.attr("precessing")(tuple_of(scenario.rotation().precession->axis),
                                   scenario.rotation().precession->rate,
                                   scenario.rotation().precession->epoch);
  return nb::cast(PythonFrame(scenario.rotation().frame));
}

nb::object system_object(const io::Scenario& scenario) {
  return core("System")(nb::cast(scenario.rotation().body), frame_object(scenario),
                        term_objects(scenario), scenario.rotation().damper);
}

}  // namespace

nb::object orbit_object(const io::ScenarioOrbit& orbit) {
  return std::visit(
      [&](const auto& motion) -> nb::object {
        if constexpr (std::is_same_v<std::decay_t<decltype(motion)>, AnyOrbit>)
          throw std::logic_error("orbit " + orbit.name + " of a scenario: its type has no class");
        else
          return nb::cast(motion);
      },
      orbit.motion);
}

void bind_objects(nb::class_<io::Scenario>& scenario) {
  scenario.def_prop_ro("frame", frame_object)
      .def_prop_ro("system", system_object)
      .def_prop_ro("orbits", orbits_of);
}

}  // namespace polhode::python
