// SPDX-License-Identifier: MIT
// A fit of snapshots and what it found, as objects that Python holds.
#pragma once

#include <optional>

#include "bindings.hpp"
#include "polhode/fit/driven_spin_fit.hpp"

namespace polhode::python {

struct SpinProblem {
  SpinFit fit;
  std::optional<SpinDrive> drive = std::nullopt;  // torques and jumps
};

struct FoundSpinSolution {
  SpinSolution solution;
};

nb::dict solution_dict(const SpinSolution& found);

}  // namespace polhode::python
