// SPDX-License-Identifier: MIT
// What the members of an ensemble differ in: alone and in a run, whatever the other keys are.
#include "polhode/ensemble/draws.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "polhode/ensemble/parts.hpp"
#include "statistics.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;

std::vector<Varied> of_each() {
  const std::vector<double> numbers{1, 2, 3, 4, 5, 6, 7, 8};
  return {{"uniform", Uniform(1.0, 2.0)},
          {"log", LogUniform(1e-3, 1e3)},
          {"normal", Normal(0.0, 1.0)},
          {"positive", TruncatedNormal(1.0, 1.0, 0.0, 1e9)},
          {"joint", JointNormal({1.0, 2.0}, {2.0, 1.0, 1.0, 2.0})},
          {"axis", IsotropicDirection{}},
          {"attitude", UniformAttitude{}},
          {"grid", DrawGrid({{0.0, 1.0, 3}, {0.0, 9.0, 10}})},
          {"clone", DrawTable(2, numbers, RowOrder::with_replacement)}};
}

TEST(Draws, CountTheirNumbers) {
  const std::vector<Varied> all = of_each();
  const std::size_t numbers[] = {1, 1, 1, 1, 2, 3, 4, 2, 2},
                    uniforms[] = {1, 1, 1, 1, 2, 2, 3, 0, 1};
  for (std::size_t key = 0; key < all.size(); ++key) {
    EXPECT_EQ(numbers_of(all[key].distribution), numbers[key]) << all[key].name;
    EXPECT_EQ(uniforms_of(all[key].distribution), uniforms[key]) << all[key].name;
  }
  EXPECT_EQ(uniforms_of(DrawTable(1, {1.0}, RowOrder::in_order)), 0u);
}

// The text of the header: the distribution at the numbers of CounterRandom, or of Sobol's point.
TEST(Draws, AreTheDistributionsOfTheirNumbers) {
  const std::vector<Varied> all = of_each();
  const Draws random(all, 5), sobol(all, 5, DrawSource::sobol);
  const SobolPoints points(12);
  for (const std::uint64_t member : {std::uint64_t{0}, std::uint64_t{17}, std::uint64_t{123456}}) {
    std::size_t dimension = 0;
    for (std::size_t key = 0; key < all.size(); ++key) {
      const CounterRandom numbers(5, key_of(all[key].name));
      std::vector<double> u(uniforms_of(all[key].distribution)), v = u;
      std::vector<double> x(numbers_of(all[key].distribution)), y = x;
      for (std::size_t i = 0; i < u.size(); ++i) {
        u[i] = numbers.uniform(member, i);
        v[i] = open_uniform(points.bits(member, dimension++) ^ numbers.shared_bits(i));
      }
      draw(all[key].distribution, member, u, x);
      draw(all[key].distribution, member, v, y);
      EXPECT_EQ(random.values(member, key), x) << all[key].name;
      EXPECT_EQ(sobol.values(member, key), y) << all[key].name;
    }
  }
}

// So that members drawn by an older version, another compiler or another processor are the same.
TEST(Draws, KeepTheirBits) {
  const std::uint64_t hashes[] = {0xe213a035a6892e23, 0x3ddd598250aa5f58};
  for (const DrawSource source : {DrawSource::random, DrawSource::sobol}) {
    const Draws draws(of_each(), 2029, source);
    std::uint64_t hash = key_of("");  // on by FNV-1a, a number at a time
    for (std::uint64_t member = 0; member < 20'000; ++member)
      for (std::size_t key = 0; key < draws.varied().size(); ++key)
        for (const double x : draws.values(member, key))
          hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3;
    EXPECT_EQ(hash, hashes[source == DrawSource::sobol ? 1 : 0]);
  }
}

TEST(Draws, MayHaveManyNumbers) {
  constexpr std::size_t n = 30;
  std::vector<double> one(n * n), u(n), x(n);
  for (std::size_t i = 0; i < n; ++i) one[(n + 1) * i] = 1.0;
  const JointNormal normal(std::vector<double>(n), one);
  CounterRandom(1, key_of("many")).uniforms(4, u);
  normal.from_uniform(u, x);
  EXPECT_EQ(Draws({{"many", normal}}, 1).values(4, 0), x);
}

TEST(Draws, AMemberAloneIsThatOfARun) {
  for (const DrawSource source : {DrawSource::random, DrawSource::sobol}) {
    const Draws draws(of_each(), 3, source);
    const std::size_t keys = draws.varied().size();
    std::vector<std::vector<double>> run(2000 * keys);
    run_parts(2000, 32, 3, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m)
        for (std::size_t key = 0; key < keys; ++key) run[m * keys + key] = draws.values(m, key);
    });
    for (std::size_t m = 2000; m-- > 0;)
      for (std::size_t key = keys; key-- > 0;)
        ASSERT_EQ(Draws(of_each(), 3, source).values(m, key), run[m * keys + key]);
  }
}

TEST(Draws, DoNotDependOnOtherKeys) {
  const std::vector<Varied> all = of_each();
  const Draws whole(all, 3), sobol(all, 3, DrawSource::sobol);
  for (std::size_t key = 0; key < all.size(); ++key) {
    EXPECT_EQ(Draws({all[key]}, 3).values(99, 0), whole.values(99, key));
    const std::vector<Varied> fewer(all.begin(),
                                    all.begin() + static_cast<std::ptrdiff_t>(key + 1));
    EXPECT_EQ(Draws(fewer, 3, DrawSource::sobol).values(99, key), sobol.values(99, key));
  }
  EXPECT_NE(Draws({all[0]}, 4).value(99, 0), whole.value(99, 0));
}

// Different keys and different seeds: as if they did not know of each other.
TEST(Draws, KeysAreIndependent) {
  std::vector<double> found;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Draws draws({{"a", Normal(0, 1)}, {"b", Normal(0, 1)}}, seed);
    const Draws other({{"a", Normal(0, 1)}}, seed + 50);
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
  const DrawTable table(1, {10, 20, 30}, RowOrder::in_order);
  const Draws draws({{"row", table}, {"grid", DrawGrid({{0, 1, 2}})}}, 1);
  EXPECT_EQ(draws.most_members(), 3u);
  const DrawTable longer(1, {1, 2, 3, 4}, RowOrder::in_order);
  EXPECT_EQ(Draws({{"row", table}, {"longer", longer}}, 1).most_members(), 3u);
  EXPECT_EQ(Draws(of_each(), 1).most_members(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(draws.value(1, 0), 20.0);
  EXPECT_EQ(draws.value(2, 1), 0.0);  // the grid again
  EXPECT_MESSAGE(draws.value(3, 0), "DrawTable::row: index 3 must be below 3");
}

// Sobol's points through a normal: the mean of z^2 is nearer to 1.
TEST(Draws, SobolPointsGoThroughTheSameDistributions) {
  const std::vector<Varied> varied{{"z", JointNormal({0, 0, 0}, {1, 0.5, 0, 0.5, 1, 0, 0, 0, 1})}};
  double errors[2] = {0.0, 0.0};
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const DrawSource source : {DrawSource::random, DrawSource::sobol}) {
      const Draws draws(varied, seed, source);
      double sum = 0.0;
      for (std::uint64_t m = 0; m < 4096; ++m) {
        const std::vector<double> x = draws.values(m, 0);
        sum += x[0] * x[1] / 4096;
      }
      errors[source == DrawSource::sobol ? 1 : 0] += std::pow(sum - 0.5, 2);
    }
  EXPECT_LE(std::sqrt(errors[1] / errors[0]), budget::sobol_over_random);
}

TEST(Draws, WhatCannotBeDrawnIsRefused) {
  const Distribution any = Uniform(0, 1);
  EXPECT_MESSAGE(Draws({{"", any}}, 1), "Draws: name \"\" must not be empty");
  EXPECT_MESSAGE(Draws({{"a", any}, {"a", any}}, 1),
                 "Draws: names \"a\" and \"a\" must differ, and so must their keys");
  std::vector<Varied> many;
  for (int i = 0; i < 3668; ++i) many.push_back({"x" + std::to_string(i), any});
  EXPECT_MESSAGE(Draws(many, 1, DrawSource::sobol),
                 "SobolPoints: 3668 dimensions must be from 1 to 3667");
  EXPECT_EQ(message_of([&] { Draws(many, 1); }), "");
  const Draws draws({{"axis", IsotropicDirection{}}}, 1);
  EXPECT_MESSAGE(draws.value(0, 0), "Draws: room for 1 numbers of \"axis\" must be for 3");
}

}  // namespace
