// SPDX-License-Identifier: MIT
#include "interface/value.hpp"

namespace polhode::python {

std::string repr_text(nb::handle value) {
  if (!nb::hasattr(value.type(), "__members__")) return nb::cast<std::string>(nb::repr(value));
  return class_name(value) + "." + nb::cast<std::string>(nb::str(nb::object(value.attr("name"))));
}

nb::tuple remade(nb::handle self, nb::handle arguments, const char* method) {
  const nb::handle type = self.type();
  if (method[0] == '\0') return nb::make_tuple(type, arguments);
  const nb::object call =
      nb::module_::import_("operator")
          .attr("methodcaller")(nb::str(method), *nb::cast<nb::tuple>(arguments));
  return nb::make_tuple(call, nb::make_tuple(type));
}

Py_hash_t hash_of(const nb::tuple& arguments) {
  nb::list hashable;
  for (const nb::handle x : arguments) {
    if (PyDict_Check(x.ptr()))
      hashable.append(nb::module_::import_("builtins").attr("frozenset")(x.attr("items")()));
    else
      hashable.append(x);
  }
  return static_cast<Py_hash_t>(nb::hash(nb::tuple(hashable)));
}

void declare_fields(nb::handle type, const nb::tuple& names) {
  type.attr("__match_args__") = names;
  const nb::object plain =
      nb::module_::import_("dataclasses")
          .attr("make_dataclass")(type.attr("__name__"), names, "init"_a = false, "repr"_a = false,
                                  "eq"_a = false);
  for (const char* const part : {"__dataclass_fields__", "__dataclass_params__"})
    type.attr(part) = plain.attr(part);
}

nb::tuple tuple_of(const Vec3& v) { return nb::make_tuple(v.x, v.y, v.z); }

nb::tuple rows_of(const Mat3& m) {
  return nb::make_tuple(tuple_of(m.row[0]), tuple_of(m.row[1]), tuple_of(m.row[2]));
}

nb::tuple tuple_of(std::span<const double> numbers) {
  nb::list list;
  for (const double x : numbers) list.append(x);
  return nb::tuple(list);
}

}  // namespace polhode::python
