// SPDX-License-Identifier: MIT
// [free], [fit] and [simulate]: what is unknown, how it is looked for, and what simulations add.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/fit/least_squares.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct FreeTable {
  std::vector<std::string> unknowns;

  bool has(std::string_view group) const { return std::ranges::count(unknowns, group) > 0; }
};
SchemaPart free_keys();
Placed<FreeTable> free_table(const FileValues& file);

struct FitTable {
  fit::Loss::Kind loss = fit::Loss::Kind::squared;
  double loss_scale = 1.0;
  int iterations = 0;
  double tolerance = 0.0;
  std::int64_t starts = 1;
  double rate_spread = 0.0, within = 0.0;
  std::size_t most_solutions = 0;
  std::uint64_t seed = 1;

  // Light curves only.
  bool searches = false, is_tumbler = false, one_by_one = false;
  double within_factor = 1.0;
};
struct SimulateTable {
  std::uint64_t seed = 1;
  std::vector<double> sessions;  // begin and end of each
};
SchemaPart fit_keys();
Placed<FitTable> fit_table(const FileValues& file);
Placed<SimulateTable> simulate_table(const FileValues& file);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
