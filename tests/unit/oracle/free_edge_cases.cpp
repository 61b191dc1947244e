// SPDX-License-Identifier: MIT
// The digits of the oracle suffice past the edges: shorter steps of a higher order give the same
// state, far below the rounding of what is judged.
#include "oracle/free_edge_cases.hpp"

#include <gtest/gtest.h>

#include "budgets.hpp"
#include "oracle/free_body.hpp"
#include "worst.hpp"

namespace {

using oracle::FreeCase;
using polhode::test::Worst;

double difference(const FreeCase& c) {
  oracle::FreeBody usual(c.moments, c.start.q, c.start.g);
  oracle::FreeBody finer(c.moments, c.start.q, c.start.g, {.order = 88, .log10_tolerance = -72.0});
  const oracle::WideState a = usual.at(c.t, c.t0), b = finer.at(c.t, c.t0);
  const oracle::WideVec3 dg = a.g - b.g;
  const oracle::WideQuaternion dq = conj(a.q) * b.q;
  const oracle::Wide turn = dq.x * dq.x + dq.y * dq.y + dq.z * dq.z;
  return static_cast<double>(oracle::Wide(sqrt(turn) + sqrt(dot(dg, dg)) / usual.momentum()));
}

void expect_digits(oracle::CaseMaker maker, double turns) {
  Worst worst;
  for (std::uint64_t i = 0; i < 4; ++i) {
    oracle::Draw draw(31, i);
    FreeCase c = maker(draw);
    if (turns > 0.0) set_time(c, turns);
    worst.add(difference(c), description(c));
  }
  EXPECT_LE(worst.value(), polhode::budget::oracle_edges) << worst.where();
}

TEST(OracleEdges, MiddleSpin) { expect_digits(oracle::middle_spin_case, 0.0); }
TEST(OracleEdges, SeparatrixOfFullMoments) { expect_digits(oracle::full_moments_case, 0.0); }
TEST(OracleEdges, SeparatrixAfterABillionTurns) {
  expect_digits(oracle::close_separatrix_case, 1e9);
}
TEST(OracleEdges, Momenta) { expect_digits(oracle::extreme_momentum_case, 0.0); }
TEST(OracleEdges, HugeTimes) { expect_digits(oracle::long_time_case, 1e25); }
TEST(OracleEdges, HugeTimesNextToTheSeparatrix) { expect_digits(oracle::full_moments_case, 1e20); }

}  // namespace
