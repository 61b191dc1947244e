// SPDX-License-Identifier: MIT
// Unknowns within bounds as functions of variables without any.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "polhode/fit/least_squares.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// One variable y and z(y) in [low, high].
class BoundedVariable {
 public:
  BoundedVariable(double low, double high, double start);
  double z(double y) const;
  double slope(double y) const;  // dz/dy
  double start() const;          // y of the start
  // The bound that z is on to a part in 1e5 of the room, or of its distance at the start.
  bool is_at_low(double z) const;
  bool is_at_high(double z) const;
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double low_, high_, start_;
  double length_ = 1.0;  // of a half-open interval
};

// x = M z, where M mixes the two unknowns of a triangle: with the moments y + z', x + z', x + y of
// second moments x, y, z' and x + y = 1, I1 = 1 - s + w and I2 = s + w for s = x, w = z', so that
// the triangle inequalities are 0 <= s <= 1 and 0 <= w.
class ChangeOfVariable {
 public:
  explicit ChangeOfVariable(const LeastSquares& problem);

  std::size_t size() const { return variables_.size(); }
  const BoundedVariable& operator[](std::size_t i) const { return variables_[i]; }
  std::vector<double> x_of_z(const std::vector<double>& z) const;
  std::vector<double> z_of_x(const std::vector<double>& x) const;
  // d/dx of one number into d/dz, in place.
  void to_z(double* derivatives) const;
  // What it means that variable i is on its lower or upper bound.
  std::string bound_text(std::size_t i, bool low) const;

 private:
  std::vector<BoundedVariable> variables_;
  std::vector<std::string> names_;
  std::optional<TriangleBound> triangle_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
