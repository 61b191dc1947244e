// SPDX-License-Identifier: MIT
// Flow-adapted charts at the ends of double range and as near to an axis as doubles come.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using free_test::pi;
using testing::HasSubstr;

const Quaternion attitude{0.5, -0.5, 0.1, 0.7};
Vec3 times(double size, const Vec3& v) { return {size * v.x, size * v.y, size * v.z}; }

// Neither side of the separatrix is given by G and T, and yet the state is.
TEST(ChartEdges, SerretNextToTheMiddleAxis) {
  for (const auto& [body, across] :
       {std::pair{Body(1.0, 1.7, 2.1), 1e-20}, std::pair{Body(2.1, 1.7, 1.0), 1e-20},
        std::pair{Body(0.9, 1.0, 1.1), 1e-100}, std::pair{Body(0.5, 0.7, 1.1), 1e-12}}) {
    for (const double side : {1.0, -1.0}) {
      for (const double turn : {0.0, 0.7, 1.6, 3.0, 4.5}) {
        const RotorState s{attitude, {across * std::cos(turn), side, across * std::sin(turn)}};
        const FreeRotation motion(body, s, 2.5);
        const SerretState e = to_serret(motion, 2.5);
        EXPECT_LE(difference(to_rotor(body, e, 2.5), s), budget::serret_beside_separatrix)
            << across << " " << turn;
      }
    }
  }
}

TEST(ChartEdges, SerretAlongAPolhodeThatTCannotTellFromTheSeparatrix) {
  const Body body(1.0, 1.7, 2.1);
  const FreeRotation motion(body, {attitude, {0.0, 1.0, 1e-18}});
  for (int i = -20; i <= 20; ++i) {
    const double t = 0.05 * i * motion.polhode_period();
    EXPECT_LE(difference(to_rotor(body, to_serret(motion, t), t), motion.at(t)),
              budget::serret_beside_separatrix)
        << i;
  }
}

TEST(ChartEdges, SerretNeedsAnEnergyThatADoubleHolds) {
  const Body body(1.0, 1.7, 2.1);
  const Vec3 g{0.3, -0.2, 0.7};
  for (const double size : {1e-160, 1e-300, 1e160, 1e300}) {
    const FreeRotation motion(body, {attitude, times(size, g)});
    EXPECT_THAT(message_of([&] { static_cast<void>(to_serret(motion, 0.0)); }),
                AllOf(HasSubstr("to_serret: T = "), HasSubstr("must be within double range")))
        << size;
  }
  SerretState e = to_serret(FreeRotation(body, {attitude, g}), 0.0);
  e.G *= 1e-160;
  e.H *= 1e-160;
  e.T = e.T * 1e-160 * 1e-160;
  EXPECT_REJECTED(to_rotor(body, e, 0.0), "needs T within double range");
  // other units of the same body hold it
  const Body small(1e-160, 1.7e-160, 2.1e-160);
  const RotorState s{attitude, times(1e-160, g)};
  const FreeRotation motion(small, s);
  EXPECT_LE(difference(to_rotor(small, to_serret(motion, 0.0), 0.0), s), budget::free_state);
}

// Powers of two are exact: the numbers of a chart, and its derivatives, are those of momenta of
// order 1.
TEST(ChartEdges, SadovDoesNotDependOnTheUnitOfMomentum) {
  for (const Vec3& moments : {Vec3{1.0, 1.7, 2.1}, Vec3{2.1, 1.0, 1.7}, Vec3{1.0, 1.0, 1.0}}) {
    const Body body(moments.x, moments.y, moments.z);
    for (const Vec3& g : {Vec3{0.3, -0.2, 0.7}, Vec3{0.9, 0.1, 0.2}, Vec3{0.0, 0.0, 1.0}}) {
      const SadovState unit = to_sadov(FreeRotation(body, {attitude, g}), 0.0);
      const Matrix6 B1 = chart_jacobian(body, unit);
      for (const int e : {997, -997, 300, -700}) {
        const double size = std::ldexp(1.0, e);
        const SadovState s{unit.phi_l,      unit.phi_g,      unit.phi_h,  size * unit.I_l,
                           size * unit.I_g, size * unit.I_h, unit.region, unit.lobe};
        const SadovState read = to_sadov(FreeRotation(body, {attitude, times(size, g)}), 0.0);
        for (const auto& [x, y] : {std::pair{read.phi_l, s.phi_l}, std::pair{read.phi_g, s.phi_g},
                                   std::pair{read.phi_h, s.phi_h}, std::pair{read.I_l, s.I_l},
                                   std::pair{read.I_g, s.I_g}, std::pair{read.I_h, s.I_h}})
          EXPECT_LE(relative(x, y), budget::free_constants_eps * eps) << e;
        const RotorState back = to_rotor(body, s), expected = to_rotor(body, unit);
        EXPECT_EQ(back, (RotorState{expected.q, times(size, expected.g)})) << e;
        const Matrix6 B = chart_jacobian(body, s);
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j) {
            if (std::isinf(B1(i, j))) continue;
            if (std::isnan(B1(i, j))) {  // J = 0 and the sphere: the set is singular
              ASSERT_TRUE(g.x == 0.0 || moments.x == moments.z) << e;
              EXPECT_TRUE(std::isnan(B(i, j))) << e;
              continue;
            }
            EXPECT_EQ(B(i, j), std::ldexp(B1(i, j), (i < 3 ? 0 : e) - (j < 3 ? 0 : e)));
          }
      }
    }
  }
}

// Derivatives by the actions, of a needle or next to a spin, that double-double holds for I_g of
// order 1 alone.
TEST(ChartEdges, SadovJacobianOfNeedlesAndSpinsInAnyUnit) {
  const double after_1 = std::nextafter(1.0, 2.0);
  struct Case {
    Vec3 moments, g;
    int exponent;
  };
  for (const auto& [moments, g, e] :
       {Case{{3.0, 4.0, 6.0}, {1.0, 0.0, 0.0}, 332}, Case{{1.0, 0.58, 0.99}, {0.0, -1.0, 0.0}, 399},
        Case{{1e-250, 1.0, after_1}, {0.03, 0.3, 0.9}, -333},
        Case{{1e-250, 1.0, after_1}, {-1e-100, 1.0, 1e-101}, -333}}) {
    const Body body(moments.x, moments.y, moments.z);
    const SadovState unit = to_sadov(FreeRotation(body, {attitude, g}), 0.0);
    SadovState s = unit;
    for (double* action : {&s.I_l, &s.I_g, &s.I_h}) *action = std::ldexp(*action, e);
    const Matrix6 B1 = chart_jacobian(body, unit), B = chart_jacobian(body, s);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        EXPECT_EQ(B(i, j), std::ldexp(B1(i, j), (i < 3 ? 0 : e) - (j < 3 ? 0 : e)))
            << moments.x << " " << e << ", entry " << i << ", " << j;
  }
}

// Next to the spin about the long axis the momentum along the short one is like sqrt(I_l I_g).
TEST(ChartEdges, SadovJacobianNextToASpinIsThatOfARoot) {
  const Body body(3.0, 4.0, 6.0);
  for (const double size : {1.0, 1e100, 1e-60, 1e300}) {
    const SadovState s =
        to_sadov(FreeRotation(body, {attitude, times(size, Vec3{1.0, 0.0, 1e-120})}), 0.0);
    const Matrix6 B = chart_jacobian(body, s);
    const double across = to_rotor(body, s).g.z;
    EXPECT_LE(relative(B(5, 3), 0.5 * across / s.I_l), budget::scaled_jacobian_eps * eps) << size;
    EXPECT_LE(relative(B(5, 4), 0.5 * across / s.I_g), budget::scaled_jacobian_eps * eps) << size;
  }
}

// Spins of a momentum so small that the displacement of a limit would underflow.
TEST(ChartEdges, SpinsOfAnyMomentumHaveTheirLimits) {
  const Body body(1.0, 1.7, 2.1);
  for (const double size : {1e-300, 1e-180, 1e300}) {
    for (int axis = 0; axis < 3; ++axis) {
      RotorState s{attitude, {}};
      s.g[axis] = size;
      const SadovState a = to_sadov(FreeRotation(body, s), 3.0);
      const RotorState back = to_rotor(body, a);
      EXPECT_LE(difference({back.q, times(1.0 / size, back.g)},
                           {FreeRotation(body, s).at(3.0).q, times(1.0 / size, s.g)}),
                axis == 1 ? budget::flow_pole : budget::free_state)
          << size << " " << axis;
    }
  }
}

// A component that FreeRotation takes for 0 leaves the spin what it is.
TEST(ChartEdges, SpinWithATraceOfAnotherAxis) {
  const Body body(1.0, 1.7, 2.1);
  for (const Vec3& g :
       {Vec3{1e-160, 0.0, 1.0}, Vec3{1e-300, 1e-200, -1.0}, Vec3{1.0, 0.0, 1e-200}}) {
    const RotorState s{attitude, g};
    const FreeRotation motion(body, s);
    EXPECT_LE(difference(to_rotor(body, to_sadov(motion, 0.0)), s), budget::free_state);
    EXPECT_LE(difference(to_rotor(body, to_serret(motion, 0.0), 0.0), s), budget::serret_spin);
  }
}

TEST(ChartEdges, NeedlesOfAnyRatioThatDoublesHold) {
  for (const double ratio : {1e-151, 1e-153, 1e-200, 1e-270}) {
    const Body body(ratio, 1.0, 1.0);
    for (const Vec3& g : {Vec3{0.3, -0.2, 0.7}, Vec3{0.9, 0.1, 0.2}}) {
      const RotorState s{attitude, g};
      const FreeRotation motion(body, s);
      EXPECT_LE(difference(motion.at(0.0), s), budget::free_state) << ratio;
      EXPECT_LE(difference(to_rotor(body, to_serret(motion, 0.0), 0.0), s), budget::serret_edge);
      EXPECT_LE(difference(to_rotor(body, to_sadov(motion, 0.0)), s), budget::serret_edge);
    }
  }
  EXPECT_REJECTED(FreeRotation(Body(1e-280, 1.0, 1.0), {attitude, {0.3, -0.2, 0.7}}),
                  "must have a ratio of at least 2^-900");
}

// A momentum component at the very end of double range, next to the middle axis of a small body.
TEST(ChartEdges, SubnormalComponentNextToTheMiddleAxis) {
  const double up = 0x1p525;
  for (const auto& [body, g] :
       {std::pair{Body(6e-158, 3e-158, 4e-158), Vec3{-1e-318, 0.0, -1e-158}},
        std::pair{Body(1e-158, 0.5e-158, 0.7e-158), Vec3{1e-318, 0.0, 1e-158}},
        std::pair{Body(3e-158, 4e-158, 6e-158), Vec3{0.0, -1e-158, 1e-320}}}) {
    const RotorState s{attitude, g};
    const FreeRotation motion(body, s, 2.0);
    const auto off = [&](const RotorState& r) {
      return difference({r.q, times(up, r.g)}, {s.q, times(up, g)});
    };
    EXPECT_LE(off(motion.at(2.0)), budget::free_state) << g.x << " " << g.z;
    EXPECT_LE(off(to_rotor(body, to_serret(motion, 2.0), 2.0)), budget::serret_next_to_separatrix);
    EXPECT_TRUE(std::isfinite(to_sadov(motion, 2.0).phi_g));
    EXPECT_TRUE(std::isfinite(to_tumbler(motion, 2.0).phi0));
  }
}

// The square of the momentum along the long axis is beyond double-double, and yet, over the moment,
// a rotation. The body spins about that axis while it precesses with it.
TEST(ChartEdges, NeedleWithTheMomentumAcross) {
  const double I1 = 1e-200, g1 = 1e-200;
  const Body body(I1, 1.0, 1.0);
  const RotorState s{attitude, {g1, 0.6, -0.8}};
  const FreeRotation motion(body, s);
  EXPECT_LE(relative(motion.polhode_period(), 2.0 * pi), budget::flow_values);
  EXPECT_LE(relative(motion.precession_rate_long(), 1.0), budget::flow_values);
  EXPECT_LE(relative(motion.precession_rate_short(), 2.0), budget::flow_values);
  const Vec3 about = inertial_momentum(s);
  for (const double t : {0.0, 0.4, 3.0, 50.0}) {
    const double c = std::cos(0.5 * t), sine = std::sin(0.5 * t) / norm(about);
    const Quaternion precession{c, sine * about.x, sine * about.y, sine * about.z};
    const Quaternion expected = precession * normalized(attitude) * rotation_x(t);
    const RotorState r = motion.at(t);
    EXPECT_LE(difference(r, {expected,
                             {g1, 0.6 * std::cos(t) - 0.8 * std::sin(t),
                              -0.8 * std::cos(t) - 0.6 * std::sin(t)}}),
              budget::free_state)
        << t;
  }
  for (const double ratio : {1e-50, 1e-120, 1e-200}) {
    const Body needle(ratio, 1.0, 1.0);
    const RotorState across{attitude, {-1e-160 * std::sqrt(ratio / 1e-50), 0.6, -0.8}};
    const FreeRotation m(needle, across);
    EXPECT_LE(difference(m.at(0.0), across), budget::free_state) << ratio;
    EXPECT_LE(difference(to_rotor(needle, to_sadov(m, 0.0)), across), budget::serret_edge);
    EXPECT_LE(relative(to_tumbler(m, 0.0).precession_period, 2.0 * pi), budget::flow_values);
  }
}

// The momentum along a needle, far below the rounding of |g|, is what sets its rate and its sign.
TEST(ChartEdges, SerretReadsANeedleFromTheMotion) {
  const Body body(1e-152, 1.0, 1.0);
  const double along = 5.93e-82, rate = along / 1e-152;
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i < 24; ++i) {
      const double turned = 0.1 + 0.25 * i, t = 1e-71;
      const Vec3 g{side * along, std::sin(turned), std::cos(turned)};
      const SerretState e = to_serret(FreeRotation(body, {attitude, g}, t), t);
      EXPECT_EQ(e.sign_g1, side) << i;
      EXPECT_LE(std::abs(std::remainder(rate * (t - e.t0) - side * turned, pi)),
                budget::flow_values)
          << i;
    }
  }
}

// Moments one ulp apart: G and T hold the state, or say that they do not.
TEST(ChartEdges, SerretOfNeedlesWithMomentsEqualButForRounding) {
  const double above = std::nextafter(1.0, 2.0);
  int held = 0;
  for (const auto& [body, g] : {std::pair{Body(1e-152, 1.0, above), Vec3{1.45e-84, 0.234, -0.972}},
                                std::pair{Body(above, 1e-160, 1.0), Vec3{-0.708, 1.06e-188, 0.706}},
                                std::pair{Body(1e-250, above, 1.0), Vec3{1.41e-135, -1.41e-5, 1.0}},
                                std::pair{Body(1e-250, above, 1.0), Vec3{1e-150, -0.6, 0.8}}}) {
    const RotorState s{attitude, g};
    const FreeRotation motion(body, s);
    const std::string said = message_of([&] {
      if (!(difference(to_rotor(body, to_serret(motion, 0.0), 0.0), s) <=
            budget::serret_next_to_separatrix))
        throw DomainError("another state");
      ++held;
    });
    EXPECT_THAT(said, AnyOf("", HasSubstr("must hold the distance from the separatrix")));
  }
  EXPECT_GT(held, 0);
}

// The smaller the difference of two moments, the more of it T loses: then the place on the curve
// that T means is not that of the phase.
TEST(ChartEdges, SerretOfMomentsThatDifferBySomeRoundings) {
  for (const double gap : {1e-13, 1e-12, 1e-11, 1e-10, 1e-8, 1e-6}) {
    for (const auto& [body, side] :
         {std::pair{Body(0.8, 1.0 - gap, 1.0), 1.0}, std::pair{Body(0.8, 0.8 + gap, 1.0), -1.0}}) {
      for (const Vec3& g : {Vec3{1e-20, side, 2e-20}, Vec3{0.0, side, 1e-9},
                            Vec3{1e-9 * std::sqrt(gap), side, 3e-10}}) {
        const RotorState s{attitude, g};
        EXPECT_LE(difference(to_rotor(body, to_serret(FreeRotation(body, s), 0.0), 0.0), s),
                  budget::serret_next_to_separatrix)
            << gap << " " << side << " " << g.z;
      }
    }
  }
}

// A polhode so slow that it began 1e10 turns ago: the rounding of t0 is then a turn of the body.
TEST(ChartEdges, SerretOfASpinAboutTheMiddleAxisOfMomentsEqualButForRounding) {
  int held = 0;
  for (const double size : {1.0, 0x1p505, 0x1p-505}) {
    const Body body(0.8 * size, size, std::nextafter(size, 2.0 * size));
    for (const double t : {0.0, -1.89, 7.76}) {
      const RotorState s{attitude, {0.0, 1.25 * size, 0.0}};
      const FreeRotation motion(body, s, t);
      RotorState back{};
      const std::string said = message_of([&] { back = to_rotor(body, to_serret(motion, t), t); });
      if (said == "") {
        ++held;
        EXPECT_LE(difference({back.q, times(1.0 / size, back.g)}, {s.q, times(1.0 / size, s.g)}),
                  budget::serret_next_to_separatrix)
            << size << " " << t;
      } else {
        EXPECT_THAT(said, HasSubstr("must hold the distance from the separatrix"));
      }
    }
  }
  EXPECT_GT(held, 0);
}

// The action about the axis that the momentum is nearly across is small, and not negative.
TEST(ChartEdges, SadovOfANeedleAcrossItsAxis) {
  for (const double g1 : {1e-130, -1e-130}) {
    const FreeRotation motion(Body(1e-50, 1.0, 1.0), {attitude, {g1, 0.8, 0.6}});
    const SadovState s = to_sadov(motion, 0.0);
    EXPECT_GT(s.I_l, 0.0) << g1;
    EXPECT_EQ(s.lobe < 0, g1 < 0.0);
  }
}

// |I_l| and |I_h| may be above I_g by a rounding or two, as sums of other programs are.
TEST(ChartEdges, SadovTakesActionsThatARoundingPutsAboveTheThird) {
  const Body body(1.0, 1.7, 2.1);
  const double above = 1.0 + 4.0 * epsilon<double>();
  const FreeRotation spin(body, {attitude, {0.0, 0.0, 1.0}});
  SadovState s = to_sadov(spin, 0.0);
  s.I_l *= above;
  EXPECT_LE(difference(to_rotor(body, s), spin.at(0.0)), budget::free_invariants);
  s.I_h = s.I_g * above;
  EXPECT_EQ(message_of([&] { static_cast<void>(to_rotor(body, s)); }), "");
  s.I_h = s.I_g * (1.0 + 64.0 * epsilon<double>());
  EXPECT_REJECTED(to_rotor(body, s), "|I_h| <= I_g");
}

// NaN in, NaN out: next to the separatrix, too.
TEST(ChartEdges, SerretAtATimeThatIsNoNumber) {
  const FreeRotation near_separatrix(Body(1.0, 1.7, 2.1), {attitude, {1e-9, 1.0, 1e-10}});
  for (const double t : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_TRUE(std::isnan(to_serret(near_separatrix, t).g0)) << t;
}

TEST(ChartEdges, SerretNeedsATimeThatADoubleHolds) {
  const FreeRotation slow(Body(0.8e300, 1e300, 1e300), {attitude, {-9e-21, -1.0, -4e-21}});
  EXPECT_THAT(message_of([&] { static_cast<void>(to_serret(slow, 0.0)); }),
              AllOf(HasSubstr("to_serret: t0 = "), HasSubstr("must be within double range")));
}

// Spin about the long axis where the lesser moments are equal but for rounding: its polhodes are so
// long that the periods tell a small one.
TEST(ChartEdges, TumblersWithLesserMomentsEqualButForRounding) {
  for (const double a : {0.63, 0.84, 0.92}) {
    const Body body(std::nextafter(a, 1.0), a, 1.0);
    for (const double across : {1e-20, 1e-10}) {
      const RotorState s{attitude, {-across, 1.0, 0.0}};
      EXPECT_LE(difference(to_rotor(body, to_tumbler(FreeRotation(body, s), 0.0)), s),
                budget::tumbler_edge)
          << a << " " << across;
    }
  }
}

// Half a period of a tumbler close to the middle axis is 140 / n: its own description has a state.
TEST(ChartEdges, TumblersNextToTheMiddleAxisComeBack) {
  const Body body(1.0, 1.7, 2.1);
  for (const double z : {1e-10, 1e-20, 1e-60, 1e-100}) {
    for (const Vec3& g : {Vec3{0.0, 1.0, z}, Vec3{0.0, -1.0, z}, Vec3{0.0, 1.0, -z}}) {
      const RotorState s{attitude, g};
      const FreeRotation motion(body, s);
      const auto seen = to_tumbler(motion, 0.0);
      RotorState back{};
      ASSERT_EQ(message_of([&] { back = to_rotor(body, seen); }), "") << z;
      EXPECT_LE(difference(back, s), budget::free_state);
      EXPECT_LE(relative(back.g.z, g.z), budget::tumbler_edge) << z;
      EXPECT_LE(relative(FreeRotation(body, back).polhode_period(), motion.polhode_period()),
                budget::tumbler_round_trip)
          << z;
    }
  }
}

TEST(ChartEdges, TumblerPeriodsOfAnySize) {
  const RotorState unit{attitude, {0.3, -0.2, 0.7}};
  for (const double size : {1e-300, 1e-160, 1e160, 1e300}) {
    const Body body(1.0, 1.7, 2.1);
    const RotorState s{attitude, times(size, unit.g)};
    const auto seen = to_tumbler(FreeRotation(body, s), 0.0);
    EXPECT_LE(difference({attitude, times(1.0 / size, to_rotor(body, seen).g)}, unit),
              budget::tumbler_round_trip)
        << size;
  }
}

}  // namespace
