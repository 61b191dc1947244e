// SPDX-License-Identifier: MIT
// Rows that a function of the library would write into a file, as arrays.
#pragma once

#include <functional>
#include <string>

#include "bindings.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode::python {

// (groups, table, notes) of what `write` writes, given a scenario and a path.
nb::tuple kept_rows(const Scenario& scenario,
                    const std::function<void(const Scenario&, const std::string& path)>& write);

}  // namespace polhode::python
