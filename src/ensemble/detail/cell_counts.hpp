// SPDX-License-Identifier: MIT
// Counts of many cells as numbers: a run of n empty cells is -n.
#pragma once

#include <cstdint>
#include <vector>

#include "ensemble/detail/number_list.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline void append_cells(std::vector<double>& to, const std::vector<std::int64_t>& cells) {
  double empty = 0.0;
  for (const std::int64_t n : cells) {
    if (n == 0) {
      ++empty;
      continue;
    }
    if (empty > 0.0) to.push_back(-empty);
    empty = 0.0;
    to.push_back(static_cast<double>(n));
  }
  if (empty > 0.0) to.push_back(-empty);
}

// Into cells that are all there; their sum must be `total`.
inline void read_cells(NumberReader& from, std::vector<std::int64_t>& cells, std::int64_t total) {
  std::int64_t left = total;
  for (std::size_t k = 0; k < cells.size();) {
    const auto rest = static_cast<std::int64_t>(cells.size() - k);
    const std::int64_t n = from.integer(-rest);
    if (n < 0) {
      k += static_cast<std::size_t>(-n);
      continue;
    }
    if (n == 0 || n > left)
      from.refuse("a count from 1 to " + std::to_string(left) + ", or a run of empty cells");
    cells[k++] = n;
    left -= n;
  }
  if (left != 0) from.refuse("counts of " + std::to_string(left) + " more");
}

inline void merge_cells(std::vector<std::int64_t>& cells, const std::vector<std::int64_t>& later) {
  for (std::size_t k = 0; k < cells.size(); ++k) cells[k] += later[k];
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
