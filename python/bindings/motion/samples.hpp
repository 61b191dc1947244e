// SPDX-License-Identifier: MIT
// Samples of a run on their way in and out of Python: when to take them, and views onto them.
#pragma once

#include "interface/arrays.hpp"
#include "polhode/trajectory/save_at.hpp"

namespace polhode::python {

// A SaveAt as it is, or times (N,). `name` stands for the argument in messages.
SaveAt save_at_of(nb::handle samples, const char* name);

// A read-only view of n blocks of numbers, `stride` bytes apart, that keeps `owner` alive: shape
// (n,) + inner.
FloatArray view_of(const double* first, std::size_t n, std::size_t stride, const Shape& inner,
                   nb::handle owner);

// "1 event", "2 events": for those who read what a run shows.
std::string counted(std::size_t n, const char* what);

}  // namespace polhode::python
