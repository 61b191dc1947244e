// SPDX-License-Identifier: MIT
#include "polhode/analysis/chaos_indicator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/detail/deviated_state.hpp"
#include "dynamics/checked_problem.hpp"
#include "dynamics/sampled_run.hpp"
#include "dynamics/transition/transition_steppers.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {
namespace {

using polhode::detail::number_text;

const char* const function_name = "chaos_indicator";

DeviationBy kind_of(const Problem& problem, bool neighbour) {
  const std::vector<AnyPerturbation>& terms = problem.system.terms();
  const bool flows = method_traits(problem.method).needs_flows;
  const bool derivable = std::all_of(terms.begin(), terms.end(), [&](const AnyPerturbation& term) {
    return term.supports_any_real() && (!flows || term.is_kick());
  });
  return derivable && !neighbour ? DeviationBy::variational : DeviationBy::neighbour;
}

// |g|; at rest what a quarter of a swing under the torque makes of it.
double natural_scale(const Problem& problem) {
  const double g = norm(problem.initial.g);
  if (g > 0.0) return g;
  const double u = norm(effect(problem.system, problem.start, problem.initial).u);
  return std::sqrt(u * problem.system.body().moments().z);
}

ChaosOptions checked(const Problem& problem, ChaosOptions options) {
  const double size = detail::length(options.deviation);
  if (!(size > 0.0) || !std::isfinite(size) ||
      !polhode::detail::is_finite(options.deviation.turn) ||
      !polhode::detail::is_finite(options.deviation.momentum))
    throw DomainError("chaos_indicator: deviation must be finite and not zero");
  if (options.momentum_scale == 0.0) options.momentum_scale = natural_scale(problem);
  if (!(options.momentum_scale > 0.0) || !std::isfinite(options.momentum_scale))
    throw DomainError("chaos_indicator: momentum_scale " + number_text(options.momentum_scale) +
                      " must be positive: a body at rest without a torque has none of its own");
  if (!(options.distance > 0.0 && options.distance <= 1e-2))
    throw DomainError("chaos_indicator: distance " + number_text(options.distance) +
                      " must be positive and at most 0.01");
  return options;
}

double last_of(const ChaosIndicator& indicator, double ChaosSample::*field) {
  return indicator.samples.empty() ? std::numeric_limits<double>::quiet_NaN()
                                   : indicator.samples.back().*field;
}

}  // namespace

double ChaosIndicator::lyapunov() const { return last_of(*this, &ChaosSample::lyapunov); }
double ChaosIndicator::mean_megno() const { return last_of(*this, &ChaosSample::mean_megno); }
double ChaosIndicator::lyapunov_time() const { return 1.0 / lyapunov(); }

ChaosIndicator chaos_indicator(const Problem& given, const SaveAt& samples,
                               const ChaosOptions& given_options, const Progress& progress) {
  Problem problem =
      polhode::detail::checked_problem(function_name, given, polhode::detail::DamperState::refused);
  problem.method = polhode::detail::derivative_method(function_name, "deviations", problem.method);
  const ChaosOptions options = checked(problem, given_options);
  ChaosIndicator result;
  result.by = kind_of(problem, options.neighbour);
  result.momentum_scale = options.momentum_scale;
  result.method =
      method_text(problem.method) + (result.by == DeviationBy::variational
                                         ? ", variational equations"
                                         : ", a second motion at " + number_text(options.distance));
  const std::vector<double> times = polhode::detail::sample_times(function_name, problem, samples);
  const BasicTrajectory<DeviatedState> run = polhode::detail::sampled_run(
      detail::deviation_stepper(problem, options, result.by), result.method, times, progress,
      polhode::detail::steps_to_samples(problem.method));
  for (const BasicSample<DeviatedState>& at : run.samples())
    result.samples.push_back(detail::sample_of(at.t, std::abs(at.t - problem.start), at.s.extra));
  result.outcome = run.outcome();
  result.statistics = run.statistics();
  return result;
}

}  // namespace analysis
}  // namespace v0
}  // namespace polhode
