// SPDX-License-Identifier: MIT
// What a fit of light curves found, as Python is given it.
#pragma once

#include "bindings.hpp"
#include "polhode/fit/light_fit.hpp"

namespace polhode::python {

nb::dict light_dict(const LightSolution& found);

}  // namespace polhode::python
