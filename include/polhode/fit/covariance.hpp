// SPDX-License-Identifier: MIT
// UnknownsCovariance: errors and correlations of what was fitted, and which combinations the data
// do not determine.
//
// Equations   C = (J^T W J / f^2 + P)^-1: J the derivatives of residuals, W what the loss leaves
//             of each as its weight, f the factor of errors of data, P the inverse covariance of
//             priors; by the singular values of J with columns scaled to length 1.
// Units       those of the unknowns.
// Domain      any result with a value. Where a combination of unknowns changes no residual their
//             errors are infinite, and correlations with them NaN. On a bound the errors are those
//             that there would be without it.
// Accuracy    Laplace's approximation: that of the residuals being linear within the errors.
// Errors      DomainError for a size that does not fit.
// Cost        one evaluation of the derivatives and one singular value decomposition.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/least_squares.hpp"

namespace polhode {
inline namespace v0 {

struct UnknownsCovariance {
  std::vector<std::string> names;
  std::vector<double> matrix;  // row by row

  // A combination that is not determined (no error, however large, is too large for the data), or
  // hardly (one unknown takes the place of others to 1 part in 30).
  struct Combination {
    bool is_determined = false;
    std::vector<double> direction;  // in unknowns over the lengths of their columns; of length 1
    std::string sentence;
  };
  std::vector<Combination> weak;

  // Without the unknowns of these names: as if they were known.
  UnknownsCovariance without(std::span<const std::string> held) const;
  double variance(std::size_t i) const { return matrix[i * names.size() + i]; }
  double error(std::size_t i) const;
  double correlation(std::size_t i, std::size_t j) const;
};

UnknownsCovariance covariance(const LeastSquares& problem, const LeastSquaresResult& result);

// Sentences: what is weakly determined; and whether residuals are not linear within the errors,
// which is so where one standard error along a principal direction raises the sum of squares by
// less than 1/2 or more than 2 instead of 1. The second is left out under robust losses, on a
// bound, with infinite errors, and where a fit may stop further than 0.1 errors from the least
// (`nearness`). 2 n evaluations for n unknowns.
std::vector<std::string> notes_on_errors(const LeastSquares& problem,
                                         const LeastSquaresResult& result,
                                         const UnknownsCovariance& covariance);

// (x - truth)^T C^-1 (x - truth): a draw of chi-square with as many degrees as unknowns where the
// errors are what they say. Infinite variances leave their unknowns out.
double mahalanobis(const UnknownsCovariance& c, std::span<const double> x,
                   std::span<const double> truth);

}  // namespace v0
}  // namespace polhode
