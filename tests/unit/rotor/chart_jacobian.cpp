// SPDX-License-Identifier: MIT
// Jacobians of the canonical charts as near to a pole of the chart as doubles come.
#include "polhode/rotor/chart_jacobian.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "property/chart_support.hpp"

namespace {

using namespace polhode;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int near_exponent = 100;  // double-double holds every quotient of this distance
constexpr double singular = 0x1p50, regular = 0x1p-50;
const Quaternion attitude{0.5, -0.5, 0.1, 0.7};

const std::vector<CanonicalChart>& charts() {
  static const std::vector<CanonicalChart> all{{CanonicalSet::andoyer},
                                               {CanonicalSet::poincare, Pole::zero, Pole::zero},
                                               {CanonicalSet::poincare, Pole::zero, Pole::pi},
                                               {CanonicalSet::poincare, Pole::pi, Pole::zero},
                                               {CanonicalSet::poincare, Pole::pi, Pole::pi}};
  return all;
}

// The momentum 2^-n from axis 3, and the figure axis as far from the inertial one.
RotorState momentum_near_axis(const Quaternion& q, double side, int n) {
  return {q, {std::ldexp(0.9, -n), std::ldexp(-0.4, -n), side}};
}
RotorState attitude_near_pole(int n) {
  return {{0.6, std::ldexp(0.3, -n), std::ldexp(0.4, -n), 0.8}, {0.3, -0.2, 0.7}};
}

// Entries that are quotients grow like the inverse distance, exactly but for rounding; the rest
// stays, and nothing is NaN.
void expect_inverse_distance(const Matrix6& m, const Matrix6& near, int n, bool all) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      EXPECT_FALSE(std::isnan(m(i, j))) << n << ", entry " << i << ", " << j;
      const double size = std::abs(near(i, j));
      if (size < singular && !(all && size > regular)) continue;
      const double wanted = std::ldexp(near(i, j), size < singular ? 0 : n - near_exponent);
      EXPECT_NEAR(m(i, j), wanted, budget::pole_jacobian_eps * eps * std::abs(wanted))
          << n << ", entry " << i << ", " << j;
    }
}

constexpr std::array<int, 5> exponents{299, 301, 700, 996, 1015};

TEST(ChartJacobian, NextToAPoleOfJ) {
  for (const CanonicalChart& chart : charts()) {
    for (const double side : {1.0, -1.0}) {
      const RotorState near = momentum_near_axis(attitude, side, near_exponent);
      for (const int n : exponents)
        expect_inverse_distance(chart_jacobian(momentum_near_axis(attitude, side, n), chart),
                                chart_jacobian(near, chart), n, true);
    }
  }
}

// The last bits of the regular entries are those of a difference there.
TEST(ChartJacobian, NextToPolesOfJAndI) {
  for (const CanonicalChart& chart : charts()) {
    for (const Quaternion& q : {Quaternion{0.6, 0.0, 0.0, 0.8}, Quaternion{0.0, 0.6, 0.8, 0.0}}) {
      const RotorState near = momentum_near_axis(q, -1.0, near_exponent);
      for (const int n : exponents)
        expect_inverse_distance(chart_jacobian(momentum_near_axis(q, -1.0, n), chart),
                                chart_jacobian(near, chart), n, false);
    }
  }
}

TEST(ChartJacobian, NextToAPoleOfTheta) {
  const CanonicalChart euler{CanonicalSet::euler};
  const RotorState near = attitude_near_pole(near_exponent);
  for (const int n : exponents) {
    const RotorState s = attitude_near_pole(n);
    expect_inverse_distance(chart_jacobian(s, euler), chart_jacobian(near, euler), n, true);
    expect_inverse_distance(inverse_chart_jacobian(s, euler), inverse_chart_jacobian(near, euler),
                            n, true);
  }
}

// theta of either sign: the same divisor but for its sign.
TEST(ChartJacobian, NextToAPoleOfThetaOnEitherSide) {
  for (const double theta : {0x1p-990, 0x1p-1000, 0x1p-1015}) {
    const EulerState s{0.3, theta, 0.7, 0.4, 0.2, 0.4};
    EulerState other = s;
    other.theta = -theta;
    const Matrix6 B = chart_jacobian(s), C = chart_jacobian(other);
    for (int i = 0; i < 2; ++i) {
      EXPECT_TRUE(std::isfinite(B(i + 3, 3))) << theta;
      EXPECT_EQ(C(i + 3, 3), -B(i + 3, 3)) << theta;
    }
  }
}

// What turns the body about its momentum leaves the momentum in space alone, and by G it grows in
// the inertial plane, 1/sin I, or along half the way to it: the derivatives of the conjugates by
// the attitude are 0 and of this length.
TEST(ChartJacobian, InverseNextToAPoleOfJ) {
  for (const CanonicalChart& chart : charts()) {
    for (const double side : {1.0, -1.0}) {
      for (const int n : {41, 60, near_exponent, 299, 301, 700, 996, 1015}) {
        const RotorState s = momentum_near_axis(attitude, side, n);
        const Matrix6 C = inverse_chart_jacobian(s, chart);
        const Vec3 g = inertial_momentum(s);
        const double G = norm(g), across = std::hypot(g.x, g.y);
        const bool pairs = chart.set == CanonicalSet::poincare;
        const double half_square = 0.5 * (chart.pole_I == Pole::zero ? G + g.z : G - g.z) / G;
        const double wanted = pairs ? 1.0 / std::sqrt(half_square) : G / across;
        const int by_G = pairs ? 0 : 1;
        EXPECT_NEAR(norm(Vec3{C(by_G, 0), C(by_G, 1), C(by_G, 2)}), wanted,
                    budget::pole_jacobian_eps * eps * wanted)
            << n;
        if (pairs && (chart.pole_J == Pole::zero) == (side > 0.0)) continue;  // not at a pole
        for (const int i : pairs ? std::array<int, 3>{1, 3, 4} : std::array<int, 3>{0, 3, 4})
          for (int j = 0; j < 3; ++j) EXPECT_EQ(C(i, j), 0.0) << n << " " << i << " " << j;
      }
    }
  }
}

TEST(ChartJacobian, TransformationsNextToAPole) {
  for (const double side : {1.0, -1.0}) {
    const RotorState near = momentum_near_axis(attitude, side, near_exponent);
    const PoincareState p = nearest_poincare(near);
    const CanonicalChart from{CanonicalSet::poincare, p.pole_J, p.pole_I};
    for (const CanonicalChart& to : charts())
      for (const int n : exponents)
        expect_inverse_distance(
            canonical_transformation(momentum_near_axis(attitude, side, n), from, to),
            canonical_transformation(near, from, to), n, false);
  }
}

}  // namespace
