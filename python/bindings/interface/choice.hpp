// SPDX-License-Identifier: MIT
// An argument that is one of a few: a member of an enum, or its name as a string.
#pragma once

#include <string>

#include "bindings.hpp"

namespace polhode::python {

// `name` stands for the argument in messages. ValueError for another word, TypeError else.
template <class E>
E choice(nb::handle value, const char* name) {
  const nb::handle type = nb::type<E>();
  if (PyObject_IsInstance(value.ptr(), type.ptr()) == 1) return nb::cast<E>(value);
  const nb::object members = type.attr("__members__");
  const bool word = nb::isinstance<nb::str>(value);
  if (word && nb::cast<bool>(members.attr("__contains__")(value)))
    return nb::cast<E>(nb::object(members[value]));
  std::string known;
  for (const nb::handle member : members) known += " " + nb::cast<std::string>(member);
  const std::string text = std::string(name) + ": got " + nb::cast<std::string>(nb::repr(value)) +
                           "; expected one of" + known;
  if (word) throw nb::value_error(text.c_str());
  throw nb::type_error(text.c_str());
}

}  // namespace polhode::python
