// SPDX-License-Identifier: MIT
// Small immutable values: how they compare, and how they are copied, pickled and printed.
#pragma once

#include <string>

#include "bindings.hpp"

namespace polhode::python {

// As Python writes a float: the shortest text that reads back the same.
inline std::string number_text(double x) { return nb::cast<std::string>(nb::repr(nb::float_(x))); }

// Equality, hash, copies and pickles by arguments(value), the tuple that its constructor takes.
template <class C, class Arguments>
void def_value(nb::class_<C>& c, Arguments arguments) {
  c.def(
       "__eq__", [arguments](const C& a, const C& b) { return arguments(a).equal(arguments(b)); },
       nb::is_operator(), nb::arg("other"))
      .def("__hash__", [arguments](const C& v) { return nb::hash(arguments(v)); })
      .def("__copy__", [](const C& v) { return v; })
      .def("__reduce__", [arguments](nb::handle_t<C> self) {
        return nb::make_tuple(nb::handle(self.type()), arguments(nb::cast<const C&>(self)));
      });
}

}  // namespace polhode::python
