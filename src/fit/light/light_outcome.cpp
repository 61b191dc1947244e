// SPDX-License-Identifier: MIT
#include "fit/detail/light_outcome.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "fit/free_motion.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

double LightSolution::error_factor() const {
  constexpr double least_freedom = 0.5;
  if (!(degrees_of_freedom >= least_freedom)) return std::numeric_limits<double>::quiet_NaN();
  if (loss.kind == Loss::Kind::squared) return std::sqrt(result.chi_square / degrees_of_freedom);
  return spread() * std::sqrt(static_cast<double>(points) / degrees_of_freedom);
}

bool LightSolution::describes_data() const {
  const double factor = error_factor();
  return !(factor * factor > most_chi_square);
}

double LightSolution::spread() const {
  constexpr double of_normal = 1.482602218505602;  // 1 / Phi^-1(3/4)
  const std::size_t n = std::min(points, result.numbers.size());
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sizes(n);
  for (std::size_t i = 0; i < n; ++i) sizes[i] = std::fabs(result.numbers[i]);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::ranges::nth_element(sizes, middle);
  return of_normal * *middle;
}

namespace detail {
namespace {

// Beyond this the vector of a turn is taken about the attitude that was found, and the fit goes on.
constexpr double far_turn = 1.0;

}  // namespace

void require_spin(const std::string& who, const SpinState& s, int most_iterations) {
  if (most_iterations < 1)
    throw DomainError(who + "most_iterations = " + std::to_string(most_iterations) +
                      " must be 1 or more");
  const double size = s.q.w * s.q.w + s.q.x * s.q.x + s.q.y * s.q.y + s.q.z * s.q.z;
  if (!std::isfinite(s.t0) || !std::isfinite(size) || !(size > 0.0))
    throw DomainError(who + "the start, t0 = " + polhode::detail::number_text(s.t0) +
                      " and its quaternion, must be finite, the quaternion not 0");
  const double rate = norm(s.w_F);
  if (!std::isfinite(rate) || !(rate > 0.0))
    throw DomainError(who + "the rate at the start, " +
                      polhode::detail::tuple_text({s.w_F.x, s.w_F.y, s.w_F.z}) +
                      ", must be finite and not 0");
}

void require_law(const std::string& who, const light::Scattering& law, bool is_unknown) {
  if (!(law.single >= 0.0) || !(law.multiple >= 0.0) || !(law.single + law.multiple > 0.0))
    throw DomainError(who + "weights of scattering " +
                      polhode::detail::tuple_text({law.single, law.multiple}) +
                      " must not be below 0, and one above");
  if (is_unknown && !(law.single > 0.0))
    throw DomainError(who +
                      "an unknown weight of Lambert's law needs that of Lommel and Seeliger to be "
                      "above 0");
}

void require_diagonal(const std::string& who, const SpinState& s, const std::string& why) {
  const Mat3& T = s.inertia_F;
  if (T(0, 1) != 0.0 || T(1, 2) != 0.0 || T(0, 2) != 0.0)
    throw DomainError(who + why + " must be principal: products of inertia are " +
                      polhode::detail::tuple_text({T(0, 1), T(1, 2), T(0, 2)}));
  static_cast<void>(Body(T(0, 0), T(1, 1), T(2, 2)));  // says what is wrong with them
}

void require_points(const std::string& who, std::size_t points, std::size_t unknowns,
                    std::size_t groups) {
  if (points >= unknowns + groups) return;
  throw DomainError(who + std::to_string(points) + " points for " + std::to_string(unknowns) +
                    " unknowns and " + std::to_string(groups) +
                    (groups == 1 ? " factor" : " factors") + "; expected as many at least");
}

void describe_motion(const SpinState& spin, LightSolution& found) {
  const FreeRotation motion = free_rotation_of(spin);
  const Vec3 L = inertial_momentum(motion.initial_state());
  found.pole = (1.0 / norm(L)) * L;
  found.periods.mode = motion.regime();
  if (motion.regime() != Regime::short_axis && motion.regime() != Regime::long_axis) return;
  found.periods.precession_period = 2.0 * pi<double>() / motion.precession_rate_long();
  found.periods.rotation_period = motion.polhode_period();
}

void settle(const TurningFit& fit, int most_iterations, std::size_t groups, LightSolution& found) {
  int iterations = 0, evaluations = 0;
  // each round has one iteration at least
  while (iterations < most_iterations) {
    found.result = solve(fit.problem(most_iterations - iterations));
    iterations += found.result.iterations;
    evaluations += found.result.evaluations;
    const std::vector<double>& x = found.result.x;
    fit.move(x);
    if (norm(Vec3{x[0], x[1], x[2]}) <= far_turn || found.result.iterations == 0 ||
        found.result.end == LeastSquaresResult::End::no_value)
      break;
  }
  found.result.iterations = iterations;
  found.result.evaluations = evaluations;
  // The same numbers with turns about what was found.
  std::fill_n(found.result.x.begin(), 3, 0.0);
  const LeastSquares problem = fit.problem(most_iterations);
  found.loss = problem.loss;
  found.points = problem.residuals.data;
  found.terms = {{"data", found.result.cost}};
  found.covariance = covariance(problem, found.result);
  found.degrees_of_freedom =
      degrees_of_freedom(problem, found.result) - static_cast<double>(groups);
  std::ranges::move(notes_on_errors(problem, found.result, found.covariance),
                    std::back_inserter(found.notes));
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
