// SPDX-License-Identifier: MIT
// A rotor with a deviation from its motion and what has grown, and the methods that step it.
#pragma once

#include <memory>

#include "analysis/detail/growth.hpp"
#include "dynamics/steppers.hpp"

namespace polhode {
inline namespace v0 {

struct DeviatedState {
  RotorState rotor;
  Deviation deviation;  // brought back to its length from time to time
  double growth = 0.0;  // L, of all of it
  double growth_integral = 0.0;
  double megno_integral = 0.0;  // of Y

  constexpr bool operator==(const DeviatedState&) const = default;
};

template <class Visit>
void each_number(DeviatedState& s, Visit&& visit) {
  each_number(s.rotor, visit);
  for (Vec3* v : {&s.deviation.turn, &s.deviation.momentum})
    for (double* x : {&v->x, &v->y, &v->z}) visit(*x);
  for (double* x : {&s.growth, &s.growth_integral, &s.megno_integral}) visit(*x);
}

namespace detail {

// Why a run with a deviation ends at a jump of a torque that the state decides.
inline constexpr const char* unknown_jump =
    "how a deviation crosses that is not known; take differences of runs";

// `options` have a scale of momentum, and a deviation that is not zero.
std::unique_ptr<BasicStepper<DeviatedState>> deviation_stepper(const Problem& problem,
                                                               const Adaptive& method,
                                                               const ChaosOptions& options,
                                                               DeviationBy by);
std::unique_ptr<BasicStepper<DeviatedState>> deviation_stepper(const Problem& problem,
                                                               const Splitting& method,
                                                               const ChaosOptions& options,
                                                               DeviationBy by);
std::unique_ptr<BasicStepper<DeviatedState>> deviation_stepper(const Problem& problem,
                                                               const Collocation& method,
                                                               const ChaosOptions& options,
                                                               DeviationBy by);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
