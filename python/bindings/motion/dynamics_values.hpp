// SPDX-License-Identifier: MIT
// What a run is made of, as Python holds it: methods, events, problems.
#pragma once

#include <string>

#include "interface/typed.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace polhode::python {

struct PythonEvent {
  std::string name;
  nb::object function;
  Crossing crossing;
  bool stops;
  double period;
  double interval;
};

// The very objects that the caller gave.
struct PythonProblem {
  Typed<"System"> system;
  Typed<"RotorState"> initial;
  double start;
  double stop;
  Typed<"Adaptive | Collocation | Splitting | VariationOfConstants"> method;
  Typed<"tuple[Event, ...]"> events;
  Vec3 damper_rate;
  bool continues;
};

// TypeError for what is none.
Method method_of(nb::handle method, const char* whose = "Problem");
// The object of its class; None where there is none.
nb::object object_of(const std::optional<Method>& method);
// The event of C++; the object that it is made of must outlive it.
Event event_of(const PythonEvent& event);
// A tuple of PythonEvent. `what` stands for it in messages.
nb::tuple events_of(nb::handle events, const char* what);
// For the time of a run: the Python objects outlive it.
Problem problem_of(const PythonProblem& problem);
// Functions that look for no events ask none of Python.
Problem problem_without_events(const PythonProblem& problem);
// A failed run is a result, with its samples so far; but nobody should plot it unawares.
void warn_of(const Outcome& outcome, const char* function);

void bind_dynamics_values(nb::module_& m);

}  // namespace polhode::python
