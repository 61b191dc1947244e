// SPDX-License-Identifier: MIT
// The digits of the oracle suffice past the edges: shorter steps of a higher order give the same
// state, far below the rounding of what is judged.
#include "oracle/free_edge_cases.hpp"

#include <gtest/gtest.h>

#include "budgets.hpp"
#include "oracle/free_body.hpp"
#include "worst.hpp"

namespace {

using namespace oracle;
using polhode::test::Worst;

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
