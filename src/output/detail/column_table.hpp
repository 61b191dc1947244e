// SPDX-License-Identifier: MIT
// The table of column groups: names, dimensions, and what fills a group: a function, or a chart.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/tables/chart_kind.hpp"

namespace polhode {
inline namespace v0 {

// The state of a row. A motion that is free in inertial axes is there itself, with the numbers, by
// group, of the charts that are constant along it. A system with a damper is that at the rate of
// the row.
struct RowSample {
  const System& system;
  double initial_energy;
  double t;
  RotorState state;
  Vec3 damper_rate = {};
  const FreeRotation* motion = nullptr;
  std::span<const ChartNumbers> constants = {};
};

namespace detail {

using Numbers = ChartNumbers;

// In which rows a column stands.
enum class Shown { always, on_branch, equatorial, not_equatorial };

struct ColumnSpec {
  std::string_view name;
  Dimension dimension = Dimension::number;
  Shown shown = Shown::always;
  std::size_t place = 0;  // among the numbers of the group
};
struct GroupSpec {
  std::string_view name;
  std::vector<ColumnSpec> columns;
  Numbers (*of_row)(const RowSample&);  // null of a chart
  std::optional<ChartKind> chart;
  bool is_constant = false;  // along a motion that is free in inertial axes
  bool is_date = false;
};
Numbers numbers_of(const GroupSpec& group, const RowSample& row);

// In the order of documents.
class ColumnTable {
 public:
  explicit ColumnTable(std::span<const ChartKind> charts);
  std::span<const GroupSpec> groups() const { return groups_; }
  bool is_constant(std::size_t group) const { return groups_[group].is_constant; }

 private:
  std::vector<GroupSpec> groups_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
