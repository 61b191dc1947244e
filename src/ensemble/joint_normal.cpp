// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;

constexpr double eps = std::numeric_limits<double>::epsilon();
// By how many eps the halves of a covariance may differ, and n times as many its eigenvalues be
// below 0: what roundings leave.
constexpr double slack = 8.0;

// A square matrix, row by row.
struct Square {
  std::size_t n;
  std::vector<double> entries;

  double& at(std::size_t i, std::size_t j) { return entries[i * n + j]; }
  double at(std::size_t i, std::size_t j) const { return entries[i * n + j]; }
};

std::string place(std::size_t i, std::size_t j) {
  return "covariance[" + std::to_string(i) + "][" + std::to_string(j) + "] = ";
}

[[noreturn]] void refuse(const std::string& message) {
  throw DomainError("JointNormal: " + message);
}

void require_numbers(const std::vector<double>& mean, const std::vector<double>& covariance) {
  const std::size_t n = mean.size();
  if (n == 0) refuse("a mean of 0 numbers must have one or more");
  if (covariance.size() != n * n)
    refuse("a covariance of " + std::to_string(covariance.size()) + " numbers must have " +
           std::to_string(n * n) + " for a mean of " + std::to_string(n));
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(mean[i]))
      refuse("mean[" + std::to_string(i) + "] = " + number_text(mean[i]) + " must be finite");
}

void require_variances(const Square& c) {
  for (std::size_t i = 0; i < c.n; ++i) {
    for (std::size_t j = 0; j < c.n; ++j)
      if (!std::isfinite(c.at(i, j)))
        refuse(place(i, j) + number_text(c.at(i, j)) + " must be finite");
    if (c.at(i, i) < 0.0) refuse(place(i, i) + number_text(c.at(i, i)) + " must not be negative");
  }
}

// The correlations; 0 beside a variance of 0.
Square correlations(const Square& c, const std::vector<double>& sigmas) {
  Square r{c.n, std::vector<double>(c.n * c.n, 0.0)};
  for (std::size_t i = 0; i < c.n; ++i) {
    if (sigmas[i] > 0.0) r.at(i, i) = 1.0;
    for (std::size_t j = 0; j < i; ++j) {
      const double above = c.at(j, i), below = c.at(i, j), size = sigmas[i] * sigmas[j];
      if (std::abs(above - below) > slack * eps * std::max(size, std::abs(above)))
        refuse(place(j, i) + number_text(above) + " and " + place(i, j) + number_text(below) +
               " must be equal");
      if (size == 0.0 && above != 0.0)
        refuse(place(j, i) + number_text(above) + " must be 0 beside a variance of 0");
      if (size > 0.0) r.at(i, j) = r.at(j, i) = (0.5 * (above + below) / sigmas[i]) / sigmas[j];
    }
  }
  return r;
}

void require_positive(const Square& r) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
  const auto n = static_cast<Eigen::Index>(r.n);
  const Matrix matrix = Eigen::Map<const Matrix>(r.entries.data(), n, n);
  const double least =
      Eigen::SelfAdjointEigenSolver<Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!(least >= -slack * static_cast<double>(r.n) * eps))
    refuse("the least eigenvalue of the correlations, " + detail::rounded_text(least) +
           ", must not be negative");
}

// Cholesky's factor, column by column: the next column is that of the largest variance left, the
// first of equal ones, until none is left but roundings. Plain sums, so that it has the same bits
// everywhere, which eigenvectors have not: their signs are the solver's.
std::vector<double> factor_of(Square r) {
  std::vector<double> factor;
  for (std::size_t k = 0; k < r.n; ++k) {
    std::size_t p = 0;
    for (std::size_t i = 1; i < r.n; ++i)
      if (r.at(i, i) > r.at(p, p)) p = i;
    const double left = r.at(p, p);
    if (left <= slack * static_cast<double>(r.n) * eps) break;
    std::vector<double> column(r.n);
    for (std::size_t i = 0; i < r.n; ++i) column[i] = r.at(i, p) / std::sqrt(left);
    for (std::size_t i = 0; i < r.n; ++i)
      for (std::size_t j = 0; j < r.n; ++j)
        r.at(i, j) = i == p || j == p ? 0.0 : r.at(i, j) - column[i] * column[j];
    factor.insert(factor.end(), column.begin(), column.end());
  }
  return factor;
}

}  // namespace

JointNormal::JointNormal(std::vector<double> mean, std::vector<double> covariance)
    : mean_(std::move(mean)), covariance_(std::move(covariance)) {
  require_numbers(mean_, covariance_);
  const Square c{size(), covariance_};
  require_variances(c);
  std::vector<double> sigmas(size());
  for (std::size_t i = 0; i < size(); ++i) sigmas[i] = std::sqrt(c.at(i, i));
  const Square r = correlations(c, sigmas);
  require_positive(r);
  factor_ = factor_of(r);
  for (std::size_t i = 0; i < factor_.size(); ++i) factor_[i] *= sigmas[i % size()];
}

void JointNormal::from_uniform(std::span<const double> u, std::span<double> x) const {
  const std::size_t n = size();
  std::copy(mean_.begin(), mean_.end(), x.begin());
  for (std::size_t k = 0; k * n < factor_.size(); ++k) {
    const double z = normal_quantile(u[k]);
    for (std::size_t i = 0; i < n; ++i) x[i] += factor_[k * n + i] * z;
  }
}

}  // namespace v0
}  // namespace polhode
