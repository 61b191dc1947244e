// SPDX-License-Identifier: MIT
#include "output/detail/attitude_interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace polhode {
namespace {

using io::detail::hermite_quaternions;
using io::detail::Interpolation;
using io::detail::interpolation_limit;
using io::detail::InterpolationError;
using io::detail::lagrange_quaternions;
using io::detail::linear_angles;

// Rows of a body that turns about its axis 3 by so many radians from row to row.
InterpolationError rows_of_a_spinner(const Interpolation& of, double turn, int count) {
  InterpolationError error(of);
  for (int k = 0; k < count; ++k) {
    const double half = 0.5 * turn * k;
    const Quaternion q{std::cos(half), 0.0, 0.0, std::sin(half)};
    const double psi =
        std::remainder(2.0 * half, 2.0 * std::numbers::pi) * 180.0 / std::numbers::pi;
    if (of.method == "LINEAR") {
      error.add({static_cast<double>(k), {0.0, 0.0, psi, 0.0}, {}, q, turn});
    } else {
      error.add({static_cast<double>(k),
                 {q.w, 0.0, 0.0, q.z},
                 {-0.5 * turn * q.z, 0.0, 0.0, 0.5 * turn * q.w},
                 q,
                 turn});
    }
  }
  return error;
}

TEST(InterpolationError, CountsWholeTurnsBetweenRows) {
  constexpr double turn = 2.0 * std::numbers::pi;
  for (const int turns : {1, 2, 3}) {
    for (const int count : {2, 5, 100}) {
      SCOPED_TRACE(testing::Message() << turns << " turns, " << count << " rows");
      EXPECT_EQ(rows_of_a_spinner(linear_angles, turns * turn, count).estimate(count),
                std::numbers::pi);
      EXPECT_GT(rows_of_a_spinner(lagrange_quaternions, turns * turn, count).estimate(count), 1.0);
      // SciPy's error is 0.096 of one turn, the first interval included
      EXPECT_GT(rows_of_a_spinner(hermite_quaternions, turns * turn, count).estimate(count), 0.096);
    }
  }
}

TEST(InterpolationError, IsSmallForARadianPerRow) {
  for (const Interpolation& of : {linear_angles, lagrange_quaternions, hermite_quaternions})
    EXPECT_LT(rows_of_a_spinner(of, 1.0, 100).estimate(100), interpolation_limit) << of.method;
}

TEST(InterpolationError, JudgesTwoRows) {
  for (const Interpolation& of : {linear_angles, lagrange_quaternions, hermite_quaternions})
    EXPECT_GT(rows_of_a_spinner(of, 1.0, 2).estimate(2), interpolation_limit) << of.method;
}

TEST(InterpolationError, OfAResumedRunIsThatOfAllItsRows) {
  for (const Interpolation& of : {linear_angles, lagrange_quaternions, hermite_quaternions})
    EXPECT_LT(rows_of_a_spinner(of, 1.0, 2).estimate(1000), interpolation_limit) << of.method;
}

TEST(Interpolation, DeclaresADegreeThatTheRowsAllow) {
  constexpr int lagrange[] = {1, 1, 2, 3, 4, 5, 6, 7, 7};
  constexpr int hermite[] = {1, 3, 5, 7, 7, 7, 7, 7, 7};
  for (int rows = 1; rows <= 9; ++rows) {
    EXPECT_EQ(lagrange_quaternions.degree_of(rows), lagrange[rows - 1]);
    EXPECT_EQ(hermite_quaternions.degree_of(rows), hermite[rows - 1]);
    EXPECT_EQ(linear_angles.degree_of(rows), 1);
  }
}

}  // namespace
}  // namespace polhode
