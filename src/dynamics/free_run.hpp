// SPDX-License-Identifier: MIT
// The exact free rotation in the loop of all runs: its steps are as long as the run, or as the
// stretches in which events are searched.
#pragma once

#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct FreeMotion {
  using State = SystemState;
  // Its states are known without steps between them.
  static constexpr bool allows_any_order = true;

  FreeRotation motion;  // in inertial axes
  Frame frame;          // of the samples
};

// The problem that begins with the state of the motion at `start`.
BasicProblem<FreeMotion> free_problem(const FreeRotation& motion, const Frame& frame, double start,
                                      double stop, std::vector<Event> events);

Trajectory integrate(const BasicProblem<FreeMotion>& problem, const Keep& keep,
                     const Progress& progress);
Trajectory integrate(const BasicProblem<FreeMotion>& problem, const SaveAt& samples,
                     const Streams& streams, const Progress& progress);
Trajectory resume(const BasicProblem<FreeMotion>& problem, const SaveAt& samples,
                  const Checkpoint& from, const Streams& streams, const Progress& progress);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
