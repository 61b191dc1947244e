// SPDX-License-Identifier: MIT
// What is said of arguments that no overload takes: a sentence in place of nanobind's list of
// signatures. Which one, functions of Python say (polhode/_mistakes.py).
#pragma once

#include <string>

#include "bindings.hpp"

namespace polhode::python {

// Whether the error that is set is nanobind's, of arguments that no overload takes.
inline bool is_of_no_overload() {
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) return false;
  PyObject *type, *value, *trace;
  PyErr_Fetch(&type, &value, &trace);
  bool is = false;
  if (PyObject* const text = value != nullptr ? PyObject_Str(value) : nullptr) {
    is = nb::cast<std::string>(nb::steal(text)).find("(): incompatible function arguments.") !=
         std::string::npos;
  }
  PyErr_Clear();
  PyErr_Restore(type, value, trace);
  return is;
}

// A default that is taken only where arguments are converted. Overloads are tried without
// conversions first and then, in their order, with them: an overload that has such an argument is
// the last of all.
struct LastResort {};

}  // namespace polhode::python

namespace nanobind::detail {

template <>
struct type_caster<polhode::python::LastResort> {
  NB_TYPE_CASTER(polhode::python::LastResort, const_name("object"))
  template <class Flags>
  bool from_python(handle, Flags flags, cleanup_list*) noexcept {
    return (flags & static_cast<Flags>(cast_flags::convert)) != 0;
  }
};

}  // namespace nanobind::detail

namespace polhode::python {

// Where no constructor of `type` fits, its class method _refuse(args, kwargs) is called, which
// raises. (A function that is kept here would keep its type alive, and Python would not see it.)
inline void explain_constructor(nb::handle type) {
  nb::cpp_function_def(
      [](nb::handle self, const nb::args& args, LastResort, const nb::kwargs& kwargs) {
        nb::handle(self.type()).attr("_refuse")(args, kwargs);
        throw nb::type_error("no constructor takes these arguments");
      },
      nb::scope(type), nb::name("__init__"), nb::is_method(), "args"_a, "_last_resort"_a = true,
      "kwargs"_a);
}

}  // namespace polhode::python
