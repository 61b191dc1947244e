// SPDX-License-Identifier: MIT
// The table of column groups: names, dimensions, and the function that fills a group.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "polhode/free/serret.hpp"
#include "polhode/output/columns.hpp"

namespace polhode {
inline namespace v0 {

// The state of a row. A motion that is free in inertial axes is there itself, with its elements. A
// system with a damper is that at the rate of the row.
struct RowSample {
  const System& system;
  double initial_energy;
  double t;
  RotorState state;
  Vec3 damper_rate = {};
  const FreeRotation* motion = nullptr;
  const SerretState* elements = nullptr;
};

namespace detail {

constexpr std::size_t widest_group = 8;
using Numbers = std::array<double, widest_group>;

struct ColumnSpec {
  std::string_view name;
  Dimension dimension = Dimension::number;
  bool is_branch = false;
};
struct GroupSpec {
  std::string_view name;
  std::array<ColumnSpec, widest_group> columns;  // an empty name ends them
  Numbers (*numbers)(const RowSample&);
};

std::span<const GroupSpec> column_table();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
