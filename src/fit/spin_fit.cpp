// SPDX-License-Identifier: MIT
// Fits of a spin state in free rotation to snapshots.
#include "polhode/fit/spin_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/snapshot_residuals.hpp"
#include "fit/detail/spin_uncertainty.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

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

namespace {

// Beyond this the vector of a turn is taken about the attitude that was found, and the fit goes on.
constexpr double far_turn = 1.0;
constexpr int most_recentrings = 20;
// Moments nearer than this have no axes of their own.
constexpr double equal_moments = 1e-12;

// Principal axes that turn with the tensor have derivatives where no moments are equal.
void require_axes(const SpinFit& fit, const Vec3& moments) {
  const Mat3& T = fit.start.inertia_F;
  const bool is_turned = T(0, 1) != 0.0 || T(1, 2) != 0.0 || T(0, 2) != 0.0;
  if (!fit.unknowns.products && !(fit.unknowns.moment_ratios && is_turned)) return;
  for (int i = 0; i < 3; ++i) {
    const double a = moments[i], b = moments[(i + 1) % 3];
    if (std::abs(a - b) > equal_moments * std::max(a, b)) continue;
    throw DomainError(
        "fit_spin: the start has the principal moments " + polhode::detail::number_text(a) +
        " and " + polhode::detail::number_text(b) +
        ", too near to each other for unknown products of inertia: their axes have no "
        "derivative; start from different moments, or fix the products at 0");
  }
}

void require_start(const SpinFit& fit) {
  const SpinState& s = fit.start;
  const double size = std::hypot(std::hypot(s.q.w, s.q.x), std::hypot(s.q.y, s.q.z));
  if (!std::isfinite(s.t0) || !std::isfinite(size) || !(size > 0.0)) {
    throw DomainError("fit_spin: the start, t0 = " + polhode::detail::number_text(s.t0) +
                      " and quaternion " +
                      polhode::detail::tuple_text({s.q.w, s.q.x, s.q.y, s.q.z}) +
                      ", must be finite, the quaternion not 0");
  }
  const double rate = norm(s.w_F);
  if (!std::isfinite(rate) || !(rate > 0.0)) {
    throw DomainError("fit_spin: the rate at the start, " +
                      polhode::detail::tuple_text({s.w_F.x, s.w_F.y, s.w_F.z}) +
                      ", must be finite and not 0");
  }
  require_axes(fit, Body::from_tensor(s.inertia_F).moments());  // says what is wrong with it
  for (const NormalPrior& prior : fit.priors) {
    for (const std::string& name : prior.unknowns) {
      if (name.starts_with("turn_")) {
        throw DomainError("fit_spin: a prior of " + name +
                          "; that of the attitude is given as attitude_prior");
      }
    }
  }
  if (!fit.attitude_prior) return;
  if (!fit.unknowns.attitude) {
    throw DomainError("fit_spin: a prior of the attitude, which is not an unknown of this fit");
  }
  ObservedAttitude prior = *fit.attitude_prior;
  prior.t = s.t0;
  check(Snapshots{{prior}, {}, {}, {}});
}

LeastSquares problem_of(const SpinFit& fit) {
  const std::vector<std::size_t> parameters = detail::parameters_of(fit.unknowns);
  if (parameters.empty()) {
    throw DomainError("fit_spin: nothing is unknown; expected attitude, rate or moments");
  }
  LeastSquares p;
  for (const std::size_t k : parameters) {
    Unknown u;
    u.name = detail::parameter_name(k);
    u.start = detail::parameter_of(fit.start, k);
    if (k == detail::first_ratio) p.triangle = {p.unknowns.size(), p.unknowns.size() + 1};
    p.unknowns.push_back(u);
  }
  const detail::SnapshotResiduals residuals(fit);
  p.residuals.data = fit.seen.numbers();
  p.residuals.prior = fit.attitude_prior ? 3 : 0;
  p.residuals.blocks = residuals.blocks();
  p.residuals.at = [residuals](std::span<const double> x, std::span<double> numbers,
                               std::span<double> jacobian) {
    return residuals.at(x, numbers, jacobian);
  };
  p.priors = fit.priors;
  p.loss = fit.loss;
  p.error_factor = fit.error_factor;
  p.most_iterations = fit.most_iterations;
  return p;
}

double size_of_turn(const SpinFit& fit, const std::vector<double>& x) {
  return fit.unknowns.attitude ? norm(Vec3{x[0], x[1], x[2]}) : 0.0;
}

SpinSolution fitted(const SpinFit& fit) {
  SpinFit about = fit;
  const std::vector<std::size_t> parameters = detail::parameters_of(fit.unknowns);
  SpinSolution found;
  int iterations = 0, evaluations = 0;
  LeastSquares problem;
  for (int round = 0; round < most_recentrings; ++round) {
    problem = problem_of(about);
    found.result = fit.scales_errors ? solve_scaled(problem) : solve(problem);
    iterations += found.result.iterations;
    evaluations += found.result.evaluations;
    about.start = detail::state_at(about.start, parameters, found.result.x);
    about.error_factor = problem.error_factor;
    const bool is_far = size_of_turn(fit, found.result.x) > far_turn;
    if (!is_far || found.result.end == LeastSquaresResult::End::no_value) break;
  }
  found.result.iterations = iterations;
  found.result.evaluations = evaluations;
  found.state = about.start;
  found.error_factor = problem.error_factor;
  // The same numbers with turns about what was found.
  const detail::SnapshotResiduals residuals(about);
  problem.residuals.at = [residuals](std::span<const double> x, std::span<double> numbers,
                                     std::span<double> jacobian) {
    return residuals.at(x, numbers, jacobian);
  };
  if (fit.unknowns.attitude) std::fill_n(found.result.x.begin(), 3, 0.0);
  found.covariance = covariance(problem, found.result);
  found.degrees_of_freedom = degrees_of_freedom(problem, found.result);
  found.attitude_rms = residuals.attitude_rms(found.state);
  found.notes = repeated(fit.seen);
  std::ranges::move(notes_on_errors(problem, found.result, found.covariance),
                    std::back_inserter(found.notes));
  return found;
}

}  // namespace

SpinSolution fit_spin(const SpinFit& fit) {
  check(fit.seen);
  require_start(fit);
  SpinSolution found = fitted(fit);
  return detail::with_undetermined_moments(fit, std::move(found), fitted);
}

LeastSquares least_squares_of(const SpinFit& fit) {
  check(fit.seen);
  require_start(fit);
  return problem_of(fit);
}

SpinState state_at(const SpinFit& fit, std::span<const double> x) {
  const std::vector<std::size_t> parameters = detail::parameters_of(fit.unknowns);
  if (x.size() != parameters.size())
    throw DomainError("state_at: got " + std::to_string(x.size()) + " unknowns; expected " +
                      std::to_string(parameters.size()));
  return detail::state_at(fit.start, parameters, x);
}

std::vector<double> unknowns_at(const SpinFit& fit, const SpinState& about,
                                const SpinState& state) {
  const Vec3 turn = attitude_residual(about.q, state.q);
  std::vector<double> x;
  for (const std::size_t p : detail::parameters_of(fit.unknowns)) {
    x.push_back(p < detail::first_rate ? turn[static_cast<int>(p)]
                                       : detail::parameter_of(state, p));
  }
  return x;
}

std::vector<PredictedAttitude> predicted(const SpinFit& fit, const SpinSolution& solution,
                                         std::span<const double> times) {
  const std::vector<std::size_t> parameters = detail::parameters_of(fit.unknowns);
  std::vector<detail::MotionPoint> points;
  const std::vector<double> at(times.begin(), times.end());
  if (!detail::free_motion(solution.state, at, {true, fit.unknowns.products}, points)) {
    throw DomainError(
        "predicted: the state of the solution is none that a body may have, or its "
        "motion has no derivatives");
  }
  const UnknownsCovariance known = solution.covariance.without(solution.held);
  std::vector<PredictedAttitude> found;
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::vector<Vec3> turn;
    for (const std::size_t p : parameters)
      if (std::ranges::count(solution.held, detail::parameter_name(p)) == 0)
        turn.push_back(points[i].turn[p]);
    found.push_back({at[i], points[i].q, points[i].w_F, detail::turn_covariance(turn, known)});
  }
  return found;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
