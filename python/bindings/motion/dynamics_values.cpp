// SPDX-License-Identifier: MIT
#include "motion/dynamics_values.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "interface/arrays.hpp"
#include "interface/batch.hpp"
#include "interface/choice.hpp"
#include "interface/object_slots.hpp"
#include "interface/value.hpp"
#include "motion/samples.hpp"
#include "motion/system_value.hpp"
#include "polhode/error.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

constexpr double inf = std::numeric_limits<double>::infinity();

std::string text_of(nb::handle value) { return nb::cast<std::string>(nb::repr(value)); }

// Valid, or a DomainError.
template <class M>
constexpr auto method_made = [](auto... numbers) {
  const M method{numbers...};
  require_valid(method);
  return method;
};

void bind_adaptive(nb::module_& m) {
  nb::enum_<Precision>(m, "Precision", "The arithmetic of an adaptive run.", nb::is_arithmetic())
      .value("compensated", Precision::compensated, "double, with compensated sums")
      .value("double_double", Precision::double_double, "32 digits, some twenty times slower");
  bind_made_value<Adaptive>(
      m, "Adaptive", R"(An explicit Runge-Kutta pair of order 9 on (q, g).

Parameters
----------
tolerance : of the local error of a step, relative to |q| = 1 and to |g|; from 1e-15 to 1e-2, and
    from 1e-30 in double-double.
precision : Precision, or its name.
first_step : 0: chosen.
largest_step : no step is longer; limit it to the time scale of a pulse of a torque written in
     Python, which a longer step could step over. inf: the shortest time_scale of the terms and
     of the frame, a quarter of a turn of what they follow.)",
      method_made<Adaptive>,
      field("tolerance", &Adaptive::tolerance, "Of the local error of a step.", 1e-12),
      field("precision", &Adaptive::precision, "The arithmetic of the run.", Precision::compensated)
          .but_quiet(),
      field("first_step", &Adaptive::first_step, "0: chosen.", 0.0).but_quiet(),
      field("largest_step", &Adaptive::largest_step, "No step is longer.", inf).but_quiet());
}

void bind_splitting(nb::module_& m) {
  nb::enum_<SplittingScheme>(m, "SplittingScheme", "Symmetric compositions of drift and kick.",
                             nb::is_arithmetic())
      .value("order2", SplittingScheme::order2, "drift, kick, drift")
      .value("order4", SplittingScheme::order4, "error of order h^4")
      .value("order6", SplittingScheme::order6, "error of order h^6")
      .value("order8", SplittingScheme::order8, "error of order h^8")
      .value("ABA864", SplittingScheme::ABA864,
             "of order eps h^8 + eps^2 h^6 + eps^3 h^4 for terms of size eps")
      .value("ABA1064", SplittingScheme::ABA1064, "of order eps h^10 + eps^2 h^6 + eps^3 h^4");
  bind_made_value<Splitting>(
      m, "Splitting", R"(The exact free rotation in turn with the exact terms.

Parameters
----------
step : constant, in the unit of time of the system; nothing checks the error it makes.
scheme : SplittingScheme, or its name. ABA864 and ABA1064 are for small terms (Blanes et al. 2013).

Symplectic for terms with an energy. Every term needs an exact flow.)",
      method_made<Splitting>, field("step", &Splitting::step, "Constant."),
      field("scheme", &Splitting::scheme, "The composition.", SplittingScheme::ABA864));
}

void bind_variation(nb::module_& m) {
  bind_made_value<VariationOfConstants>(
      m, "VariationOfConstants", R"(The constants of the free rotation are the unknowns.

Parameters
----------
tolerance : of the local error of a step, from 1e-15 to 1e-2.
largest_step : as in Adaptive.

For weak terms: steps may span many turns. [SA (98)-(103)])",
      method_made<VariationOfConstants>,
      field("tolerance", &VariationOfConstants::tolerance, "Of the local error of a step.", 1e-12),
      field("largest_step", &VariationOfConstants::largest_step, "No step is longer.", inf)
          .but_quiet());
}

void bind_collocation(nb::module_& m) {
  bind_made_value<Collocation>(
      m, "Collocation", R"(Gauss-Legendre collocation of (q, g), its stages computed together.

Parameters
----------
tolerance : of the local error of a step, relative to |q| = 1 and to |g|; from 1e-15 to 1e-2.
stages : 4, 8 or 16; the order is twice as large.
step : 0: chosen by the tolerance. Else every step is so long, and nothing checks the error it
    makes; the method is then symmetric, and symplectic to its order for terms with an energy.
largest_step : as in Adaptive; with steps under control.

The default of a Problem. Implicit, solved by sweeps; a run fails where they do not converge. Most
accurate for its time where torques are smooth; where they have many kinks and jumps that no term
names Adaptive is faster.)",
      method_made<Collocation>,
      field("tolerance", &Collocation::tolerance, "Of the local error of a step.", 1e-12),
      field("stages", &Collocation::stages, "4, 8 or 16.", 8).but_quiet(),
      field("step", &Collocation::step, "0: chosen.", 0.0).but_quiet(),
      field("largest_step", &Collocation::largest_step, "No step is longer.", inf).but_quiet());
}

PythonEvent checked_event(const std::string& name, nb::handle function, nb::handle crossing,
                          bool stops, double period, double interval) {
  if (PyCallable_Check(function.ptr()) == 0)
    throw nb::type_error(
        ("Event \"" + name + "\": function " + text_of(function) + " must be callable").c_str());
  for (const auto& [what, value] : {std::pair("period", period), std::pair("interval", interval)})
    if (!(value >= 0.0) || !std::isfinite(value))
      throw DomainError("Event \"" + name + "\": " + what + " " + number_text(value) +
                        " must be positive, or 0 for none");
  return {name,    nb::borrow(function), choice<Crossing>(crossing, "crossing"), stops, period,
          interval};
}

nb::tuple arguments_of(const PythonEvent& e) {
  return nb::make_tuple(e.name, e.function, e.crossing, e.stops, e.period, e.interval);
}

void bind_event(nb::module_& m) {
  nb::enum_<Crossing>(m, "Crossing", "Which zeros of a function are events, as time runs.",
                      nb::is_arithmetic())
      .value("both", Crossing::both, "every change of sign")
      .value("rising", Crossing::rising, "from below zero, as time runs")
      .value("falling", Crossing::falling, "from above zero, as time runs");
  nb::class_<PythonEvent>(m, "Event",
                          R"(A zero of a function of time and state, to be found along a run.

Parameters
----------
name : stands in EventRecord.name.
function : f(t, s) -> float, continuous, s one RotorState.
crossing : Crossing, or its name.
stops : the run ends at the first one, with a last sample there.
period : of a function that is an angle folded into one turn: that turn, so that its jump is no
    crossing. 0: none.
interval : no two looks at the function are farther apart: for one that varies faster than the body
    turns. 0: looks follow the rotation.

The function is looked at inside every step, twelve times in the fastest turn at least, with its
slope. It finds changes of sign, two zeros between two looks where it turns around beyond zero, and
touches (direction 0, with crossing both; as abs(x) or an even power up to the 20th); zeros at start
and stop too. A function that reaches zero and stays there is two events, its first instant and its
last. Events at one instant are all reported, also if one of them stops the run. Each is solved on
the dense output to rounding. What the function raises ends the run and passes through; NaN ends it
with an outcome that says so.)",
                          nb::type_slots(object_slots<PythonEvent, &PythonEvent::function>()))
      .def(
          "__init__",
          [](PythonEvent* self, const std::string& name,
             const Typed<"collections.abc.Callable[[float, RotorState], float]">& function,
             const OneOf<Crossing>& crossing, bool stops, double period, double interval) {
            new (self)
                PythonEvent(checked_event(name, function, crossing, stops, period, interval));
          },
          "name"_a, "function"_a, "crossing"_a = "both", "stops"_a = false, "period"_a = 0.0,
          "interval"_a = 0.0)
      .def_ro("name", &PythonEvent::name, "Stands in EventRecord.name.")
      .def_ro("function", &PythonEvent::function, "The very object that was given.")
      .def_ro("crossing", &PythonEvent::crossing, "Which zeros are events.")
      .def_ro("stops", &PythonEvent::stops, "Whether the run ends at the first one.")
      .def_ro("period", &PythonEvent::period, "Of a folded angle; 0: none.")
      .def_ro("interval", &PythonEvent::interval, "Between two looks, at most; 0: none asked for.")
      .def("__repr__",
           [](const PythonEvent& e) {
             std::string text = "<Event: " + e.name;
             if (e.crossing == Crossing::rising) text += ", rising";
             if (e.crossing == Crossing::falling) text += ", falling";
             return text + (e.stops ? ", stops>" : ">");
           })
      .def("__reduce__", [](nb::handle_t<PythonEvent> self) {
        return nb::make_tuple(nb::handle(self.type()),
                              arguments_of(nb::cast<const PythonEvent&>(self)));
      });
}

// One state of the hub.
void require_state(nb::handle initial) {
  const bool rotor = nb::isinstance<Rotors>(initial);
  if (rotor && nb::cast<const Rotors&>(initial).shape().empty()) return;
  const std::string what = "Problem: initial: got ";
  if (rotor)
    throw nb::value_error(
        (what + "shape " + text_of(nb::object(initial.attr("shape"))) + " of states; expected one")
            .c_str());
  throw nb::type_error((what + class_name(initial) +
                        "; expected a RotorState, which to_rotor makes of other variables")
                           .c_str());
}

void make_problem(PythonProblem* self, const Typed<"System">& system,
                  const Typed<"RotorState">& initial, double start, double stop,
                  const Typed<"Adaptive | Collocation | Splitting | VariationOfConstants">& method,
                  const Typed<"collections.abc.Iterable[Event]">& events,
                  const ArrayLike& damper_rate, bool continues) {
  system_of(system, "Problem: system");
  require_state(initial);
  static_cast<void>(polhode::detail::FiniteSpan(start, stop));
  method_of(method);
  new (self) PythonProblem{nb::borrow(system),
                           nb::borrow(initial),
                           start,
                           stop,
                           nb::borrow(method),
                           events_of(events, "Problem"),
                           vec3(damper_rate, "Problem: damper_rate"),
                           continues};
}

nb::tuple arguments_of(const PythonProblem& p) {
  return nb::make_tuple(p.system, p.initial, p.start, p.stop, p.method, p.events,
                        nb::make_tuple(p.damper_rate.x, p.damper_rate.y, p.damper_rate.z),
                        p.continues);
}

void bind_problem(nb::module_& m) {
  nb::class_<PythonProblem>(
      m, "Problem",
      R"(A system, its state at `start`, and how to bring it to `stop`.

Parameters
----------
system : System.
initial : one RotorState at `start`, in the reference frame.
start, stop : in the unit of time of the system; either may be the larger.
method : Adaptive, Collocation, Splitting or VariationOfConstants.
events : Events, in any number.
damper_rate : (3,), rate of the sphere of the system's damper relative to the body, body axes, at
    `start`.
continues : whether another run has ended at `start`: an event there is that run's.)",
      nb::type_slots(object_slots<PythonProblem, &PythonProblem::system, &PythonProblem::initial,
                                  &PythonProblem::method, &PythonProblem::events>()))
      .def("__init__", make_problem, "system"_a, "initial"_a, "start"_a, "stop"_a,
           "method"_a.sig("Collocation()") = default_rotor_method, "events"_a = nb::make_tuple(),
           "damper_rate"_a = nb::make_tuple(0.0, 0.0, 0.0), "continues"_a = false)
      .def_ro("system", &PythonProblem::system, "The very object that was given.")
      .def_ro("initial", &PythonProblem::initial, "The state at `start`.")
      .def_ro("start", &PythonProblem::start, "Where `initial` is the state.")
      .def_ro("stop", &PythonProblem::stop, "Where the run shall end.")
      .def_ro("method", &PythonProblem::method, "How it is integrated.")
      .def_ro("events", &PythonProblem::events, "What the run looks for.")
      .def_prop_ro(
          "damper_rate", [](const PythonProblem& p) { return array_of(p.damper_rate); },
          "(3,): of the system's damper relative to the body, at `start`.")
      .def_ro("continues", &PythonProblem::continues, "Whether another run has ended at `start`.")
      .def("__repr__",
           [](const PythonProblem& p) {
             const std::size_t events = nb::len(p.events);
             return "<Problem: t = " + number_text(p.start) + " to " + number_text(p.stop) + "; " +
                    method_text(method_of(p.method)) +
                    (events == 0 ? "" : "; " + counted(events, "event")) + ">";
           })
      .def("__reduce__", [](nb::handle_t<PythonProblem> self) {
        return nb::make_tuple(nb::handle(self.type()),
                              arguments_of(nb::cast<const PythonProblem&>(self)));
      });
}

}  // namespace

nb::tuple events_of(nb::handle events, const char* what) {
  if (!nb::hasattr(events, "__iter__"))
    throw nb::type_error((std::string(what) + ": events: got " +
                          nb::cast<std::string>(nb::repr(events)) +
                          "; expected a sequence of Event")
                             .c_str());
  nb::tuple all(events);
  for (const nb::handle event : all)
    if (!nb::isinstance<PythonEvent>(event))
      throw nb::type_error(
          (std::string(what) + ": events: got " + class_name(event) + "; expected Event").c_str());
  return all;
}

namespace {

// Of the methods that have a class here.
template <class... Classes>
struct Methods {
  static bool set(std::optional<Method>& found, nb::handle method) {
    return ((nb::isinstance<Classes>(method) && (found = nb::cast<Classes>(method), true)) || ...);
  }
  static bool set(nb::object& found, const Method& method) {
    return ((std::holds_alternative<Classes>(method) &&
             (found = nb::cast(std::get<Classes>(method)), true)) ||
            ...);
  }
};
using OurMethods = Methods<Adaptive, Collocation, Splitting, VariationOfConstants>;

}  // namespace

Method method_of(nb::handle method, const char* whose) {
  std::optional<Method> found;
  if (OurMethods::set(found, method)) return *found;
  throw nb::type_error((std::string(whose) + ": method: got " + class_name(method) +
                        "; expected Adaptive, Collocation, Splitting or VariationOfConstants")
                           .c_str());
}

nb::object object_of(const std::optional<Method>& method) {
  nb::object found = nb::none();
  if (method) OurMethods::set(found, *method);
  return found;
}

void bind_dynamics_values(nb::module_& m) {
  bind_adaptive(m);
  bind_splitting(m);
  bind_variation(m);
  bind_collocation(m);
  bind_event(m);
  bind_problem(m);
}

}  // namespace polhode::python
