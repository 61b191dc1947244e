// SPDX-License-Identifier: MIT
// The residual vector of a least-squares problem: robust losses, and data under them with priors.
#include "fit/detail/residual_vector.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fit/detail/scaling.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/least_squares.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace {

// Below this the quotients of ln(1 + z) cancel, and four terms of their series are exact.
constexpr double small = 1e-4;

LossValue huber(double z) {
  if (!(z > 1.0)) return {};
  const double root = std::sqrt(z);
  return {(2.0 * root - 1.0) / z, (1.0 - root) / z / z, 1.0 / root, 0.0};
}

LossValue soft_l1(double z) {
  const double root = std::sqrt(1.0 + z), sum = 1.0 + root;
  return {2.0 / sum, -1.0 / (root * sum * sum), 1.0 / root, 1.0 / (root * root * root)};
}

LossValue cauchy(double z) {
  const double weight = 1.0 / (1.0 + z), curvature = (1.0 - z) * weight * weight;
  if (z < small) {
    return {1.0 - z * (1.0 / 2.0 - z * (1.0 / 3.0 - z * (1.0 / 4.0 - z / 5.0))),
            -1.0 / 2.0 + z * (2.0 / 3.0 - z * (3.0 / 4.0 - z * (4.0 / 5.0))), weight, curvature};
  }
  const double ratio = std::log1p(z) / z;
  return {ratio, (weight - ratio) / z, weight, curvature};
}

}  // namespace

LossValue value(const Loss& loss, double z) {
  switch (loss.kind) {
    case Loss::Kind::huber:
      return huber(z);
    case Loss::Kind::soft_l1:
      return soft_l1(z);
    case Loss::Kind::cauchy:
      return cauchy(z);
    case Loss::Kind::squared:
      break;
  }
  return {};
}

void check(const Loss& loss) {
  if (!(loss.scale > 0.0) || !std::isfinite(loss.scale)) {
    throw DomainError("Loss: scale = " + polhode::detail::number_text(loss.scale) +
                      " must be positive, in standard errors of a residual");
  }
}

namespace detail {

namespace {

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::string list_text(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::vector<double> root_of(const NormalPrior& prior) {
  const auto n = std::ssize(prior.unknowns);
  const Square C = Eigen::Map<const Square>(prior.covariance.data(), n, n);
  const Eigen::LLT<Square> factor(C);
  if (!C.allFinite() || !C.isApprox(C.transpose(), 1e-12) || factor.info() != Eigen::Success) {
    throw DomainError("solve: the covariance of the prior of " + list_text(prior.unknowns) +
                      " must be finite, symmetric and positive definite; its first entry is " +
                      polhode::detail::number_text(C(0, 0)));
  }
  const Square root = inverse_root(factor);
  return {root.data(), root.data() + root.size()};
}

}  // namespace

ResidualVector::ResidualVector(const LeastSquares& problem) : problem_(&problem) {
  check(problem.loss);
  const Residuals& residuals = problem.residuals;
  const std::size_t blocks =
      std::accumulate(residuals.blocks.begin(), residuals.blocks.end(), std::size_t{0});
  if (!residuals.blocks.empty() && blocks != residuals.data) {
    throw DomainError("solve: blocks of " + std::to_string(blocks) + " numbers in all; expected " +
                      std::to_string(residuals.data) + ", as many as there are data");
  }
  if (!(problem.error_factor > 0.0) || !std::isfinite(problem.error_factor)) {
    throw DomainError(
        "solve: error_factor = " + polhode::detail::number_text(problem.error_factor) +
        " must be positive and finite");
  }
  if (!residuals.at) throw DomainError("solve: there is no function of residuals");
  if (problem.triangle) {
    const auto [a, b] = *problem.triangle;
    if (a == b || std::max(a, b) >= problem.unknowns.size()) {
      throw DomainError("solve: the triangle has unknowns " + std::to_string(a) + " and " +
                        std::to_string(b) + "; expected two different ones of " +
                        std::to_string(problem.unknowns.size()));
    }
  }
  std::set<std::string> names;
  for (const Unknown& u : problem.unknowns) {
    if (!names.insert(u.name).second) {
      throw DomainError("solve: the unknown " + u.name + " comes twice");
    }
  }
  size_ = residuals.data + residuals.prior;
  for (const NormalPrior& prior : problem.priors) add_prior(prior);
  if (size_ < problem.unknowns.size()) {
    throw DomainError("solve: " + std::to_string(problem.unknowns.size()) + " unknowns (" +
                      list_text([&] {
                        std::vector<std::string> all;
                        for (const Unknown& u : problem.unknowns) all.push_back(u.name);
                        return all;
                      }()) +
                      ") and " + std::to_string(size_) +
                      " numbers that say something of them, priors included; needs at least as "
                      "many: fix some unknowns or give priors");
  }
}

void ResidualVector::add_prior(const NormalPrior& prior) {
  const std::size_t n = prior.unknowns.size();
  if (n == 0 || prior.mean.size() != n || prior.covariance.size() != n * n) {
    throw DomainError("solve: the prior of " + list_text(prior.unknowns) + " has " +
                      std::to_string(prior.mean.size()) + " means and " +
                      std::to_string(prior.covariance.size()) + " covariances; expected " +
                      std::to_string(n) + " and " + std::to_string(n * n));
  }
  Whitened found{{}, prior.mean, root_of(prior)};
  for (std::size_t k = 0; k < n; ++k) {
    if (!std::isfinite(prior.mean[k])) {
      throw DomainError("solve: the prior mean of " + prior.unknowns[k] + " must be finite");
    }
    std::size_t i = 0;
    while (i < unknowns() && problem_->unknowns[i].name != prior.unknowns[k]) ++i;
    if (i == unknowns()) {
      throw DomainError("solve: a prior is of " + prior.unknowns[k] +
                        ", which is not an unknown of this fit");
    }
    if (std::ranges::find(found.unknowns, i) != found.unknowns.end()) {
      throw DomainError("solve: the prior of " + list_text(prior.unknowns) + " names " +
                        prior.unknowns[k] + " twice");
    }
    found.unknowns.push_back(i);
  }
  size_ += n;
  priors_.push_back(std::move(found));
}

void ResidualVector::weigh(std::size_t first, std::size_t count, double* numbers, double* jacobian,
                           Derivatives which) const {
  const std::size_t n = unknowns();
  const double scale = problem_->loss.scale;
  double z = 0.0;
  for (std::size_t i = first; i < first + count; ++i) z += numbers[i] * numbers[i];
  z /= scale * scale;
  const LossValue v = value(problem_->loss, z);
  const double factor = std::sqrt(v.ratio);
  if (jacobian != nullptr) {
    const bool exact = which == Derivatives::exact;
    const double kept = exact ? factor : std::sqrt(v.weight);
    const double turn = exact ? v.slope / (factor * scale * scale) : 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      double along = 0.0;  // of z scale^2 / 2
      for (std::size_t i = first; i < first + count; ++i) along += numbers[i] * jacobian[i * n + j];
      for (std::size_t i = first; i < first + count; ++i) {
        jacobian[i * n + j] = kept * jacobian[i * n + j] + turn * along * numbers[i];
      }
    }
  }
  for (std::size_t i = first; i < first + count; ++i) numbers[i] *= factor;
}

bool ResidualVector::at(const std::vector<double>& x, double* numbers, double* jacobian,
                        Derivatives which) const {
  const Residuals& residuals = problem_->residuals;
  const std::size_t n = unknowns(), given = residuals.data + residuals.prior;
  const std::size_t derivatives = jacobian == nullptr ? 0 : given * n;
  if (!residuals.at(x, {numbers, given}, {jacobian, derivatives})) return false;
  const double f = 1.0 / problem_->error_factor;
  for (std::size_t i = 0; i < residuals.data; ++i) numbers[i] *= f;
  for (std::size_t i = 0; i < (derivatives == 0 ? 0 : residuals.data * n); ++i) jacobian[i] *= f;
  if (problem_->loss.kind != Loss::Kind::squared) {
    std::size_t first = 0;
    for (const std::size_t count : residuals.blocks) {
      weigh(first, count, numbers, jacobian, which);
      first += count;
    }
    for (; residuals.blocks.empty() && first < residuals.data; ++first) {
      weigh(first, 1, numbers, jacobian, which);
    }
  }
  std::size_t row = given;
  for (const Whitened& prior : priors_) {
    const std::size_t m = prior.unknowns.size();
    for (std::size_t i = 0; i < m; ++i, ++row) {
      numbers[row] = 0.0;
      if (jacobian != nullptr) std::fill_n(jacobian + row * n, n, 0.0);
      for (std::size_t k = 0; k <= i; ++k) {
        const std::size_t u = prior.unknowns[k];
        numbers[row] += prior.root[i * m + k] * (x[u] - prior.mean[k]);
        if (jacobian != nullptr) jacobian[row * n + u] = prior.root[i * m + k];
      }
    }
  }
  return true;
}

bool ResidualVector::given(const std::vector<double>& x, std::vector<double>& numbers) const {
  numbers.assign(problem_->residuals.data + problem_->residuals.prior, 0.0);
  return problem_->residuals.at(x, numbers, {});
}

}  // namespace detail

ResidualFunction::ResidualFunction(LeastSquares problem)
    : problem_(std::make_shared<const LeastSquares>(std::move(problem))),
      numbers_(std::make_shared<const detail::ResidualVector>(*problem_)) {}

std::size_t ResidualFunction::size() const { return numbers_->size(); }

bool ResidualFunction::at(std::span<const double> x, std::span<double> numbers,
                          std::span<double> jacobian) const {
  if (x.size() != unknowns() || numbers.size() != size() ||
      (!jacobian.empty() && jacobian.size() != size() * unknowns()))
    throw DomainError("ResidualFunction: got " + std::to_string(x.size()) +
                      " unknowns and room for " + std::to_string(numbers.size()) +
                      " numbers; expected " + std::to_string(unknowns()) + " and " +
                      std::to_string(size()));
  const std::vector<double> at(x.begin(), x.end());
  return numbers_->at(at, numbers.data(), jacobian.empty() ? nullptr : jacobian.data());
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
