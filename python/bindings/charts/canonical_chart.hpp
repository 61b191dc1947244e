// SPDX-License-Identifier: MIT
// Canonical charts by name, for the functions that work in any of them.
#pragma once

#include "interface/typed.hpp"
#include "polhode/rotor/chart_jacobian.hpp"

namespace polhode::python {

using AnyChart = Typed<"CanonicalChart | CanonicalSet | str">;

// A CanonicalChart, a CanonicalSet, or its name. TypeError or ValueError else.
CanonicalChart chart_of(nb::handle chart, const char* name);

// CanonicalSet, CanonicalChart and their Jacobians, and those of sets that are not canonical.
void bind_jacobians(nb::module_& m);

}  // namespace polhode::python
