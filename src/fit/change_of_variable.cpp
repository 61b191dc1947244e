// SPDX-License-Identifier: MIT
#include "fit/detail/change_of_variable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// How near to a bound counts as on it.
constexpr double near = 1e-5;

}  // namespace

BoundedVariable::BoundedVariable(double low, double high, double start)
    : low_(low), high_(high), start_(start) {
  if (std::isfinite(low) != std::isfinite(high)) {
    length_ = std::isfinite(low) ? start - low : high - start;
  }
}

double BoundedVariable::z(double y) const {
  const bool below = std::isfinite(low_), above = std::isfinite(high_);
  if (below && above) return low_ + (high_ - low_) * (0.5 + 0.5 * std::sin(y));
  // y^2 / (1 + sqrt(1 + y^2)), not sqrt(1 + y^2) - 1: cancels
  const double away = length_ * (y * y / (1.0 + std::hypot(1.0, y)));
  if (below) return low_ + away;
  return above ? high_ - away : y;
}

double BoundedVariable::slope(double y) const {
  const bool below = std::isfinite(low_), above = std::isfinite(high_);
  if (below && above) return 0.5 * (high_ - low_) * std::cos(y);
  const double away = length_ * y / std::hypot(1.0, y);
  if (below) return away;
  return above ? -away : 1.0;
}

double BoundedVariable::start() const {
  const bool below = std::isfinite(low_), above = std::isfinite(high_);
  if (below && above) return std::asin(2.0 * ((start_ - low_) / (high_ - low_)) - 1.0);
  return below || above ? std::sqrt(3.0) : start_;
}

bool BoundedVariable::is_at_low(double z) const {
  const double room = std::isfinite(high_) ? high_ - low_ : length_;
  return std::isfinite(low_) && z - low_ <= near * room;
}

bool BoundedVariable::is_at_high(double z) const {
  const double room = std::isfinite(low_) ? high_ - low_ : length_;
  return std::isfinite(high_) && high_ - z <= near * room;
}

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
      throw DomainError("solve: the bounds of " + u.name + ", " + number_text(low) + " and " +
                        number_text(high) + ", must leave room between them");
    }
    if (!std::isfinite(u.start) || !(z[i] > low) || !(z[i] < high)) {
      throw DomainError(
          "solve: the start of " + u.name + ", " + number_text(u.start) +
          ", must lie between its bounds" +
          (is_a || is_b ? ", which are those of the triangle inequality of moments" : ""));
    }
    variables_.emplace_back(low, high, z[i]);
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
  const BoundedVariable& v = variables_[i];
  return names_[i] + " is on its bound, " + number_text(low ? v.low() : v.high());
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
