// SPDX-License-Identifier: MIT
// What the Python classes of terms share: their names and how they print, compare and pickle.
#pragma once

#include <string>

#include "arrays.hpp"
#include "term_value.hpp"

namespace polhode::python {

// The name given, or that of the function, or of the class.
inline std::string name_of(nb::handle name, const char* otherwise, nb::handle function = {}) {
  if (nb::isinstance<nb::str>(name)) return nb::cast<std::string>(name);
  if (!name.is_none())
    throw nb::type_error(
        (std::string(otherwise) + ": name: got " + class_name(name) + "; expected a str").c_str());
  if (function.is_valid() && nb::hasattr(function, "__name__"))
    return nb::cast<std::string>(nb::str(nb::object(function.attr("__name__"))));
  return otherwise;
}

inline std::string labelled(const char* type, const std::string& name) {
  return std::string(type) + " \"" + name + "\"";
}

inline nb::tuple tuple_of(const Vec3& v) { return nb::make_tuple(v.x, v.y, v.z); }

template <class C, class Class>
void def_term(Class& c) {
  def_recipe<C>(c, [](const C& term) { return "\"" + term.name() + "\""; });
}

}  // namespace polhode::python
