// SPDX-License-Identifier: MIT
// What fits of light curves have in common: checks of a start, rounds about an attitude that is
// taken anew, and what is said of the motion that was found.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "polhode/fit/light_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// DomainErrors that begin with `who`, "fit_light: ".
void require_spin(const std::string& who, const SpinState& spin, int most_iterations);
void require_law(const std::string& who, const Scattering& law, bool is_unknown);
void require_diagonal(const std::string& who, const SpinState& spin, const std::string& why);
void require_points(const std::string& who, std::size_t points, std::size_t unknowns,
                    std::size_t groups);

void describe_motion(const SpinState& spin, LightOutcome& found);

// A fit whose first three unknowns are a turn about the attitude of a body that it keeps.
struct TurningFit {
  std::function<LeastSquares(int most_iterations)> problem;  // about the present body
  std::function<void(const std::vector<double>& x)> move;    // to the body at x
};

// Rounds until no turn is far; then covariance and degrees of freedom about the body found, less
// the factors of `groups`.
void settle(const TurningFit& fit, int most_iterations, std::size_t groups, LightOutcome& found);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
