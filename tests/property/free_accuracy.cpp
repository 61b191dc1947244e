// SPDX-License-Identifier: MIT
// How accurate FreeRotation is, against 76-digit Taylor integration: a seeded sample of each set,
// or the full counts when POLHODE_TEST_FULL is set. tools/accuracy/free_rotation.py writes the
// properties recorded here into docs/accuracy/free-rotation.md.
#include "oracle/free_accuracy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "budgets.hpp"

namespace {

namespace budget = polhode::budget;
using oracle::FreeCase;
using oracle::FreeError;

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

// The errors of one set and the cases where each is worst.
struct Survey {
  std::vector<double> angle, momentum, fraction;  // fraction: of the bound, by the larger error
  double largest_angle = 0.0, largest_momentum = 0.0, largest_fraction = 0.0;
  std::string worst;

  void add(const FreeCase& c, const FreeError& e, double bound) {
    const double fraction_here = std::max(e.angle, e.momentum) / bound;
    angle.push_back(e.angle);
    momentum.push_back(e.momentum);
    fraction.push_back(fraction_here);
    largest_angle = std::max(largest_angle, e.angle);
    largest_momentum = std::max(largest_momentum, e.momentum);
    if (worst.empty() || fraction_here > largest_fraction) {
      largest_fraction = fraction_here;
      worst = "angle " + digits(e.angle) + " momentum " + digits(e.momentum) + " bound " +
              digits(bound) + ": " + description(c);
    }
  }
  void record() const {
    testing::Test::RecordProperty("cases", std::to_string(angle.size()));
    testing::Test::RecordProperty("angle_median", digits(median(angle)));
    testing::Test::RecordProperty("angle_max", digits(largest_angle));
    testing::Test::RecordProperty("momentum_median", digits(median(momentum)));
    testing::Test::RecordProperty("momentum_max", digits(largest_momentum));
    testing::Test::RecordProperty("bound_fraction_max", digits(largest_fraction));
  }
};

FreeCase drawn(oracle::CaseMaker maker, std::uint64_t stream, std::size_t index) {
  oracle::Draw draw(seed + (stream << 32U), index);
  return maker(draw);
}

// Every case within its bound of the hard cases; no case may fail to give a finite state.
void expect_hard_cases(oracle::CaseMaker maker, std::uint64_t stream, std::size_t count) {
  Survey survey;
  for (std::size_t i = 0; i < count; ++i) {
    const FreeCase c = drawn(maker, stream, i);
    const FreeError e = oracle::free_error(c);
    survey.add(c, e, e.bound);
  }
  survey.record();
  EXPECT_TRUE(std::isfinite(survey.largest_angle + survey.largest_momentum)) << survey.worst;
  EXPECT_LE(survey.largest_fraction, 1.0) << survey.worst;
}

void expect_after_turns(double turns, std::uint64_t stream, std::size_t count, double bound) {
  Survey survey;
  for (std::size_t i = 0; i < count; ++i) {
    FreeCase c = drawn(oracle::long_time_case, stream, i);
    set_time(c, i % 2 == 0 ? turns : -turns);
    survey.add(c, oracle::free_error(c), bound);
  }
  survey.record();
  EXPECT_LE(survey.largest_fraction, 1.0) << survey.worst;
}

TEST(FreeAccuracy, RandomBodies) {
  Survey survey;
  for (std::size_t i = 0; i < count_of(200, 1000); ++i) {
    const FreeCase c = drawn(oracle::random_case, 1, i);
    survey.add(c, oracle::free_error(c), budget::free_attitude);
  }
  survey.record();
  EXPECT_LE(median(survey.angle), budget::free_attitude_median);
  EXPECT_LE(survey.largest_fraction, 1.0) << survey.worst;
}

TEST(FreeAccuracy, NearPrincipalAxes) {
  expect_hard_cases(oracle::near_axis_case, 2, count_of(150, 2500));
}

TEST(FreeAccuracy, NearlyEqualMoments) {
  expect_hard_cases(oracle::nearly_equal_case, 3, count_of(250, 2500));
}

TEST(FreeAccuracy, NearTheSeparatrix) {
  expect_hard_cases(oracle::near_separatrix_case, 4, count_of(150, 2000));
}

TEST(FreeAccuracy, OnTheSeparatrix) {
  expect_hard_cases(oracle::exact_separatrix_case, 5, count_of(120, 500));
}

TEST(FreeAccuracy, SmallAngles) {
  expect_hard_cases(oracle::small_angle_case, 6, count_of(200, 2500));
}

TEST(FreeAccuracy, ExtremeShapesAndUnits) {
  expect_hard_cases(oracle::extreme_case, 9, count_of(150, 2000));
}

TEST(FreeAccuracy, AfterAMillionTurns) {
  expect_after_turns(1e6, 7, count_of(100, 1000), budget::free_attitude_1e6_turns);
}

TEST(FreeAccuracy, AfterABillionTurns) {
  expect_after_turns(1e9, 8, count_of(100, 1000), budget::free_attitude_1e9_turns);
}

}  // namespace
