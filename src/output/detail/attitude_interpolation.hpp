// SPDX-License-Identifier: MIT
// How far the attitudes that a reader interpolates between the rows of a file are from the motion.
//
// Equations   every other row is left out and interpolated from the rows beside it; a polynomial of
//             degree d is 2^(d+1) times nearer at half the spacing, and `ends` times farther in the
//             first interval of its rows than in the middle one. Rows do not show whole
//             revolutions between them. If the body rotates by theta = |omega| step from row to row
//             about a fixed axis, a polynomial of degree d of its quaternion is off by about
//             2 (theta/2)^(d+1)/(d+1)! prod |s - s_i| in the first interval of its rows, and
//             angles, from theta = pi on, by up to pi.
// Domain      rows that rise in time, evenly or nearly so.
// Accuracy    a bound to within a factor of some ten for rows that resolve the rotation; where
//             they do not, the error that was found, in whole.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string_view>

#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// What a file says of its interpolation.
struct Interpolation {
  std::string_view method;  // of CCSDS: LINEAR, LAGRANGE, HERMITE
  int degree;
  std::size_t rows;  // from which a value is interpolated, even
  double ends;

  // Of a file of so many rows, which may be too few for `degree`.
  int degree_of(std::int64_t rows_written) const;
};
inline constexpr Interpolation linear_angles{"LINEAR", 1, 2, 1.0};
inline constexpr Interpolation lagrange_quaternions{"LAGRANGE", 7, 8, 12.3};
inline constexpr Interpolation hermite_quaternions{"HERMITE", 7, 4, 2.8};

// From this error on a writer warns: 0.01 degrees.
inline constexpr double interpolation_limit = 1.75e-4;

class InterpolationError {
 public:
  // The numbers that are interpolated: a quaternion, or three angles in the order of their
  // rotations 3, 1, 3. The slopes are used by HERMITE only.
  struct Row {
    double t;
    std::array<double, 4> x;
    std::array<double, 4> slope;
    Quaternion q;
    double rate;  // |omega|, in rad per unit of t
  };

  explicit InterpolationError(const Interpolation& interpolation)
      : interpolation_(interpolation), span_(2 * interpolation.rows - 1) {}

  void add(const Row& row);
  // In rad, of a file of so many rows: those that were added are its last ones.
  double estimate(std::int64_t rows_written) const;

 private:
  double of_middle(std::size_t first, std::size_t nodes) const;
  double at_spacing(double found, std::size_t nodes) const;
  double of_turn(std::int64_t rows_written) const;

  Interpolation interpolation_;
  std::size_t span_;
  std::deque<Row> rows_;
  double largest_ = 0.0;
  double turn_ = 0.0;  // the largest angle from row to row
  bool is_full_ = false;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
