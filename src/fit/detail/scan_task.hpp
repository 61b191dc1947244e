// SPDX-License-Identifier: MIT
// A block of frequency pairs, as the sources of fit/lanes are given it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Points in lanes of eight: those from `count` on have no weight. Points of one group, with a
// constant of its own, stand together: group g has those from starts[g] to starts[g + 1].
struct ScanTable {
  std::size_t count = 0, padded = 0;
  std::vector<double> t;         // from the epoch
  std::vector<double> weight;    // 1 / sigma^2
  std::vector<double> variance;  // sigma^2
  std::vector<double> weighted;  // weight times the value, from the weighted mean of its group
  std::vector<std::size_t> starts;
  std::vector<double> group_weight;
  double total = 0.0;  // sum of weight times value squared

  std::size_t groups() const { return group_weight.size(); }
};

struct ScanBlock {
  const ScanTable* points;
  std::size_t first_order, second_order;  // harmonics of f1 and of f2
  const double* first;                    // f1 of each row
  std::size_t rows;
  const double* second;  // f2 of each column; so many numbers that packs of eight are full
  std::size_t columns;
  double floor;  // least part of a column that is not a sum of those before it
  // rows x columns, by rows; suspect where a column falls below the floor
  double* chi_square;
  std::uint8_t* suspect;
};

// Chi-square of every pair of the block, from the normal equations.
template <InstructionSet isa>
void scan_in_lanes(const ScanBlock& block);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
