// SPDX-License-Identifier: MIT
// Least squares with bounds and priors: unknowns as bounded variables, and the solution by
// Levenberg-Marquardt steps.
#include "polhode/fit/least_squares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "fit/detail/levenberg_marquardt.hpp"
#include "fit/detail/residual_vector.hpp"
#include "fit/detail/scaling.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

// [low, high], one or both of which may be infinite.
class Interval {
 public:
  Interval(double low, double high, double start);
  double inside(double z) const;  // the nearest point of it
  bool has(double z) const { return z >= low_ && z <= high_; }
  // The bound that z is on to a part in 1e5 of the room, or of its distance at the start.
  bool is_at_low(double z) const { return z - low_ <= near_; }
  bool is_at_high(double z) const { return high_ - z <= near_; }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double low_, high_, near_;
};

// x = M z, where M mixes the two unknowns of a triangle: with the moments y + z', x + z', x + y of
// second moments x, y, z' and x + y = 1, I1 = 1 - s + w and I2 = s + w for s = x, w = z', so that
// the triangle inequalities are 0 <= s <= 1 and 0 <= w.
class ChangeOfVariable {
 public:
  explicit ChangeOfVariable(const LeastSquares& problem);

  std::size_t size() const { return intervals_.size(); }
  const Interval& operator[](std::size_t i) const { return intervals_[i]; }
  // z of the start: what rounding put beyond a bound is on it.
  const std::vector<double>& start() const { return start_; }
  std::vector<double> x_of_z(const std::vector<double>& z) const;
  std::vector<double> z_of_x(const std::vector<double>& x) const;
  // d/dx of one number into d/dz, in place.
  void to_z(double* derivatives) const;
  // What it means that variable i is on its lower or upper bound.
  std::string bound_text(std::size_t i, bool low) const;

 private:
  std::vector<Interval> intervals_;
  std::vector<double> start_;
  std::vector<std::string> names_;
  std::optional<TriangleBound> triangle_;
};

constexpr double infinite = std::numeric_limits<double>::infinity();
// How near to a bound counts as on it.
constexpr double near = 1e-5;
// Of the mixing of two sides of a triangle, and of a division by the third before it.
constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

Interval::Interval(double low, double high, double start) : low_(low), high_(high), near_(0.0) {
  const bool below = std::isfinite(low), above = std::isfinite(high);
  if (below && above) near_ = near * (high - low);
  if (below != above) near_ = near * (below ? start - low : high - start);
}

double Interval::inside(double z) const { return std::min(std::max(z, low_), high_); }

ChangeOfVariable::ChangeOfVariable(const LeastSquares& problem) : triangle_(problem.triangle) {
  std::vector<double> x;
  for (const Unknown& u : problem.unknowns) {
    x.push_back(u.start);
    names_.push_back(u.name);
  }
  const std::vector<double> z = z_of_x(x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Unknown& u = problem.unknowns[i];
    double low = u.low, high = u.high;
    const bool is_a = triangle_ && i == triangle_->a, is_b = triangle_ && i == triangle_->b;
    if (is_a || is_b) {
      if (std::isfinite(low) || std::isfinite(high)) {
        throw DomainError("solve: " + u.name +
                          " has bounds of its own; the triangle inequality is the only one that a "
                          "ratio of moments may have, a prior says more");
      }
      low = 0.0;
      high = is_a ? 1.0 : infinite;
    }
    if (!(low < high)) {
      throw DomainError("solve: the bounds of " + u.name + ", " +
                        polhode::detail::number_text(low) + " and " +
                        polhode::detail::number_text(high) + ", must leave room between them");
    }
    const double slack = is_a || is_b ? rounding * (1.0 + std::abs(u.start)) : 0.0;
    if (!std::isfinite(u.start) || !(z[i] >= low - slack) || !(z[i] <= high + slack)) {
      throw DomainError(
          "solve: the start of " + u.name + ", " + polhode::detail::number_text(u.start) +
          ", must lie between its bounds" +
          (is_a || is_b ? ", which are those of the triangle inequality of moments" : ""));
    }
    start_.push_back(std::min(std::max(z[i], low), high));
    intervals_.emplace_back(low, high, start_.back());
  }
}

std::vector<double> ChangeOfVariable::x_of_z(const std::vector<double>& z) const {
  std::vector<double> x = z;
  if (triangle_) {
    const double s = z[triangle_->a], w = z[triangle_->b];
    x[triangle_->a] = (1.0 - s) + w;
    x[triangle_->b] = s + w;
  }
  return x;
}

std::vector<double> ChangeOfVariable::z_of_x(const std::vector<double>& x) const {
  std::vector<double> z = x;
  if (triangle_) {
    const double a = x[triangle_->a], b = x[triangle_->b];
    z[triangle_->a] = 0.5 * ((1.0 - a) + b);
    z[triangle_->b] = 0.5 * ((a - 1.0) + b);
  }
  return z;
}

void ChangeOfVariable::to_z(double* derivatives) const {
  if (!triangle_) return;
  double &a = derivatives[triangle_->a], &b = derivatives[triangle_->b];
  const double by_a = a, by_b = b;
  a = by_b - by_a;
  b = by_a + by_b;
}

std::string ChangeOfVariable::bound_text(std::size_t i, bool low) const {
  if (triangle_ && (i == triangle_->a || i == triangle_->b)) {
    const std::string &a = names_[triangle_->a], &b = names_[triangle_->b];
    if (i == triangle_->b) return a + " + " + b + " is on its bound, 1";
    return low ? a + " is on its bound, 1 + " + b : b + " is on its bound, 1 + " + a;
  }
  const Interval& v = intervals_[i];
  return names_[i] + " is on its bound, " + polhode::detail::number_text(low ? v.low() : v.high());
}

}  // namespace
}  // namespace detail

namespace {

using End = LeastSquaresResult::End;
using detail::RowByRow;

// How near the least of the linear problem has to be, of the sum of squares.
constexpr double near_cost = 1e-9;
// How often errors are scaled until their factor stays to 1e-6, and by how much it may change.
constexpr int most_scalings = 50;
constexpr double same_factor = 1e-6;
// Degrees of freedom that are rounding: no data are left over to find errors from.
constexpr double no_freedom = 1e-6;

// Rounds of descent for each unknown, at most: of bounds that are met and left again.
constexpr std::size_t most_rounds = 8;

class Solver {
 public:
  explicit Solver(const LeastSquares& problem)
      : problem_(problem), numbers_(problem), change_(problem), z_(change_.start()) {
    for (std::size_t i = 0; i < change_.size(); ++i) free_.push_back(i);
  }

  // Levenberg and Marquardt's method up to the first bound; what is pressed against it is held
  // there, and the others go on. At their least, what would rather leave its bound is let go.
  LeastSquaresResult solved() {
    LeastSquaresResult result;
    detail::Descent descent;
    holds_what_is_pressed();
    for (std::size_t round = 0; round < most_rounds * (z_.size() + 1); ++round) {
      descent = round_of_descent(problem_.most_iterations - result.iterations);
      result.iterations += descent.iterations;
      result.evaluations += descent.evaluations;
      if (descent.end == DescentEnd::no_value || descent.end == DescentEnd::iteration_limit) break;
      const bool holds = holds_what_is_pressed();
      if (descent.end == DescentEnd::small_step && !holds && !lets_go()) break;
      if (result.iterations >= problem_.most_iterations) {
        descent.end = DescentEnd::iteration_limit;
        break;
      }
    }
    result.x = change_.x_of_z(z_);
    finish(result, descent.end);
    return result;
  }

 private:
  using DescentEnd = detail::Descent::End;

  detail::Descent round_of_descent(int most_iterations) {
    std::vector<double> y;
    for (const std::size_t i : free_) y.push_back(z_[i]);
    if (y.empty()) {
      detail::Descent none;
      none.end = DescentEnd::small_step;
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
        for (std::size_t k = 0; k < m; ++k) jacobian[row * m + k] = wide[row * n + free_[k]];
      }
      return has_value;
    };
    const detail::Within is_within = [&](const std::vector<double>& at) {
      for (std::size_t k = 0; k < free_.size(); ++k) {
        if (!change_[free_[k]].has(at[k])) return false;
      }
      return true;
    };
    detail::Descent found = detail::levenberg_marquardt(f, is_within, numbers_.size(), y,
                                                        most_iterations, problem_.first_step);
    place(found.y);
    return found;
  }

  // On the bound what is beyond it.
  void place(const std::vector<double>& y) {
    for (std::size_t k = 0; k < free_.size(); ++k) {
      z_[free_[k]] = change_[free_[k]].inside(y[k]);
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

  // Whether descent would take variable i beyond the bound that it is on.
  bool is_pressed(std::size_t i, double slope) const {
    return (change_[i].is_at_low(z_[i]) && slope > 0.0) ||
           (change_[i].is_at_high(z_[i]) && slope < 0.0);
  }

  bool is_any_on_bound() const {
    for (std::size_t i = 0; i < z_.size(); ++i) {
      if (change_[i].is_at_low(z_[i]) || change_[i].is_at_high(z_[i])) return true;
    }
    return false;
  }

  // Fixes what is pressed against its bound, there; whether anything was.
  bool holds_what_is_pressed() {
    Eigen::VectorXd numbers;
    RowByRow jacobian;
    if (!is_any_on_bound() || !derivatives(numbers, jacobian)) return false;
    const Eigen::VectorXd gradient = jacobian.transpose() * numbers;
    const std::vector<double> z = z_;
    const std::vector<std::size_t> free = free_;
    std::erase_if(free_, [&](std::size_t i) {
      const double slope = gradient[static_cast<Eigen::Index>(i)];
      if (!is_pressed(i, slope)) return false;
      z_[i] = slope > 0.0 ? change_[i].low() : change_[i].high();
      return true;
    });
    // a corner of bounds may be no place: a rod without thickness
    if (z_ != z && !numbers_.at(change_.x_of_z(z_), numbers.data(), nullptr)) {
      z_ = z;
      free_ = free;
    }
    return free_.size() != free.size();
  }

  // The variables without those that are held and pressed against their bound.
  std::vector<std::size_t> movable(const Eigen::VectorXd& gradient) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < z_.size(); ++i) {
      const bool is_held = std::ranges::find(free_, i) == free_.end();
      if (!is_held || !is_pressed(i, gradient[static_cast<Eigen::Index>(i)])) found.push_back(i);
    }
    return found;
  }

  // Frees what is held and would leave its bound; whether anything was.
  bool lets_go() {
    if (free_.size() == z_.size()) return false;
    Eigen::VectorXd numbers;
    RowByRow jacobian;
    if (!derivatives(numbers, jacobian)) return false;
    std::vector<std::size_t> found = movable(jacobian.transpose() * numbers);
    const bool is_more = found.size() != free_.size();
    free_ = std::move(found);
    return is_more;
  }

  // Whether the least of the linear problem is near, in the unknowns that may move.
  bool is_least() const {
    Eigen::VectorXd numbers;
    RowByRow jacobian;
    if (!derivatives(numbers, jacobian)) return false;
    const std::vector<std::size_t> free = movable(jacobian.transpose() * numbers);
    if (free.empty()) return true;
    RowByRow of_free(jacobian.rows(), std::ssize(free));
    for (std::size_t k = 0; k < free.size(); ++k) {
      of_free.col(static_cast<Eigen::Index>(k)) = jacobian.col(static_cast<Eigen::Index>(free[k]));
    }
    detail::to_unit_columns(of_free);
    const Eigen::ColPivHouseholderQR<RowByRow> qr(of_free);
    const Eigen::VectorXd turned = qr.matrixQ().adjoint() * numbers;
    const double step2 = turned.head(qr.rank()).squaredNorm();
    return step2 <=
           std::max(problem_.nearness * problem_.nearness, near_cost * numbers.squaredNorm());
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
            polhode::detail::rounded_text(result.x[i]);
    }
    return "not converged: residuals or their derivatives are not numbers at " + at;
  }

  const LeastSquares& problem_;
  detail::ResidualVector numbers_;
  detail::ChangeOfVariable change_;
  std::vector<double> z_;
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
  const detail::ResidualVector numbers(problem);
  const auto n = std::ssize(problem.unknowns);
  if (std::ssize(result.x) != n) {
    throw DomainError("degrees_of_freedom: a result of " + std::to_string(result.x.size()) +
                      " unknowns for a problem of " + std::to_string(n));
  }
  Eigen::VectorXd f(static_cast<Eigen::Index>(numbers.size()));
  RowByRow J(f.size(), n);
  if (!numbers.at(result.x, f.data(), J.data(), detail::ResidualVector::Derivatives::weighted)) {
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
                         polhode::detail::rounded_text(std::max(freedom, 0.0)) +
                         " degrees of freedom and chi-square " +
                         polhode::detail::rounded_text(result.chi_square);
      break;
    }
    const double factor = std::sqrt(result.chi_square / freedom);
    is_settled = std::abs(factor / problem.error_factor - 1.0) <= same_factor;
    problem.error_factor = factor;
    if (is_settled) break;
    if (k + 1 == most_scalings) {
      result.sentence += "; the factor of errors did not settle: it is " +
                         polhode::detail::rounded_text(factor) + " or near it";
    }
    for (std::size_t i = 0; i < problem.unknowns.size(); ++i)
      problem.unknowns[i].start = result.x[i];
  }
  result.iterations = iterations;
  result.evaluations = evaluations;
  return result;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
