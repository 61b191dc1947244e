// SPDX-License-Identifier: MIT
// Small immutable values, as Python's frozen dataclasses are: a list of fields makes the
// constructor, the properties, equality, hash, copies, pickles and the text.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "interface/arrays.hpp"
#include "interface/choice.hpp"

namespace polhode::python {

// As Python writes a float: the shortest text that reads back the same.
inline std::string number_text(double x) { return nb::cast<std::string>(nb::repr(nb::float_(x))); }
// As repr writes it; a member of an enum as "Dimension.length".
std::string repr_text(nb::handle value);

// What __reduce__ returns of `self`: its class, or a class method of it, with these arguments.
nb::tuple remade(nb::handle self, nb::handle arguments, const char* method = "");

// For match statements, and for dataclasses: fields, asdict, replace.
void declare_fields(nb::handle type, const nb::tuple& names);

nb::tuple tuple_of(const Vec3& v);
nb::tuple rows_of(const Mat3& m);
nb::tuple tuple_of(std::span<const double> numbers);

// How a member of type M comes from Python, is shown by a property, and is given back to the
// constructor: as plain Python numbers, which compare and hash.
template <class M>
struct Carried {
  using In = M;
  static M read(const M& x, const char*) { return x; }
  static M shown(const M& x) { return x; }
  static nb::object argument(const M& x) { return nb::cast(x); }
};
template <class M>
  requires std::is_enum_v<M>
struct Carried<M> {
  using In = OneOf<M>;
  static M read(nb::handle x, const char* name) { return choice<M>(x, name); }
  static M shown(M x) { return x; }
  static nb::object argument(M x) { return nb::cast(x); }
};
template <>
struct Carried<Vec3> {
  using In = ArrayLike;
  static Vec3 read(nb::handle x, const char* name) { return vec3(x, name); }
  static FloatArray shown(const Vec3& x) { return array_of(x); }
  static nb::object argument(const Vec3& x) { return tuple_of(x); }
};
template <std::size_t n>
struct Carried<std::array<double, n>> {
  using In = ArrayLike;
  static std::array<double, n> read(nb::handle x, const char* name) {
    const Numbers numbers(x, name, {n});
    std::array<double, n> out;
    std::copy_n(numbers.at(0), n, out.begin());
    return out;
  }
  static FloatArray shown(const std::array<double, n>& x) { return array_of(std::span(x)); }
  static nb::object argument(const std::array<double, n>& x) { return tuple_of(std::span(x)); }
};
template <class X>
struct Carried<std::vector<X>> {
  using In = std::vector<X>;
  using Out = nb::typed<nb::tuple, X, nb::ellipsis>;
  static In read(const In& x, const char*) { return x; }
  static Out shown(const In& x) { return nb::borrow<Out>(argument(x)); }
  static nb::object argument(const In& x) { return nb::tuple(nb::cast(x)); }
};

struct Required {};

// A member of a value, or a function of it without arguments.
template <class Get, class Default = Required>
struct ValueField {
  const char* name;
  Get get;
  const char* text;
  Default otherwise = {};
  bool quiet = false;  // not in the text of a value that has the default

  template <class C>
  using Member = std::remove_cvref_t<std::invoke_result_t<Get, const C&>>;
  template <class C>
  Member<C> operator()(const C& value) const {
    return std::invoke(get, value);
  }
  ValueField but_quiet() const {
    ValueField other = *this;
    other.quiet = true;
    return other;
  }
};

template <class Get>
ValueField<Get> field(const char* name, Get get, const char* text) {
  return {name, get, text};
}
template <class Get, class Default>
ValueField<Get, Default> field(const char* name, Get get, const char* text, Default otherwise) {
  return {name, get, text, otherwise};
}

// The hash of a tuple of arguments. A dictionary in it is hashed by its items.
Py_hash_t hash_of(const nb::tuple& arguments);

// Equality, hash, copies and pickles by arguments(value), the tuple that its constructor takes, or
// its class method of this name.
template <class C, class Arguments>
void def_value(nb::class_<C>& c, Arguments arguments, const char* method = "") {
  c.def(
       "__eq__", [arguments](const C& a, const C& b) { return arguments(a).equal(arguments(b)); },
       nb::is_operator(), "other"_a)
      .def("__hash__", [arguments](const C& v) { return hash_of(arguments(v)); })
      .def("__copy__", [](const C& v) { return v; })
      .def(
          "__deepcopy__", [](const C& v, nb::handle) { return v; }, "memo"_a)
      .def("__reduce__", [arguments, method](nb::handle_t<C> self) {
        return remade(self, arguments(nb::cast<const C&>(self)), method);
      });
}

namespace detail {

template <class Get>
nb::arg argument_of(const ValueField<Get>& f) {
  return nb::arg(f.name);
}
template <class Get, class Default>
auto argument_of(const ValueField<Get, Default>& f) {
  return nb::arg(f.name) = f.otherwise;
}

template <class C, class Get, class Default>
void add_text(std::string& text, const C& value, const ValueField<Get, Default>& f) {
  using Member = typename ValueField<Get, Default>::template Member<C>;
  const nb::object argument = Carried<Member>::argument(f(value));
  if constexpr (!std::is_same_v<Default, Required>)
    if (f.quiet && argument.equal(nb::cast(f.otherwise))) return;
  text += (text.back() == '(' ? "" : ", ") + std::string(f.name) + "=" + repr_text(argument);
}

}  // namespace detail

// The class of a value that made(members ...) makes, or refuses.
template <class C, class Made, class... Fields>
nb::class_<C> bind_made_value(nb::module_& m, const char* name, const char* doc, Made made,
                              Fields... fields) {
  nb::class_<C> c(m, name, doc);
  c.def(
      "__init__",
      [=](C* self, typename Carried<typename Fields::template Member<C>>::In... in) {
        new (self) C(made(Carried<typename Fields::template Member<C>>::read(in, fields.name)...));
      },
      detail::argument_of(fields)...);
  (c.def_prop_ro(
       fields.name,
       [get = fields](const C& v) {
         return Carried<typename Fields::template Member<C>>::shown(get(v));
       },
       fields.text),
   ...);
  c.def("__repr__", [=](const C& v) {
    std::string text = std::string(name) + "(";
    (detail::add_text(text, v, fields), ...);
    return text + ")";
  });
  def_value(c, [=](const C& v) {
    return nb::make_tuple(Carried<typename Fields::template Member<C>>::argument(fields(v))...);
  });
  declare_fields(c, nb::make_tuple(fields.name...));
  return c;
}

// The class of a plain struct C.
template <class C, class... Fields>
nb::class_<C> bind_value(nb::module_& m, const char* name, const char* doc, Fields... fields) {
  return bind_made_value<C>(
      m, name, doc, [](auto... members) { return C{members...}; }, fields...);
}

}  // namespace polhode::python
