// SPDX-License-Identifier: MIT
// integrate_many: the runs of many bodies, one after the other.
//
// Equations   those of integrate.
// Units       those of each system.
// Domain      any problems of a rotor. integrate_body may be called from several threads, for
//             example by ordered_parallel_for (polhode/ensemble/ordered_parallel_for.hpp).
// Accuracy    the bits of integrate for each.
// Errors      a body that fails leaves the others as they are. A run that cannot go on has a
//             trajectory whose outcome says so, as from integrate. An invalid problem, or one whose
//             term throws, has none, and `error` names the body, the time and the cause. What
//             `problem`, `done` and `progress` throw passes through.
// Cost        that of integrate for each.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/dynamics/problem.hpp"
#include "polhode/trajectory/progress.hpp"

namespace polhode {
inline namespace v0 {

struct BodyRun {
  std::optional<Trajectory> trajectory;
  std::string error;          // why there is none
  std::exception_ptr thrown;  // and what was thrown
};

// One of them. `error` calls it by its index. `progress` is called after every step.
BodyRun integrate_body(std::size_t index, const Problem& problem, const Keep& keep,
                       const Progress& progress = {});

// Integrates the problems with indices below `count`, in order. `problem` is called for each before
// its run, and `done` gets the run when it has ended.
void integrate_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, BodyRun)>& done,
                    const Progress& progress = {});

// All of them, in the order of the problems.
std::vector<BodyRun> integrate_many(std::span<const Problem> problems, const Keep& keep = {});

}  // namespace v0
}  // namespace polhode
