// SPDX-License-Identifier: MIT
// What one cell of a map is: the run of an experiment, and the rows that are kept of it.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/run/map.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The results of a cell, without its axes.
ColumnGroup result_columns(const MapPlan& plan, const Units& units);
// A cell that failed has one row of NaN.
MapCell failed_cell(std::size_t width, std::string why);
// What the map wants of a cell.
struct CellContext {
  const MapPlan& plan;
  const Units& units;
  std::span<const ChartKind> charts;
};
// Of the experiment of a cell, which the map can wrap.
MapCell map_cell(const Rotation& rotation, const CellContext& of, const Progress& progress);
MapCell map_cell(const Obliquity& obliquity, const CellContext& of, const Progress& progress);
MapCell map_cell(const OwnExperiment&, const CellContext& of, const Progress& progress);
// Where the run did not end, why.
MapCell ended(std::vector<double> numbers, const Outcome& outcome, std::size_t width);
// The least, the largest and the last value.
class Extremes {
 public:
  void add(double value) {
    last_ = value;
    if (!(least_ <= last_)) least_ = last_;
    if (!(most_ >= last_)) most_ = last_;
  }
  std::vector<double> in(const Units& units, Dimension dimension) const {
    return {units.from_core(least_, dimension), units.from_core(most_, dimension),
            units.from_core(last_, dimension)};
  }

 private:
  double least_ = std::numeric_limits<double>::quiet_NaN();
  double most_ = least_;
  double last_ = least_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
