// SPDX-License-Identifier: MIT
// Trajectory, as Python holds it.
#pragma once

#include <memory>
#include <vector>

#include "bindings.hpp"
#include "polhode/dynamics/problem.hpp"

namespace polhode::python {

// The samples are next to the rest, and not in it: arrays keep what they look at, and the garbage
// collector does not see into arrays. One that kept the terms would keep, through a term in Python,
// the globals of a script, hence itself.
struct PythonTrajectory {
  explicit PythonTrajectory(DampedTrajectory trajectory, nb::object of = {})
      : run(std::move(trajectory)),
        rows(std::make_shared<const std::vector<DampedSample>>(std::move(run).samples())),
        system(std::move(of)) {}

  DampedTrajectory run;  // all but the samples
  std::shared_ptr<const std::vector<DampedSample>> rows;
  // The Python object whose terms dense output asks: a term in Python lives as long as its object.
  // Null where there is none.
  nb::object system;
};

}  // namespace polhode::python
