// SPDX-License-Identifier: MIT
// CounterRandom: random numbers by counter. A number is a function of a seed, a key, a member and
// which of the member's draws it is; nothing is advanced, so that any member can be drawn alone.
//
// Equations   Philox4x64-10 (Salmon, Moraes, Dror and Shaw 2011) of counter (draw / 4, member, 0,
//             0) under key (seed, key): draw has word draw % 4. A key is made of a name by FNV-1a
//             of 64 bits.
// Domain      any seed, key, member and draw.
// Accuracy    the bits are the same on any machine, thread and rank. A uniform number is one of the
//             2^52 odd multiples of 2^-53, so that 1 - u and u - 1/2 are exact.
// Cost        time/number of benchmarks/draws.cpp: four uniform numbers take the time of one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

// The key of what is varied, by its name: FNV-1a of its bytes. It stays as it is for good, since
// members drawn again must be those of before.
constexpr std::uint64_t key_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

// 64 random bits as a number in the open interval (0, 1).
constexpr double open_uniform(std::uint64_t bits) {
  return static_cast<double>(2 * (bits >> 12) + 1) * 0x1p-53;
}

class CounterRandom {
 public:
  constexpr CounterRandom(std::uint64_t seed, std::uint64_t key) : seed_(seed), key_(key) {}

  std::uint64_t bits(std::uint64_t member, std::uint64_t draw) const;
  double uniform(std::uint64_t member, std::uint64_t draw) const {
    return open_uniform(bits(member, draw));
  }
  // Of mean 0 and variance 1, the normal_quantile of the uniform number of this draw.
  double normal(std::uint64_t member, std::uint64_t draw) const;
  // The draws 0, 1, ... of a member.
  void uniforms(std::uint64_t member, std::span<double> u) const;

  // Bits that all members share: counter (draw / 4, 0, 0, 1), which no member has.
  std::uint64_t shared_bits(std::uint64_t draw) const;

 private:
  std::uint64_t seed_;
  std::uint64_t key_;
};

}  // namespace v0
}  // namespace polhode
