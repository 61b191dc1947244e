// SPDX-License-Identifier: MIT
// How accurate FreeRotation is, against 76-digit Taylor integration: a seeded sample of each set,
// or the full counts when POLHODE_TEST_FULL is set. tools/accuracy/free_rotation.py writes the
// properties recorded here into docs/accuracy/free-rotation.md.
#include "oracle/free_accuracy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "oracle/free_edge_cases.hpp"
#include "worst.hpp"

namespace {

using polhode::test::larger;
using polhode::test::Worst;
namespace budget = polhode::budget;
using namespace oracle;
using oracle::FreeCase;

constexpr std::uint64_t seed = 1867;  // the year of Serret's paper

std::size_t count_of(std::size_t sample, std::size_t full) {
  return std::getenv("POLHODE_TEST_FULL") != nullptr ? full : sample;
}

std::string digits(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", x);
  return text.data();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What the phase of a double-double rate loses: nothing before some 1e15 turns.
double phase_loss(const FreeCase& c) {
  const double turns = (c.t - c.t0) / oracle::detail::turn_length(c);
  return budget::free_phase * 2.0 * 3.141592653589793 * std::abs(turns);
}

// The errors of one set, less that of the phase, and the case of the largest.
struct Survey {
  std::vector<double> angle, momentum;
  Worst<> worst;  // of both kinds
  Worst<> worst_angle, worst_momentum, lost;

  void add(const FreeCase& c) {
    const FreeError e = free_error(c);
    angle.push_back(e.angle);
    momentum.push_back(e.momentum);
    worst_angle.add(e.angle);
    worst_momentum.add(e.momentum);
    lost.add(phase_loss(c));
    worst.add(
        larger(e.angle, e.momentum) - phase_loss(c),
        "angle " + digits(e.angle) + ", momentum " + digits(e.momentum) + ": " + description(c));
  }
  void expect_accurate() const {
    testing::Test::RecordProperty("cases", std::to_string(angle.size()));
    testing::Test::RecordProperty("angle_median", digits(median(angle)));
    testing::Test::RecordProperty("angle_max", digits(worst_angle.value()));
    testing::Test::RecordProperty("momentum_median", digits(median(momentum)));
    testing::Test::RecordProperty("momentum_max", digits(worst_momentum.value()));
    EXPECT_LE(median(angle), budget::free_state_median + lost.value());
    EXPECT_LE(median(momentum), budget::free_state_median + lost.value());
    EXPECT_LE(worst.value(), budget::free_state) << worst.where();
  }
};

FreeCase drawn(CaseMaker maker, std::uint64_t stream, std::size_t index) {
  Draw draw(seed + (stream << 32U), index);
  return maker(draw);
}

void expect_accurate(CaseMaker maker, std::uint64_t stream, std::size_t count) {
  Survey survey;
  for (std::size_t i = 0; i < count; ++i) survey.add(drawn(maker, stream, i));
  survey.expect_accurate();
}

void expect_accurate_after(CaseMaker maker, double turns, std::uint64_t stream, std::size_t count) {
  Survey survey;
  for (std::size_t i = 0; i < count; ++i) {
    FreeCase c = drawn(maker, stream, i);
    set_time(c, i % 2 == 0 ? turns : -turns);
    survey.add(c);
  }
  survey.expect_accurate();
}

TEST(FreeAccuracy, RandomBodies) { expect_accurate(random_case, 1, count_of(200, 1000)); }

TEST(FreeAccuracy, NearPrincipalAxes) { expect_accurate(near_axis_case, 2, count_of(150, 2500)); }

TEST(FreeAccuracy, NearlyEqualMoments) {
  expect_accurate(nearly_equal_case, 3, count_of(250, 2500));
}

TEST(FreeAccuracy, NearTheSeparatrix) {
  expect_accurate(near_separatrix_case, 4, count_of(150, 2000));
}

TEST(FreeAccuracy, OnTheSeparatrix) {
  expect_accurate(exact_separatrix_case, 5, count_of(120, 500));
}

TEST(FreeAccuracy, SmallAngles) { expect_accurate(small_angle_case, 6, count_of(200, 2500)); }

TEST(FreeAccuracy, ExtremeShapesAndUnits) { expect_accurate(extreme_case, 9, count_of(150, 2000)); }

// Past the edges, each class apart.
TEST(FreeAccuracy, EdgeMiddleSpin) { expect_accurate(middle_spin_case, 21, count_of(12, 1000)); }

TEST(FreeAccuracy, EdgeSeparatrixOfFullMoments) {
  expect_accurate(full_moments_case, 22, count_of(24, 1000));
}

TEST(FreeAccuracy, EdgeSeparatrixAfterABillionTurns) {
  expect_accurate_after(close_separatrix_case, 1e9, 23, count_of(20, 300));
}

TEST(FreeAccuracy, EdgeMomenta) { expect_accurate(extreme_momentum_case, 24, count_of(60, 1000)); }

// More than 2^52 periods: the numbers t and t0 are what they are, and so is the state.
TEST(FreeAccuracy, EdgeHugeTimes) {
  for (const double turns : {0x1p53, 0x1p58, 1e20, 1e25})
    expect_accurate_after(long_time_case, turns, 25, count_of(15, 200));
}

TEST(FreeAccuracy, EdgeHugeTimesNextToTheSeparatrix) {
  for (const double turns : {0x1p54, 0x1p58, 1e20})
    expect_accurate_after(full_moments_case, turns, 26, count_of(6, 200));
}

TEST(FreeAccuracy, AfterAMillionTurns) {
  expect_accurate_after(long_time_case, 1e6, 7, count_of(100, 1000));
}

TEST(FreeAccuracy, AfterABillionTurns) {
  expect_accurate_after(long_time_case, 1e9, 8, count_of(100, 1000));
}

// FreeRotation where digits are easily lost without a word: next to the middle axis down to the
// smallest double, as near to the separatrix as doubles come, after 1e9 turns there, and beyond
// 2^52 periods.

void expect_exact(const FreeCase& c, double allowed = budget::free_state) {
  const oracle::FreeError e = oracle::free_error(c);
  EXPECT_LE(e.angle, allowed) << description(c);
  EXPECT_LE(e.momentum, allowed) << description(c);
}

FreeCase case_of(const polhode::Vec3& moments, const polhode::Vec3& g, double turns) {
  FreeCase c{moments, {{0.5, 0.5, -0.125, 0.75}, g}, 0.0, 0.0};
  set_time(c, turns);
  return c;
}

TEST(FreeEdges, NextToTheMiddleAxisDownToTheSmallestDouble) {
  expect_exact(case_of({1.0, 1.7, 2.1}, {1e-170, 1.0, 0.0}, 1.0));
  expect_exact(case_of({1.0, 1.7, 2.1}, {1e-170, 1.0, 0.7e-170}, 1000.0));
  // the squares, and the quotient, of these are no doubles
  expect_exact(case_of({1.0, 1.7, 2.1}, {1e-300, 1e300, -3e-299}, 1000.0));
}

// The distance is 4e-21 of G^2: every digit of it hangs on the last ones of the moments.
TEST(FreeEdges, AsNearToTheSeparatrixAsDoublesCome) {
  for (const double turns : {32.0, 1e6, 1e12})
    expect_exact(case_of({0.32200176517297396, 0.3789751609709488, 0.661517593383879},
                         {0.8233251531952871, -0.3, 0.5299161674818204}, turns));
}

// The phase loses some 2^-104 of itself, and no half period.
TEST(FreeEdges, BeyondTheIntegersThatADoubleCounts) {
  for (const double turns : {1e16, -3e17, 1e18, 0.7e19, -1e20})
    expect_exact(
        case_of({1.0, 1.7, 2.1}, {0.3, 1.0, 0.284}, turns),
        budget::free_state + budget::free_phase * 2.0 * std::numbers::pi * std::abs(turns));
}

}  // namespace
