// SPDX-License-Identifier: MIT
// Systems: body, frame and terms, and what the equations of motion say of a state.
#include <optional>

#include "interface/object_slots.hpp"
#include "motion/frame_value.hpp"
#include "motion/system_functions.hpp"
#include "motion/system_value.hpp"
#include "polhode/system/system.hpp"
#include "terms/term_value.hpp"

namespace polhode::python {

namespace {

std::vector<AnyPerturbation> terms_of(const nb::tuple& terms) {
  std::vector<AnyPerturbation> all;
  for (const nb::handle term : terms) {
    if (!nb::isinstance<PythonTerm>(term))
      throw nb::type_error(("System: terms: got " + class_name(term) +
                            "; expected GravityGradient, ConstantTorque, LinearDamping, TorqueTerm "
                            "or HamiltonianTerm")
                               .c_str());
    if (!nb::inst_ready(term))
      throw nb::type_error(("System: terms: got a " + class_name(term) +
                            " that was never made; its __init__ must call super().__init__")
                               .c_str());
    const std::vector<AnyPerturbation>& parts = nb::cast<const PythonTerm&>(term).parts;
    all.insert(all.end(), parts.begin(), parts.end());
  }
  return all;
}

// One term is as good as a sequence of one.
nb::tuple tuple_of(nb::handle terms) {
  if (nb::isinstance<PythonTerm>(terms)) return nb::make_tuple(terms);
  if (!nb::hasattr(terms, "__iter__"))
    throw nb::type_error(("System: terms: got " + nb::cast<std::string>(nb::repr(terms)) +
                          "; expected a term or a sequence of them: of a function of time and "
                          "state, TorqueTerm or HamiltonianTerm makes one")
                             .c_str());
  return nb::tuple(terms);
}

void make_system(PythonSystem* self, const Body& body, Typed<"Frame"> frame,
                 Typed<"AnyPerturbation | collections.abc.Iterable[AnyPerturbation]"> terms,
                 const std::optional<KaneDamper>& damper) {
  nb::object of = frame_or_inertial(frame, "System");
  nb::tuple all = tuple_of(terms);
  const Frame& value = nb::cast<const PythonFrame&>(of);
  System system(body, value, terms_of(all), damper);
  new (self) PythonSystem(std::move(system), std::move(of), std::move(all));
}

nb::tuple arguments_of(const PythonSystem& s) {
  return nb::make_tuple(s.body(), s.python_frame, s.python_terms, s.damper());
}

std::string repr_of(const PythonSystem& s) {
  std::string text = "System(" + nb::cast<std::string>(nb::repr(nb::cast(s.body())));
  if (!s.frame().is_inertial())
    text += ", frame=" + nb::cast<std::string>(nb::repr(s.python_frame));
  if (nb::len(s.python_terms) != 0)
    text += ", terms=" + nb::cast<std::string>(nb::repr(s.python_terms));
  if (s.damper()) text += ", damper=" + nb::cast<std::string>(nb::repr(nb::cast(*s.damper())));
  return text + ")";
}

}  // namespace

PythonSystem::PythonSystem(const System& system) : System(system) {
  python_frame = nb::cast(PythonFrame(system.frame()));
  nb::list all;
  for (const AnyPerturbation& term : system.terms()) all.append(nb::cast(PythonTerm(term)));
  python_terms = nb::tuple(all);
}

PythonSystem::PythonSystem(System system, const PythonSystem& like)
    : System(std::move(system)), python_frame(like.python_frame) {
  nb::list all;
  for (const nb::handle term : like.python_terms) all.append(term);
  for (std::size_t i = like.terms().size(); i < terms().size(); ++i)
    all.append(nb::cast(PythonTerm(terms()[i])));
  python_terms = nb::tuple(all);
}

const PythonSystem& system_of(nb::handle object, const char* where) {
  if (!nb::isinstance<PythonSystem>(object))
    throw nb::type_error(
        (std::string(where) + ": got " + class_name(object) + "; expected a System").c_str());
  return nb::cast<const PythonSystem&>(object);
}

void bind_system(nb::module_& m) {
  using S = PythonSystem;
  nb::class_<S> c(
      m, "System", R"(A body, a reference frame S, and what acts on the body.

dq/dt = (1/2) q (0, w_SB), dg/dt = g x w_SB + u, w_SB = I^-1 g + v; v and u are summed over the
terms and the frame, which the system adds by itself as the term -mu . g. [SA (118), (124)]

Parameters
----------
body : Body.
frame : Frame; None: inertial axes.
terms : one term or a sequence: GravityGradient, ConstantTorque, LinearDamping, TorqueTerm,
    HamiltonianTerm.
damper : KaneDamper, or None.

Functions of a system take a time and a RotorState in the frame S, which broadcast. They are in any
consistent units.)",
      nb::type_slots(
          object_slots<PythonSystem, &PythonSystem::python_frame, &PythonSystem::python_terms>()));
  c.def("__init__", make_system, "body"_a, "frame"_a = nb::none(), "terms"_a = nb::make_tuple(),
        "damper"_a = nb::none())
      .def_prop_ro(
          "body", [](const S& s) { return s.body(); }, "What rotates.")
      .def_prop_ro(
          "frame", [](const S& s) { return s.python_frame; }, "The very object that was given.")
      .def_prop_ro(
          "terms", [](const S& s) { return s.python_terms; }, "The very objects that were given.")
      .def_prop_ro(
          "damper", [](const S& s) { return s.damper(); }, "None: none.")
      .def_prop_ro(
          "is_hamiltonian", [](const S& s) { return s.is_hamiltonian(); },
          "Whether every term has an energy, and no damper takes it.");
  def_object(
      c, [](const S& s) { return arguments_of(s); }, [](const S& s) { return repr_of(s); });
  bind_system_functions(m);
  bind_andoyer_method(m);
}

}  // namespace polhode::python
