// SPDX-License-Identifier: MIT
// solve(): least squares with priors, bounds and a robust loss, and how it ended.
//
// Equations   The least of sum loss(r_k(x) / f) + sum p_k(x)^2 + sum (x_S - m)^T C^-1 (x_S - m):
//             residuals r of data in units of their standard errors, each block under one loss
//             (loss.hpp); residuals p of priors; normal priors of some unknowns S. f multiplies the
//             errors of data, never those of priors. Method: Levenberg-Marquardt (More 1978) as
//             Eigen has it from MINPACK, its trial steps brought back to the bounds (Kanzow,
//             Yamashita & Fukushima 2004); an unknown that is pressed against its bound is held on
//             it while the others go on, and let go where it would rather leave.
// Units       those of the unknowns; residuals are numbers.
// Domain      a start within its bounds, or on one, at which every residual is finite; at least as
//             many numbers (data and priors) as unknowns. A step to where the residuals have no
//             value is not taken.
// Accuracy    is_converged says: the least of the linear problem is nearer than `nearness`
//             standard errors, or lower by less than 1e-9 of the cost. Derivatives are those that
//             are given.
// Errors      DomainError for bounds without a room between them, a start outside, fewer numbers
//             than unknowns, covariances that are not positive definite, names that come twice.
//             What a residual function throws passes through.
// Cost        the residuals once a trial step, their derivatives once an iteration.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/loss.hpp"

namespace polhode {
inline namespace v0 {

struct Unknown {
  std::string name;
  double start = 0.0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// Normal, of one unknown or of several: covariance is that of them, row by row.
struct NormalPrior {
  std::vector<std::string> unknowns;
  std::vector<double> mean;
  std::vector<double> covariance;
};

// Two unknowns that are, with 1, the sides of a triangle: ratios of moments of inertia. They have
// no other bounds.
struct TriangleBound {
  std::size_t a = 0;
  std::size_t b = 1;
};

struct Residuals {
  // How many numbers of data, and after them how many of priors.
  std::size_t data = 0;
  std::size_t prior = 0;
  // The sizes of the blocks of data that the loss takes as one, in order; empty: each number alone.
  std::vector<std::size_t> blocks;
  // The numbers at unknowns x, data first; and where `jacobian` is not empty, their derivatives,
  // row by row. False where they have no value.
  std::function<bool(std::span<const double> x, std::span<double> numbers,
                     std::span<double> jacobian)>
      at;
};

struct LeastSquares {
  std::vector<Unknown> unknowns;
  Residuals residuals;
  std::vector<NormalPrior> priors;
  std::optional<TriangleBound> triangle;
  Loss loss;
  double error_factor = 1.0;  // f, by which errors of data are multiplied
  int most_iterations = 200;
  // How near the least of the linear problem has to be, in standard errors. Residuals whose
  // derivatives jump here and there come no nearer than their jumps let them.
  double nearness = 1e-3;
  // The longest that the first step may be: each unknown counts in its standard error with the
  // others held. Later steps may be longer where the linear model holds. 0: no such limit. It keeps
  // a start at the right one of many minima near it.
  double first_step = 0.0;
};

struct LeastSquaresResult {
  enum class End { converged, no_descent, iteration_limit, no_value };
  End end = End::no_value;
  // What happened, and where it did not converge what to try; and which unknowns are on a bound.
  std::string sentence;
  int iterations = 0;
  int evaluations = 0;

  std::vector<double> x;
  std::vector<double> numbers;     // residuals there as they were given, data and priors
  double chi_square = 0.0;         // sum of squares of those of data, without loss and factor
  double cost = 0.0;               // the sum that was minimised
  std::vector<std::size_t> bound;  // unknowns that are on a bound

  bool is_converged() const { return end == End::converged; }
};

LeastSquaresResult solve(const LeastSquares& problem);

// The same with the factor of errors found from the residuals: chi-square per degree of freedom
// becomes 1, where what priors determine does not count as a degree that data lost. Ends with the
// factor in `problem`. For the squared loss alone. Where the data leave no degree of freedom errors
// stay as given, and the sentence says so.
LeastSquaresResult solve_scaled(LeastSquares& problem);

// Numbers of data less the unknowns that they determine: n_data - p + tr(C_post C_prior^-1), C_post
// with the present factor, p unknowns.
double degrees_of_freedom(const LeastSquares& problem, const LeastSquaresResult& result);

}  // namespace v0
}  // namespace polhode
