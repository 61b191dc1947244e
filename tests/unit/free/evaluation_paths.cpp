// SPDX-License-Identifier: MIT
// A state has the same bits whether or not the processor has FMA.
#include <gtest/gtest.h>

#include "free/detail/evaluated_without_fma.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;

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
