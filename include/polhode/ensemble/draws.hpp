// SPDX-License-Identifier: MIT
// In this header: counter_random, draw_points, sobol_points, draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "polhode/ensemble/distributions.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace ensemble {

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
  // A standard normal number: the normal_quantile of the uniform number of this draw.
  double normal(std::uint64_t member, std::uint64_t draw) const;
  // The draws 0, 1, ... of a member.
  void uniforms(std::uint64_t member, std::span<double> u) const;

  // Bits that all members share: counter (draw / 4, 0, 0, 1), which no member has.
  std::uint64_t shared_bits(std::uint64_t draw) const;

 private:
  std::uint64_t seed_;
  std::uint64_t key_;
};

// Points that are listed: an even grid over several axes, and the rows of a table of draws.
//
// Equations   point k of an axis is from + k (to - from) / (count - 1), as SaveAt::count has it;
//             the points of a grid are counted with the last axis the fastest, as the cells of a
//             map.
// Units       those of the numbers.
// Domain      1 to 2^53 points; an axis of one point has `from`. Tables of finite numbers, one row
//             or more.
// Accuracy    that of SaveAt; the rows of a table are as given.
// Errors      DomainError names the axis, or the entry, and what it must be; `at` and `row` for an
//             index past the last one.
// Cost        a table is shared by its copies.

struct DrawAxis {
  double from;
  double to;
  std::int64_t count;
};

class DrawGrid {
 public:
  explicit DrawGrid(std::vector<DrawAxis> axes);
  const std::vector<DrawAxis>& axes() const { return axes_; }
  std::uint64_t size() const { return size_; }
  // The point `index`, one number an axis.
  void at(std::uint64_t index, std::span<double> x) const;

 private:
  std::vector<DrawAxis> axes_;
  std::vector<SaveAt> points_;  // of each axis
  std::uint64_t size_ = 1;
};

// Rows of a file for members: row k for member k, or a random row for each, with replacement.
enum class RowOrder { in_order, with_replacement };

class DrawTable {
 public:
  // Row by row.
  DrawTable(std::size_t columns, std::vector<double> numbers, RowOrder order);
  std::size_t columns() const { return columns_; }
  std::uint64_t rows() const { return numbers_->size() / columns_; }
  RowOrder order() const { return order_; }
  std::span<const double> row(std::uint64_t index) const;
  std::span<const double> from_uniform(double u) const;

 private:
  std::size_t columns_;
  std::shared_ptr<const std::vector<double>> numbers_;
  RowOrder order_;
};

// Sobol's points by their index: they fill a cube more evenly than random ones, so that means over
// them converge faster.
//
// Equations   bits of point n in a dimension: the direction numbers at the bits of the Gray code of
//             n, added without carry; numbers of Joe and Kuo (2008), as Boost.Random has them.
//             Point 0 is 0, and 2^k points from a multiple of 2^k on are a net. A digital shift
//             adds bits that are the same for all points, without carry: each point is then
//             uniform.
// Units       none: 64 bits a number, to be taken by open_uniform.
// Domain      1 to `most_dimensions` dimensions, any index.
// Accuracy    exact.
// Errors      DomainError names the number of dimensions and the largest.
// Cost        one addition for each bit of the Gray code of n, ten for a million points; 512 bytes
//             a dimension.

class SobolPoints {
 public:
  static const std::size_t most_dimensions;  // 3667 with Boost's table

  explicit SobolPoints(std::size_t dimensions);
  std::size_t dimensions() const { return directions_.size() / 64; }
  std::uint64_t bits(std::uint64_t index, std::size_t dimension) const {
    std::uint64_t sum = 0;
    const std::uint64_t* direction = directions_.data() + 64 * dimension;
    for (std::uint64_t gray = index ^ (index >> 1); gray != 0; gray >>= 1, ++direction)
      sum ^= *direction & (0 - (gray & 1));
    return sum;
  }

 private:
  std::vector<std::uint64_t> directions_;  // 64 of each dimension
};

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

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
