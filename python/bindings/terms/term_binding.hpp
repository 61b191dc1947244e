// SPDX-License-Identifier: MIT
// What the Python classes of terms share: their names, their orbits, and how they print, compare
// and pickle.
#pragma once

#include <string>

#include "interface/value.hpp"
#include "terms/orbit_value.hpp"
#include "terms/term_value.hpp"

namespace polhode::python {

// The name given, or that of the function, or of the class.
inline std::string name_of(nb::handle name, const char* otherwise, nb::handle function = {}) {
  if (nb::isinstance<nb::str>(name)) return nb::cast<std::string>(name);
  if (!name.is_none())
    throw nb::type_error(
        (std::string(otherwise) + ": name: got " + class_name(name) + "; expected a str").c_str());
  if (function.is_valid() && nb::hasattr(function, "__name__"))
    return nb::cast<std::string>(nb::str(nb::object(function.attr("__name__"))));
  return otherwise;
}

inline std::string labelled(const char* type, const std::string& name) {
  return std::string(type) + " \"" + name + "\"";
}

// What a term was made of: the names of its arguments and the very objects.
struct Given {
  std::initializer_list<const char*> names;
  nb::object arguments;
};

// What the argument `orbit` of a term takes: an orbit with a velocity, or any.
using MovingOrbit = Typed<"KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit">;
using Orbit = Typed<
    "KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit | "
    "typing.Callable[[float], numpy.typing.ArrayLike]">;

// A term of class C along an orbit that Python gives: made(called, orbit) is an AnyPerturbation.
template <class C, class Made>
void make_along(C* self, const char* type, nb::handle orbit, nb::handle name, const Given& given,
                const Made& made) {
  const std::string called = name_of(name, type);
  std::vector<SharedFunction> functions;
  const AnyPythonOrbit any = orbit_of(orbit, labelled(type, called) + ": orbit", functions);
  const AnyPerturbation term =
      std::visit([&](const auto& o) -> AnyPerturbation { return made(called, o); }, any);
  new (self) C(term, recipe_of("", given.names, given.arguments, std::move(functions)));
}

// What a term was given at place i.
template <std::size_t i, TypeText type>
Typed<type> given(const PythonTerm& term) {
  return nb::object(term.recipe.argument(i));
}

template <class C, class Class>
void def_term(Class& c) {
  def_recipe<C>(c, [](const C& term) { return "\"" + term.name() + "\""; });
}

}  // namespace polhode::python
