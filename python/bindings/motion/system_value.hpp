// SPDX-License-Identifier: MIT
// System, as Python holds it.
#pragma once

#include "bindings.hpp"
#include "polhode/system/system.hpp"

namespace polhode::python {

// Python's class System: nb::cast<const PythonSystem&>(object) is a System, and
// nb::cast(PythonSystem(system)) makes an object of one that C++ made. (Not nb::cast(system).)
struct PythonSystem : System {
  PythonSystem(System system, nb::object frame, nb::tuple terms)
      : System(std::move(system)), python_frame(std::move(frame)), python_terms(std::move(terms)) {}
  explicit PythonSystem(const System& system);
  // A system with terms more than `like` has: those keep their objects.
  PythonSystem(System system, const PythonSystem& like);

  Typed<"Frame"> python_frame;
  Typed<"tuple[AnyPerturbation, ...]"> python_terms;  // the very objects that were given
};

// Of a Python object that must be a System. TypeError else: `where` starts the message.
const PythonSystem& system_of(nb::handle object, const char* where);

}  // namespace polhode::python
