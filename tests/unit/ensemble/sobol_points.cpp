// SPDX-License-Identifier: MIT
// Sobol's points: those of others, of any index, evenly in every cell, and what a shift does.
#include "polhode/ensemble/sobol_points.hpp"

#include <gtest/gtest.h>

#include <boost/random/sobol.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "message_of.hpp"
#include "polhode/ensemble/counter_random.hpp"
#include "statistics.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;

// The first 30 bits, by SciPy 1.17: qmc.Sobol(d=3667, scramble=False, bits=30).
TEST(SobolPoints, AreThoseOfSciPy) {
  const SobolPoints points(3667);
  constexpr std::size_t dimensions[7] = {0, 1, 2, 7, 39, 999, 3666};
  struct Row {
    std::uint64_t index;
    std::uint32_t bits[7];
  };
  const Row rows[] = {
      {0, {0, 0, 0, 0, 0, 0, 0}},
      {2, {0x30000000, 0x10000000, 0x10000000, 0x30000000, 0x10000000, 0x30000000, 0x10000000}},
      {3, {0x10000000, 0x30000000, 0x30000000, 0x10000000, 0x30000000, 0x10000000, 0x30000000}},
      {5, {0x38000000, 0x38000000, 0x8000000, 0x18000000, 0x18000000, 0x28000000, 0x8000000}},
      {100, {0x1a800000, 0x10800000, 0x31800000, 0x1e800000, 0x8800000, 0x3a800000, 0x20800000}},
      {12345, {0x29050000, 0x340f0000, 0xa430000, 0x7410000, 0x3caf0000, 0x8630000, 0x34830000}},
      {1048575, {0x400, 0x3c003c00, 0x31642400, 0x38dce400, 0x2fd32c00, 0x3179c00, 0x3f007c00}}};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < 7; ++i)
      EXPECT_EQ(points.bits(row.index, dimensions[i]) >> 34, row.bits[i]) << row.index << ", " << i;
}

// All 64 bits, far along too.
TEST(SobolPoints, AreThoseOfBoostFromOneToTheNext) {
  constexpr std::size_t dimensions = 11;
  const SobolPoints points(dimensions);
  boost::random::sobol engine(dimensions);
  for (const std::uint64_t start : {std::uint64_t{0}, std::uint64_t{123456789012345}}) {
    engine.seed(start);
    for (std::uint64_t n = start + 1; n < start + 500; ++n)
      for (std::size_t i = 0; i < dimensions; ++i) ASSERT_EQ(points.bits(n, i), engine());
  }
}

// 2^k points from a multiple of 2^k on: one in each of 2^k intervals of every dimension, shifted or
// not; and in the first two dimensions in every rectangle of that area.
TEST(SobolPoints, AreNets) {
  constexpr std::size_t dimensions = 40;
  const SobolPoints points(dimensions);
  constexpr std::uint64_t size = 256;
  for (const std::uint64_t shift : {std::uint64_t{0}, CounterRandom(1, 2).shared_bits(3)})
    for (const std::uint64_t start : {std::uint64_t{0}, 77 * size})
      for (std::size_t i = 0; i < dimensions; ++i) {
        std::set<std::uint64_t> seen;
        for (std::uint64_t n = start; n < start + size; ++n)
          seen.insert((points.bits(n, i) ^ shift) >> 56);
        EXPECT_EQ(seen.size(), size) << i;
      }
  for (unsigned wide = 1; wide < 8; ++wide) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t n = 0; n < size; ++n)
      seen.insert((points.bits(n, 0) >> (64 - wide) << (8 - wide)) |
                  (points.bits(n, 1) >> (56 + wide)));
    EXPECT_EQ(seen.size(), size) << wide;
  }
}

// Sobol's own integrand, the product of (|4 x - 2| + a) / (1 + a), a = 1, 2, ... 6; its integral
// over the cube is 1.
constexpr std::size_t factors = 6;
template <class Number>
double product(const Number& number) {
  double f = 1.0;
  for (std::size_t i = 0; i < factors; ++i) {
    const auto a = static_cast<double>(i + 1);
    f *= (std::abs(4.0 * number(i) - 2.0) + a) / (1.0 + a);
  }
  return f;
}

double mean_of_random(std::uint64_t seed, std::uint64_t count) {
  const CounterRandom random(seed, key_of("x"));
  double sum = 0.0;
  for (std::uint64_t m = 0; m < count; ++m)
    sum += product([&](std::size_t i) { return random.uniform(m, i); });
  return sum / static_cast<double>(count);
}

double mean_of_points(const SobolPoints& points, std::uint64_t seed, std::uint64_t count) {
  const CounterRandom random(seed, key_of("x"));
  std::vector<std::uint64_t> shifts;
  for (std::size_t i = 0; i < factors; ++i) shifts.push_back(random.shared_bits(i));
  double sum = 0.0;
  for (std::uint64_t m = 0; m < count; ++m)
    sum += product([&](std::size_t i) { return open_uniform(points.bits(m, i) ^ shifts[i]); });
  return sum / static_cast<double>(count);
}

TEST(SobolPoints, IntegrateBetterThanRandomOnesAndWithoutBias) {
  constexpr int seeds = 40;
  constexpr std::uint64_t count = 4096;
  const SobolPoints points(factors);
  std::vector<double> means;
  double of_random = 0.0, of_points = 0.0, of_fewer = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    means.push_back(mean_of_points(points, s, count));
    of_points += std::pow(means.back() - 1.0, 2);
    of_fewer += std::pow(mean_of_points(points, s, count / 16) - 1.0, 2);
    of_random += std::pow(mean_of_random(s, count) - 1.0, 2);
  }
  EXPECT_LE(std::sqrt(of_points / of_random), budget::sobol_over_random);
  // 16 times as many points: 4 times as near if they were random
  EXPECT_LE(std::sqrt(of_points / of_fewer), budget::sobol_over_fewer);
  expect_as_it_should_be(mean_is(means, 1.0));
}

// One point, whichever, is uniform over the shifts of many seeds.
TEST(SobolPoints, OneShiftedPointIsUniform) {
  const SobolPoints points(5);
  std::vector<double> found;
  for (const std::uint64_t member : {0u, 1u, 77u, 123456u}) {
    std::vector<double> sample;
    for (std::uint64_t seed = 0; seed < 4096; ++seed)
      sample.push_back(
          open_uniform(points.bits(member, 4) ^ CounterRandom(seed, member).shared_bits(4)));
    found.push_back(kolmogorov(sample, [](double u) { return u; }));
  }
  expect_as_it_should_be(pooled(found));
}

TEST(SobolPoints, HaveAMostOfDimensions) {
  EXPECT_EQ(SobolPoints(3667).dimensions(), 3667u);
  EXPECT_EQ(SobolPoints::most_dimensions, 3667u);
  EXPECT_MESSAGE(SobolPoints(0), "SobolPoints: 0 dimensions must be from 1 to 3667");
  EXPECT_MESSAGE(SobolPoints(3668), "SobolPoints: 3668 dimensions must be from 1 to 3667");
}

}  // namespace
