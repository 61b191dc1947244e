// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace {

using namespace polhode;
using oracle::Draw;

std::vector<shape::PointMass> drawn_points(std::uint64_t seed, const Mat3& R = Mat3::identity()) {
  Draw draw(seed, 0);
  std::vector<shape::PointMass> points;
  for (int i = 0; i < 7; ++i) {
    const double mass = draw.uniform(0.1, 1.0);
    const Vec3 x{draw.normal(), draw.normal(), draw.normal()};
    points.push_back({mass, R * x});
  }
  return points;
}

Mat3 drawn_rotation(std::uint64_t seed) {
  Draw draw(seed, 1);
  return rotation_matrix(
      normalized(Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}));
}

// The words of the header, letter by letter.
TEST(MassMoments, OrderIsThatOfTheHeader) {
  const std::vector<std::string> third{"xxx", "xxy", "xxz", "xyy", "xyz",
                                       "xzz", "yyy", "yyz", "yzz", "zzz"};
  const std::vector<std::string> fourth{"xxxx", "xxxy", "xxxz", "xxyy", "xxyz",
                                        "xxzz", "xyyy", "xyyz", "xyzz", "xzzz",
                                        "yyyy", "yyyz", "yyzz", "yzzz", "zzzz"};
  const shape::PointMass p{2.0, {3.0, 5.0, 7.0}};
  const shape::MassMoments m = shape::mass_moments(std::span<const shape::PointMass>(&p, 1));
  const auto value = [](const std::string& word) {
    double product = 2.0;
    for (const char letter : word) product *= letter == 'x' ? 3.0 : (letter == 'y' ? 5.0 : 7.0);
    return product;
  };
  ASSERT_EQ(m.third.size(), third.size());
  ASSERT_EQ(m.fourth.size(), fourth.size());
  for (std::size_t i = 0; i < third.size(); ++i) EXPECT_EQ(m.third[i], value(third[i]));
  for (std::size_t i = 0; i < fourth.size(); ++i) EXPECT_EQ(m.fourth[i], value(fourth[i]));
}

// Turned moments are those of the turned points.
TEST(MassMoments, RotatedAsThePointsAre) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Mat3 R = drawn_rotation(seed);
    const shape::MassMoments got =
        shape::rotated(shape::mass_moments<double>(drawn_points(seed)), R);
    const shape::MassMoments want = shape::mass_moments<double>(drawn_points(seed, R));
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_NEAR(got.third[i], want.third[i], budget::mass_moments_rotated);
    for (std::size_t i = 0; i < 15; ++i)
      EXPECT_NEAR(got.fourth[i], want.fourth[i], budget::mass_moments_rotated);
  }
}

// A quarter turn about z moves x to y and y to -x, without rounding.
TEST(MassMoments, QuarterTurnByHand) {
  const Mat3 R{{{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
  shape::MassMoments m;
  m.third[shape::moment_place(0, 0)] = 4.0;   // xxx
  m.fourth[shape::moment_place(1, 1)] = 3.0;  // xxyz
  const shape::MassMoments turned = shape::rotated(m, R);
  EXPECT_EQ(turned.third[shape::moment_place(3, 0)], 4.0);
  EXPECT_EQ(turned.fourth[shape::moment_place(2, 1)], -3.0);
  EXPECT_EQ(shape::rotated(turned, transpose(R)), m);
}

}  // namespace
