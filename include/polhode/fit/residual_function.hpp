// SPDX-License-Identifier: MIT
// ResidualFunction: the numbers whose squares a fit minimises, with their derivatives, for an
// optimiser or a sampler of your own.
//
// Equations   the sum of solve() (polhode/fit/least_squares.hpp) is that of the squares of these
//             numbers: data over the factor of their errors and under their loss, then priors. With
//             J their derivatives, r the numbers, -r^T r / 2 is the logarithm of the posterior
//             density but for a constant, and -J^T r its gradient.
// Units       those of the unknowns; the numbers are in standard errors.
// Domain      any x: where there is no value, `at` says so. Bounds are not looked at.
// Accuracy    derivatives are exact: those of fit_spin and fit_light.
// Errors      DomainError as solve() for what is no problem.
// Cost        one evaluation of the residuals.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "polhode/fit/least_squares.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {
class ResidualVector;
}  // namespace detail

class ResidualFunction {
 public:
  explicit ResidualFunction(LeastSquares problem);

  const LeastSquares& problem() const { return *problem_; }
  std::size_t data() const { return problem_->residuals.data; }
  std::size_t size() const;  // with those of priors
  std::size_t unknowns() const { return problem_->unknowns.size(); }

  // size() numbers at x; their derivatives row by row, size() times unknowns(), where `jacobian` is
  // not empty. False where they have no value.
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const;

 private:
  std::shared_ptr<const LeastSquares> problem_;
  std::shared_ptr<const detail::ResidualVector> numbers_;
};

}  // namespace v0
}  // namespace polhode
