// SPDX-License-Identifier: MIT
// A rotor with a deviation from its motion and its growth: lengths, indicators, and the methods
// that step it.
#pragma once

#include <cmath>
#include <memory>

#include "dynamics/augmented.hpp"
#include "dynamics/steppers.hpp"
#include "math/finite.hpp"
#include "polhode/analysis/chaos_indicator.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {
namespace detail {

// Lengths of deviations, and the indicators that follow from their logarithm and its integrals.
inline double length(const Deviation& d) {
  const double size = polhode::detail::larger(std::abs(d.turn.x), std::abs(d.turn.y),
                                              std::abs(d.turn.z), std::abs(d.momentum.x),
                                              std::abs(d.momentum.y), std::abs(d.momentum.z));
  if (!(size > 0.0) || !std::isfinite(size)) return size;
  const Vec3 a = (1.0 / size) * d.turn, b = (1.0 / size) * d.momentum;
  return size * std::sqrt(dot(a, a) + dot(b, b));
}

inline Deviation scaled(const Deviation& d, double factor) {
  return {factor * d.turn, factor * d.momentum};
}

// From one state to a near one, the length of the second quaternion being 1 to rounding.
inline Deviation deviation(const RotorState& from, const RotorState& to, double momentum_scale) {
  const Quaternion d = conj(from.q) * to.q;
  const double two = d.w < 0.0 ? -2.0 : 2.0;  // q and -q are one attitude
  return {{two * d.x, two * d.y, two * d.z}, (1.0 / momentum_scale) * (to.g - from.g)};
}
inline RotorState moved_by(const RotorState& s, const Deviation& d, double momentum_scale) {
  const Vec3 half = 0.5 * d.turn;
  return {normalized(s.q * Quaternion{1.0, half.x, half.y, half.z}),
          s.g + momentum_scale * d.momentum};
}

// A neighbour is brought back where it has come this many times nearer or farther than its
// distance. Not at every step: each time its place is rounded, and of a regular motion, whose
// deviation is a runaway phase after a while, the small rest that drives it drowns in that.
inline constexpr double neighbour_reach = 16.0;

// Y of [Cincotta and Simo 2000] from L and its integral over an elapsed time.
inline double megno(double growth, double integral, double elapsed) {
  return elapsed > 0.0 ? 2.0 * (growth - integral / elapsed) : 0.0;
}

}  // namespace detail

struct GrownDeviation {
  Deviation deviation;  // brought back to its length from time to time
  double growth = 0.0;  // L, of all of it
  double growth_integral = 0.0;
  double megno_integral = 0.0;  // of Y

  constexpr bool operator==(const GrownDeviation&) const = default;
};

template <class Visit>
void each_number(GrownDeviation& d, Visit&& visit) {
  for (Vec3* v : {&d.deviation.turn, &d.deviation.momentum})
    for (double* x : {&v->x, &v->y, &v->z}) visit(*x);
  for (double* x : {&d.growth, &d.growth_integral, &d.megno_integral}) visit(*x);
}

using DeviatedState = Augmented<GrownDeviation>;

namespace detail {

inline ChaosSample sample_of(double t, double elapsed, const GrownDeviation& d) {
  if (!(elapsed > 0.0)) return {t, d.growth, 0.0, 0.0, 0.0};
  return {t, d.growth, d.growth / elapsed, megno(d.growth, d.growth_integral, elapsed),
          d.megno_integral / elapsed};
}

// Why a run with a deviation ends at a jump of a torque that the state decides.
inline constexpr const char* unknown_jump =
    "how a deviation crosses that is not known; take differences of runs";

// For a problem whose method carries derivatives (transition_steppers.hpp). `options` have a scale
// of momentum, and a deviation that is not zero.
std::unique_ptr<polhode::detail::BasicStepper<DeviatedState>> deviation_stepper(
    const Problem& problem, const ChaosOptions& options, DeviationBy by);
std::unique_ptr<polhode::detail::BasicStepper<DeviatedState>> splitting_deviation(
    const Problem& problem, const Splitting& method, const ChaosOptions& options, DeviationBy by);

}  // namespace detail

}  // namespace analysis
}  // namespace v0
}  // namespace polhode
