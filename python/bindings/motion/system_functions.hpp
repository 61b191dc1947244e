// SPDX-License-Identifier: MIT
// Functions of a system, a time and a state.
#pragma once

#include "bindings.hpp"

namespace polhode::python {

void bind_system_functions(nb::module_& m);
// Equations of motion of elements in any gauge.
void bind_element_rates(nb::module_& m);
// Equations of motion in variables that Python writes.
void bind_andoyer_method(nb::module_& m);

}  // namespace polhode::python
