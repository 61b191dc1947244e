// SPDX-License-Identifier: MIT
// A fit of snapshots and what it found, as objects that Python holds.
#pragma once

#include "bindings.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace polhode::python {

struct SpinProblem {
  SpinFit fit;
};

struct FoundSpinSolution {
  SpinSolution solution;
};

nb::dict solution_dict(const SpinSolution& found);

}  // namespace polhode::python
