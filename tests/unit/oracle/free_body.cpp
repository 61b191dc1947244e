// SPDX-License-Identifier: MIT
// The oracle of free rotation judged by what is known without it: typed digits of another program,
// the closed axisymmetric solution, invariants, symmetries, other orders and another integration.
#include "oracle/free_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "oracle/direct_flow.hpp"
#include "oracle/free_cases.hpp"
#include "oracle/free_edge_cases.hpp"
#include "worst.hpp"

namespace {

using namespace oracle;
namespace budget = polhode::budget;
using polhode::test::Worst;

double length(const WideVec3& v) { return static_cast<double>(Wide(sqrt(dot(v, v)))); }

double angle_between(const WideQuaternion& a, const WideQuaternion& b) {
  const WideQuaternion d = conj(a) * b;
  return 2.0 * length({d.x, d.y, d.z});
}

void expect_same(const WideState& a, const WideState& b, double tolerance) {
  EXPECT_LE(angle_between(a.q, b.q), tolerance);
  EXPECT_LE(length(a.g - b.g), tolerance * (length(a.g) + length(b.g)));
}

WideQuaternion turned(const WideVec3& axis_rate, const Wide& t) {
  const Wide rate = sqrt(dot(axis_rate, axis_rate)), s = sin(rate * t / 2) / rate;
  return {cos(rate * t / 2), s * axis_rate.x, s * axis_rate.y, s * axis_rate.z};
}

// Cases of every kind; near the middle axis of the small angles nothing else can follow the oracle.
std::vector<FreeCase> assorted_cases(std::size_t of_each) {
  constexpr std::uint64_t seed = 20240201;
  const CaseMaker makers[] = {random_case,          near_axis_case,        nearly_equal_case,
                              near_separatrix_case, exact_separatrix_case, small_angle_case};
  std::vector<FreeCase> cases;
  for (const auto& maker : makers) {
    for (std::size_t i = 0; i < of_each; ++i) {
      Draw draw(seed, cases.size());
      cases.push_back(maker(draw));
    }
  }
  return cases;
}

Wide turns(const FreeCase& c, double count) { return Wide(count * oracle::detail::turn_length(c)); }

// Digits of tools/accuracy/oracle_reference.py (mpmath).
TEST(OracleFreeBody, AgreesWithMpmath) {
  FreeBody body({2.5, 1.0, 2.0}, {0.5, 0.5, -0.125, 0.75}, {0.75, 0.5, 0.3125});
  const WideState reference{
      {Wide("-0.42068716222724643386661385648236"), Wide("0.42176586016763488309063894879298"),
       Wide("-0.63202892498163081274779646194249"), Wide("-0.49565644222667538160578142212244")},
      {Wide("-0.78333169553615622244743239772293"), Wide("0.51011930863897895593379137518361"),
       Wide("-0.19059379770113396746209091320278")}};
  expect_same(body.at(12.5, 0.0), reference, budget::oracle_typed_digits);
  expect_same(body.at(13.25, 0.75), reference, budget::oracle_typed_digits);
}

// I1 = I2: q(t) = exp(G_I t / I1) q0 exp(b3 (g3/I3 - g3/I1) t), and the same about any axis.
TEST(OracleFreeBody, AgreesWithTheAxisymmetricSolution) {
  for (const auto& [moments, axis] :
       {std::pair{polhode::Vec3{1.0, 1.0, 1.5}, 2}, std::pair{polhode::Vec3{0.75, 2.0, 2.0}, 0},
        std::pair{polhode::Vec3{3.0, 0.5, 3.0}, 1}}) {
    for (const polhode::Vec3& g : {polhode::Vec3{0.3, 0.5, 0.2}, polhode::Vec3{-0.3, -0.5, -0.2},
                                   polhode::Vec3{1e-9, 1e-30, -1e-12}}) {
      FreeBody body(moments, {0.3, -0.5, 0.25, 2.0}, g);
      ASSERT_EQ(body.motion(), Motion::periodic);
      const WideQuaternion q0 = body.initial().q;
      const Wide across(moments[(axis + 1) % 3]), along(moments[axis]);
      WideVec3 spin;
      spin[axis] = body.initial().g[axis] * (across - along) / (across * along);
      const WideVec3 precession = (1 / across) * polhode::rotate(q0, body.initial().g);
      for (const double t : {-7.0, 0.0, 1.0, 1e3, 1e12}) {
        const WideState s = body.at(t, 0.0);
        EXPECT_LE(angle_between(s.q, turned(precession, t) * q0 * turned(spin, t)),
                  budget::oracle_agreement);
      }
    }
  }
}

TEST(OracleFreeBody, AgreesWithTheDirectIntegration) {
  for (const FreeCase& c : assorted_cases(3)) {
    SCOPED_TRACE(description(c));
    FreeBody body(c.moments, c.start.q, c.start.g);
    const DirectFlow flow(c.moments);
    for (const double count : {0.7, -3.3}) {
      const Wide t = turns(c, count);
      expect_same(body.at(t), flow.after(body.initial(), t), budget::oracle_agreement);
    }
  }
}

// Several half periods later the jump by symmetry is where the direct integration arrives.
TEST(OracleFreeBody, JumpsByHalfPeriods) {
  for (const polhode::Vec3& g : {polhode::Vec3{0.7, 0.5, 0.3}, polhode::Vec3{0.1, -0.5, -0.9}}) {
    FreeBody body({1.0, 2.0, 2.5}, {0.3, -0.5, 0.25, 2.0}, g);
    const DirectFlow flow({1.0, 2.0, 2.5});
    for (const double halves : {-3.5, -1.0, 1.0, 2.0, 5.25}) {
      const Wide t = Wide(halves) * body.half_period();
      expect_same(body.at(t), flow.after(body.initial(), t), budget::oracle_agreement);
    }
  }
}

TEST(OracleFreeBody, KeepsMomentumAndEnergy) {
  for (const FreeCase& c : assorted_cases(3)) {
    SCOPED_TRACE(description(c));
    FreeBody body(c.moments, c.start.q, c.start.g);
    const WideVec3 G = polhode::inertial_momentum(body.initial());
    for (const double count : {-1e9, -70.0, 0.0, 3.0, 100.0, 1e6}) {
      const WideState s = body.at(turns(c, count));
      const WideVec3& I = body.equations().moments();
      const Wide twice_T = s.g.x * s.g.x / I.x + s.g.y * s.g.y / I.y + s.g.z * s.g.z / I.z;
      EXPECT_LE(length(polhode::rotate(s.q, s.g) - G), budget::oracle_agreement * length(G));
      EXPECT_LE(static_cast<double>(Wide(abs(twice_T / body.twice_energy() - 1))),
                budget::oracle_agreement);
    }
  }
}

// The motion with -g is the motion with g run backward.
TEST(OracleFreeBody, RunsBackward) {
  for (const FreeCase& c : assorted_cases(3)) {
    SCOPED_TRACE(description(c));
    FreeBody body(c.moments, c.start.q, c.start.g);
    FreeBody reversed(c.moments, c.start.q, -c.start.g);
    for (const double count : {0.3, 90.0}) {
      WideState back = reversed.at(-turns(c, count));
      back.g = -back.g;
      expect_same(body.at(turns(c, count)), back, budget::oracle_agreement);
    }
  }
}

// Neither another order nor shorter steps change it.
TEST(OracleFreeBody, HasConverged) {
  for (const FreeCase& c : assorted_cases(3)) {
    SCOPED_TRACE(description(c));
    FreeBody body(c.moments, c.start.q, c.start.g);
    FreeBody higher_order(c.moments, c.start.q, c.start.g, {90, -72.0});
    FreeBody shorter_steps(c.moments, c.start.q, c.start.g, {60, -70.0});
    for (const double count : {-20.0, 100.0}) {
      const WideState s = body.at(turns(c, count));
      expect_same(s, higher_order.at(turns(c, count)), budget::oracle_agreement);
      expect_same(s, shorter_steps.at(turns(c, count)), budget::oracle_agreement);
    }
  }
}

// Renaming the axes renames the answer.
TEST(OracleFreeBody, KnowsNoOrderOfAxes) {
  for (const FreeCase& c : assorted_cases(2)) {
    SCOPED_TRACE(description(c));
    const auto& [I1, I2, I3] = c.moments;
    const auto& [q, g] = c.start;
    FreeBody body(c.moments, q, g), renamed({I2, I3, I1}, {q.w, q.y, q.z, q.x}, {g.y, g.z, g.x});
    const WideState a = body.at(turns(c, 60.0)), b = renamed.at(turns(c, 60.0));
    expect_same({{a.q.w, a.q.y, a.q.z, a.q.x}, {a.g.y, a.g.z, a.g.x}}, b, budget::oracle_agreement);
  }
}

TEST(OracleFreeBody, TellsTheMotionExactly) {
  const polhode::Quaternion q{1.0, 0.0, 0.0, 0.0};
  const polhode::Vec3 I{3.0, 4.0, 6.0};
  const double next = std::nextafter(0.3, 1.0);
  EXPECT_EQ(FreeBody(I, q, {0.3, 0.5, 0.3}).motion(), Motion::separatrix);
  EXPECT_EQ(FreeBody(I, q, {0.3, 0.5, -0.3}).motion(), Motion::separatrix);
  EXPECT_EQ(FreeBody(I, q, {0.3, 0.5, next}).pole(), 2U);
  EXPECT_EQ(FreeBody(I, q, {next, 0.5, 0.3}).pole(), 0U);
  EXPECT_EQ(FreeBody(I, q, {0.0, 0.5, 1e-150}).pole(), 2U);
  EXPECT_EQ(FreeBody(I, q, {0.0, 0.5, 0.0}).motion(), Motion::steady);
  EXPECT_EQ(FreeBody(I, q, {0.0, 0.0, 0.0}).motion(), Motion::rest);
  EXPECT_EQ(FreeBody({2.0, 2.0, 2.0}, q, {0.3, 0.5, 0.3}).motion(), Motion::steady);
  EXPECT_EQ(FreeBody({2.0, 2.0, 3.0}, q, {0.3, 0.5, 0.0}).motion(), Motion::steady);
}

// On the separatrix g ends at the middle axis, on both sides of time.
TEST(OracleFreeBody, FollowsTheSeparatrixToItsEnds) {
  FreeBody body({3.0, 4.0, 6.0}, {1.0, 0.0, 0.0, 0.0}, {0.3, 0.5, 0.3});
  for (const double t : {-1e9, 1e9}) {
    const WideState s = body.at(t, 0.0);
    EXPECT_LE(length({s.g.x, Wide(0), s.g.z}), budget::oracle_agreement);
    EXPECT_LE(static_cast<double>(Wide(abs(abs(s.g.y) - body.momentum()))),
              budget::oracle_agreement);
  }
  EXPECT_TRUE(body.at(1e9, 0.0).g.y * body.at(-1e9, 0.0).g.y < 0);
}

// The digits of the oracle suffice past the edges: shorter steps of a higher order give the same
// state, far below the rounding of what is judged.

double difference(const FreeCase& c) {
  FreeBody usual(c.moments, c.start.q, c.start.g);
  FreeBody finer(c.moments, c.start.q, c.start.g, {.order = 88, .log10_tolerance = -72.0});
  const WideState a = usual.at(c.t, c.t0), b = finer.at(c.t, c.t0);
  const WideVec3 dg = a.g - b.g;
  const WideQuaternion dq = conj(a.q) * b.q;
  const Wide turn = dq.x * dq.x + dq.y * dq.y + dq.z * dq.z;
  return static_cast<double>(Wide(sqrt(turn) + sqrt(dot(dg, dg)) / usual.momentum()));
}

void expect_digits(CaseMaker maker, double turns) {
  Worst worst;
  for (std::uint64_t i = 0; i < 4; ++i) {
    Draw draw(31, i);
    FreeCase c = maker(draw);
    if (turns > 0.0) set_time(c, turns);
    worst.add(difference(c), description(c));
  }
  EXPECT_LE(worst.value(), polhode::budget::oracle_edges) << worst.where();
}

TEST(OracleEdges, MiddleSpin) { expect_digits(middle_spin_case, 0.0); }
TEST(OracleEdges, SeparatrixOfFullMoments) { expect_digits(full_moments_case, 0.0); }
TEST(OracleEdges, SeparatrixAfterABillionTurns) { expect_digits(close_separatrix_case, 1e9); }
TEST(OracleEdges, Momenta) { expect_digits(extreme_momentum_case, 0.0); }
TEST(OracleEdges, HugeTimes) { expect_digits(long_time_case, 1e25); }
TEST(OracleEdges, HugeTimesNextToTheSeparatrix) { expect_digits(full_moments_case, 1e20); }

}  // namespace
