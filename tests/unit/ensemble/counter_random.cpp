// SPDX-License-Identifier: MIT
// Numbers by counter: the published answers of Random123, one number alone and in a run, and that
// members, keys, draws and seeds have nothing to do with each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "ensemble/detail/philox.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/ensemble/draws.hpp"
#include "polhode/ensemble/executor.hpp"
#include "statistics.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;

constexpr std::uint64_t ones = std::numeric_limits<std::uint64_t>::max();

// Known answers of Random123, file kat_vectors, philox 4x64 of 10 rounds.
TEST(CounterRandom, PhiloxHasThePublishedAnswers) {
  using ensemble::detail::philox;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
            (ensemble::detail::PhiloxCounter{0x16554d9eca36314c, 0xdb20fe9d672d0fdc,
                                             0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
  EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}),
            (ensemble::detail::PhiloxCounter{0x87b092c3013fe90b, 0x438c3c67be8d0224,
                                             0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}));
  EXPECT_EQ(philox({0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
                   {0x452821e638d01377, 0xbe5466cf34e90c6c}),
            (ensemble::detail::PhiloxCounter{0xa528f45403e61d95, 0x38c72dbd566e9788,
                                             0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6}));
}

// So that members drawn by an older version can be drawn again.
TEST(CounterRandom, KeepsItsBits) {
  const ensemble::CounterRandom zero(0, 0);
  EXPECT_EQ(zero.bits(0, 0), 0x16554d9eca36314c);
  EXPECT_EQ(zero.bits(0, 3), 0x7e68b68aec7ba23b);
  const ensemble::CounterRandom random(2029, ensemble::key_of("state.euler.theta"));
  const ensemble::detail::PhiloxKey key{2029, ensemble::key_of("state.euler.theta")};
  EXPECT_EQ(random.bits(123456, 5), ensemble::detail::philox({1, 123456, 0, 0}, key)[1]);
  EXPECT_EQ(random.shared_bits(6), ensemble::detail::philox({1, 0, 0, 1}, key)[2]);
}

// Test vectors of FNV-1a, 64 bits (Fowler, Noll, Vo).
TEST(CounterRandom, KeysAreThePublishedHash) {
  EXPECT_EQ(ensemble::key_of(""), 0xcbf29ce484222325);
  EXPECT_EQ(ensemble::key_of("a"), 0xaf63dc4c8601ec8c);
  EXPECT_EQ(ensemble::key_of("foobar"), 0x85944171f73967e8);
}

TEST(CounterRandom, UniformNumbersAreOddMultiplesOfTwoToMinus53) {
  EXPECT_EQ(ensemble::open_uniform(0), 0x1p-53);
  EXPECT_EQ(ensemble::open_uniform(ones), 1.0 - 0x1p-53);
  EXPECT_EQ(ensemble::open_uniform(std::uint64_t{1} << 63), 0.5 + 0x1p-53);
  for (const std::uint64_t bits : {std::uint64_t{0}, std::uint64_t{12345} << 40, ones})
    EXPECT_EQ(ensemble::open_uniform(~bits), 1.0 - ensemble::open_uniform(bits));
}

TEST(CounterRandom, AMemberAloneIsThatOfARun) {
  const ensemble::CounterRandom random(7, ensemble::key_of("body.moments"));
  constexpr std::size_t members = 5000, draws = 7;
  std::vector<double> run(members * draws);
  ensemble::run_parts(members, 64, 3, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m)
      random.uniforms(m, std::span(run).subspan(m * draws, draws));
  });
  for (std::size_t m = members; m-- > 0;)
    for (std::size_t i = draws; i-- > 0;) {
      ASSERT_EQ(run[m * draws + i], random.uniform(m, i));
      ASSERT_EQ(random.normal(m, i), ensemble::normal_quantile(random.uniform(m, i)));
    }
}

// How the numbers of a member, a key, a draw, a seed are named in what follows.
struct Place {
  std::uint64_t seed, key, member, draw;
  double uniform() const { return ensemble::CounterRandom(seed, key).uniform(member, draw); }
};

// One number for each k.
template <class Where>
std::vector<double> numbers(std::size_t count, const Where& where) {
  std::vector<double> u(count);
  for (std::size_t k = 0; k < count; ++k) u[k] = where(k).uniform();
  return u;
}

// That pairs of numbers fill a square of 16 x 16 cells, and the probability of their correlation.
std::vector<double> of_pairs(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> cells(256), products;
  for (std::size_t i = 0; i < a.size(); ++i) {
    cells[16 * static_cast<std::size_t>(16.0 * a[i]) + static_cast<std::size_t>(16.0 * b[i])] += 1;
    products.push_back((a[i] - 0.5) * (b[i] - 0.5));
  }
  return {evenness(cells), mean_is(products, 0.0)};
}

constexpr std::size_t count = 1 << 14;
constexpr int seeds = 12;

TEST(CounterRandom, NumbersAreUniformAlongEveryCounter) {
  const auto below = [](double u) { return u; };
  expect_as_it_should_be(over_seeds(seeds, [&](std::uint64_t s) {
    return kolmogorov(numbers(count, [&](std::size_t k) { return Place{s, 1, k, 0}; }), below);
  }));
  expect_as_it_should_be(over_seeds(seeds, [&](std::uint64_t s) {
    return kolmogorov(numbers(count, [&](std::size_t k) { return Place{s, 1, 9, k}; }), below);
  }));
  expect_as_it_should_be(over_seeds(seeds, [&](std::uint64_t s) {
    return kolmogorov(numbers(count, [&](std::size_t k) { return Place{s, k, 9, 0}; }), below);
  }));
  expect_as_it_should_be(over_seeds(seeds, [&](std::uint64_t s) {
    return kolmogorov(numbers(count, [&](std::size_t k) { return Place{k, s, 9, 0}; }), below);
  }));
}

// The number at one place beside that at the next one, over all members.
template <class Next>
void expect_independent(const Next& next) {
  std::vector<double> found;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto place = [&](std::size_t k) { return Place{seed, ensemble::key_of("a"), k, 0}; };
    const std::vector<double> a = numbers(count, place);
    const std::vector<double> b = numbers(count, [&](std::size_t k) { return next(place(k)); });
    for (const double p : of_pairs(a, b)) found.push_back(p);
  }
  expect_as_it_should_be(pooled(found));
}

TEST(CounterRandom, NeighboursAreIndependent) {
  expect_independent([](Place p) { return Place{p.seed, p.key, p.member + count, p.draw}; });
  for (const std::uint64_t step : {1u, 2u, 3u, 4u})
    expect_independent([&](Place p) { return Place{p.seed, p.key, p.member, p.draw + step}; });
  expect_independent([](Place p) { return Place{p.seed, p.key + 1, p.member, p.draw}; });
  expect_independent([](Place p) {
    return Place{p.seed, ensemble::key_of("b"), p.member, p.draw};
  });
  expect_independent([](Place p) { return Place{p.seed + 100, p.key, p.member, p.draw}; });
}

// Neighbouring members in one sequence.
TEST(CounterRandom, MembersInARowAreIndependent) {
  std::vector<double> found;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const std::vector<double> u = numbers(2 * count, [&](std::size_t k) {
      return Place{seed, ensemble::key_of("a"), k, 0};
    });
    std::vector<double> even, odd;
    for (std::size_t k = 0; k < u.size(); ++k) (k % 2 == 0 ? even : odd).push_back(u[k]);
    for (const double p : of_pairs(even, odd)) found.push_back(p);
  }
  expect_as_it_should_be(pooled(found));
}

// Each of the 64 bits is set as often as not, and a change of one bit of any counter changes half.
TEST(CounterRandom, EveryBitChangesHalfOfAll) {
  std::vector<double> set(64), changed;
  for (std::uint64_t member = 0; member < count; ++member) {
    const std::uint64_t bits = ensemble::CounterRandom(1, 2).bits(member, 0);
    for (std::size_t i = 0; i < 64; ++i) set[i] += static_cast<double>((bits >> i) & 1);
  }
  double x = 0.0;
  for (const double n : set) x += (n - 0.5 * count) * (n - 0.5 * count) / (0.25 * count);
  expect_as_it_should_be(chi_square_above(x, 64.0));
  for (unsigned i = 0; i < 64; ++i) {
    const std::uint64_t one = std::uint64_t{1} << i;
    for (std::uint64_t k = 0; k < 64; ++k) {
      const std::uint64_t from = ensemble::CounterRandom(k, 2).bits(3, 4);
      for (const std::uint64_t to : {ensemble::CounterRandom(k ^ one, 2).bits(3, 4),
                                     ensemble::CounterRandom(k, 2 ^ one).bits(3, 4),
                                     ensemble::CounterRandom(k, 2).bits(3 ^ one, 4),
                                     ensemble::CounterRandom(k, 2).bits(3, 4 ^ one)})
        changed.push_back(std::popcount(from ^ to));
    }
  }
  expect_as_it_should_be(mean_is(changed, 32.0));
}

}  // namespace
