// SPDX-License-Identifier: MIT
#include "polhode/rotor/andoyer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/rotor/euler.hpp"
#include "property/chart_support.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace chart_test;
using polhode::test::smaller;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double eps = std::numeric_limits<double>::epsilon();
const Quaternion half_turn{0.0, 1.0, 0.0, 0.0};

bool in_range(const AndoyerState& a) {
  const auto ok = [](double x) { return x > -pi<double>() && x <= pi<double>(); };
  return ok(a.l) && ok(a.g) && ok(a.h) && std::abs(a.L) <= a.G && std::abs(a.H) <= a.G;
}
std::string message_of(const AndoyerState& a) {
  return test::message_of([&] { andoyer_state(a.l, a.g, a.h, a.L, a.G, a.H); });
}
Mat3 R1(double a) {
  return {{{1, 0, 0}, {0, std::cos(a), std::sin(a)}, {0, -std::sin(a), std::cos(a)}}};
}
Mat3 R3(double a) {
  return {{{std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1}}};
}

// R = R3(l) R1(J) R3(g) R1(I) R3(h) and [SA (1490)-(1492)].
TEST(Andoyer, AttitudeAndMomentumAreThoseOfThePaper) {
  Sampler sample(1);
  for (int k = 0; k < 1000; ++k) {
    const AndoyerState a{
        sample.angle(),         sample.angle(), sample.angle(), sample.uniform(-1., 1.), 1.0,
        sample.uniform(-1., 1.)};
    const double J = std::acos(a.L), I = std::acos(a.H);
    const Mat3 R = transpose(rotation_matrix(to_rotor(a).q));
    const Mat3 expected = R3(a.l) * (R1(J) * (R3(a.g) * (R1(I) * R3(a.h))));
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(R(i, j), expected(i, j), budget::chart_rounding);
    }
    const double sJ = std::sqrt(1.0 - a.L * a.L);
    const Vec3 g{sJ * std::sin(a.l), sJ * std::cos(a.l), a.L};
    EXPECT_LE(norm(to_rotor(a).g - g), budget::chart_rounding);
    EXPECT_NEAR(inertial_momentum(to_rotor(a)).z, a.H, budget::chart_rounding);
  }
}

// G, L, H and l, h by their definitions; g by the node's own directions.
TEST(Andoyer, ExtractionIsTheDefinition) {
  Sampler sample(2);
  for (int k = 0; k < 1000; ++k) {
    const RotorState s = sample.generic(3.0);
    const AndoyerState a = to_andoyer(s);
    const Vec3 G = inertial_momentum(s);
    EXPECT_TRUE(in_range(a));
    EXPECT_EQ(a.L, s.g.z);
    EXPECT_NEAR(a.G, norm(s.g), 3.0 * budget::chart_rounding);
    EXPECT_NEAR(a.H, G.z, 3.0 * budget::chart_rounding);
    EXPECT_NEAR(a.l, std::atan2(s.g.x, s.g.y), budget::chart_rounding);
    const double sI = std::sqrt(1.0 - a.H * a.H / (a.G * a.G));
    const double sJ = std::sqrt(1.0 - a.L * a.L / (a.G * a.G));
    EXPECT_LE(std::abs(angle_difference(a.h, std::atan2(G.x, -G.y))), budget::chart_rounding / sI);
    const Vec3 i{std::cos(a.h), std::sin(a.h), 0.0};
    const Vec3 j = rotate(s.q, Vec3{std::cos(a.l), -std::sin(a.l), 0.0});
    const double g = std::atan2(dot(G, cross(i, j)) / a.G, dot(i, j));
    EXPECT_LE(std::abs(angle_difference(a.g, g)), budget::chart_rounding / (sI * sJ));
  }
}

TEST(Andoyer, LimitsAtJ) {
  Sampler sample(3);
  for (int k = 0; k < 300; ++k) {
    const double I = sample.uniform(0.5, 2.6), g = sample.angle(), h = sample.angle();
    for (const bool flip : {false, true}) {
      const RotorState s = inclined_state({0.0, flip, I, false}, 0.0, g, h, 2.0);
      const AndoyerState a = to_andoyer(s);
      EXPECT_EQ(a.l, 0.0);
      EXPECT_EQ(a.L, flip ? -2.0 : 2.0);
      EXPECT_EQ(a.G, 2.0);
      EXPECT_LE(std::abs(angle_difference(a.g, g)), budget::chart_rounding);
      EXPECT_LE(hub_difference(to_rotor(a), s), budget::chart_rounding);
      // the limit of a small J with any l: g + l, and g - l at J = pi
      const double l = sample.angle();
      const RotorState close = inclined_state({1e-9, flip, I, false}, l, flip ? g + l : g - l, h);
      const AndoyerState near = to_andoyer(close);
      EXPECT_LE(hub_difference(close, {s.q, 0.5 * s.g}), budget::andoyer_limit);
      EXPECT_LE(std::abs(angle_difference(flip ? near.g - near.l : near.g + near.l, a.g)),
                budget::andoyer_limit);
    }
  }
}

TEST(Andoyer, LimitsAtI) {
  Sampler sample(4);
  // states with G exactly along +-s3: quarter turns of the axes, and spins about s3
  const std::array<RotorState, 6> exact{RotorState{{0.5, 0.5, 0.5, 0.5}, {0, 2, 0}},
                                        RotorState{{0.5, 0.5, 0.5, 0.5}, {0, -2, 0}},
                                        RotorState{{0.5, -0.5, -0.5, -0.5}, {2, 0, 0}},
                                        RotorState{{0.5, -0.5, -0.5, -0.5}, {-2, 0, 0}},
                                        RotorState{rotation_z(0.3), {0, 0, 2}},
                                        RotorState{rotation_z(0.3), {0, 0, -2}}};
  for (const RotorState& s : exact) {
    const AndoyerState a = to_andoyer(s);
    EXPECT_EQ(a.h, 0.0);
    EXPECT_EQ(std::abs(a.H), 2.0);
    EXPECT_LE(hub_difference(to_rotor(a), s), budget::chart_rounding);
    const double h = sample.angle();
    const Quaternion tilt = rotation_z(h) * rotation_x(1e-9) * rotation_z(-h);
    const AndoyerState near = to_andoyer(RotorState{tilt * s.q, s.g});
    const double l = angle_difference(near.l, a.l);
    const double J = a.L > 0 ? l : -l;  // l is free too where J = 0, pi
    const double sum = near.g + (a.H > 0 ? near.h : -near.h) + (std::abs(a.L) < 2 ? 0.0 : J);
    EXPECT_LE(std::abs(angle_difference(a.g, sum)), budget::andoyer_limit);
  }
}

TEST(Andoyer, EveryPairOfPolesWithEverySignOfZero) {
  for (const double z : {0.0, -0.0}) {
    for (const double w : {0.0, -0.0}) {
      EXPECT_EQ(to_andoyer({{1, z, w, z}, {w, z, 1}}), (AndoyerState{0, 0, 0, 1, 1, 1}));
      EXPECT_EQ(to_andoyer({{1, z, w, w}, {z, w, -1}}), (AndoyerState{0, 0, 0, -1, 1, -1}));
      EXPECT_EQ(to_andoyer({{z, 1, w, z}, {w, z, 1}}), (AndoyerState{0, 0, 0, 1, 1, -1}));
      EXPECT_EQ(to_andoyer({{w, 1, z, w}, {z, w, -1}}), (AndoyerState{0, 0, 0, -1, 1, 1}));
      const AndoyerState turned = to_andoyer({{z, w, z, 1}, {z, w, 1}});
      EXPECT_EQ(turned, (AndoyerState{0, pi<double>(), 0, 1, 1, 1}));
      // half a turn about the second axis: R3(g) with g = pi, then R1(pi)
      const AndoyerState tumbled = to_andoyer({{z, w, 1, z}, {z, w, 1}});
      EXPECT_EQ(tumbled, (AndoyerState{0, pi<double>(), 0, 1, 1, -1}));
    }
  }
}

TEST(Andoyer, WithoutMomentumTheAnglesHoldTheAttitude) {
  Sampler sample(5);
  for (int k = 0; k < 1000; ++k) {
    Quaternion q = sample.generic().q;
    if (k % 4 == 1) q = rotation_z(sample.angle());
    if (k % 4 == 2) q = rotation_z(sample.angle()) * half_turn;
    if (k % 4 == 3) q = rotation_z(sample.angle()) * rotation_x(1e-150) * rotation_z(0.3);
    const AndoyerState a = to_andoyer(RotorState{q, {0.0, -0.0, 0.0}});
    EXPECT_TRUE(in_range(a));
    EXPECT_EQ(a.L, 0.0);
    EXPECT_EQ(a.G, 0.0);
    EXPECT_EQ(a.H, 0.0);
    const RotorState back = to_rotor(a);
    EXPECT_EQ(back.g, Vec3{});
    EXPECT_LE(attitude_difference(back.q, q), budget::chart_rounding);
  }
}

// What L and G hold: cos J to about eps, so J to min(sqrt(2 eps), eps/J), and the same for I.
TEST(Andoyer, NearThePolesLosesWhatItsNumbersCannotHold) {
  Sampler sample(6);
  for (const double d : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-150, 1e-300}) {
    for (int k = 0; k < 500; ++k) {
      const double J = d * sample.uniform(0.5, 1.5), I = d * sample.uniform(0.5, 1.5);
      const RotorState s =
          inclined_state({k % 3 == 1 ? 1.0 : J, sample.coin(), k % 3 == 2 ? 1.0 : I, sample.coin()},
                         sample.angle(), sample.angle(), sample.angle());
      const AndoyerState a = to_andoyer(s);
      EXPECT_TRUE(in_range(a));
      const double lost = smaller(budget::andoyer_pole_eps * eps / d, budget::andoyer_pole);
      EXPECT_LE(hub_difference(to_rotor(a), s), budget::chart_rounding + lost);
    }
  }
}

// Angles alone, with the inclinations given exactly: g +- l +- h is what the attitude needs.
TEST(Andoyer, RegularSumLosesNothing) {
  Sampler sample(7);
  for (const double d : {1e-2, 1e-6, 1e-10, 1e-14, 1e-18}) {
    for (int k = 0; k < 500; ++k) {
      const Inclined c{d * sample.uniform(0.5, 1.5), sample.coin(), d * sample.uniform(0.5, 1.5),
                       sample.coin()};
      const double l = sample.angle(), g = sample.angle(), h = sample.angle();
      const AndoyerState a = to_andoyer(inclined_state(c, l, g, h));
      const double sJ = c.J_flip ? -1.0 : 1.0, sI = c.I_flip ? -1.0 : 1.0;
      EXPECT_LE(std::abs(angle_difference(a.g + sJ * a.l + sI * a.h, g + sJ * l + sI * h)),
                budget::andoyer_sum);
    }
  }
}

// A given L a few ulps below G says what J is, to full relative accuracy.
TEST(Andoyer, DifferencesOfMomentaKeepTheirDigits) {
  using Wide = DoubleDouble;
  Sampler sample(9);
  for (int k = 0; k < 500; ++k) {
    const double G = sample.uniform(1.0, 7.0);
    const double L = G * (1.0 - (1 + k % 7) * eps) * (sample.coin() ? 1.0 : -1.0);
    const AndoyerState a{sample.angle(), sample.angle(), sample.angle(), L, G, 0.3 * G};
    const RotorState s = to_rotor(a);
    const auto w = to_rotor(BasicAndoyerState<Wide>{a.l, a.g, a.h, a.L, a.G, a.H});
    const double size = std::hypot(s.g.x, s.g.y);
    EXPECT_LE(std::abs((Wide(s.g.x) - w.g.x).hi), budget::chart_rounding * size);
    EXPECT_LE(std::abs((Wide(s.g.y) - w.g.y).hi), budget::chart_rounding * size);
    const Quaternion q{w.q.w.hi, w.q.x.hi, w.q.y.hi, w.q.z.hi};
    EXPECT_LE(attitude_difference(s.q, q), budget::chart_rounding);
  }
}

TEST(Andoyer, MomentaBeyondGAreClampedOrRefused) {
  const AndoyerState over = andoyer_state(0.1, 0.2, 0.3, 1.0 + 2 * eps, 1.0, -1.0 - 2 * eps);
  EXPECT_EQ(over.L, 1.0);
  EXPECT_EQ(over.H, -1.0);
  EXPECT_EQ(message_of({0.1, 0.2, 0.3, 1.5, 1.0, 0.0}),
            "andoyer_state: L = 1.5 must be within +-G, G = 1");
  EXPECT_EQ(message_of({0.1, 0.2, 0.3, 0.5, 1.0, -1.0 - 8 * eps}),
            "andoyer_state: H = -1.0000000000000018 must be within +-G, G = 1");
  EXPECT_EQ(message_of({0.1, 0.2, 0.3, 0.0, -1.0, 0.0}),
            "andoyer_state: G = -1 must not be negative");
  EXPECT_EQ(message_of({0.1, inf, 0.3, 0.0, 1.0, 0.0}),
            "andoyer_state: (0.1, inf, 0.3, 0, 1, 0) must be finite");
  EXPECT_EQ(message_of({0.1, 0.2, 0.3, 0.0, 0.0, 0.0}), "");
  EXPECT_EQ(to_rotor(AndoyerState{0.1, 0.2, 0.3, 1.5, 1.0, -2.0}),
            to_rotor(AndoyerState{0.1, 0.2, 0.3, 1.0, 1.0, -1.0}));
}

TEST(Andoyer, ExtremeScalesAndNotANumber) {
  Sampler sample(8);
  for (const double G : {1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300}) {
    for (int k = 0; k < 100; ++k) {
      const RotorState s =
          inclined_state({sample.uniform(0.1, 3.0), false, sample.uniform(0.1, 3.0), false},
                         sample.angle(), sample.angle(), sample.angle(), G);
      EXPECT_LE(hub_difference(to_rotor(to_andoyer(s)), s), budget::andoyer_generic);
    }
  }
  EXPECT_TRUE(std::isnan(to_andoyer(RotorState{{1, 0, 0, 0}, {nan, 0, 1}}).G));
  EXPECT_TRUE(std::isnan(to_andoyer(RotorState{{1, nan, 0, 0}, {0, 0, 1}}).H));
  EXPECT_TRUE(std::isnan(to_rotor(AndoyerState{nan, 0, 0, 0, 1, 0}).q.w));
}

}  // namespace
