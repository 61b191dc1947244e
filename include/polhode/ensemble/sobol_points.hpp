// SPDX-License-Identifier: MIT
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
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
