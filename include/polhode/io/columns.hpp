// SPDX-License-Identifier: MIT
// What a row of output holds: t, then the column groups that a scenario asks for.
//
// Equations   those of the charts.
// Units       each column in the units of the scenario (polhode/io/units.hpp); names and units in
//             groups().
// Domain      one symbol, one number: a column that two groups share (h, G, H of andoyer and
//             serret) is in the first of them only. With a full tensor q, omega and g refer to its
//             axes, everything else to principal axes.
// Accuracy    that of FreeRotation and of the charts.
// Errors      DomainError for an unknown or repeated group.
// Cost        one evaluation of the motion per row, and one conversion per chart.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/free/free_rotation.hpp"
#include "polhode/io/units.hpp"

namespace polhode {
inline namespace v0 {

struct RowSample;

struct Column {
  std::string name;
  std::string unit;
};
struct ColumnGroup {
  std::string name;
  std::vector<Column> columns;
};

// The names that [output] columns may list.
std::vector<std::string_view> column_group_names();

class RowLayout {
 public:
  RowLayout(std::span<const std::string> groups, const Units& units);

  // "t" first, then as asked for, without columns that an earlier group has.
  const std::vector<ColumnGroup>& groups() const { return groups_; }
  std::size_t width() const { return width_; }
  // Writes width() numbers per time to out. Serret's elements, constants of the motion, are those
  // at the epoch in every row: t0 does not jump by a period.
  void write_rows(const FreeRotation& motion, std::span<const double> times,
                  std::span<double> out) const;

 private:
  void write_row(const RowSample& sample, std::span<double> out) const;

  struct Cell {
    std::size_t group;  // in the table of groups
    std::size_t index;  // in that group
    Dimension dimension;
  };
  std::vector<ColumnGroup> groups_;
  std::vector<Cell> cells_;
  std::size_t width_ = 0;
  Units units_;
};

}  // namespace v0
}  // namespace polhode
