// SPDX-License-Identifier: MIT
// What the tables [[free.parameter]] and [[free.jump]] of a scenario of kind "fit" say: numbers of
// its torques that are unknown, and jumps of the spin.
//
// Equations   those of fit_driven_spin (polhode/fit/driven_spin_fit.hpp).
// Units       parameters, their bounds and priors in the unit that their key has in the file; jumps
//             in core units (polhode/text/units.hpp).
// Domain      numbers of [[perturbation]] and [[surface]], each once; of a key that holds nothing
//             negative the lower bound is 0.
// Errors      spin_drive: ScenarioError at the place of what has no neighbours.
// Cost        plain values; a drive makes its torques again for every set of numbers.
#pragma once

#include <string>
#include <vector>

#include "polhode/fit/driven_spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
struct Scenario;

struct FreeParameter {
  fit::TorqueParameter number;  // by its key: "perturbation[0].torque[2]"
  std::string unit;             // as outputs name it
};

struct FitDrive {
  std::vector<FreeParameter> parameters;
  std::vector<fit::SpinJump> jumps;
  double tolerance = 1e-12;  // of the motion and its derivatives, in a step
};

// The torques of a scenario of kind "fit" with what of them is unknown, and its jumps.
fit::SpinDrive spin_drive(const Scenario& scenario);

}  // namespace io
}  // namespace v0
}  // namespace polhode
