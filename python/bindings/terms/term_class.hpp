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
#include "terms/term_value.hpp"

namespace polhode::python {

// How an argument of type M comes from Python, what is kept of it in the recipe, and what a
// property shows of that: numbers as Carried does, objects as they were given.
template <class M>
struct Taken : Carried<M> {
  using Shown = decltype(Carried<M>::shown(std::declval<M>()));
  static nb::object kept(const M& x) { return Carried<M>::argument(x); }
  static nb::object show(const nb::object& kept) {
    if constexpr (std::is_same_v<typename Carried<M>::In, ArrayLike>)
      return Carried<M>::shown(Carried<M>::read(kept, ""));
    else
      return kept;
  }
};
// An object of Python, which the one who makes the term looks into.
template <class M>
  requires std::is_base_of_v<nb::object, M>
struct Taken<M> {
  using In = M;
  using Shown = M;
  static M read(const M& x, const char*) { return x; }
  static nb::object kept(const M& x) { return x; }
  static nb::object show(const nb::object& kept) { return kept; }
};
// A value of a class of ours.
template <class M>
  requires(std::is_same_v<typename Carried<M>::In, M> &&
           nb::detail::is_base_caster_v<nb::detail::make_caster<M>>)
struct Taken<M> {
  using In = nb::handle_t<M>;
  using Shown = nb::handle_t<M>;
  static In read(In x, const char*) { return x; }
  static nb::object kept(In x) { return nb::borrow(x); }
  static nb::object show(const nb::object& kept) { return kept; }
};

// A member of an enum, its name, or None.
template <class E>
  requires std::is_enum_v<E>
struct Taken<std::optional<E>> {
  using In = OneOf<E>;
  using Shown = std::optional<E>;
  static Shown read(nb::handle x, const char* name) {
    return x.is_none() ? Shown() : choice<E>(x, name);
  }
  static nb::object kept(const Shown& x) { return x ? nb::cast(*x) : nb::none(); }
  static nb::object show(const nb::object& kept) { return kept; }
};

// Numbers of any shape; kept as tuples.
struct Table {
  FloatArray numbers;
};
template <>
struct Taken<Table> {
  using In = ArrayLike;
  using Shown = FloatArray;
  static Table read(nb::handle x, const char* name) { return {real_array(x, name)}; }
  static nb::object kept(const Table& x);
  static FloatArray show(nb::handle kept) { return real_array(kept, ""); }
};

// One number, or a diagonal (3,).
struct Diagonal {
  Vec3 all;
  bool is_one;
};
template <>
struct Taken<Diagonal> {
  using In = ArrayLike;
  using Shown = Typed<"float | tuple[float, float, float]">;
  static Diagonal read(nb::handle x, const char* name);
  static nb::object kept(const Diagonal& x) {
    return x.is_one ? nb::object(nb::float_(x.all.x)) : nb::object(tuple_of(x.all));
  }
  static nb::object show(const nb::object& kept) { return kept; }
};

// One number, a diagonal (3,) or a matrix (3, 3), along the principal axes.
struct Tensor {
  Mat3 matrix;
  bool is_full;
};
Tensor tensor_of(nb::handle value, const char* name);
template <>
struct Taken<Tensor> {
  using In = ArrayLike;
  using Shown = FloatArray;
  static Tensor read(nb::handle x, const char* name) { return tensor_of(x, name); }
  static nb::object kept(const Tensor& x);
  static FloatArray show(nb::handle kept) { return array_of(tensor_of(kept, "").matrix); }
};

// The name of a term in messages: the one given, or that of the function, or of the class.
struct TermName {};
template <>
struct Taken<TermName> {
  using In = Text;
  using Shown = Text;
  static TermName read(nb::handle, const char*) { return {}; }
};

// An object that signatures call as they call a T.
template <class T>
class As : public nb::object {
 public:
  static constexpr auto Name = nb::detail::make_caster<T>::Name;
  As(nb::handle any, nb::detail::borrow_t) : nb::object(any, nb::detail::borrow_t{}) {}
  As(nb::handle any, nb::detail::steal_t) : nb::object(any, nb::detail::steal_t{}) {}
  static bool check_(nb::handle) { return true; }
};

template <class M, class Default = Required>
struct Argument {
  using Member = M;
  const char* name;
  const char* text;  // what it is, for the docstring
  Default otherwise = {};
  bool has_property = true;

  Argument without_property() const {
    Argument other = *this;
    other.has_property = false;
    return other;
  }
};
template <class M>
Argument<M> argument(const char* name, const char* text = "") {
  return {name, text};
}
template <class M, class Default>
Argument<M, Default> argument(const char* name, const char* text, Default otherwise) {
  return {name, text, otherwise};
}
inline Argument<TermName, nb::none> term_name() {
  return {"name", "stands in messages.", nb::none()};
}

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
    "KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit | "
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
