// SPDX-License-Identifier: MIT
// The Python module, layer by layer. Layers are bound in this order: a signature can only name
// types that are bound already.
#pragma once

#include <nanobind/nanobind.h>
// before the containers of numbers
#include "interface/plain_number.hpp"
// Casters are included here, once for all: a source without one would compile another cast of the
// same name, and the linker takes either.
#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

namespace polhode::python {

namespace nb = nanobind;
using namespace nb::literals;  // "t"_a: an argument

void bind_numbers(nb::module_& m);
void bind_math(nb::module_& m);
void bind_elliptic(nb::module_& m);
void bind_rotor(nb::module_& m);
void bind_free(nb::module_& m);
void bind_generating(nb::module_& m);
void bind_orbit(nb::module_& m);
void bind_frame(nb::module_& m);
void bind_shape(nb::module_& m);
void bind_perturb(nb::module_& m);
void bind_user_terms(nb::module_& m);
void bind_damper(nb::module_& m);
void bind_system(nb::module_& m);
void bind_trajectory(nb::module_& m);
void bind_dynamics(nb::module_& m);
void bind_many(nb::module_& m);
void bind_satellite(nb::module_& m);
void bind_analysis(nb::module_& m);
void bind_section(nb::module_& m);
void bind_secular(nb::module_& m);
void bind_spin_histories(nb::module_& m);
void bind_planet_data(nb::module_& m);
void bind_spectrum(nb::module_& m);
void bind_series(nb::module_& m);
void bind_lie_transform(nb::module_& m);
void bind_normal_form(nb::module_& m);
void bind_io(nb::module_& m);

}  // namespace polhode::python
