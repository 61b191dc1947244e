// SPDX-License-Identifier: MIT
// integrate: one function for every method.
//
// Equations   those of System; of the method.
// Units       those of the system.
// Domain      any state with a non-zero quaternion, from `start` to `stop` in either direction.
//             Samples outside the span are left out, but for a last one that rounding alone puts
//             beyond `stop`. A sample at `stop` is the end of the last step; others come from the
//             dense output.
// Accuracy    docs/guide/which-propagator.md.
// Errors      DomainError for a problem that is none (NaN, a method out of range, a splitting of a
//             term without a flow, a damper with another method than Adaptive). A run that cannot
//             go on (NaN, a step too small) ends with Outcome::failed and a sentence; samples so
//             far are kept. What a user's callable or `progress` throws passes through after the
//             samples so far have been pushed.
// Cost        docs/guide/which-propagator.md.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "polhode/dynamics/event.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/math/matrix6.hpp"
#include "polhode/system/system.hpp"
#include "polhode/trajectory/progress.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {

struct Problem {
  System system;
  RotorState initial;  // q_SB, g_B at `start`
  double start;
  double stop;
  Method method = Adaptive{};
  std::vector<Event> events = {};
  Vec3 damper_rate = {};  // of the system's damper relative to the body, at `start`
  // This run continues one that ended at `start`, which has already reported any event there.
  bool continues = false;
};

// What to keep in memory.
struct Keep {
  std::optional<SaveAt> samples = std::nullopt;  // none: the end of every step
  bool dense = true;
};

Trajectory integrate(const Problem& problem, const Keep& keep = {}, const Progress& progress = {});

// The same with samples pushed block by block into a sink: constant memory. The trajectory returned
// has no samples and no dense output.
Trajectory integrate(const Problem& problem, const SaveAt& samples, const SampleSink& sink,
                     const Progress& progress = {});

// A state with the derivative of its hub tangent (dtheta_B, dg_B) by that of the initial state.
struct TransitionSample {
  double t;
  RotorState s;
  Matrix6 transition;
};

// The state transition matrix along a run. Adaptive: by the variational equations (dual numbers);
// VariationOfConstants: by those of Adaptive at its tolerance; Splitting: the derivative of the
// splitting's own steps, symplectic as they are (terms that are kicks). Every term must be a
// template on the number type, and there is no damper. A run that cannot go on is a DomainError
// here.
std::vector<TransitionSample> state_transitions(const Problem& problem, const SaveAt& samples,
                                                const Progress& progress = {});

}  // namespace v0
}  // namespace polhode
