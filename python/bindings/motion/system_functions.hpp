// SPDX-License-Identifier: MIT
// Functions of a system, a time and a state.
#pragma once

#include "bindings.hpp"
#include "polhode/system/element_rates.hpp"

namespace polhode::python {

void bind_system_functions(nb::module_& m);
// Equations of motion of elements in any gauge.
void bind_element_rates(nb::module_& m);
using AnyGauge = Typed<"str | typing.Callable[[typing.Any, typing.Any], typing.Any]">;
rates::Gauge gauge_of(nb::handle gauge);
// Equations of motion in variables that Python writes.
void bind_andoyer_method(nb::module_& m);

}  // namespace polhode::python
