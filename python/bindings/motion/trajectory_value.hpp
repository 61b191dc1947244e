// SPDX-License-Identifier: MIT
// Trajectory, as Python holds it.
#pragma once

#include "interface/records.hpp"
#include "polhode/dynamics/problem.hpp"

namespace polhode::python {

// The samples are next to the rest, and not in it: arrays keep what they look at, and the garbage
// collector does not see into arrays. One that kept the terms would keep, through a term in Python,
// the globals of a script, hence itself.
struct PythonTrajectory : Records<Sample> {
  explicit PythonTrajectory(Trajectory trajectory, nb::object of = {})
      : Records(std::move(trajectory).samples()),
        run(std::move(trajectory)),
        system(std::move(of)) {}

  Trajectory run;  // all but the samples
  // The Python object whose terms dense output asks: a term in Python lives as long as its object.
  // Null where there is none.
  nb::object system;
};

}  // namespace polhode::python
