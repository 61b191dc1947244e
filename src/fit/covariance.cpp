// SPDX-License-Identifier: MIT
#include "polhode/fit/covariance.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/detail/stacked_numbers.hpp"
#include "fit/detail/unit_columns.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
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
  const detail::StackedNumbers numbers(problem);
  const auto n = std::ssize(problem.unknowns);
  if (std::ssize(result.x) != n) {
    throw DomainError("covariance: a result of " + std::to_string(result.x.size()) +
                      " unknowns for a problem of " + std::to_string(n));
  }
  Eigen::VectorXd f(static_cast<Eigen::Index>(numbers.size()));
  RowByRow J(f.size(), n);
  const bool has_value =
      numbers.at(result.x, f.data(), J.data(), detail::StackedNumbers::Derivatives::weighted);
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

}  // namespace v0
}  // namespace polhode
