// SPDX-License-Identifier: MIT
// integrate_many: the runs of many bodies, several at a time.
//
// Equations   those of integrate. By Collocation eight bodies go in lockstep, a lane of a register
//             for each, with steps of their own; a body that ends makes room for the next.
// Units       those of each system.
// Domain      any problems of a rotor. Bodies may differ in state, moments, orbit, times, events.
//             They go in lockstep as long as they have as many terms, a frame that moves or none,
//             and as many stages; the first that differs waits until those before it have ended. A
//             term is asked for all of them at a time where it is one of the library's, with the
//             same numbers in each (gm, a damping matrix, facets) and no switching function; else
//             body by body. By another method, and with a damper, bodies go one after the other.
// Accuracy    the bits of integrate for each, whichever bodies are beside it and however many.
// Errors      a body that fails leaves the others as they are. A run that cannot go on has a
//             trajectory whose outcome says so, as from integrate; for a problem that is invalid,
//             and for what a term throws, there is none, and `error` says the body, the time, and
//             what it was. What `problem` and `done` throw passes through.
// Cost        docs/guide/which-propagator.md.
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

template <MotionState S>
struct BasicBodyRun {
  std::optional<BasicTrajectory<S>> trajectory;
  std::string error;          // why there is none
  std::exception_ptr thrown;  // and what was thrown
};
using BodyRun = BasicBodyRun<RotorState>;
using DampedBodyRun = BasicBodyRun<DampedRotorState>;

// Of the problem of each index below `count`, each asked for when its turn comes. `done` gets every
// run once, as they end. `progress` is called after every step with the time of one of the bodies;
// what it throws ends the runs.
void integrate_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, BodyRun)>& done,
                    const Progress& progress = {});
void integrate_many(std::size_t count, const std::function<DampedProblem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, DampedBodyRun)>& done,
                    const Progress& progress = {});

// All of them, in the order of the problems.
std::vector<BodyRun> integrate_many(std::span<const Problem> problems, const Keep& keep = {});
std::vector<DampedBodyRun> integrate_many(std::span<const DampedProblem> problems,
                                          const Keep& keep = {});

}  // namespace v0
}  // namespace polhode
