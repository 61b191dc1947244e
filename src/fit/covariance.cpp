// SPDX-License-Identifier: MIT
// Covariance of the unknowns of a fit, and notes on errors that are not to be trusted.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fit/detail/residual_vector.hpp"
#include "fit/detail/scaling.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/least_squares.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace {

using detail::RowByRow;
constexpr double infinite = std::numeric_limits<double>::infinity();

// Singular values over the greatest, of columns of length 1: below the first nothing but rounding
// is left, below the second a combination is hardly determined.
constexpr double nothing = 1e-12, hardly = 1.0 / 30.0;
// The part of a direction below which an unknown has no share in it, and is not named.
constexpr double share = 1e-6, named = 0.2;

std::string together(const std::vector<std::string>& names, const Eigen::VectorXd& direction) {
  const double greatest = direction.cwiseAbs().maxCoeff();
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::abs(direction[static_cast<Eigen::Index>(i)]) >= named * greatest) which.push_back(i);
  }
  if (which.size() == 1) return names[which[0]];
  std::string text;
  for (std::size_t k = 0; k < which.size(); ++k) {
    text += (k == 0 ? "" : k + 1 == which.size() ? " and " : ", ") + names[which[k]];
  }
  text += " apart: ";
  // A positive part times a column of positive length: how the unknown itself grows.
  const double first = direction[static_cast<Eigen::Index>(which[0])];
  std::string others, against;
  for (const std::size_t i : which) {
    const bool same = direction[static_cast<Eigen::Index>(i)] * first > 0.0;
    std::string& list = same ? others : against;
    list += (list.empty() ? "" : ", ") + names[i];
  }
  return text +
         (against.empty()
              ? "they grow together"
              : others + (others.find(',') == std::string::npos ? " grows" : " grow") + " where " +
                    against + (against.find(',') == std::string::npos ? " falls" : " fall"));
}

}  // namespace

double UnknownsCovariance::error(std::size_t i) const { return std::sqrt(variance(i)); }

double UnknownsCovariance::correlation(std::size_t i, std::size_t j) const {
  return matrix[i * names.size() + j] / (error(i) * error(j));
}

UnknownsCovariance UnknownsCovariance::without(std::span<const std::string> held) const {
  if (held.empty()) return *this;
  UnknownsCovariance found;
  const std::size_t n = names.size();
  const auto stays = [&](std::size_t i) { return std::ranges::count(held, names[i]) == 0; };
  for (std::size_t i = 0; i < n; ++i) {
    if (!stays(i)) continue;
    found.names.push_back(names[i]);
    for (std::size_t j = 0; j < n; ++j)
      if (stays(j)) found.matrix.push_back(matrix[i * n + j]);
  }
  return found;
}

UnknownsCovariance covariance(const LeastSquares& problem, const LeastSquaresResult& result) {
  UnknownsCovariance found;
  for (const Unknown& u : problem.unknowns) found.names.push_back(u.name);
  const detail::ResidualVector numbers(problem);
  const auto n = std::ssize(problem.unknowns);
  if (std::ssize(result.x) != n) {
    throw DomainError("covariance: a result of " + std::to_string(result.x.size()) +
                      " unknowns for a problem of " + std::to_string(n));
  }
  Eigen::VectorXd f(static_cast<Eigen::Index>(numbers.size()));
  RowByRow J(f.size(), n);
  const bool has_value =
      numbers.at(result.x, f.data(), J.data(), detail::ResidualVector::Derivatives::weighted);
  if (!has_value || !J.allFinite()) {
    found.matrix.assign(static_cast<std::size_t>(n * n), std::numeric_limits<double>::quiet_NaN());
    return found;
  }
  const Eigen::VectorXd scales = detail::to_unit_columns(J);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n);
  std::vector<bool> is_infinite(static_cast<std::size_t>(n), false);
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    const Eigen::VectorXd v = svd.matrixV().col(k);
    const bool is_determined = s[k] > nothing * s[0];
    if (is_determined) C += v * v.transpose() / (s[k] * s[k]);
    if (s[k] > hardly * s[0]) continue;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!is_determined && std::abs(v[i]) > share) is_infinite[static_cast<std::size_t>(i)] = true;
    }
    found.weak.push_back(
        {is_determined,
         {v.data(), v.data() + n},
         (is_determined ? "the data hardly determine " : "the data do not determine ") +
             together(found.names, v)});
  }
  C = scales.cwiseInverse().asDiagonal() * C * scales.cwiseInverse().asDiagonal();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const bool any =
          is_infinite[static_cast<std::size_t>(i)] || is_infinite[static_cast<std::size_t>(j)];
      const double undefined = i == j ? infinite : std::numeric_limits<double>::quiet_NaN();
      found.matrix.push_back(any ? undefined : C(i, j));
    }
  }
  return found;
}

double mahalanobis(const UnknownsCovariance& c, std::span<const double> x,
                   std::span<const double> truth) {
  const std::size_t n = c.names.size();
  if (x.size() != n || truth.size() != n) {
    throw DomainError("mahalanobis: " + std::to_string(x.size()) + " and " +
                      std::to_string(truth.size()) + " numbers; expected " + std::to_string(n));
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < n; ++i) {
    if (c.variance(i) != infinite) kept.push_back(i);
  }
  const auto m = std::ssize(kept);
  Eigen::MatrixXd C(m, m);
  Eigen::VectorXd d(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const std::size_t a = kept[static_cast<std::size_t>(i)];
    d[i] = (x[a] - truth[a]) / c.error(a);
    for (Eigen::Index j = 0; j < m; ++j) {
      C(i, j) = c.correlation(a, kept[static_cast<std::size_t>(j)]);
    }
  }
  return d.dot(C.ldlt().solve(d));
}

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
  const detail::ResidualVector numbers(problem);
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
         (worst > far ? "more than 100" : polhode::detail::rounded_text(worst)) +
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

}  // namespace fit
}  // namespace v0
}  // namespace polhode
