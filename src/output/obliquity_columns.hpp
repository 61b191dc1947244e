// SPDX-License-Identifier: MIT
// What a row of a spin axis over ages holds: t, then the groups of columns that a scenario asks
// for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/column_kind.hpp"
#include "polhode/secular/insolation.hpp"
#include "polhode/secular/tides.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// What a row is of.
struct SpinRow {
  secular::TidalSpin axis;
  secular::OrbitElements orbit;
  secular::SpinAngles angles;
  double insolation;
};
SpinRow spin_row(const secular::TidalSpin& axis, const secular::OrbitElements& orbit,
                 const std::optional<secular::InsolationPlace>& place);

struct SpinColumn {
  std::string_view group;
  std::string_view name;
  Dimension dimension;
  double (*value)(const SpinRow&);
  std::string_view unit = {};  // where no dimension says it
};
std::string unit_of(const SpinColumn& column, const Units& units);
// Null where there is no column of that name.
const SpinColumn* spin_column(std::string_view name);
std::vector<std::string_view> spin_column_names();

// The names that [output] columns may list.
std::vector<std::string_view> spin_column_groups();

class SpinLayout {
 public:
  // DomainError for an unknown or repeated group.
  SpinLayout(std::span<const std::string> groups, const Units& units);

  const std::vector<ColumnGroup>& groups() const { return groups_; }
  std::size_t width() const { return cells_.size() + 1; }
  void write(double t, const SpinRow& row, std::span<double> out) const;

 private:
  struct Cell {
    double (*value)(const SpinRow&);
    Dimension dimension;
  };
  std::vector<ColumnGroup> groups_;
  std::vector<Cell> cells_;
  Units units_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
