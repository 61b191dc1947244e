// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/detail/stacked_numbers.hpp"
#include "math/number_text.hpp"
#include "polhode/fit/covariance.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Rises of the sum that are near enough to 1, and the part of the greatest component from which
// on one is named.
constexpr double least = 0.5, greatest = 2.0, named_part = 0.5;
// Fits that may stop further from the least, in errors: their rises are other ones for that alone.
constexpr double near_enough = 0.1;
constexpr double no_correlation = 1e-10;  // of correlations: their rounding
constexpr double far = 100.0;             // beyond it the number says no more

bool is_inside(const LeastSquares& problem, const std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Unknown& u = problem.unknowns[i];
    if (x[i] < u.low || x[i] > u.high) return false;
  }
  return true;
}

std::string names_along(const std::vector<std::string>& names, const Eigen::VectorXd& direction) {
  const double greatest_part = direction.cwiseAbs().maxCoeff();
  std::vector<std::string> parts;
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (std::abs(direction[i]) >= named_part * greatest_part)
      parts.push_back(names[static_cast<std::size_t>(i)]);
  }
  std::string text = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i)
    text += (i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

// Of the sums one error away, both ways along each principal direction of the unknowns over their
// errors, the one that differs most from a rise of 1. Points beyond bounds or without a value are
// skipped.
std::string bend_within_errors(const LeastSquares& problem, const LeastSquaresResult& result,
                               const UnknownsCovariance& covariance) {
  const auto n = std::ssize(covariance.names);
  if (n == 0 || problem.nearness > near_enough || problem.loss.kind != Loss::Kind::squared ||
      !result.is_converged() || !result.bound.empty())
    return {};
  Eigen::VectorXd errors(n);
  Eigen::MatrixXd R(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    errors[i] = covariance.error(static_cast<std::size_t>(i));
    for (Eigen::Index j = 0; j < n; ++j)
      R(i, j) = covariance.correlation(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  if (!R.allFinite()) return {};
  const detail::StackedNumbers numbers(problem);
  Eigen::VectorXd f(static_cast<Eigen::Index>(numbers.size()));
  const auto sum_at = [&](const std::vector<double>& x) -> std::optional<double> {
    if (!is_inside(problem, x) || !numbers.at(x, f.data(), nullptr)) return std::nullopt;
    return f.squaredNorm();
  };
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(R);
  double worst = 1.0;
  Eigen::VectorXd where;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!(principal.eigenvalues()[k] > no_correlation)) continue;
    const Eigen::VectorXd direction = principal.eigenvectors().col(k);
    const Eigen::VectorXd step =
        errors.cwiseProduct(direction) * std::sqrt(principal.eigenvalues()[k]);
    for (const double way : {1.0, -1.0}) {
      std::vector<double> x = result.x;
      for (Eigen::Index i = 0; i < n; ++i) x[static_cast<std::size_t>(i)] += way * step[i];
      const std::optional<double> sum = sum_at(x);
      if (!sum || !std::isfinite(*sum)) continue;
      const double rise = std::max(*sum - result.cost, 0.0);
      if (std::abs(std::log(rise)) <= std::abs(std::log(worst))) continue;
      worst = rise;
      where = direction;
    }
  }
  if (worst >= least && worst <= greatest) return {};
  return "residuals are not linear within the errors: one standard error away along " +
         names_along(covariance.names, where) + ", the sum of squares is " +
         (worst > far ? "more than 100" : detail::rounded_text(worst)) +
         " higher instead of 1; draw from the posterior for better errors";
}

}  // namespace

std::vector<std::string> notes_on_errors(const LeastSquares& problem,
                                         const LeastSquaresResult& result,
                                         const UnknownsCovariance& covariance) {
  std::vector<std::string> notes;
  for (const UnknownsCovariance::Combination& weak : covariance.weak)
    notes.push_back(weak.sentence);
  const std::string bend = bend_within_errors(problem, result, covariance);
  if (!bend.empty()) notes.push_back(bend);
  return notes;
}

}  // namespace v0
}  // namespace polhode
