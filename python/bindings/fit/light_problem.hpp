// SPDX-License-Identifier: MIT
// What a fit of light curves found, as Python is given it.
#pragma once

#include "bindings.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode::python {

nb::dict light_dict(const LightSolution& found);
nb::dict found_dict(const FoundLight& found);

}  // namespace polhode::python
