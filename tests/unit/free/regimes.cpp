// SPDX-License-Identifier: MIT
// Which regime a motion is in, and its constants: periods, mean rates, modulus, actions, with their
// exact limits.
#include <gtest/gtest.h>

#include <numeric>

#include "budgets.hpp"
#include "polhode/math/double_double.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using free_test::pi;

// Within a few roundings.
void expect_same(double value, double expected, const char* what = "") {
  EXPECT_LE(relative(value, expected), budget::free_constants_eps * eps)
      << what << ": " << value << " is not " << expected;
}

TEST(Regimes, OfEveryMotion) {
  for (const NamedMotion& m : motions()) EXPECT_EQ(m.motion().regime(), m.regime) << m.name;
}

TEST(Regimes, MomentumAndEnergy) {
  for (const NamedMotion& m : motions()) {
    const FreeRotation motion = m.motion();
    expect_same(motion.momentum(), norm(m.g), m.name);
    expect_same(motion.energy(), kinetic_energy(m.body(), m.start()), m.name);
  }
}

// 2 pi/P_phi and the mean rate of the short axis differ by one turn of the polhode.
TEST(Regimes, RatesAndPeriodOfOneMotion) {
  for (const FreeCase& c : drawn_cases(41, 100)) {
    const FreeRotation m = motion_of(c);
    if (m.regime() != Regime::short_axis && m.regime() != Regime::long_axis) continue;
    const double polhode_rate = 2.0 * pi / m.polhode_period();
    EXPECT_NEAR(m.precession_rate_short() - m.precession_rate_long(), polhode_rate,
                budget::free_constants_eps * eps * m.precession_rate_short());
    // 2 T = I_l n_l + I_g n_g: the long-axis action is that of the circulation about b1
    const double n_l = -polhode_rate, I_l = m.regime() == Regime::short_axis
                                                ? m.circulation_action()
                                                : m.circulation_deficit();
    EXPECT_NEAR(I_l * n_l + m.momentum() * m.precession_rate_short(), 2.0 * m.energy(),
                budget::free_constants_eps * eps * m.momentum() * m.precession_rate_short());
    EXPECT_NEAR(m.circulation_action() + m.circulation_deficit(), m.momentum(),
                budget::free_constants_eps * eps * m.momentum());
    EXPECT_NEAR(m.modulus().m() + m.modulus().m1(), 1.0, eps);
  }
}

// k^2 = (I2 - I1) D3 / ((I3 - I2) D1), 1 - k^2 = (I3 - I1) D2 / ((I3 - I2) D1), or with axes 1 and
// 3 exchanged [SA (A20)]
TEST(Regimes, ModulusFromTheDiscriminants) {
  for (const FreeCase& c : drawn_cases(42, 60)) {
    const FreeRotation m = motion_of(c);
    if (m.regime() != Regime::short_axis && m.regime() != Regime::long_axis) continue;
    std::array<double, 3> I{c.moments.x, c.moments.y, c.moments.z};
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return I[i]; });
    const std::array<double, 3> g{c.start.g.x, c.start.g.y, c.start.g.z};
    if (m.regime() == Regime::long_axis) std::swap(order[0], order[2]);
    const auto wide = [](double x) { return DoubleDouble(x); };
    const DoubleDouble A = I[order[0]], B = I[order[1]], C = I[order[2]];
    const DoubleDouble gA = wide(g[order[0]]) * g[order[0]], gB = wide(g[order[1]]) * g[order[1]],
                       gC = wide(g[order[2]]) * g[order[2]];
    const DoubleDouble DA = gB * (B - A) / B + gC * (C - A) / C;
    const DoubleDouble DC = gA * (C - A) / A + gB * (C - B) / B;
    const DoubleDouble D2 = gC * (C - B) / C - gA * (B - A) / A;
    expect_same(m.modulus().m(), ((B - A) * DC / ((C - B) * DA)).hi, "m");
    expect_same(m.modulus().m1(), ((C - A) * D2 / ((C - B) * DA)).hi, "1 - m");
    expect_same(m.separatrix_distance(), m.regime() == Regime::long_axis ? -abs(D2).hi : D2.hi,
                "D2");
  }
}

TEST(Regimes, OblateBody) {
  const Body body(3.0, 3.0, 5.0);
  for (const double sense : {1.0, -1.0}) {
    const Vec3 g{0.3, 0.2, sense};
    const FreeRotation m(body, {{}, g});
    EXPECT_EQ(m.regime(), Regime::short_axis);
    EXPECT_EQ(m.modulus().m(), 0.0);
    EXPECT_EQ(m.modulus().m1(), 1.0);
    expect_same(m.polhode_period(), 2.0 * pi / (1.0 / 3.0 - 1.0 / 5.0), "period");
    expect_same(m.precession_rate_short(), norm(g) / 3.0, "rate of the symmetry axis");
    expect_same(m.circulation_action(), 1.0, "action |L|");
    EXPECT_EQ(m.sign_g3(), sense);
  }
}

TEST(Regimes, ProlateBody) {
  const Body body(2.0, 5.0, 5.0);
  const Vec3 g{1.0, 0.2, 0.3};
  const FreeRotation m(body, {{}, g});
  EXPECT_EQ(m.regime(), Regime::long_axis);
  EXPECT_EQ(m.modulus().m(), 0.0);
  expect_same(m.polhode_period(), 2.0 * pi / (1.0 / 2.0 - 1.0 / 5.0), "period");
  expect_same(m.precession_rate_long(), norm(g) / 5.0, "rate of the symmetry axis");
  expect_same(m.circulation_action(), 1.0, "action |g1|");
  expect_same(m.circulation_deficit(), 0.13 / (norm(g) + 1.0), "G - |g1|");
}

TEST(Regimes, SphereTurnsAtOneRate) {
  const Vec3 g{0.3, 0.2, 1.0};
  const FreeRotation m(Body(2.0, 2.0, 2.0), {{}, g});
  expect_same(m.precession_rate_short(), norm(g) / 2.0);
  expect_same(m.precession_rate_long(), norm(g) / 2.0);
  EXPECT_EQ(m.polhode_period(), infinite);
}

// Periods of exact spins are those of the smallest polhodes around them.
TEST(Regimes, SpinsAboutPrincipalAxes) {
  const double I1 = 3.0, I2 = 4.0, I3 = 6.0, G = 1.25;
  const Body body(I1, I2, I3);
  const double about_b1 = G / I1 * std::sqrt((I2 - I1) * (I3 - I1) / (I2 * I3));
  const double about_b3 = G * std::sqrt((1.0 / I1 - 1.0 / I3) * (1.0 / I2 - 1.0 / I3));
  for (const double sense : {1.0, -1.0}) {
    const FreeRotation b1(body, {{}, {sense * G, 0.0, 0.0}});
    expect_same(b1.polhode_period(), 2.0 * pi / about_b1, "b1 period");
    expect_same(b1.precession_rate_short(), G / I1, "b1 rate of b3");
    expect_same(b1.precession_rate_long(), G / I1 - about_b1, "b1 rate of b1");
    const FreeRotation b3(body, {{}, {0.0, 0.0, sense * G}});
    expect_same(b3.polhode_period(), 2.0 * pi / about_b3, "b3 period");
    expect_same(b3.precession_rate_long(), G / I3, "b3 rate of b1");
    expect_same(b3.precession_rate_short(), G / I3 + about_b3, "b3 rate of b3");
    const FreeRotation b2(body, {{}, {0.0, sense * G, 0.0}});
    EXPECT_EQ(b2.polhode_period(), infinite);
    expect_same(b2.precession_rate_long(), G / I2, "b2");
    expect_same(b2.precession_rate_short(), G / I2, "b2");
    // and motions 1e-9 away have the same to 1e-18
    const FreeRotation near(body, {{}, {1e-9 * G, -1e-9 * G, sense * G}});
    expect_same(near.polhode_period(), b3.polhode_period(), "near b3");
    expect_same(near.precession_rate_short(), b3.precession_rate_short(), "near b3");
  }
}

TEST(Regimes, SeparatrixHasNoPeriod) {
  const FreeRotation m(Body(3.0, 4.0, 6.0), {{}, {1.0, 0.5, 1.0}});
  EXPECT_EQ(m.regime(), Regime::separatrix);
  EXPECT_EQ(m.separatrix_distance(), 0.0);
  EXPECT_EQ(m.polhode_period(), infinite);
  EXPECT_EQ(m.modulus().m(), 1.0);
  EXPECT_EQ(m.modulus().m1(), 0.0);
  expect_same(m.precession_rate_long(), 1.5 / 4.0);
  expect_same(m.precession_rate_short(), 1.5 / 4.0);
  // I_l = (2/pi) I_g arctan kappa, kappa = 1 for these moments
  expect_same(m.circulation_action(), 0.75, "action");
}

// Integer moments and momenta with 2 T I2 = G^2 exactly, in every order and sense; one ulp of one
// component away the mode is that of the exact sign of D2.
TEST(Regimes, ExactSeparatrixOfIntegerStates) {
  const auto found = oracle::detail::exact_separatrices();
  ASSERT_GT(found.size(), 100U);
  const std::vector<Turn> turns = proper_turns();
  for (std::size_t k = 0; k < found.size(); ++k) {
    const oracle::detail::ExactSeparatrix& e = found[k];
    const Turn& turn = turns[k % turns.size()];
    const Vec3 I{double(e.lo), double(e.mid), double(e.hi)};
    const Vec3 g{double(e.g_lo), 0.3, double(e.g_hi)};
    Vec3 moments, start;
    for (int i = 0; i < 3; ++i) {
      const auto j = static_cast<std::size_t>(i);
      moments[i] = I[turn.axis[j]];
      start[i] = turn.sign[j] * g[turn.axis[j]];
    }
    const Body body(moments.x, moments.y, moments.z);
    EXPECT_EQ(FreeRotation(body, {{}, start}).regime(), Regime::separatrix) << k;
    for (int i = 0; i < 3; ++i) {
      const int axis = turn.axis[static_cast<std::size_t>(i)];
      if (axis == 1) continue;
      Vec3 moved = start;
      moved[i] = std::nextafter(moved[i], start[i] > 0.0 ? 100.0 : -100.0);
      const FreeRotation m(body, {{}, moved});
      EXPECT_EQ(m.regime(), axis == 2 ? Regime::short_axis : Regime::long_axis) << k;
      EXPECT_EQ(std::signbit(m.separatrix_distance()), axis == 0);
    }
  }
}

// No square vanishes or overflows: momenta between 1e-150 and 1e150 are in the regime of their
// directions.
TEST(Regimes, DoNotDependOnUnits) {
  for (const NamedMotion& m : motions()) {
    for (const int moment_exponent : {-490, 0, 490}) {
      for (const int momentum_exponent : {-490, 0, 490}) {
        const double c = std::ldexp(1.0, moment_exponent), d = std::ldexp(1.0, momentum_exponent);
        const Vec3 I = c * m.moments;
        const FreeRotation scaled(Body(I.x, I.y, I.z), {m.start().q, d * m.g});
        const FreeRotation motion = m.motion();
        EXPECT_EQ(scaled.regime(), m.regime) << m.name;
        EXPECT_EQ(scaled.modulus().m(), motion.modulus().m());
        EXPECT_EQ(scaled.modulus().m1(), motion.modulus().m1());
        EXPECT_EQ(scaled.momentum(), d * motion.momentum());
        EXPECT_EQ(scaled.polhode_period(),
                  std::ldexp(motion.polhode_period(), moment_exponent - momentum_exponent));
        EXPECT_EQ(scaled.precession_rate_long(),
                  std::ldexp(motion.precession_rate_long(), momentum_exponent - moment_exponent));
        EXPECT_EQ(scaled.circulation_action(), d * motion.circulation_action());
      }
    }
  }
}

TEST(Regimes, RestHasNoRates) {
  const FreeRotation m(Body(3.0, 4.0, 6.0), {{}, {0.0, 0.0, 0.0}});
  EXPECT_EQ(m.momentum(), 0.0);
  EXPECT_EQ(m.energy(), 0.0);
  EXPECT_EQ(m.precession_rate_long(), 0.0);
  EXPECT_EQ(m.precession_rate_short(), 0.0);
  EXPECT_EQ(m.polhode_period(), infinite);
}

}  // namespace
