// SPDX-License-Identifier: MIT
// The Python class of a kind of term, from the list of its arguments and a function that makes the
// term of them: constructor, docstring, properties, and by its recipe equality, text and pickles.
#pragma once

#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "interface/value.hpp"
#include "terms/orbit_value.hpp"
#include "terms/term_argument.hpp"
#include "terms/term_value.hpp"

namespace polhode::python {

// What a term is being made with, next to its arguments.
struct Making {
  std::string name;   // of the term
  std::string label;  // GravityGradient "moon"
  std::vector<SharedFunction> functions = {};
};
Making making(const char* type, nb::handle name, nb::handle function);

// "summary ... Parameters ... notes" of a docstring.
std::string docstring(const char* summary, std::span<const std::pair<const char*, const char*>> of,
                      const char* notes);

// What the argument `orbit` of a term takes: an orbit with a velocity, or any.
using MovingOrbit = Typed<"KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit">;
using Orbit = Typed<
    "KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit | HistoryOrbit | "
    "typing.Callable[[float], numpy.typing.ArrayLike]">;

// made(orbit), a term, of what Python gave as one.
template <class Made>
AnyPerturbation along(Making& at, nb::handle orbit, const Made& made) {
  const AnyPythonOrbit any = orbit_of(orbit, at.label + ": orbit", at.functions);
  return std::visit([&](const auto& o) { return AnyPerturbation(at.name, made(o)); }, any);
}

// One C++ type per Python class.
template <TypeText type>
struct TermOf : PythonTerm {
  using PythonTerm::PythonTerm;
};

namespace detail {

template <class M>
nb::arg python_argument(const Argument<M>& a) {
  return nb::arg(a.name);
}
template <class M, class Default>
auto python_argument(const Argument<M, Default>& a) {
  return nb::arg(a.name) = a.otherwise;
}

template <class M, class In>
auto passed_on(const In& in, const char* name) {
  if constexpr (std::is_same_v<M, TermName>)
    return std::tuple<>();
  else
    return std::tuple(Taken<M>::read(in, name));
}
template <class M, class In>
nb::object kept(const In& in, const char* name) {
  if constexpr (std::is_same_v<M, TermName>)
    return nb::borrow(in);
  else
    return Taken<M>::kept(Taken<M>::read(in, name));
}
template <class M>
void note_name(nb::handle in, nb::handle& name) {
  if constexpr (std::is_same_v<M, TermName>) name = in;
}

// The term of class C that made(at, values ...) gives, with its recipe.
template <TypeText type, class Made, class... A>
TermOf<type> term_of(const char* method, const Made& made, const std::tuple<A...>& arguments,
                     const typename Taken<typename A::Member>::In&... in) {
  return std::apply(
      [&](const A&... a) {
        nb::handle name = Py_None, function;
        (note_name<typename A::Member>(nb::cast(in), name), ...);
        nb::tuple given = nb::make_tuple(nb::cast(in)...);
        if (std::string_view(std::get<0>(arguments).name) == "function") function = given[0];
        Making at = making(type.chars, name, function);
        AnyPerturbation term =
            std::apply([&](const auto&... values) { return AnyPerturbation(made(at, values...)); },
                       std::tuple_cat(passed_on<typename A::Member>(in, a.name)...));
        return TermOf<type>(
            std::move(term),
            recipe_of(method, {a.name...}, nb::make_tuple(kept<typename A::Member>(in, a.name)...),
                      std::move(at.functions)));
      },
      arguments);
}

}  // namespace detail

template <TypeText type>
using TermClass = nb::class_<TermOf<type>, PythonTerm>;

// A class whose terms are made by class methods.
template <TypeText type>
TermClass<type> term_class(nb::module_& m, const char* doc) {
  using C = TermOf<type>;
  TermClass<type> c(m, type.chars, doc, nb::type_slots(recipe_slots<C>()));
  def_recipe<C>(c, [](const C& term) { return "\"" + term.name() + "\""; });
  return c;
}

template <TypeText type, class Made, class... A>
void def_maker(TermClass<type>& c, const char* method, const char* doc, Made made, A... arguments) {
  const std::tuple<A...> all(arguments...);
  c.def_static(
      method,
      [=](typename Taken<typename A::Member>::In... in) {
        return detail::term_of<type>(method, made, all, in...);
      },
      detail::python_argument(arguments)..., doc);
}

// A class whose constructor makes the term: made(at, values ...), a term or an AnyPerturbation.
template <TypeText type, class Made, class... A>
TermClass<type> bind_term(nb::module_& m, const char* summary, const char* notes, Made made,
                          A... arguments) {
  using C = TermOf<type>;
  const std::pair<const char*, const char*> texts[] = {{arguments.name, arguments.text}...};
  const std::string doc = docstring(summary, texts, notes);
  TermClass<type> c = term_class<type>(m, doc.c_str());
  const std::tuple<A...> all(arguments...);
  c.def(
      "__init__",
      [=](C* self, typename Taken<typename A::Member>::In... in) {
        new (self) C(detail::term_of<type>("", made, all, in...));
      },
      detail::python_argument(arguments)...);
  std::size_t place = 0;
  const auto property = [&]<class M, class D>(const Argument<M, D>& a) {
    const std::size_t i = place++;
    if constexpr (!std::is_same_v<M, TermName>) {
      if (!a.has_property) return;
      c.def_prop_ro(
          a.name,
          [i](const C& term) -> As<typename Taken<M>::Shown> {
            nb::object shown = term.recipe.argument(i);
            if (!shown.is_none()) shown = Taken<M>::show(shown);
            return nb::borrow<As<typename Taken<M>::Shown>>(nb::handle(shown));
          },
          a.text);
    }
  };
  (property(arguments), ...);
  c.attr("__match_args__") = nb::make_tuple(arguments.name...);
  return c;
}

}  // namespace polhode::python
