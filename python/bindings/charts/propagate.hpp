// SPDX-License-Identifier: MIT
// propagate, the free rotation of many bodies: a part of bind_free.
#pragma once

#include "bindings.hpp"

namespace polhode::python {

void bind_propagate(nb::module_& m);

}  // namespace polhode::python
