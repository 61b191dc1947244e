// SPDX-License-Identifier: MIT
// Classes that hold Python objects: what the garbage collector must know, and the methods by which
// they are compared, copied and shown.
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

// Equality, hash, pickles and text of a class that holds Python objects. arguments(value) is the
// tuple that its constructor takes. A copy is the object itself.
template <class C, class Arguments, class Text>
void def_object(nb::class_<C>& c, Arguments arguments, Text text) {
  c.def(
       "__eq__",
       [arguments](const C& a, nb::handle b) -> Typed<"bool"> {
         if (!nb::isinstance<C>(b)) return nb::borrow(Py_NotImplemented);
         return nb::bool_(arguments(a).equal(arguments(nb::cast<const C&>(b))));
       },
       nb::is_operator(), "other"_a)
      .def("__hash__", [arguments](const C& v) { return nb::hash(arguments(v)); })
      .def("__repr__", [text](const C& v) { return text(v); })
      .def("__copy__", [](nb::handle_t<C> v) { return nb::object(nb::borrow(v)); })
      .def("__reduce__", [arguments](nb::handle_t<C> self) {
        return nb::make_tuple(nb::handle(self.type()), arguments(nb::cast<const C&>(self)));
      });
}

}  // namespace polhode::python
