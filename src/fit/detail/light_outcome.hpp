// SPDX-License-Identifier: MIT
// Parts of fits of light curves: checks of a start, rounds about an attitude that is taken anew,
// what is said of the motion that was found, and the short fits of searches.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/detail/light_starts.hpp"
#include "polhode/fit/light_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// DomainErrors that begin with `who`, "fit_light: ".
void require_spin(const std::string& who, const SpinState& spin, int most_iterations);
void require_law(const std::string& who, const light::Scattering& law, bool is_unknown);
void require_diagonal(const std::string& who, const SpinState& spin, const std::string& why);
void require_points(const std::string& who, std::size_t points, std::size_t unknowns,
                    std::size_t groups);

void describe_motion(const SpinState& spin, LightSolution& found);

// A fit whose first three unknowns are a turn about the attitude of a body that it keeps.
struct TurningFit {
  std::function<LeastSquares(int most_iterations)> problem;  // about the present body
  std::function<void(const std::vector<double>& x)> move;    // to the body at x
};

// Rounds until no turn is far; then covariance and degrees of freedom about the body found, less
// the factors of `groups`.
void settle(const TurningFit& fit, int most_iterations, std::size_t groups, LightSolution& found);

// The unknowns of a fit at its start, with their bounds.
std::vector<Unknown> light_unknowns(const LightFit& fit);

// A few iterations about the start, without checks, covariance and factors. None without a value.
std::optional<LightTrial> fit_shortly(const LightFit& fit);

// Tries `tries` rotations q of the whole motion of the start, whose attitude at t0 is 1. Returns
// the one whose light is nearest to the curves, with the sum that a fit would minimise, which is
// infinite if none has light. Returns nullopt if the start has no motion.
std::optional<std::pair<Quaternion, double>> best_attitude(const LightFit& fit, std::size_t tries,
                                                           const std::function<Quaternion()>& next);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
