// SPDX-License-Identifier: MIT
// What a Python object was made from, kept with the C++ value, which does not say: for its
// properties, for pickles, equality and repr, and for the garbage collector.
#pragma once

#include <string>
#include <vector>

#include "interface/python_function.hpp"
#include "interface/typed.hpp"

namespace polhode::python {

struct Recipe {
  // The class method that made it; "" is the class itself.
  const char* method = "";
  std::vector<const char*> names;
  // The very objects, one per name. Null where C++ made the value: from a scenario.
  nb::object arguments;
  std::vector<SharedFunction> functions;

  bool is_known() const { return arguments.is_valid(); }
  // None where nothing is known.
  Any argument(std::size_t i) const;
  Typed<"dict[str, typing.Any]"> by_name() const;

  int traverse(visitproc visit, void* arg) const;
  void clear();
};

Recipe recipe_of(const char* method, std::initializer_list<const char*> names, nb::object arguments,
                 std::vector<SharedFunction> functions = {});

// __reduce__ of `self`. TypeError where C++ made it.
nb::object reduced(nb::handle self, const Recipe& recipe);
// "GravityGradient(gm=1.0, ...)"; `otherwise` where C++ made it.
std::string repr_of(nb::handle self, const Recipe& recipe, const std::string& otherwise);
bool same_recipe(const Recipe& a, const Recipe& b);
nb::object hash_of(const Recipe& recipe);

// Slots of a class C that has a member `recipe`; also for what derives from it.
template <class C>
int traverse_recipe(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  return nb::inst_ptr<C>(self)->recipe.traverse(visit, arg);
}
template <class C>
int clear_recipe(PyObject* self) {
  if (nb::inst_ready(self)) nb::inst_ptr<C>(self)->recipe.clear();
  return 0;
}
template <class C>
PyType_Slot* recipe_slots() {
  static PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse_recipe<C>)},
                                {Py_tp_clear, reinterpret_cast<void*>(clear_recipe<C>)},
                                {0, nullptr}};
  return slots;
}

// Equality, hash, repr, copies and pickles by the recipe.
template <class C, class Class>
void def_recipe(Class& c, std::string (*otherwise)(const C&)) {
  c.def(
       "__eq__",
       [](nb::handle_t<C> a, nb::handle b) -> nb::object {
         if (a.is(b)) return nb::bool_(true);
         if (!nb::handle(a.type()).is(b.type())) return nb::borrow(Py_NotImplemented);
         return nb::bool_(same_recipe(nb::cast<const C&>(a).recipe, nb::cast<const C&>(b).recipe));
       },
       nb::is_operator(), "other"_a, nb::sig("def __eq__(self, other: object) -> bool"))
      .def(
          "__hash__", [](nb::handle_t<C> a) { return hash_of(nb::cast<const C&>(a).recipe); },
          nb::sig("def __hash__(self) -> int"))
      .def("__repr__",
           [otherwise](nb::handle_t<C> a) {
             const C& value = nb::cast<const C&>(a);
             return repr_of(a, value.recipe, otherwise(value));
           })
      .def("__copy__", [](nb::handle_t<C> a) { return nb::object(nb::borrow(a)); })  // immutable
      .def("__reduce__",
           [](nb::handle_t<C> a) { return reduced(a, nb::cast<const C&>(a).recipe); });
}

}  // namespace polhode::python
