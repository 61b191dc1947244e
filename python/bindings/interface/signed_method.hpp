// SPDX-License-Identifier: MIT
// A method that inspect.signature knows. nanobind's own takes no attributes; a function of Python
// around it would cost 50 ns a call, which is a third of FreeRotation.at.
#pragma once

#include "bindings.hpp"

namespace polhode::python {

// Calls `method`, as which it also answers for its name and text; its __signature__ is what
// make_signature() returns, asked for once. Of arguments that it does not take,
// explain(self, args, kwargs) raises what is said.
nb::object signed_method(nb::handle method, nb::handle make_signature, nb::handle explain);

}  // namespace polhode::python
