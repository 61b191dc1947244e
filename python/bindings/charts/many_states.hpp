// SPDX-License-Identifier: MIT
// Functions of free rotation that compute many states together.
#pragma once

#include <cstdint>

#include "interface/batch.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode::python {

// FreeRotation.at_grid.
Batch<RotorState> states_of_grid(const FreeRotation& f, double start, double step,
                                 std::int64_t count, std::int64_t first, int threads);
void bind_to_sadov(nb::module_& m);
void bind_rotor_of_sadov(nb::module_& m);
void bind_to_serret(nb::module_& m);
void bind_rotor_of_serret(nb::module_& m);

}  // namespace polhode::python
