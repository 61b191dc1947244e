// SPDX-License-Identifier: MIT
// Columns of a table by their names: those of scenario files, for states from anywhere.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "interface/arrays.hpp"
#include "polhode/dynamics/problem.hpp"
#include "polhode/system/system.hpp"

namespace polhode::python {

// Name -> array of a number per row. `names` are groups ("andoyer") or columns ("theta"); a column
// that two groups share comes once. Core units; components along principal axes. ValueError for an
// unknown name, with the nearest known one.
nb::dict columns_of(const System& system, std::span<const Sample> rows,
                    const std::vector<std::string>& names, double initial_energy);

// None, one name, or a sequence of names.
std::vector<std::string> names_of(nb::handle names);

// Whether one of the names is an energy, which not every system has.
bool any_needs_energy(const std::vector<std::string>& names);

}  // namespace polhode::python
