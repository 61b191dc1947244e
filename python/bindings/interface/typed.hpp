// SPDX-License-Identifier: MIT
// Python objects whose type is written down: what a parameter or a result is called in signatures,
// in the stub and in documentation. Nothing is checked here; who reads the object does that.
#pragma once

#include <cstddef>
#include <utility>

#include "bindings.hpp"

namespace polhode::python {

// A text that can be an argument of a template.
template <std::size_t n>
struct TypeText {
  char chars[n]{};
  consteval TypeText(const char (&text)[n]) {
    for (std::size_t i = 0; i < n; ++i) chars[i] = text[i];
  }
};

inline bool is_anything(PyObject*) { return true; }

template <TypeText text>
class Typed : public nb::object {
  NB_OBJECT_DEFAULT(Typed, nb::object, text.chars, is_anything)
  // NOLINTNEXTLINE(google-explicit-constructor): any object may be given as one of this type
  Typed(nb::object any) : nb::object(std::move(any)) {}
};

using Any = Typed<"typing.Any">;
using ArrayLike = Typed<"numpy.typing.ArrayLike">;
using FloatArray = Typed<"numpy.typing.NDArray[numpy.float64]">;
using Floats = Typed<"float | numpy.typing.NDArray[numpy.float64]">;  // one, or many
using Text = Typed<"str">;

// A member of an enum, or its name: choice(value, "axes") says which.
template <class E>
class OneOf : public nb::object {
 public:
  static constexpr auto Name = nb::detail::const_name<E>() + nb::detail::const_name(" | str");
  OneOf() = default;
  OneOf(nb::handle any, nb::detail::borrow_t) : nb::object(any, nb::detail::borrow_t{}) {}
  OneOf(nb::handle any, nb::detail::steal_t) : nb::object(any, nb::detail::steal_t{}) {}
  static bool check_(nb::handle) { return true; }
};

}  // namespace polhode::python
