// SPDX-License-Identifier: MIT
// Draws: what the members of an ensemble differ in. A list of varied keys, each with its
// distribution; the numbers of any member and key, alone and in any order.
//
// Equations   the distribution of a key (distributions.hpp, draw_points.hpp) at uniform numbers of
//             CounterRandom(seed, key_of(name)), or at Sobol's point of the member's index, shifted
//             by shared_bits of the same.
// Units       those of the distributions.
// Domain      any member; of a table in order, as many as it has rows. Members past the last point
//             of a grid begin it again. With Sobol's points a key has dimensions of its own, those
//             after the keys before it.
// Accuracy    that of the distributions. The numbers of a key do not depend on the other keys; with
//             Sobol's points not on those after it.
// Errors      DomainError for a name that is empty or comes twice, for more Sobol dimensions than
//             there are, for a member past the last row, and for too few or too many numbers.
// Cost        time/number of benchmarks/draws.cpp. Nothing is changed by a draw: share one among
//             threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "polhode/ensemble/counter_random.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/ensemble/draw_points.hpp"
#include "polhode/ensemble/sobol_points.hpp"

namespace polhode {
inline namespace v0 {

using Distribution = std::variant<Uniform, LogUniform, Normal, TruncatedNormal, JointNormal,
                                  IsotropicDirection, UniformAttitude, DrawGrid, DrawTable>;

// How many numbers a draw has: 3 of a direction, 4 (w, x, y, z) of an attitude.
std::size_t numbers_of(const Distribution& distribution);
// How many uniform numbers it takes: 2, 3; none of a grid and of a table in order.
std::size_t uniforms_of(const Distribution& distribution);
// The numbers of a member by as many uniform ones.
void draw(const Distribution& distribution, std::uint64_t member, std::span<const double> u,
          std::span<double> x);

struct Varied {
  std::string name;
  Distribution distribution;
};

enum class DrawSource { random, sobol };

class Draws {
 public:
  Draws(std::vector<Varied> varied, std::uint64_t seed, DrawSource source = DrawSource::random);
  const std::vector<Varied>& varied() const { return varied_; }
  // How many members there can be: the rows of the shortest table in order; else 2^64 - 1.
  std::uint64_t most_members() const { return most_members_; }

  // numbers_of the key's distribution.
  void values(std::uint64_t member, std::size_t key, std::span<double> x) const;
  std::vector<double> values(std::uint64_t member, std::size_t key) const;
  // Of a distribution of one number.
  double value(std::uint64_t member, std::size_t key) const;

 private:
  struct Source {
    CounterRandom random;
    std::size_t dimension;              // the first of its own
    std::vector<std::uint64_t> shifts;  // of each of these
  };
  void uniforms(std::uint64_t member, std::size_t key, std::span<double> u) const;

  std::vector<Varied> varied_;
  std::vector<Source> sources_;
  std::optional<SobolPoints> points_;
  std::uint64_t most_members_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace v0
}  // namespace polhode
