// SPDX-License-Identifier: MIT
// In this header: loss, least_squares, covariance, residual_function.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace fit {

// Loss: what a residual costs. The square of it, or less where it is far out, so that a few bad
// observations do not draw a fit away from the good ones.
//
// Equations   With z = |r|^2 / scale^2 a residual (one number, or the three of a rotation) costs
//             scale^2 rho(z) in place of |r|^2: z (squared); z, and 2 sqrt(z) - 1 from z = 1 on
//             (huber); 2 (sqrt(1 + z) - 1) (soft_l1); ln(1 + z) (cauchy). A least-squares method
//             sees f = r sqrt(rho(z) / z), whose square is the loss to the last digit, and the
//             derivative of that.
// Units       residuals are in units of their standard errors, and so is scale.
// Domain      scale > 0; any residual. As z -> 0 every loss is the square.
// Accuracy    budget loss in tests/budgets/fit.hpp.
// Errors      DomainError for a scale that is not positive and finite.
// Cost        a few dozen flops.

struct Loss {
  enum class Kind { squared, huber, soft_l1, cauchy };
  Kind kind = Kind::squared;
  double scale = 1.0;
};

// At z, the square of a residual over that of the scale.
struct LossValue {
  double ratio = 1.0;  // rho(z) / z, which the square of a residual is multiplied by
  double slope = 0.0;  // of the ratio, d(rho / z)/dz
  // rho'(z): the weight that the residual keeps in the normal equations.
  double weight = 1.0;
  // rho' + 2 z rho'': the derivative of weight times residual by the residual, for one number
  double curvature = 1.0;
};

LossValue value(const Loss& loss, double z);

// Throws unless the scale is positive and finite.
void check(const Loss& loss);

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

}  // namespace fit
}  // namespace v0
}  // namespace polhode
