// SPDX-License-Identifier: MIT
#include "polhode/fit/least_squares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/detail/change_of_variable.hpp"
#include "fit/detail/levenberg_marquardt.hpp"
#include "fit/detail/stacked_numbers.hpp"
#include "fit/detail/unit_columns.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using End = LeastSquaresResult::End;
using detail::RowByRow;

// How near the least of the linear problem has to be: in standard errors, or of the sum of squares.
constexpr double near_errors = 1e-3, near_cost = 1e-9;
// How often errors are scaled until their factor stays to 1e-6, and by how much it may change.
constexpr int most_scalings = 50;
constexpr double same_factor = 1e-6;
// Degrees of freedom that are rounding: no data are left over to find errors from.
constexpr double no_freedom = 1e-6;

class Solver {
 public:
  explicit Solver(const LeastSquares& problem)
      : problem_(problem), numbers_(problem), change_(problem) {
    for (std::size_t i = 0; i < change_.size(); ++i) {
      z_.push_back(0.0);
      free_.push_back(i);
      y_.push_back(change_[i].start());
      z_[i] = change_[i].z(y_[i]);
    }
  }

  LeastSquaresResult solved() {
    LeastSquaresResult result;
    detail::Descent descent;
    // each round but the last puts an unknown on its bound
    for (std::size_t round = 0; round <= z_.size(); ++round) {
      descent = round_of_descent();
      result.iterations += descent.iterations;
      result.evaluations += descent.evaluations;
      if (descent.end == detail::Descent::End::no_value || !puts_on_bound()) break;
    }
    result.x = change_.x_of_z(z_);
    finish(result, descent.end);
    return result;
  }

 private:
  detail::Descent round_of_descent() {
    std::vector<double> y;
    for (const std::size_t i : free_) y.push_back(y_[i]);
    if (y.empty()) {
      detail::Descent none;
      none.end = detail::Descent::End::small_step;
      return none;
    }
    std::vector<double> wide(numbers_.size() * change_.size());
    const detail::Numbers f = [&](const std::vector<double>& at, double* numbers,
                                  double* jacobian) {
      place(at);
      const std::size_t n = change_.size(), m = free_.size();
      const bool has_value =
          numbers_.at(change_.x_of_z(z_), numbers, jacobian == nullptr ? nullptr : wide.data());
      for (std::size_t row = 0; jacobian != nullptr && row < numbers_.size(); ++row) {
        change_.to_z(wide.data() + row * n);
        for (std::size_t k = 0; k < m; ++k) {
          jacobian[row * m + k] = wide[row * n + free_[k]] * change_[free_[k]].slope(at[k]);
        }
      }
      return has_value;
    };
    detail::Descent found =
        detail::levenberg_marquardt(f, numbers_.size(), y, problem_.most_iterations);
    place(found.y);
    return found;
  }

  void place(const std::vector<double>& y) {
    for (std::size_t k = 0; k < free_.size(); ++k) {
      y_[free_[k]] = y[k];
      z_[free_[k]] = change_[free_[k]].z(y[k]);
    }
  }

  // Half the gradient of the sum of squares by z, and the derivatives; false without a value.
  bool derivatives(Eigen::VectorXd& numbers, RowByRow& jacobian) const {
    numbers.resize(static_cast<Eigen::Index>(numbers_.size()));
    jacobian.resize(numbers.size(), static_cast<Eigen::Index>(change_.size()));
    if (!numbers_.at(change_.x_of_z(z_), numbers.data(), jacobian.data())) return false;
    for (Eigen::Index row = 0; row < jacobian.rows(); ++row) change_.to_z(jacobian.row(row).data());
    return numbers.allFinite() && jacobian.allFinite();
  }

  // Fixes what is pressed against its bound, there; whether anything was.
  bool puts_on_bound() {
    Eigen::VectorXd numbers;
    RowByRow jacobian;
    if (!derivatives(numbers, jacobian)) return false;
    const Eigen::VectorXd gradient = jacobian.transpose() * numbers;
    const std::size_t before = free_.size();
    std::erase_if(free_, [&](std::size_t i) {
      const double slope = gradient[static_cast<Eigen::Index>(i)];
      const bool low = change_[i].is_at_low(z_[i]) && slope > 0.0;
      const bool high = change_[i].is_at_high(z_[i]) && slope < 0.0;
      if (low) z_[i] = change_[i].low();
      if (high) z_[i] = change_[i].high();
      return low || high;
    });
    return free_.size() != before;
  }

  // Whether the least of the linear problem in the free unknowns is near.
  bool is_least() const {
    Eigen::VectorXd numbers;
    RowByRow jacobian;
    if (!derivatives(numbers, jacobian)) return false;
    if (free_.empty()) return true;
    RowByRow of_free(jacobian.rows(), std::ssize(free_));
    for (std::size_t k = 0; k < free_.size(); ++k) {
      of_free.col(static_cast<Eigen::Index>(k)) = jacobian.col(static_cast<Eigen::Index>(free_[k]));
    }
    detail::to_unit_columns(of_free);
    const Eigen::ColPivHouseholderQR<RowByRow> qr(of_free);
    const Eigen::VectorXd turned = qr.matrixQ().adjoint() * numbers;
    const double step2 = turned.head(qr.rank()).squaredNorm();
    return step2 <= std::max(near_errors * near_errors, near_cost * numbers.squaredNorm());
  }

  void finish(LeastSquaresResult& result, detail::Descent::End end) const {
    std::vector<double> numbers(numbers_.size());
    const bool has_value =
        numbers_.given(result.x, result.numbers) && numbers_.at(result.x, numbers.data(), nullptr);
    for (std::size_t i = 0; i < numbers_.data(); ++i) {
      result.chi_square += result.numbers[i] * result.numbers[i];
    }
    for (const double x : numbers) result.cost += x * x;
    if (!has_value) result.chi_square = result.cost = std::numeric_limits<double>::quiet_NaN();
    if (end == detail::Descent::End::no_value || !has_value || !std::isfinite(result.cost)) {
      result.end = End::no_value;
    } else if (is_least()) {
      result.end = End::converged;
    } else {
      result.end =
          end == detail::Descent::End::iteration_limit ? End::iteration_limit : End::no_descent;
    }
    result.sentence = sentence_of(result);
    for (std::size_t i = 0; i < change_.size(); ++i) {
      const bool low = change_[i].is_at_low(z_[i]);
      if (!low && !change_[i].is_at_high(z_[i])) continue;
      result.bound.push_back(i);
      result.sentence += "; " + change_.bound_text(i, low) + ", so that its error means little";
    }
  }

  std::string sentence_of(const LeastSquaresResult& result) const {
    const std::string after = " after " + std::to_string(result.iterations) + " iterations";
    switch (result.end) {
      case End::converged:
        return "converged" + after;
      case End::iteration_limit:
        return "not converged" + after + ", the most allowed: start nearer, or allow more";
      case End::no_descent:
        return "not converged" + after +
               ": no step made the residuals smaller, and the least of the linear problem is not "
               "near; start elsewhere, or fix what the data do not determine";
      case End::no_value:
        break;
    }
    std::string at;
    for (std::size_t i = 0; i < result.x.size(); ++i) {
      at += (at.empty() ? "" : ", ") + problem_.unknowns[i].name + " = " +
            detail::rounded_text(result.x[i]);
    }
    return "not converged: residuals or their derivatives are not numbers at " + at;
  }

  const LeastSquares& problem_;
  detail::StackedNumbers numbers_;
  detail::ChangeOfVariable change_;
  std::vector<double> z_, y_;
  std::vector<std::size_t> free_;
};

}  // namespace

LeastSquaresResult solve(const LeastSquares& problem) {
  if (problem.unknowns.empty()) throw DomainError("solve: no unknowns; expected one at least");
  if (problem.most_iterations < 1) {
    throw DomainError("solve: most_iterations = " + std::to_string(problem.most_iterations) +
                      " must be 1 or more");
  }
  return Solver(problem).solved();
}

double degrees_of_freedom(const LeastSquares& problem, const LeastSquaresResult& result) {
  const detail::StackedNumbers numbers(problem);
  const auto n = std::ssize(problem.unknowns);
  if (std::ssize(result.x) != n) {
    throw DomainError("degrees_of_freedom: a result of " + std::to_string(result.x.size()) +
                      " unknowns for a problem of " + std::to_string(n));
  }
  Eigen::VectorXd f(static_cast<Eigen::Index>(numbers.size()));
  RowByRow J(f.size(), n);
  if (!numbers.at(result.x, f.data(), J.data(), detail::StackedNumbers::Derivatives::weighted)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  detail::to_unit_columns(J);
  // tr of the part of the hat matrix that belongs to the data: rows of an orthonormal basis.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU);
  const auto data = static_cast<Eigen::Index>(numbers.data());
  double determined = 0.0;
  for (Eigen::Index k = 0; k < svd.rank(); ++k) {
    determined += svd.matrixU().col(k).head(data).squaredNorm();
  }
  return static_cast<double>(data) - determined;
}

namespace {

// A start on a bound would be none: what is there, and what the triangle mixes with it, starts as
// before.
void start_from(const LeastSquaresResult& result, LeastSquares& problem) {
  const auto is_on_bound = [&](std::size_t i) {
    return std::ranges::find(result.bound, i) != result.bound.end();
  };
  const std::optional<TriangleBound>& sides = problem.triangle;
  const bool holds_sides = sides && (is_on_bound(sides->a) || is_on_bound(sides->b));
  for (std::size_t i = 0; i < problem.unknowns.size(); ++i) {
    const bool is_side = sides && (i == sides->a || i == sides->b);
    if (is_side ? !holds_sides : !is_on_bound(i)) problem.unknowns[i].start = result.x[i];
  }
}

}  // namespace

LeastSquaresResult solve_scaled(LeastSquares& problem) {
  if (problem.loss.kind != Loss::Kind::squared) {
    throw DomainError(
        "solve_scaled: errors are scaled by the residuals for the squared loss alone; a robust one "
        "has a scale of its own");
  }
  LeastSquaresResult result;
  int iterations = 0, evaluations = 0;
  bool is_settled = false;
  for (int k = 0; k < most_scalings && !is_settled; ++k) {
    result = solve(problem);
    iterations += result.iterations;
    evaluations += result.evaluations;
    const double freedom = degrees_of_freedom(problem, result);
    if (!result.is_converged()) break;
    if (!(freedom > no_freedom) || !(result.chi_square > 0.0)) {
      result.sentence += "; errors are as given: they cannot be found from data that leave " +
                         detail::rounded_text(std::max(freedom, 0.0)) +
                         " degrees of freedom and chi-square " +
                         detail::rounded_text(result.chi_square);
      break;
    }
    const double factor = std::sqrt(result.chi_square / freedom);
    is_settled = std::abs(factor / problem.error_factor - 1.0) <= same_factor;
    problem.error_factor = factor;
    if (is_settled) break;
    if (k + 1 == most_scalings) {
      result.sentence += "; the factor of errors did not settle: it is " +
                         detail::rounded_text(factor) + " or near it";
    }
    start_from(result, problem);
  }
  result.iterations = iterations;
  result.evaluations = evaluations;
  return result;
}

}  // namespace v0
}  // namespace polhode
