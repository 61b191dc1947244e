// SPDX-License-Identifier: MIT
// What Python's garbage collector must know of a class that holds Python objects.
#pragma once

#include "bindings.hpp"

namespace polhode::python {

template <class C, auto... objects>
int traverse_objects(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const C* holder = nb::inst_ptr<C>(self);
  for (const nb::handle object : {nb::handle((holder->*objects).ptr())...}) Py_VISIT(object.ptr());
  return 0;
}

template <class C, auto... objects>
int clear_objects(PyObject* self) {
  if (!nb::inst_ready(self)) return 0;
  C* holder = nb::inst_ptr<C>(self);
  ((holder->*objects).reset(), ...);
  return 0;
}

// Slots of a class C whose members `objects` are Python objects.
template <class C, auto... objects>
PyType_Slot* object_slots() {
  static PyType_Slot slots[] = {
      {Py_tp_traverse, reinterpret_cast<void*>(traverse_objects<C, objects...>)},
      {Py_tp_clear, reinterpret_cast<void*>(clear_objects<C, objects...>)},
      {0, nullptr}};
  return slots;
}

}  // namespace polhode::python
