// SPDX-License-Identifier: MIT
// Unknowns x as variables z, each in an interval of its own.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "polhode/fit/least_squares.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
