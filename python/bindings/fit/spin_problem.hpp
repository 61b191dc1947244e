// SPDX-License-Identifier: MIT
// A fit of snapshots and what it found, as objects that Python holds.
#pragma once

#include <optional>

#include "bindings.hpp"
#include "polhode/fit/driven_spin_fit.hpp"

namespace polhode::python {

struct SpinProblem {
  fit::SpinFit fit;
  std::optional<fit::SpinDrive> drive = std::nullopt;  // torques and jumps
};

struct FoundSpinSolution {
  fit::SpinSolution solution;
};

nb::dict solution_dict(const fit::SpinSolution& found);

}  // namespace polhode::python
