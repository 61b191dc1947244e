// SPDX-License-Identifier: MIT
// How functions written in Python read their numbers: by the rules of all others.
#include "interface/arrays.hpp"
#include "interface/mistakes.hpp"
#include "interface/signed_method.hpp"

namespace polhode::python {

void bind_numbers(nb::module_& m) {
  // NumPy's types are looked up now: later another thread could wait for them, with the GIL
  is_plain_scalar(nb::none());
  is_plain_array(nb::none());
  is_refused(nb::none());
  m.def("_numbers", &real_array, "value"_a, "name"_a,
        "An array of real numbers; `name` stands for it in messages. TypeError for quantities.");
  m.def("_signed_method", &signed_method, "method"_a, "make_signature"_a, "explain"_a,
        "The method, with a __signature__ that make_signature() returns when it is asked for.");
  m.def("_explain_constructor", &explain_constructor, "type"_a,
        "type._refuse(args, kwargs) raises what is said of arguments that no constructor takes.");
  m.def("_number", &number, "value"_a, "name"_a, "One real number.");
  m.def("_require_plain", &require_plain, "value"_a, "name"_a,
        "TypeError for what would lose its unit, its mask, ... as a number.");
}

}  // namespace polhode::python
