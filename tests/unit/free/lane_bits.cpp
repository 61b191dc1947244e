// SPDX-License-Identifier: MIT
// What lanes compute has the same bits on every processor: checksums of results, which x86-64 and
// AArch64 share. States and times are drawn without a function of the C library.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <vector>

#include "polhode/free/free_rotation.hpp"
#include "polhode/free/propagate.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/many_states.hpp"

namespace {

using namespace polhode;

constexpr std::size_t count = 1000;

// FNV-1a of the numbers' bytes, the least significant first.
template <class State>
std::uint64_t checksum(const std::vector<State>& states) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const State& s : states) {
    std::uint64_t words[sizeof(State) / 8];
    std::memcpy(words, &s, sizeof s);
    for (const std::uint64_t word : words)
      for (int k = 0; k < 64; k += 8) hash = (hash ^ (word >> k & 0xff)) * 0x100000001b3;
  }
  return hash;
}

struct Sample {
  std::vector<RotorState> states;
  std::vector<double> times;
};
const Sample& sample() {
  static const Sample drawn = [] {
    std::mt19937_64 engine(36);
    const auto number = [&] { return std::ldexp(static_cast<double>(engine() >> 11U), -52) - 1.0; };
    Sample s;
    for (std::size_t i = 0; i < count; ++i) {
      s.states.push_back(
          {{number(), number(), number(), number()}, {number(), number(), number()}});
      s.times.push_back(100.0 * number());
    }
    return s;
  }();
  return drawn;
}

const Body body(1.0, 1.7, 2.1);

TEST(LaneBits, OfFreeRotation) {
  std::vector<RotorState> results(count);
  EXPECT_TRUE(propagate({&body, 1}, sample().states, sample().times, 0.25, results).empty());
  EXPECT_EQ(checksum(results), 0x3bb3858f028abc2du);
  const FreeRotation motion(body, {{0.9, 0.1, -0.3, 0.2}, {0.2, 0.4, 0.89}});
  motion.at(sample().times, results);
  EXPECT_EQ(checksum(results), 0x7fdd8040d2bb1466u);
  motion.at(TimeGrid{-3.5, 0.0625}, results, 10);
  EXPECT_EQ(checksum(results), 0xfa302809a5fa327eu);
}

TEST(LaneBits, OfCanonicalCharts) {
  std::vector<RotorState> results(count);
  std::vector<AndoyerState> andoyer(count);
  to_andoyer(sample().states, andoyer);
  EXPECT_EQ(checksum(andoyer), 0xad21a44bd037ab9eu);
  to_rotor(andoyer, results);
  EXPECT_EQ(checksum(results), 0x5412885f1dae4e44u);
  std::vector<EulerState> euler(count);
  to_euler(sample().states, euler);
  EXPECT_EQ(checksum(euler), 0x4cdcc98ee9f643e5u);
  to_rotor(euler, results);
  EXPECT_EQ(checksum(results), 0x7571d817d05f62c1u);
  std::vector<PoincareState> poincare(count);
  nearest_poincare(sample().states, poincare);
  EXPECT_EQ(checksum(poincare), 0x2321d97f51ad1f42u);
  to_rotor(poincare, results);
  EXPECT_EQ(checksum(results), 0x88655792e8b3d4d4u);
}

TEST(LaneBits, OfFlowCharts) {
  std::vector<RotorState> results(count);
  std::vector<SadovState> sadov(count);
  to_sadov(body, sample().states, sadov);
  EXPECT_EQ(checksum(sadov), 0x91b7bebd41feb44eu);
  to_rotor(body, sadov, results);
  EXPECT_EQ(checksum(results), 0x54885447fd69fc66u);
  std::vector<SerretState> serret(count);
  to_serret(body, sample().states, sample().times, serret);
  EXPECT_EQ(checksum(serret), 0x6c6085bcac35cbb0u);
  to_rotor(body, serret, sample().times, results);
  EXPECT_EQ(checksum(results), 0x004ad82905e8332cu);
}

}  // namespace
