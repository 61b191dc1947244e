// SPDX-License-Identifier: MIT
#include "interface/signed_method.hpp"

#include <structmember.h>

#include <cstddef>

#include "interface/mistakes.hpp"

namespace polhode::python {

namespace {

struct SignedMethod {
  PyObject_HEAD vectorcallfunc call;
  PyObject* method;
  PyObject* make_signature;  // null once it was asked
  PyObject* explain;
  PyObject* signature;  // null until then
};

SignedMethod* of(PyObject* self) { return reinterpret_cast<SignedMethod*>(self); }

// In place of the error that is set, the one that explain(self, args, kwargs) raises, if it does.
void raise_explained(const SignedMethod* s, PyObject* const* arguments, std::size_t count,
                     PyObject* names) {
  const std::size_t n = static_cast<std::size_t>(PyVectorcall_NARGS(count));
  if (n == 0) return;
  PyErr_Clear();
  try {
    nb::list args;
    for (std::size_t i = 1; i < n; ++i) args.append(nb::handle(arguments[i]));
    nb::dict kwargs;
    const std::size_t named = names == nullptr ? 0 : nb::len(names);
    for (std::size_t i = 0; i < named; ++i)
      kwargs[nb::handle(names)[i]] = nb::handle(arguments[n + i]);
    nb::handle(s->explain)(nb::handle(arguments[0]), args, kwargs);
  } catch (nb::python_error& e) {
    e.restore();
  }
}

PyObject* call(PyObject* self, PyObject* const* arguments, std::size_t count, PyObject* names) {
  PyObject* const result = PyObject_Vectorcall(of(self)->method, arguments, count, names);
  if (result == nullptr && is_of_no_overload()) raise_explained(of(self), arguments, count, names);
  return result;
}

// Of the class it is itself; of an object, a bound method. Calls do not come here.
PyObject* bound(PyObject* self, PyObject* object, PyObject*) {
  if (object == nullptr || object == Py_None) return nb::borrow(self).release().ptr();
  return PyObject_CallFunctionObjArgs(nb::module_::import_("types").attr("MethodType").ptr(), self,
                                      object, nullptr);
}

PyObject* signature(PyObject* self, void*) {
  SignedMethod* const s = of(self);
  if (s->signature == nullptr) {
    s->signature = PyObject_CallNoArgs(s->make_signature);
    if (s->signature == nullptr) return nullptr;
    Py_CLEAR(s->make_signature);
  }
  return nb::borrow(s->signature).release().ptr();
}

// Name, text and the like are those of the method.
PyObject* attribute(PyObject* self, PyObject* name) {
  if (PyUnicode_CompareWithASCIIString(name, "__signature__") != 0)
    if (PyObject* const its = PyObject_GetAttr(of(self)->method, name)) return its;
  PyErr_Clear();
  return PyObject_GenericGetAttr(self, name);
}

PyObject* repr(PyObject* self) { return PyObject_Repr(of(self)->method); }

int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  Py_VISIT(of(self)->method);
  Py_VISIT(of(self)->make_signature);
  Py_VISIT(of(self)->explain);
  Py_VISIT(of(self)->signature);
  return 0;
}
int clear(PyObject* self) {
  Py_CLEAR(of(self)->method);
  Py_CLEAR(of(self)->make_signature);
  Py_CLEAR(of(self)->explain);
  Py_CLEAR(of(self)->signature);
  return 0;
}
void deallocate(PyObject* self) {
  PyTypeObject* const type = Py_TYPE(self);
  PyObject_GC_UnTrack(self);
  clear(self);
  PyObject_GC_Del(self);
  Py_DECREF(type);
}

nb::object made_type() {
  static PyMemberDef members[] = {
      {"__vectorcalloffset__", T_PYSSIZET, offsetof(SignedMethod, call), READONLY, nullptr},
      {nullptr, 0, 0, 0, nullptr}};
  static PyGetSetDef properties[] = {{"__signature__", signature, nullptr, nullptr, nullptr},
                                     {nullptr, nullptr, nullptr, nullptr, nullptr}};
  static PyType_Slot slots[] = {{Py_tp_call, reinterpret_cast<void*>(PyVectorcall_Call)},
                                {Py_tp_descr_get, reinterpret_cast<void*>(bound)},
                                {Py_tp_members, members},
                                {Py_tp_getset, properties},
                                {Py_tp_getattro, reinterpret_cast<void*>(attribute)},
                                {Py_tp_repr, reinterpret_cast<void*>(repr)},
                                {Py_tp_traverse, reinterpret_cast<void*>(traverse)},
                                {Py_tp_clear, reinterpret_cast<void*>(clear)},
                                {Py_tp_dealloc, reinterpret_cast<void*>(deallocate)},
                                {0, nullptr}};
  static PyType_Spec spec = {"polhode.method", sizeof(SignedMethod), 0,
                             Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_HAVE_VECTORCALL |
                                 Py_TPFLAGS_METHOD_DESCRIPTOR,
                             slots};
  return nb::steal(PyType_FromSpec(&spec));
}

}  // namespace

nb::object signed_method(nb::handle method, nb::handle make_signature, nb::handle explain) {
  static PyObject* const type = made_type().release().ptr();
  SignedMethod* const made = PyObject_GC_New(SignedMethod, reinterpret_cast<PyTypeObject*>(type));
  if (made == nullptr) throw nb::python_error();
  made->call = call;
  made->method = method.inc_ref().ptr();
  made->make_signature = make_signature.inc_ref().ptr();
  made->explain = explain.inc_ref().ptr();
  made->signature = nullptr;
  PyObject_GC_Track(made);
  return nb::steal(reinterpret_cast<PyObject*>(made));
}

}  // namespace polhode::python
