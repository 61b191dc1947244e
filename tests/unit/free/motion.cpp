// SPDX-License-Identifier: MIT
// What every free rotation does: it starts where it should, keeps its invariants, composes in
// time, and does not care how axes, units, time and quaternions were chosen.
#include <gmock/gmock.h>

#include "budgets.hpp"
#include "free/detail/evaluated_without_fma.hpp"
#include "message_of.hpp"
#include "polhode/rotor/attitude.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
namespace budget = polhode::budget;
using ::testing::HasSubstr;

constexpr double times[] = {0.0, 0.1, -1.7, 12.3, -345.6, 7.8e4, 1e6};

bool finite(const RotorState& s) {
  return std::isfinite(s.q.w + s.q.x + s.q.y + s.q.z + s.g.x + s.g.y + s.g.z);
}

// A relative rounding of the state at one epoch, as it is at another.
double carried(double sensitivity) { return budget::free_carried_eps * eps * sensitivity; }

TEST(Motion, StartsAtTheStateGiven) {
  for (const NamedMotion& m : motions())
    for (const double t0 : {0.0, 3.25, -1e9})
      EXPECT_LE(difference(m.motion(t0).at(t0), m.start()), budget::free_state) << m.name;
  for (const FreeCase& c : drawn_cases(11, 100))
    EXPECT_LE(difference(motion_of(c).at(c.t0), c.start), budget::free_state) << description(c);
}

TEST(Motion, RemembersWhatItWasMadeOf) {
  const NamedMotion m = motions().front();
  const FreeRotation motion = m.motion(2.5);
  EXPECT_EQ(motion.epoch(), 2.5);
  EXPECT_EQ(motion.initial_state(), m.start());
  EXPECT_EQ(motion.body().moments(), m.moments);
}

TEST(Motion, KeepsMomentumEnergyAndLength) {
  for (const NamedMotion& m : motions()) {
    const FreeRotation motion = m.motion();
    const Vec3 G = inertial_momentum(m.start());
    std::vector<double> all(std::begin(times), std::end(times));
    // beyond 1e15 turns the phase has few digits left, then none: still a state of this orbit
    for (const double far : {1e18, 1e100, 1e300, 1e308, std::numeric_limits<double>::max()})
      all.insert(all.end(), {far, -far});
    for (const double t : all) {
      const RotorState s = motion.at(t);
      ASSERT_TRUE(finite(s)) << m.name << " " << t;
      EXPECT_LE(relative(s.q.w * s.q.w + s.q.x * s.q.x + s.q.y * s.q.y + s.q.z * s.q.z, 1.0),
                budget::free_state)
          << m.name;
      EXPECT_LE(norm(inertial_momentum(s) - G), budget::free_invariants * norm(m.g)) << m.name;
      EXPECT_LE(std::abs(norm(s.g) - norm(m.g)), budget::free_state * norm(m.g)) << m.name;
      EXPECT_LE(std::abs(kinetic_energy(m.body(), s) - motion.energy()),
                budget::free_invariants * motion.energy())
          << m.name << " " << t;
    }
  }
}

// at(t) of the motion started anew from at(t1), with the rounding of at(t1) carried on.
TEST(Motion, FlowsThroughItsOwnStates) {
  for (const FreeCase& c : drawn_cases(12, 40)) {
    const FreeRotation motion = motion_of(c);
    const double t1 = c.t0 + 0.3 * (c.t - c.t0);
    const FreeRotation later(motion.body(), motion.at(t1), t1);
    EXPECT_LE(difference(later.at(c.t), motion.at(c.t)),
              budget::free_state + carried(sensitivity(later, c.t)))
        << description(c);
  }
}

TEST(Motion, ForwardThenBack) {
  for (const FreeCase& c : drawn_cases(13, 40)) {
    const FreeRotation motion = motion_of(c);
    const FreeRotation back(motion.body(), motion.at(c.t), c.t);
    EXPECT_LE(difference(back.at(c.t0), c.start),
              budget::free_state + carried(sensitivity(back, c.t0)))
        << description(c);
  }
}

// The axes of the body may be named in any order, and turned: 24 ways, one motion.
TEST(Motion, DoesNotDependOnTheOrderOfAxes) {
  for (const NamedMotion& m : motions()) {
    const FreeRotation motion = m.motion();
    for (const Turn& turn : proper_turns()) {
      // rows of the rotation, and its quaternion by way of the states it makes of the body axes
      polhode::Mat3 P{};
      Vec3 I, g;
      for (int i = 0; i < 3; ++i) {
        const auto j = static_cast<std::size_t>(i);
        P(i, turn.axis[j]) = turn.sign[j];
        I[i] = m.moments[turn.axis[j]];
      }
      g = P * m.g;
      const Quaternion q_turn = polhode::attitude(P);  // new axes to old
      const FreeRotation turned(Body(I.x, I.y, I.z), {m.start().q * q_turn, g});
      for (const double t : times) {
        const RotorState s = motion.at(t), u = turned.at(t);
        EXPECT_LE(difference({s.q * q_turn, P * s.g}, u), budget::free_state) << m.name << " " << t;
      }
    }
  }
}

// Powers of two change units without rounding: the same bits.
TEST(Motion, ScalesExactlyWithPowersOfTwo) {
  for (const NamedMotion& m : motions()) {
    const FreeRotation motion = m.motion();
    for (const auto& [a, b] : {std::pair{3, -5}, std::pair{-490, 490}, std::pair{490, 490}}) {
      const double c = std::ldexp(1.0, a), d = std::ldexp(1.0, b);
      const Vec3 I = c * m.moments;
      const FreeRotation scaled(Body(I.x, I.y, I.z), {m.start().q, d * m.g});
      for (const double t : times) {
        const RotorState s = motion.at(t), u = scaled.at(std::ldexp(t, a - b));
        EXPECT_EQ(u.q, s.q) << m.name;
        EXPECT_EQ(u.g, d * s.g) << m.name;
      }
    }
  }
}

TEST(Motion, ScalesWithAnyUnits) {
  for (const FreeCase& c : drawn_cases(14, 20)) {
    const FreeRotation motion = motion_of(c);
    const double allowed = budget::free_state + carried(sensitivity(motion, c.t)) * 100.0;
    for (const auto& [moment, momentum] :
         {std::pair{1e-150, 1e-150}, std::pair{1e150, 1e60}, std::pair{0.3, 1e150}}) {
      const Vec3 I = moment * c.moments;
      const double unit = moment / momentum;
      const FreeRotation scaled(Body(I.x, I.y, I.z), {c.start.q, momentum * c.start.g},
                                unit * c.t0);
      const RotorState s = motion.at(c.t), u = scaled.at(unit * c.t);
      EXPECT_LE(difference({u.q, (1.0 / momentum) * u.g}, s), allowed) << description(c);
    }
  }
}

TEST(Motion, TimeReversed) {
  for (const NamedMotion& m : motions()) {
    const FreeRotation motion = m.motion();
    const FreeRotation reversed(m.body(), {m.start().q, -m.g});
    for (const double t : times) {
      const RotorState s = motion.at(t);
      EXPECT_LE(difference({s.q, -s.g}, reversed.at(-t)), budget::free_state) << m.name << " " << t;
    }
  }
}

// The epoch is only a place on the clock, as long as differences of times are exact.
TEST(Motion, DoesNotDependOnTheEpoch) {
  for (const NamedMotion& m : motions()) {
    const FreeRotation motion = m.motion(), late = m.motion(0x1p30);
    for (const double t : {0.0, 0.5, -12.25, 1e6}) EXPECT_EQ(late.at(0x1p30 + t), motion.at(t));
  }
}

TEST(Motion, UsesTheDirectionOfTheQuaternionAlone) {
  for (const NamedMotion& m : motions()) {
    const RotorState s0 = m.start();
    const FreeRotation motion = m.motion();
    for (const double scale : {-1.0, 0x1p-900, 3.0, -1e200}) {
      const Quaternion q{scale * s0.q.w, scale * s0.q.x, scale * s0.q.y, scale * s0.q.z};
      const FreeRotation same(m.body(), {q, s0.g});
      for (const double t : times)
        EXPECT_LE(difference(same.at(t), motion.at(t)), budget::free_state) << m.name;
    }
  }
}

TEST(Motion, RestsExactly) {
  const RotorState s0{{2.0, 0.0, 0.0, 0.0}, {}};
  const FreeRotation m(Body(3.0, 4.0, 6.0), s0);
  for (const double t : times) EXPECT_EQ(m.at(t), (RotorState{{}, {}}));
}

// q(t) = q0 exp(omega t / 2) where omega does not move.
TEST(Motion, SteadySpinIsAUniformTurn) {
  for (const NamedMotion& m : motions()) {
    if (m.regime != Regime::steady) continue;
    const FreeRotation motion = m.motion();
    const Vec3 w = angular_velocity(m.body(), m.start());
    for (const double t : {0.1, -1.7, 12.3}) {
      const double half = 0.5 * norm(w) * t, f = std::sin(half) / norm(w);
      const Quaternion turn{std::cos(half), f * w.x, f * w.y, f * w.z};
      const RotorState s = motion.at(t);
      EXPECT_EQ(s.g, m.g) << m.name;
      EXPECT_LE(attitude_difference(s.q, m.start().q * turn), budget::free_invariants) << m.name;
    }
  }
}

// The flip: from one spin about b2 to the other, and there it stays.
TEST(Motion, SeparatrixEndsAboutTheMiddleAxis) {
  const NamedMotion m{"", {3.0, 4.0, 6.0}, {1.0, 0.5, 1.0}, Regime::separatrix};
  const FreeRotation motion = m.motion();
  EXPECT_LE(norm(motion.at(1e4).g - Vec3{0.0, 1.5, 0.0}), budget::free_state);
  EXPECT_LE(norm(motion.at(-1e4).g - Vec3{0.0, -1.5, 0.0}), budget::free_state);
  EXPECT_TRUE(finite(motion.at(1e300)));
  EXPECT_TRUE(finite(motion.at(-1e300)));
}

// A wing nut: after half a polhode period the momentum has turned by pi about the axis that it
// circles, after a whole one it is back.
TEST(Motion, PolhodeClosesAfterItsPeriod) {
  for (const NamedMotion& m : motions()) {
    if (m.regime != Regime::short_axis && m.regime != Regime::long_axis) continue;
    const FreeRotation motion = m.motion();
    const double P = motion.polhode_period();
    const int axis = m.regime == Regime::short_axis ? 2 : 0;
    const Vec3 half = motion.at(0.5 * P).g, whole = motion.at(P).g;
    for (int i = 0; i < 3; ++i) {
      const double size = budget::free_invariants * norm(m.g);
      EXPECT_NEAR(half[i], i == axis ? m.g[i] : -m.g[i], size) << m.name;
      EXPECT_NEAR(whole[i], m.g[i], size) << m.name;
    }
  }
}

TEST(Motion, NanTimesGiveNan) {
  for (const NamedMotion& m : motions()) {
    const bool g_moves = m.regime != Regime::rest && m.regime != Regime::steady;
    const FreeRotation motion = m.motion();
    for (const double t : {not_a_number, infinite, -infinite}) {
      const auto [q, g] = motion.at(t);
      EXPECT_TRUE(std::isnan(q.w) && std::isnan(q.x) && std::isnan(q.y) && std::isnan(q.z))
          << m.name << " " << t;
      if (g_moves)
        EXPECT_TRUE(std::isnan(g.x) && std::isnan(g.y) && std::isnan(g.z)) << m.name << " " << t;
      else
        EXPECT_EQ(g, m.g) << m.name << " " << t;
    }
  }
}

TEST(Motion, RefusesWhatIsNoState) {
  const Body body(3.0, 4.0, 6.0);
  const auto message = [&](const RotorState& s, double t0) {
    return message_of([&] { FreeRotation(body, s, t0); });
  };
  EXPECT_THAT(message({{0, 0, 0, 0}, {1, 2, 3}}, 0.0),
              "FreeRotation: q (0, 0, 0, 0) is not a finite, non-zero quaternion");
  EXPECT_THAT(message({{1, not_a_number, 0, 0}, {1, 2, 3}}, 0.0), HasSubstr("q (1, nan, 0, 0)"));
  EXPECT_THAT(message({{1, 0, 0, 0}, {1, infinite, 3}}, 0.0),
              "FreeRotation: g (1, inf, 3) is not finite");
  EXPECT_THAT(message({{1, 0, 0, 0}, {1, 2, 3}}, not_a_number),
              "FreeRotation: t0 = nan is not finite");
  EXPECT_REJECTED(FreeRotation::short_arc(body, {{}, {not_a_number, 0, 0}}), "is not finite");
}

// Prepared in double: as good for a few turns, and slowly worse.
TEST(Motion, ShortArcAgreesForAFewTurns) {
  for (const FreeCase& c : drawn_cases(15, 60)) {
    const FreeRotation motion = motion_of(c);
    const FreeRotation brief = FreeRotation::short_arc(motion.body(), c.start, c.t0);
    EXPECT_EQ(brief.regime(), motion.regime());
    const double turn = oracle::detail::turn_length(c);
    for (const double turns : {0.0, 0.02, -0.7, 3.0}) {
      const double t = c.t0 + turns * turn;
      EXPECT_LE(difference(brief.at(t), motion.at(t)),
                budget::free_state + budget::free_short_arc_eps * eps * sensitivity(motion, t))
          << turns << " " << description(c);
    }
  }
}

// A state has the same bits whether or not the processor has FMA.

bool two_paths_exist() { return polhode::supports(polhode::InstructionSet::avx2); }

void expect_same_bits(const FreeRotation& m, double t, const std::string& what) {
  EXPECT_EQ(bits(m.at(t)), bits(polhode::detail::evaluated_without_fma(m.kernel(), t)))
      << what << ", t = " << t;
}

TEST(EvaluationPaths, AgreeForRandomBodiesAndTimes) {
  if (!two_paths_exist()) GTEST_SKIP() << "this processor has one path only";
  Draw draw(61, 0);
  for (const FreeCase& c : drawn_cases(60, 300)) {
    const FreeRotation m = motion_of(c);
    expect_same_bits(m, c.t0, description(c));
    expect_same_bits(m, c.t, description(c));
    for (int k = 0; k < 20; ++k)
      expect_same_bits(m, draw.sign() * draw.power_of_ten(-3.0, 12.0), description(c));
    for (int k = 0; k < 5; ++k)
      expect_same_bits(m, draw.sign() * draw.power_of_ten(12.0, 308.0), description(c));
  }
}

TEST(EvaluationPaths, AgreeInEveryRegimeAtAnyTime) {
  if (!two_paths_exist()) GTEST_SKIP() << "this processor has one path only";
  Draw draw(62, 0);
  for (const NamedMotion& n : motions()) {
    const FreeRotation m = n.motion();
    for (const double t : {0.0, 1e18, -1e100, 1e300, 1e308, -1e308, infinite, not_a_number})
      expect_same_bits(m, t, n.name);
    for (int k = 0; k < 200; ++k)
      expect_same_bits(m, draw.sign() * draw.power_of_ten(-300, 308), n.name);
  }
}

}  // namespace
