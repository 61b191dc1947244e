// SPDX-License-Identifier: MIT
// Batches on several threads: the bits and the errors of one.
#include "polhode/ensemble/batches.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"

namespace {

using namespace polhode;

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

std::vector<RotorState> drawn_states(std::size_t count) {
  std::mt19937_64 random(36);
  std::normal_distribution<double> normal;
  std::vector<RotorState> states;
  for (std::size_t i = 0; i < count; ++i)
    states.push_back({{normal(random), normal(random), normal(random), normal(random)},
                      {normal(random), normal(random), normal(random)}});
  return states;
}

std::vector<double> some_times(std::size_t count) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = 0.37 * static_cast<double>(i);
  return times;
}

const Body body(0.9, 1.0, 1.1);

TEST(Parts, AreTheWholeOnceInOrder) {
  for (const std::size_t size : {0u, 1u, 1023u, 1024u, 2047u, 2048u, 5000u, 300000u})
    for (const int threads : {1, 2, 3, 8}) {
      std::vector<int> seen(size, 0);
      std::size_t next = 0;
      ensemble::run_parts(
          size, 1024, threads,
          [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) ++seen[i];
            return end;
          },
          [&](std::size_t begin, std::size_t end) {
            EXPECT_EQ(begin, next);
            next = end;
          });
      EXPECT_EQ(next, size);
      EXPECT_EQ(std::accumulate(seen.begin(), seen.end(), std::size_t{0}), size);
    }
}

TEST(Parts, AreManyEnoughAndLongEnough) {
  EXPECT_EQ(ensemble::parts_for(1'000'000, 1024, 1).count, 1);
  EXPECT_EQ(ensemble::parts_for(1'000'000, 1024, 2).count, 32);
  EXPECT_EQ(ensemble::parts_for(1'000'000, 1024, 2).each % 1024, 0u);
  EXPECT_EQ(ensemble::parts_for(3000, 1024, 8).count, 3);
  EXPECT_EQ(ensemble::parts_for(1500, 1024, 8).count, 1);
  EXPECT_EQ(ensemble::parts_for(0, 1024, 2).count, 0);
  EXPECT_THROW(ensemble::parts_for(10, 1, 0), DomainError);
}

TEST(Batches, HaveTheBitsOfOneThread) {
  constexpr std::size_t n = 200'003;
  const std::vector<RotorState> states = drawn_states(n);
  const std::vector<double> times = some_times(n);
  const FreeKernel kernel = FreeRotation(body, states[0]).kernel();
  const auto results = [&](int threads) {
    std::vector<RotorState> all(5 * n);
    const auto room = [&](std::size_t k) { return std::span(all).subspan(k * n, n); };
    EXPECT_TRUE(ensemble::propagate({&body, 1}, states, times, 0.5, room(0), threads).empty());
    ensemble::states_at(kernel, times, room(1), threads);
    ensemble::states_on_grid(kernel, {0.25, 0.01}, 77, room(2), threads);
    std::vector<AndoyerState> andoyer(n);
    ensemble::to_andoyer(states, andoyer, threads);
    ensemble::to_rotor(andoyer, room(3), threads);
    std::vector<EulerState> euler(n);
    ensemble::to_euler(states, euler, threads);
    ensemble::to_rotor(euler, room(4), threads);
    return all;
  };
  const std::vector<RotorState> alone = results(1);
  for (const int threads : {2, 3}) EXPECT_TRUE(same_bits(results(threads), alone)) << threads;
}

TEST(Batches, FlowChartsHaveTheBitsOfOneThread) {
  const std::vector<RotorState> states = drawn_states(40'000);
  std::vector<SadovState> alone(states.size()), together(states.size());
  ensemble::to_sadov(body, states, alone, 1);
  ensemble::to_sadov(body, states, together, 2);
  EXPECT_EQ(alone, together);
  std::vector<RotorState> back(states.size()), back_together(states.size());
  ensemble::to_rotor(body, alone, back, 1);
  ensemble::to_rotor(body, alone, back_together, 2);
  EXPECT_TRUE(same_bits(back, back_together));
  const std::vector<double> times = some_times(states.size());
  std::vector<SerretState> serret(states.size()), serret_together(states.size());
  ensemble::to_serret(body, states, times, serret, 1);
  ensemble::to_serret(body, states, times, serret_together, 2);
  EXPECT_EQ(serret, serret_together);
  ensemble::to_rotor(body, serret, times, back, 1);
  ensemble::to_rotor(body, serret, times, back_together, 2);
  EXPECT_TRUE(same_bits(back, back_together));
}

TEST(Batches, BodiesThatFailAreNamedInOrder) {
  constexpr std::size_t n = 50'000;
  std::vector<RotorState> states = drawn_states(n);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const std::size_t bad : {49'999u, 17u, 30'000u}) states[bad].g.x = infinite;
  const double time = 1.0;
  for (const int threads : {1, 2, 8}) {
    std::vector<RotorState> results(n);
    const auto failed = ensemble::propagate({&body, 1}, states, {&time, 1}, 0.0, results, threads);
    ASSERT_EQ(failed.size(), 3u);
    EXPECT_EQ(failed[0].index, 17u);
    EXPECT_EQ(failed[1].index, 30'000u);
    EXPECT_EQ(failed[2].index, 49'999u);
    EXPECT_NE(failed[0].reason.find("finite"), std::string::npos) << failed[0].reason;
    std::vector<SadovState> sadov(n);
    const std::string message =
        test::message_of([&] { ensemble::to_sadov(body, states, sadov, threads); });
    EXPECT_NE(message.find("(state 17)"), std::string::npos) << message;
  }
}

TEST(Batches, RefuseWhatOneThreadRefuses) {
  const std::vector<RotorState> states = drawn_states(10);
  std::vector<RotorState> results(9);
  std::vector<AndoyerState> andoyer(9);
  const std::vector<double> times = some_times(10);
  const FreeKernel kernel = FreeRotation(body, states[0]).kernel();
  EXPECT_THROW(ensemble::propagate({&body, 1}, states, times, 0.0, results, 2), DomainError);
  EXPECT_THROW(ensemble::states_at(kernel, times, results, 2), DomainError);
  EXPECT_THROW(ensemble::to_andoyer(states, andoyer, 2), DomainError);
  EXPECT_THROW(ensemble::states_on_grid(kernel, {}, (std::uint64_t{1} << 53) - 8, results, 2),
               DomainError);
  EXPECT_THROW(ensemble::states_at(kernel, std::span(times).first(9), results, 0), DomainError);
}

}  // namespace
