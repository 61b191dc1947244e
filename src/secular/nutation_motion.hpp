// SPDX-License-Identifier: MIT
// How the axes answer the torque: the momentum by a Lie transform, the body about it by Euler's
// equations.
#pragma once

#include <map>
#include <vector>

#include "polhode/secular/nutation.hpp"
#include "secular/nutation_torque.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// By multipliers, of which the first that is not zero is positive.
using Waves = std::map<std::vector<int>, NutationWave>;

Waves sum(const Waves& a, const Waves& b);

struct MomentumMotion {
  NutationOffset precession;
  double phi_rate;  // of Phi, where it is there
  Waves nutation;
};
// Poisson terms.
MomentumMotion momentum_motion(const NutationProblem& problem, const NutationSymbols& names,
                               const NutationTorque& torque, const std::vector<double>& rates);

struct WobbleMotion {
  Waves figure, rotation;  // less the momentum
};
// Oppolzer terms.
WobbleMotion wobble_motion(const NutationProblem& problem, const NutationSymbols& names,
                           const NutationTorque& torque, const std::vector<double>& rates);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
