// SPDX-License-Identifier: MIT
// What the members of an ensemble differ in: alone and in a run, whatever the other keys are.
#include "polhode/ensemble/draws.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "polhode/ensemble/executor.hpp"
#include "statistics.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;

std::vector<ensemble::Varied> of_each() {
  const std::vector<double> numbers{1, 2, 3, 4, 5, 6, 7, 8};
  return {{"uniform", ensemble::Uniform(1.0, 2.0)},
          {"log", ensemble::LogUniform(1e-3, 1e3)},
          {"normal", ensemble::Normal(0.0, 1.0)},
          {"positive", ensemble::TruncatedNormal(1.0, 1.0, 0.0, 1e9)},
          {"joint", ensemble::JointNormal({1.0, 2.0}, {2.0, 1.0, 1.0, 2.0})},
          {"axis", ensemble::IsotropicDirection{}},
          {"attitude", ensemble::UniformAttitude{}},
          {"grid", ensemble::DrawGrid({{0.0, 1.0, 3}, {0.0, 9.0, 10}})},
          {"clone", ensemble::DrawTable(2, numbers, ensemble::RowOrder::with_replacement)}};
}

TEST(Draws, CountTheirNumbers) {
  const std::vector<ensemble::Varied> all = of_each();
  const std::size_t numbers[] = {1, 1, 1, 1, 2, 3, 4, 2, 2},
                    uniforms[] = {1, 1, 1, 1, 2, 2, 3, 0, 1};
  for (std::size_t key = 0; key < all.size(); ++key) {
    EXPECT_EQ(ensemble::numbers_of(all[key].distribution), numbers[key]) << all[key].name;
    EXPECT_EQ(ensemble::uniforms_of(all[key].distribution), uniforms[key]) << all[key].name;
  }
  EXPECT_EQ(ensemble::uniforms_of(ensemble::DrawTable(1, {1.0}, ensemble::RowOrder::in_order)), 0u);
}

// The text of the header: the distribution at the numbers of CounterRandom, or of Sobol's point.
TEST(Draws, AreTheDistributionsOfTheirNumbers) {
  const std::vector<ensemble::Varied> all = of_each();
  const ensemble::Draws random(all, 5), sobol(all, 5, ensemble::DrawSource::sobol);
  const ensemble::SobolPoints points(12);
  for (const std::uint64_t member : {std::uint64_t{0}, std::uint64_t{17}, std::uint64_t{123456}}) {
    std::size_t dimension = 0;
    for (std::size_t key = 0; key < all.size(); ++key) {
      const ensemble::CounterRandom numbers(5, ensemble::key_of(all[key].name));
      std::vector<double> u(ensemble::uniforms_of(all[key].distribution)), v = u;
      std::vector<double> x(ensemble::numbers_of(all[key].distribution)), y = x;
      for (std::size_t i = 0; i < u.size(); ++i) {
        u[i] = numbers.uniform(member, i);
        v[i] = ensemble::open_uniform(points.bits(member, dimension++) ^ numbers.shared_bits(i));
      }
      ensemble::draw(all[key].distribution, member, u, x);
      ensemble::draw(all[key].distribution, member, v, y);
      EXPECT_EQ(random.values(member, key), x) << all[key].name;
      EXPECT_EQ(sobol.values(member, key), y) << all[key].name;
    }
  }
}

// So that members drawn by an older version, another compiler or another processor are the same.
TEST(Draws, KeepTheirBits) {
  const std::uint64_t hashes[] = {0xe213a035a6892e23, 0x3ddd598250aa5f58};
  for (const ensemble::DrawSource source :
       {ensemble::DrawSource::random, ensemble::DrawSource::sobol}) {
    const ensemble::Draws draws(of_each(), 2029, source);
    std::uint64_t hash = ensemble::key_of("");  // on by FNV-1a, a number at a time
    for (std::uint64_t member = 0; member < 20'000; ++member)
      for (std::size_t key = 0; key < draws.varied().size(); ++key)
        for (const double x : draws.values(member, key))
          hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3;
    EXPECT_EQ(hash, hashes[source == ensemble::DrawSource::sobol ? 1 : 0]);
  }
}

TEST(Draws, MayHaveManyNumbers) {
  constexpr std::size_t n = 30;
  std::vector<double> one(n * n), u(n), x(n);
  for (std::size_t i = 0; i < n; ++i) one[(n + 1) * i] = 1.0;
  const ensemble::JointNormal normal(std::vector<double>(n), one);
  ensemble::CounterRandom(1, ensemble::key_of("many")).uniforms(4, u);
  normal.from_uniform(u, x);
  EXPECT_EQ(ensemble::Draws({{"many", normal}}, 1).values(4, 0), x);
}

TEST(Draws, AMemberAloneIsThatOfARun) {
  for (const ensemble::DrawSource source :
       {ensemble::DrawSource::random, ensemble::DrawSource::sobol}) {
    const ensemble::Draws draws(of_each(), 3, source);
    const std::size_t keys = draws.varied().size();
    std::vector<std::vector<double>> run(2000 * keys);
    ensemble::run_parts(2000, 32, 3, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m)
        for (std::size_t key = 0; key < keys; ++key) run[m * keys + key] = draws.values(m, key);
    });
    for (std::size_t m = 2000; m-- > 0;)
      for (std::size_t key = keys; key-- > 0;)
        ASSERT_EQ(ensemble::Draws(of_each(), 3, source).values(m, key), run[m * keys + key]);
  }
}

TEST(Draws, DoNotDependOnOtherKeys) {
  const std::vector<ensemble::Varied> all = of_each();
  const ensemble::Draws whole(all, 3), sobol(all, 3, ensemble::DrawSource::sobol);
  for (std::size_t key = 0; key < all.size(); ++key) {
    EXPECT_EQ(ensemble::Draws({all[key]}, 3).values(99, 0), whole.values(99, key));
    const std::vector<ensemble::Varied> fewer(all.begin(),
                                              all.begin() + static_cast<std::ptrdiff_t>(key + 1));
    EXPECT_EQ(ensemble::Draws(fewer, 3, ensemble::DrawSource::sobol).values(99, key),
              sobol.values(99, key));
  }
  EXPECT_NE(ensemble::Draws({all[0]}, 4).value(99, 0), whole.value(99, 0));
}

// Different keys and different seeds: as if they did not know of each other.
TEST(Draws, KeysAreIndependent) {
  std::vector<double> found;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const ensemble::Draws draws({{"a", ensemble::Normal(0, 1)}, {"b", ensemble::Normal(0, 1)}},
                                seed);
    const ensemble::Draws other({{"a", ensemble::Normal(0, 1)}}, seed + 50);
    std::vector<double> products, of_seeds;
    for (std::uint64_t m = 0; m < 8192; ++m) {
      products.push_back(draws.value(m, 0) * draws.value(m, 1));
      of_seeds.push_back(draws.value(m, 0) * other.value(m, 0));
    }
    found.push_back(mean_is(products, 0.0));
    found.push_back(mean_is(of_seeds, 0.0));
  }
  expect_as_it_should_be(pooled(found));
}

TEST(Draws, ListedPointsGoByTheMember) {
  const ensemble::DrawTable table(1, {10, 20, 30}, ensemble::RowOrder::in_order);
  const ensemble::Draws draws({{"row", table}, {"grid", ensemble::DrawGrid({{0, 1, 2}})}}, 1);
  EXPECT_EQ(draws.most_members(), 3u);
  const ensemble::DrawTable longer(1, {1, 2, 3, 4}, ensemble::RowOrder::in_order);
  EXPECT_EQ(ensemble::Draws({{"row", table}, {"longer", longer}}, 1).most_members(), 3u);
  EXPECT_EQ(ensemble::Draws(of_each(), 1).most_members(),
            std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(draws.value(1, 0), 20.0);
  EXPECT_EQ(draws.value(2, 1), 0.0);  // the grid again
  EXPECT_MESSAGE(draws.value(3, 0), "DrawTable::row: index 3 must be below 3");
}

// Sobol's points through a normal: the mean of z^2 is nearer to 1.
TEST(Draws, SobolPointsGoThroughTheSameDistributions) {
  const std::vector<ensemble::Varied> varied{
      {"z", ensemble::JointNormal({0, 0, 0}, {1, 0.5, 0, 0.5, 1, 0, 0, 0, 1})}};
  double errors[2] = {0.0, 0.0};
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const ensemble::DrawSource source :
         {ensemble::DrawSource::random, ensemble::DrawSource::sobol}) {
      const ensemble::Draws draws(varied, seed, source);
      double sum = 0.0;
      for (std::uint64_t m = 0; m < 4096; ++m) {
        const std::vector<double> x = draws.values(m, 0);
        sum += x[0] * x[1] / 4096;
      }
      errors[source == ensemble::DrawSource::sobol ? 1 : 0] += std::pow(sum - 0.5, 2);
    }
  EXPECT_LE(std::sqrt(errors[1] / errors[0]), budget::sobol_over_random);
}

TEST(Draws, WhatCannotBeDrawnIsRefused) {
  const ensemble::Distribution any = ensemble::Uniform(0, 1);
  EXPECT_MESSAGE(ensemble::Draws({{"", any}}, 1), "Draws: name \"\" must not be empty");
  EXPECT_MESSAGE(ensemble::Draws({{"a", any}, {"a", any}}, 1),
                 "Draws: names \"a\" and \"a\" must differ, and so must their keys");
  std::vector<ensemble::Varied> many;
  for (int i = 0; i < 3668; ++i) many.push_back({"x" + std::to_string(i), any});
  EXPECT_MESSAGE(ensemble::Draws(many, 1, ensemble::DrawSource::sobol),
                 "SobolPoints: 3668 dimensions must be from 1 to 3667");
  EXPECT_EQ(message_of([&] { ensemble::Draws(many, 1); }), "");
  const ensemble::Draws draws({{"axis", ensemble::IsotropicDirection{}}}, 1);
  EXPECT_MESSAGE(draws.value(0, 0), "Draws: room for 1 numbers of \"axis\" must be for 3");
}

// Points that are listed: a grid in its order, the rows of a table.

TEST(DrawGrid, CountsTheLastAxisTheFastest) {
  const ensemble::DrawGrid grid({{1.0, 3.0, 3}, {5.0, 5.0, 1}, {0.0, -1.0, 2}});
  ASSERT_EQ(grid.size(), 6u);
  const double want[6][3] = {{1, 5, 0}, {1, 5, -1}, {2, 5, 0}, {2, 5, -1}, {3, 5, 0}, {3, 5, -1}};
  for (std::uint64_t index = 6; index-- > 0;) {
    std::vector<double> x(3);
    grid.at(index, x);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(x[i], want[index][i]) << index << ", " << i;
  }
}

TEST(DrawGrid, EndsAreExactAndPointsRoundedOnce) {
  const ensemble::DrawGrid grid({{0.1, 0.7, 7}});
  for (int k = 0; k < 7; ++k) {
    double x = 0.0;
    grid.at(static_cast<std::uint64_t>(k), {&x, 1});
    EXPECT_EQ(x, SaveAt::count(0.1, 0.7, 7)[k]);
  }
}

TEST(DrawGrid, WhatIsNoneIsRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_MESSAGE(ensemble::DrawGrid({}), "DrawGrid: 0 axes must be one or more");
  EXPECT_MESSAGE(ensemble::DrawGrid({{0, 1, 2}, {0, infinity, 2}}),
                 "DrawGrid: axis[1]: to inf must be finite");
  EXPECT_MESSAGE(ensemble::DrawGrid({{0, 1, 0}}), "DrawGrid: axis[0]: count 0 must be 1 or more");
  EXPECT_MESSAGE(ensemble::DrawGrid({{0, 1, -3}, {0, 1, -4}}),
                 "DrawGrid: axis[0]: count -3 must be 1 or more");
  EXPECT_MESSAGE(
      ensemble::DrawGrid({{0, 1, 1LL << 40}, {0, 1, 1LL << 40}}),
      "DrawGrid: axis[1]: count 1099511627776 makes more points than 2^53, which must be the most");
  double x = 0.0;
  EXPECT_MESSAGE(ensemble::DrawGrid({{0, 1, 2}}).at(2, {&x, 1}),
                 "DrawGrid::at: index 2 must be below 2");
}

TEST(DrawTable, HasItsRows) {
  const ensemble::DrawTable table(2, {1, 2, 3, 4, 5, 6}, ensemble::RowOrder::in_order);
  EXPECT_EQ(table.rows(), 3u);
  EXPECT_EQ(table.row(2)[0], 5.0);
  EXPECT_EQ(table.row(2)[1], 6.0);
  EXPECT_EQ(ensemble::DrawTable(table).row(0).data(), table.row(0).data());  // shared
}

TEST(DrawTable, DrawsEveryRowAsOften) {
  std::vector<double> numbers(37);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i);
  const ensemble::DrawTable table(1, numbers, ensemble::RowOrder::with_replacement);
  EXPECT_EQ(table.from_uniform(0x1p-53)[0], 0.0);
  EXPECT_EQ(table.from_uniform(1.0 - 0x1p-53)[0], 36.0);
  expect_as_it_should_be(over_seeds(12, [&](std::uint64_t seed) {
    const ensemble::CounterRandom random(seed, ensemble::key_of("clone"));
    std::vector<double> counts(37);
    for (std::uint64_t m = 0; m < 8192; ++m)
      ++counts[static_cast<std::size_t>(table.from_uniform(random.uniform(m, 0))[0])];
    return evenness(counts);
  }));
}

TEST(DrawTable, WhatIsNoneIsRefused) {
  constexpr ensemble::RowOrder any = ensemble::RowOrder::in_order;
  EXPECT_MESSAGE(ensemble::DrawTable(0, {1}, any), "DrawTable: 0 columns must be one or more");
  EXPECT_MESSAGE(ensemble::DrawTable(2, {}, any), "DrawTable: 0 rows must be one or more");
  EXPECT_MESSAGE(ensemble::DrawTable(2, {1, 2, 3}, any),
                 "DrawTable: 3 numbers must be whole rows of 2");
  EXPECT_MESSAGE(ensemble::DrawTable(2, {1, 2, 3, std::nan("")}, any),
                 "DrawTable: row 1, column 1: nan must be finite");
  EXPECT_MESSAGE(ensemble::DrawTable(1, {1, 2}, any).row(2),
                 "DrawTable::row: index 2 must be below 2");
}

// Sobol's points: those of others, of any index, evenly in every cell, and what a shift does.

// The first 30 bits, by SciPy 1.17: qmc.Sobol(d=3667, scramble=False, bits=30).
TEST(SobolPoints, AreThoseOfSciPy) {
  const ensemble::SobolPoints points(3667);
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
  const ensemble::SobolPoints points(dimensions);
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
  const ensemble::SobolPoints points(dimensions);
  constexpr std::uint64_t size = 256;
  for (const std::uint64_t shift : {std::uint64_t{0}, ensemble::CounterRandom(1, 2).shared_bits(3)})
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
  const ensemble::CounterRandom random(seed, ensemble::key_of("x"));
  double sum = 0.0;
  for (std::uint64_t m = 0; m < count; ++m)
    sum += product([&](std::size_t i) { return random.uniform(m, i); });
  return sum / static_cast<double>(count);
}

double mean_of_points(const ensemble::SobolPoints& points, std::uint64_t seed,
                      std::uint64_t count) {
  const ensemble::CounterRandom random(seed, ensemble::key_of("x"));
  std::vector<std::uint64_t> shifts;
  for (std::size_t i = 0; i < factors; ++i) shifts.push_back(random.shared_bits(i));
  double sum = 0.0;
  for (std::uint64_t m = 0; m < count; ++m)
    sum += product(
        [&](std::size_t i) { return ensemble::open_uniform(points.bits(m, i) ^ shifts[i]); });
  return sum / static_cast<double>(count);
}

TEST(SobolPoints, IntegrateBetterThanRandomOnesAndWithoutBias) {
  constexpr int seeds = 40;
  constexpr std::uint64_t count = 4096;
  const ensemble::SobolPoints points(factors);
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
  const ensemble::SobolPoints points(5);
  std::vector<double> found;
  for (const std::uint64_t member : {0u, 1u, 77u, 123456u}) {
    std::vector<double> sample;
    for (std::uint64_t seed = 0; seed < 4096; ++seed)
      sample.push_back(ensemble::open_uniform(
          points.bits(member, 4) ^ ensemble::CounterRandom(seed, member).shared_bits(4)));
    found.push_back(kolmogorov(sample, [](double u) { return u; }));
  }
  expect_as_it_should_be(pooled(found));
}

TEST(SobolPoints, HaveAMostOfDimensions) {
  EXPECT_EQ(ensemble::SobolPoints(3667).dimensions(), 3667u);
  EXPECT_EQ(ensemble::SobolPoints::most_dimensions, 3667u);
  EXPECT_MESSAGE(ensemble::SobolPoints(0), "SobolPoints: 0 dimensions must be from 1 to 3667");
  EXPECT_MESSAGE(ensemble::SobolPoints(3668),
                 "SobolPoints: 3668 dimensions must be from 1 to 3667");
}

}  // namespace
