// SPDX-License-Identifier: MIT
// What one cell of a map is: the run of an experiment, and the rows that are kept of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/run/map.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The results of a cell, without its axes.
ColumnGroup result_columns(const MapPlan& plan, const Units& units,
                           std::span<const ChartKind> charts);
// A cell that failed has one row of NaN.
MapCell failed_cell(std::size_t width, std::string why);
// A cell: its experiment, and what the map wants of it.
struct CellContext {
  DampedProblem problem;
  const SaveAt& rows;
  const std::vector<ScenarioOrbit>& orbits;
  const MapPlan& plan;
  const Units& units;
  std::span<const ChartKind> charts;
};
MapCell map_cell(const CellContext& of, const Progress& progress);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
