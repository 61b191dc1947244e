// SPDX-License-Identifier: MIT
#include "fit/detail/undetermined_moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fit/detail/snapshot_residuals.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// The sum may fall by so much with unknown moments if only noise makes the body wobble: the wobble
// has a period, which is chosen from many, and two amplitudes.
constexpr double most_of_noise = 25.0;
constexpr int uniform_iterations = 50;

bool has_prior_of_moments(const SpinFit& fit) {
  return std::ranges::any_of(fit.priors, [](const NormalPrior& prior) {
    return std::ranges::any_of(prior.unknowns,
                               [](const std::string& name) { return name.starts_with("I"); });
  });
}

double start_of(const SpinFit& fit, const std::string& name) {
  for (const std::size_t k : detail::parameters_of(fit.unknowns))
    if (name == detail::parameter_name(k)) return detail::parameter_of(fit.start, k);
  return std::numeric_limits<double>::quiet_NaN();
}

// A solution without unknown moments, with all `names` of the fit: the moments have their start and
// an infinite variance.
SpinSolution with_held(const SpinFit& fit, const std::vector<std::string>& names,
                       SpinSolution found) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const UnknownsCovariance known = std::move(found.covariance);
  const std::size_t n = names.size(), m = known.names.size();
  std::vector<std::size_t> place;  // among those that are known, or m
  std::vector<double> x;
  for (const std::string& name : names) {
    place.push_back(
        static_cast<std::size_t>(std::ranges::find(known.names, name) - known.names.begin()));
    x.push_back(place.back() < m ? found.result.x[place.back()] : start_of(fit, name));
    if (place.back() == m) found.held.push_back(name);
  }
  found.result.x = std::move(x);
  found.covariance = {};
  found.covariance.names = names;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      found.covariance.matrix.push_back(place[i] < m && place[j] < m
                                            ? known.matrix[place[i] * m + place[j]]
                                        : i == j ? infinite
                                                 : nan);
  found.covariance.weak = known.weak;
  for (UnknownsCovariance::Combination& one : found.covariance.weak) {
    std::vector<double> direction;
    for (const std::size_t k : place) direction.push_back(k < m ? one.direction[k] : 0.0);
    one.direction = std::move(direction);
  }
  std::string text;
  for (const std::string& name : found.held)
    text += (text.empty() ? "" : name == found.held.back() ? " and " : ", ") + name;
  found.notes.push_back("not determined: " + text +
                        "; one rotation about a fixed axis of the body describes the data as well, "
                        "so that they stay at their start, and other errors are for these moments");
  return found;
}

}  // namespace

SpinSolution detail::with_undetermined_moments(
    const SpinFit& fit, SpinSolution found,
    const std::function<SpinSolution(const SpinFit&)>& fitted) {
  if (!fit.unknowns.attitude || !fit.unknowns.rate || has_prior_of_moments(fit) ||
      !(fit.unknowns.moment_ratios || fit.unknowns.products))
    return found;
  const bool can_be_judged = found.degrees_of_freedom > 0 && fit.seen.numbers() >= 6;
  if (!can_be_judged) return found;
  SpinFit held = fit;
  held.unknowns.moment_ratios = held.unknowns.products = false;
  SpinFit uniform = held;
  uniform.error_factor = found.error_factor;
  uniform.scales_errors = false;
  uniform.most_iterations = std::min(uniform.most_iterations, uniform_iterations);
  uniform.start = found.state;
  const double Izz = fit.start.inertia_F(2, 2);
  uniform.start.inertia_F = {{{Izz, 0.0, 0.0}, {0.0, Izz, 0.0}, {0.0, 0.0, Izz}}};
  const double per_number = std::fmax(1.0, found.result.cost / found.degrees_of_freedom);
  const auto is_as_good = [&](const SpinSolution& other) {
    return other.result.end != LeastSquaresResult::End::no_value &&
           other.result.cost - found.result.cost <= most_of_noise * per_number;
  };
  if (!is_as_good(fitted(uniform))) return found;
  SpinSolution solution = fitted(held);
  return solution.is_found() && is_as_good(solution)
             ? with_held(fit, found.covariance.names, std::move(solution))
             : found;
}

}  // namespace v0
}  // namespace polhode
