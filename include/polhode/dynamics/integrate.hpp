// SPDX-License-Identifier: MIT
// integrate: one function for every method and every state.
//
// Equations   those of System; of the method.
// Units       those of the system.
// Domain      any state with a non-zero quaternion, from `start` to `stop` in either direction.
//             Samples outside the span are left out, but for a last one that rounding alone puts
//             beyond `stop`. A sample at `stop` is the end of the last step; others come from the
//             dense output. A damper moves from the rate in the initial state. For models of your
//             own: polhode/dynamics/integrate_model.hpp.
// Accuracy    docs/guide/which-propagator.md.
// Errors      DomainError for an invalid problem (NaN, a method out of range, a splitting of a
//             term without a flow, a damper with a method that does not move its state). A run
//             that cannot go on (NaN, a step too small) ends with Outcome::failed and a sentence;
//             samples so far are kept. What a user's callable or `progress` throws passes through
//             after the samples so far have been pushed.
// Cost        docs/guide/which-propagator.md.
#pragma once

#include <concepts>
#include <type_traits>
#include <vector>

#include "polhode/dynamics/model.hpp"
#include "polhode/dynamics/problem.hpp"
#include "polhode/math/matrix6.hpp"
#include "polhode/trajectory/progress.hpp"

namespace polhode {
inline namespace v0 {

Trajectory integrate(const Problem& problem, const Keep& keep = {}, const Progress& progress = {});

// The same with samples pushed block by block into a sink: constant memory. The trajectory returned
// has no samples and no dense output.
Trajectory integrate(const Problem& problem, const SaveAt& samples, const SampleSink& sink,
                     const Progress& progress = {});

// The same of a model of your own.
template <class M>
concept Integrable = Model<M> || FrozenModel<M>;

template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const Keep& keep = {},
                                             const Progress& progress = {});
template <Integrable M>
BasicTrajectory<typename M::State> integrate(const BasicProblem<M>& problem, const SaveAt& samples,
                                             const BasicSampleSink<typename M::State>& sink,
                                             const Progress& progress = {});

// A state with the derivative of its hub tangent (dtheta_B, dg_B) by that of the initial state.
struct TransitionSample {
  double t;
  RotorState s;
  Matrix6 transition;
};

// The state transition matrix along a run. Adaptive: by the variational equations (dual numbers);
// VariationOfConstants: by those of Adaptive at its tolerance; Collocation and Splitting (terms
// that are kicks): the derivative of the method's own steps; those of a splitting are symplectic.
// Every term must be a template on the number type, and there is no damper. A run that cannot go on
// is a DomainError here.
std::vector<TransitionSample> state_transitions(const Problem& problem, const SaveAt& samples,
                                                const Progress& progress = {});

}  // namespace v0
}  // namespace polhode
