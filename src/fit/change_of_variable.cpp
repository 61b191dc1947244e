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
// What the mixing of two sides of a triangle, and whoever divided by a third, may round.
constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace

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
      throw DomainError("solve: the bounds of " + u.name + ", " + number_text(low) + " and " +
                        number_text(high) + ", must leave room between them");
    }
    const double slack = is_a || is_b ? rounding * (1.0 + std::abs(u.start)) : 0.0;
    if (!std::isfinite(u.start) || !(z[i] >= low - slack) || !(z[i] <= high + slack)) {
      throw DomainError(
          "solve: the start of " + u.name + ", " + number_text(u.start) +
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
  return names_[i] + " is on its bound, " + number_text(low ? v.low() : v.high());
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
